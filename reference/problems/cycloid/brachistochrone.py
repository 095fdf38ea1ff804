"""The brachistochrone to an end point in closed form, in balls and, by other formulas, in mpmath.

With p = dy/dx at the end point (x_B, y_B), p = cot(theta_B/2): it obeys

    (1 + p^2) acot(p) - p = x_B/y_B,     0 < acot(p) < pi,

whose left side is convex and falls from infinity to 0, and R = y_B (1 + p^2)/2: nothing cancels where the end point is
almost level with the start (p -> -infinity), and where it is almost below it (p -> infinity) only the left side does.
That side is less than 2/(3 p) for p > 0 and more than p^2 for p < 0, which gives the bracket.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.arithmetic import quadrature
from reference.arithmetic.precision import mp
from reference.declaration import ClosedForm
from reference.problems.cycloid.equations import arc_frequency, excess, point_below_cusp, slowness

if TYPE_CHECKING:
    from collections.abc import Callable

    from reference.arithmetic.protocols import CalculusArithmetic

__all__ = ["Brachistochrone", "QuadratureBrachistochrone"]


def end_ratio(m: CalculusArithmetic, slope: Any) -> Any:
    """x_B/y_B of a cycloid with the slope dy/dx at B, which falls as the slope rises."""
    return (1 + slope * slope) * (m.pi() / 2 - m.atan(slope)) - slope


class Brachistochrone(ClosedForm):
    """The cycloid through the end point: its constants once, then any time, fraction or neighbour."""

    def __init__(self, m: CalculusArithmetic, end_x: Any, end_y: Any, g: Any) -> None:
        self.m: CalculusArithmetic = m
        self.end_x, self.end_y, self.g = end_x, end_y, g
        self.half, self.radius = self._solved()
        self.end_angle = 2 * self.half
        self.rate = m.sqrt(g / self.radius)

    def _solved(self) -> tuple[Any, Any]:
        """(theta_B/2, R)."""
        m, ratio = self.m, self.end_x / self.end_y
        slope = m.root(lambda m, p: end_ratio(m, p) - ratio, -m.sqrt(ratio), 2 / (3 * ratio))
        return m.atan2(m.number(Fraction(1)), slope), self.end_y * (1 + slope * slope) / 2

    @property
    def descent_time(self) -> Any:
        return self.end_angle / self.rate

    @property
    def arc_length(self) -> Any:
        """4 R (1 - cos(theta_B/2)) = y_B/cos^2(theta_B/4)."""
        return self.end_y / self.m.cos(self.half / 2) ** 2

    @property
    def chord_time(self) -> Any:
        return self.m.sqrt(2 * (self.end_x * self.end_x + self.end_y * self.end_y) / (self.g * self.end_y))

    @property
    def chord_gap(self) -> Any:
        return self.chord_time - self.descent_time

    def curve(self, fraction: Any) -> tuple[Any, Any]:
        """(x, y) after a fraction of the time, which is the same fraction of the angle."""
        return point_below_cusp(self.m, fraction * self.end_angle, self.radius)

    def arc(self, fraction: Any) -> tuple[Any, Any]:
        """(x, y) after a fraction of the arc: sin^2(theta/4) is that fraction of sin^2(theta_B/4)."""
        m, quarter = self.m, self.half / 2
        sine = m.sqrt(fraction) * m.sin(quarter)
        cosine = m.sqrt(1 - fraction + fraction * m.cos(quarter) ** 2)
        return point_below_cusp(m, 4 * m.atan2(sine, cosine), self.radius)

    def state(self, t: Any) -> tuple[Any, Any]:
        """(s, s'): the bead swings from cusp to cusp."""
        m, quarter = self.m, self.rate * t / 4
        return 8 * self.radius * m.sin(quarter) ** 2, 2 * self.radius * self.rate * m.sin(2 * quarter)

    def position(self, t: Any) -> tuple[Any, Any]:
        """(x, y) at s(t), with theta/2 within [0, pi]."""
        m, half = self.m, arc_frequency(self.m, self.radius, self.g) * t
        return point_below_cusp(m, 2 * m.atan2(abs(m.sin(half)), m.cos(half)), self.radius)

    def neighbour_gap(self, epsilon: Any) -> Any:
        pi, half = self.m.pi(), self.half
        zero, one = (self.m.number(Fraction(whole)) for whole in (0, 1))
        mean = self.m.integral(lambda m, f: excess(m, f, half, pi, epsilon), zero, one)
        return self.descent_time * epsilon * epsilon / 2 * mean


class QuadratureBrachistochrone(Brachistochrone):
    """The same in mpmath: another equation for another unknown, and every time and length as its own integral."""

    def _solved(self) -> tuple[Any, Any]:
        """(b - sin b cos b)/sin^2 b = x_B/y_B, b = theta_B/2."""
        ratio = self.end_x / self.end_y
        bracket = mp.atan2(1, 2 / (3 * ratio)), mp.atan2(1, -mp.sqrt(ratio))

        def missed(half: Any) -> Any:
            return half - mp.sin(half) * mp.cos(half) - ratio * mp.sin(half) ** 2

        half = mp.findroot(missed, bracket, solver="anderson", verify=False, maxsteps=mp.prec)
        return half, self.end_y / (2 * mp.sin(half) ** 2)

    @property
    def descent_time(self) -> Any:
        """The integral of ds/sqrt(2 g y), y = s - s^2/(8 R), s = arc u^2; beyond the bottom by symmetry."""
        bottom, arc = 4 * self.radius, self.arc_length

        def until(arc: Any) -> Any:
            mean = self._mean(lambda u: 1 / mp.sqrt(1 - arc / (2 * bottom) * u * u))
            return mp.sqrt(2 * arc / self.g) * mean

        return until(arc) if arc <= bottom else 2 * until(bottom) - until(2 * bottom - arc)

    @property
    def arc_length(self) -> Any:
        """The integral of 4 R sin(b) db."""
        half = self.half
        return 4 * self.radius * half**2 * self._mean(lambda v: v * mp.sinc(half * v))

    def _mean(self, function: Callable[[Any], Any]) -> Any:
        """Over [0, 1]; of the order of 1, as the rule's error estimate wants it."""
        return quadrature.integral(function, mp.mpf(0), mp.mpf(1))

    def arc(self, fraction: Any) -> tuple[Any, Any]:
        """By the angle whose cosine is 1 - s/(4 R)."""
        half = mp.acos(1 - fraction * (1 - mp.cos(self.half)))
        return point_below_cusp(self.m, 2 * half, self.radius)

    def state(self, t: Any) -> tuple[Any, Any]:
        """s'' = g - (g/(4 R)) s from rest at the cusp."""
        frequency = arc_frequency(self.m, self.radius, self.g)
        return (
            4 * self.radius * (1 - mp.cos(frequency * t)),
            4 * self.radius * frequency * mp.sin(frequency * t),
        )

    def position(self, t: Any) -> tuple[Any, Any]:
        """x as the integral of 4 R sin^2(b) db."""
        half = mp.acos(mp.cos(arc_frequency(self.m, self.radius, self.g) * t))
        x = 4 * self.radius * half**3 * self._mean(lambda v: (v * mp.sinc(half * v)) ** 2)
        return x, self.radius * (1 - mp.cos(2 * half))

    def neighbour_gap(self, epsilon: Any) -> Any:
        """T_epsilon - T with no digit saved."""
        mean = self._mean(lambda fraction: slowness(self.m, fraction, self.half, mp.pi, epsilon))
        return self.end_angle / self.rate * (mean - 1)
