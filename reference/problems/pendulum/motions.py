"""The pendulum's closed forms, one for each motion: libration, rotation, separatrix.

With s = sin(theta0/2), c = cos(theta0/2), w = sqrt(g/l), p = omega0/(2 w), u = w t and k^2 = s^2 + p^2, every motion is

    sin(theta/2) = (p c S + s C D)/(1 - s^2 S^2),     cos(theta/2) = (c D - s p S C)/(1 - s^2 S^2),
    theta' = 2 w (p C - s c S D)/(1 - s^2 S^2),       S, C, D = sn, cn, dn(u | k^2):

Jacobi's addition theorem (DLMF 22.8.1-3) spares the phase of the start.  Libration has k < 1; rotation has k > 1, with
S, C, D by the reciprocal modulus (DLMF 22.17.2-4); on the separatrix k = 1.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.arithmetic import quadrature
from reference.arithmetic.dual import DualArithmetic
from reference.arithmetic.precision import mp
from reference.declaration import ClosedForm
from reference.problems.pendulum.equations import condition, energy

if TYPE_CHECKING:
    from reference.arithmetic.protocols import EllipticArithmetic

__all__ = [
    "BY_QUADRATURE",
    "CLOSED_FORMS",
    "Libration",
    "Motion",
    "QuadratureLibration",
    "QuadratureRotation",
    "Rest",
    "Rotation",
    "Separatrix",
    "addition",
]

HALF = Fraction(1, 2)


def addition(s: Any, c: Any, p: Any, sn: Any, cn: Any, dn: Any) -> tuple[Any, Any, Any, Any]:
    """The orbit u after the point (s, c, p): sin(theta/2), cos(theta/2) and theta'/(2 w) over one scale, and this."""
    rise, speed, fall = s * sn, p * cn, c * dn
    return p * c * sn + s * cn * dn, fall - rise * speed, speed - rise * fall, 1 - rise * rise


class Motion(ClosedForm):
    """What all motions share: the constants of the orbit once, then any time.

    ``turns`` is the whole number of turns in theta0: s and c are of the rest, which lies within pi.
    """

    def __init__(self, m: EllipticArithmetic, theta0: Any, omega0: Any, g: Any, length: Any, turns: int) -> None:
        self.m: EllipticArithmetic = m
        self.theta0, self.omega0, self.g, self.length, self.turns = theta0, omega0, g, length, turns
        self.half = theta0 / 2 - turns * m.pi() if turns else theta0 / 2
        self.s, self.c = m.sin(self.half), m.cos(self.half)
        self.w = m.sqrt(g / length)
        self.p = omega0 / (2 * self.w)
        self._known_duals: dict[int, tuple[DualArithmetic, Motion]] = {}

    @property
    def energy(self) -> Any:
        """The energy at the start, which the motion keeps."""
        return energy(self.m, self.theta0, self.omega0, self.g, self.length)

    def functions(self, u: Any) -> tuple[Any, Any, Any]:
        """(sn, cn, dn)(u) of the motion's own modulus."""
        raise NotImplementedError

    def turns_at(self, t: Any) -> Any:
        """Whole turns from the start's turn to the turn at t: |theta/2 - (turns + these) pi| < pi/2."""
        del t
        return 0

    def state(self, t: Any) -> tuple[Any, Any]:
        """(theta, theta') at t."""
        sine, cosine, rate, scale = addition(self.s, self.c, self.p, *self.functions(self.w * t))
        half = self.m.atan(sine / cosine)
        return 2 * half + 2 * self.m.pi() * (self.turns + self.turns_at(t)), 2 * self.w * rate / scale

    def gradient(self, t: Any) -> tuple[Any, ...]:
        """d(theta, theta')/d(theta0, omega0, g, l) at fixed t: the four of theta, then those of theta'."""
        return self._slopes(4, t)

    def sensitivity(self, t: Any) -> tuple[Any, ...]:
        """d(theta, theta')/dtheta0 at fixed t."""
        return self._slopes(1, t)

    def curvature(self, t: Any) -> tuple[Any, ...]:
        """d^2(theta, theta')/dtheta0^2 at fixed t."""
        m, motion = self._duals(1)
        return tuple(slope.slopes[0] for slope in motion._slopes(1, m.constant(t)))  # noqa: SLF001 - our own kind

    def condition(self, t: Any) -> Any:
        """How much an error of the start has grown by t, at most."""
        return condition(self.m, self.w, *self._slopes(2, t))

    def _slopes(self, width: int, t: Any) -> tuple[Any, ...]:
        """The slopes of theta, then of theta', by the first ``width`` of theta0, omega0, g and l."""
        m, motion = self._duals(width)
        theta, omega = motion.state(m.constant(t))
        return *theta.slopes, *omega.slopes

    def _duals(self, width: int) -> tuple[DualArithmetic, Motion]:
        """The same motion in dual numbers, with slopes by the first ``width`` of theta0, omega0, g and l."""
        if width not in self._known_duals:
            m = DualArithmetic(self.m, width)
            theta0, omega0, g, length = (
                m.variable(value, place) if place < width else m.constant(value)
                for place, value in enumerate((self.theta0, self.omega0, self.g, self.length))
            )
            self._known_duals[width] = m, type(self)(m, theta0, omega0, g, length, self.turns)
        return self._known_duals[width]


class Libration(Motion):
    """k = sqrt(s^2 + p^2) < 1: the amplitude is 2 asin k, the period T = 4 K/w."""

    def __init__(self, m: EllipticArithmetic, theta0: Any, omega0: Any, g: Any, length: Any, turns: int) -> None:
        super().__init__(m, theta0, omega0, g, length, turns)
        self.modulus = m.sqrt(self.s**2 + self.p**2)
        self.complementary_modulus = m.sqrt((self.c - self.p) * (self.c + self.p))
        self.elliptic = m.elliptic(self.modulus, self.complementary_modulus)
        self.functions = self.elliptic.functions  # type: ignore[method-assign]

    @property
    def period(self) -> Any:
        return 4 * self.elliptic.first / self.w

    @property
    def dperiod_damplitude(self) -> Any:
        """dT/d(amplitude) = 2 (E - kc^2 K)/(w k kc), from dK/dk (DLMF 19.4.1)."""
        k, kc = self.modulus, self.complementary_modulus
        return 2 * (self.elliptic.second() - kc * kc * self.elliptic.first) / (self.w * k * kc)

    @property
    def d2period_damplitude2(self) -> Any:
        """d^2 T/d(amplitude)^2, of a release from rest at theta0 = +-amplitude."""
        _, motion = self._duals(1)
        by_start = motion.dperiod_damplitude.slopes[0]  # type: ignore[attr-defined]
        return by_start if self.s > 0 else -by_start

    @property
    def phase(self) -> Any:
        """u since the last upward passage through the bottom: sn = s/k, cn = p/k there; within 2K."""
        if self.omega0 == 0:
            return self.elliptic.first * (1 if self.s > 0 else -1)
        return self.elliptic.incomplete(self.m.atan2(self.s, self.p))

    def zero_crossing(self, j: int) -> Any:
        """The time at which theta passes its mean value for the (j + 1)-th time after the start, j = 0, 1, ..."""
        if self.theta0 == 0:
            return 2 * self.elliptic.first * (j + 1) / self.w
        return (2 * self.elliptic.first * (j + (1 if self.s > 0 else 0)) - self.phase) / self.w

    def turning_point(self, j: int) -> Any:
        """The time at which theta' = 0 for the (j + 1)-th time after the start, j = 0, 1, ..."""
        upward, beyond = self.omega0 > 0, self.s > 0 or self.theta0 == 0
        first = 0 if upward or (self.omega0 == 0 and not beyond) else 1 if beyond else -1
        return ((2 * (j + first) + 1) * self.elliptic.first - self.phase) / self.w


class Rotation(Motion):
    """k = sqrt(s^2 + p^2) > 1: one turn takes T = 2 K(1/k)/(w k)."""

    def __init__(self, m: EllipticArithmetic, theta0: Any, omega0: Any, g: Any, length: Any, turns: int) -> None:
        super().__init__(m, theta0, omega0, g, length, turns)
        self.modulus = m.sqrt(self.s**2 + self.p**2)
        self.direction = 1 if omega0 > 0 else -1
        excess = m.sqrt((self.p - self.c) * (self.p + self.c))
        self.elliptic = m.elliptic(1 / self.modulus, excess / self.modulus)

    @property
    def turn(self) -> Any:
        """The time of one turn."""
        return 2 * self.elliptic.first / (self.w * self.modulus)

    @property
    def period(self) -> Any:
        return self.turn

    @property
    def passed(self) -> Any:
        """The time since the pendulum hung at the bottom of the start's turn, negative where it is still to come."""
        return self.direction * self.elliptic.incomplete(self.half) / (self.w * self.modulus)

    def functions(self, u: Any) -> tuple[Any, Any, Any]:
        sn, cn, dn = self.elliptic.functions(self.modulus * u)
        return sn / self.modulus, dn, cn

    def turns_at(self, t: Any) -> Any:
        return self.direction * self.m.floor((t + self.passed) / self.turn + self.m.number(HALF))

    def zero_crossing(self, j: int) -> Any:
        """The time at which the pendulum hangs at the bottom for the (j + 1)-th time after the start, j = 0, 1, ..."""
        ahead = self.direction * self.half < 0
        return self.period * (j + (0 if ahead else 1)) - self.passed


class Separatrix(Motion):
    """k = 1: sn u = tanh u, cn u = dn u = sech u; from the bottom towards the top, which it never reaches."""

    def functions(self, u: Any) -> tuple[Any, Any, Any]:
        """To first order in 1 - k^2, which is zero here and whose slopes are not (Abramowitz and Stegun 16.15)."""
        excess = (self.c - self.p) * (self.c + self.p) / 4
        sinh, cosh = self.m.sinh(u), self.m.cosh(u)
        sn, cn = sinh / cosh, 1 / cosh
        return (
            sn + excess * (sinh * cosh - u) * cn * cn,
            cn - excess * (sinh * cosh - u) * sn * cn,
            cn + excess * (sinh * cosh + u) * sn * cn,
        )


class Rest(Motion):
    """The linearised pendulum, theta'' = -(g/l) theta: exact at rest, and to first order about it."""

    def state(self, t: Any) -> tuple[Any, Any]:
        """(theta, theta') at t."""
        sine, cosine = self.m.sin(self.w * t), self.m.cos(self.w * t)
        return self.theta0 * cosine + self.omega0 / self.w * sine, self.omega0 * cosine - self.theta0 * self.w * sine


class QuadratureLibration(Libration):
    """The closed form by mpmath's elliptic functions, and the period from its integral.

    T = (8/w) times the integral of (1 + kc^2 sinh^2 x)^(-1/2) over 0 <= x <= asinh(kc^(-1/2)): K's integrand after
    tan phi = sinh x, halved by the symmetry u -> K - u; analytic on the closed interval for every amplitude.
    """

    @property
    def period(self) -> Any:
        return 4 * complete_integral(self.complementary_modulus) / self.w


class QuadratureRotation(Rotation):
    """The same for rotation: T = 2 K(1/k)/(w k), K from its integral."""

    @property
    def period(self) -> Any:
        return (
            2
            * complete_integral(self.m.sqrt((self.p - self.c) * (self.p + self.c)) / self.modulus)
            / (self.w * self.modulus)
        )


def complete_integral(kc: Any) -> Any:
    """K as twice the integral of (1 + kc^2 sinh^2 x)^(-1/2) over 0 <= x <= asinh(kc^(-1/2))."""
    return 2 * quadrature.integral(lambda x: 1 / mp.sqrt(1 + (kc * mp.sinh(x)) ** 2), 0, mp.asinh(1 / mp.sqrt(kc)))


CLOSED_FORMS: dict[str, type[Motion]] = {
    "libration": Libration,
    "rotation": Rotation,
    "separatrix": Separatrix,
    "rest": Rest,
}
BY_QUADRATURE: dict[str, type[Motion]] = {
    **CLOSED_FORMS,
    "libration": QuadratureLibration,
    "rotation": QuadratureRotation,
}
