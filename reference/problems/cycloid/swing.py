"""The swing on a cycloid in closed form, by the arc length and by the angle, in balls and in mpmath.

With w = sqrt(g/(4 R)) the arc length from the bottom is s = s(0) cos(w t), whatever s(0).  As s = 4 R sin(theta/2),
with S = sin(theta(0)/2) and K = cos(theta(0)/2)

    tan(theta/2) = S cos(w t)/D,     theta' = -2 w S sin(w t)/D,     D = cos(theta/2) = sqrt(K^2 + S^2 sin^2(w t)),

where no digit cancels, however near to the cusp the start is.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from reference.arithmetic import quadrature
from reference.arithmetic.precision import mp
from reference.declaration import ClosedForm
from reference.problems.cycloid.equations import arc_energy, arc_frequency, point_from_bottom, swing_energy

if TYPE_CHECKING:
    from reference.arithmetic.protocols import EllipticArithmetic

__all__ = ["ArcSwing", "QuadratureArcSwing", "QuadratureSwing", "Swing"]


class Clock(ClosedForm):
    """The times, which no start changes."""

    def __init__(self, m: EllipticArithmetic, radius: Any, g: Any) -> None:
        self.m: EllipticArithmetic = m
        self.radius, self.g = radius, g
        self.frequency = arc_frequency(m, radius, g)

    @property
    def descent_time(self) -> Any:
        return self.m.pi() / (2 * self.frequency)

    @property
    def period(self) -> Any:
        return 4 * self.descent_time

    def turned(self, t: Any) -> tuple[Any, Any]:
        """sin and cos of w t."""
        return self.m.sin(self.frequency * t), self.m.cos(self.frequency * t)


class QuadratureClock(Clock):
    """The times by an integral.

    From the height h0 to the bottom it is that of ds/sqrt(2 g (h0 - h)), s = sqrt(8 R h).  With h = h0 v the start
    drops out of it: sqrt(R/g) dv/sqrt(v (1 - v)), 0 <= v <= 1, twice that of 0 <= v <= 1/2, where v = u^2/2.
    """

    @property
    def descent_time(self) -> Any:
        mean = quadrature.integral(lambda u: 1 / mp.sqrt(1 - u * u / 2), mp.mpf(0), mp.mpf(1))
        return mp.sqrt(8 * self.radius / self.g) * mean


class ArcSwing(Clock):
    """s = s(0) cos(w t)."""

    def __init__(self, m: EllipticArithmetic, arc: Any, radius: Any, g: Any) -> None:
        super().__init__(m, radius, g)
        self.start = arc

    @property
    def energy(self) -> Any:
        """Of the start."""
        return arc_energy(self.start, 0, self.radius, self.g)

    def state(self, t: Any) -> tuple[Any, Any]:
        """(s, s')."""
        sine, cosine = self.turned(t)
        return self.start * cosine, -self.start * self.frequency * sine


class QuadratureArcSwing(QuadratureClock, ArcSwing):
    """The same with the times by an integral, and the motion as that of a point on a circle."""

    def state(self, t: Any) -> tuple[Any, Any]:
        turned = self.start * mp.expj(self.frequency * t)
        return turned.real, -self.frequency * turned.imag


class Swing(Clock):
    """By the angle theta."""

    def __init__(self, m: EllipticArithmetic, angle: Any, radius: Any, g: Any) -> None:
        super().__init__(m, radius, g)
        self.angle = angle
        self.sine, self.cosine = m.sin(angle / 2), m.cos(angle / 2)

    @property
    def energy(self) -> Any:
        """Of the start."""
        return swing_energy(self.m, self.angle, 0, self.radius, self.g)

    def state(self, t: Any) -> tuple[Any, Any]:
        """(theta, theta')."""
        sine, cosine = self.turned(t)
        upright = self.m.sqrt(self.cosine**2 + (self.sine * sine) ** 2)
        return 2 * self.m.atan2(self.sine * cosine, upright), -2 * self.frequency * self.sine * sine / upright

    def position(self, t: Any) -> tuple[Any, Any]:
        """(x, y), y upward from the bottom."""
        return point_from_bottom(self.m, self.state(t)[0], self.radius)

    def arc(self, t: Any) -> tuple[Any, Any]:
        """(s, s')."""
        sine, cosine = self.turned(t)
        start = 4 * self.radius * self.sine
        return start * cosine, -start * self.frequency * sine


class QuadratureSwing(QuadratureClock, Swing):
    """The same with the times by an integral, and the angle as the textbooks have it, by its sine."""

    @property
    def energy(self) -> Any:
        return arc_energy(4 * self.radius * self.sine, 0, self.radius, self.g)

    def state(self, t: Any) -> tuple[Any, Any]:
        sine, cosine = self.turned(t)
        half = mp.asin(self.sine * cosine)
        return 2 * half, -2 * self.frequency * self.sine * sine / mp.cos(half)

    def position(self, t: Any) -> tuple[Any, Any]:
        """The height by the arc, s^2/(8 R)."""
        angle, (arc, _) = self.state(t)[0], self.arc(t)
        return self.radius * (angle + mp.sin(angle)), arc * arc / (8 * self.radius)
