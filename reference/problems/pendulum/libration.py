"""Libration from rest, by the three routes.

With k = sin(theta0/2), kc = cos(theta0/2), omega0 = sqrt(g/l) and u = omega0 t, the closed form is in Jacobi's elliptic
functions of modulus k; see P. F. Byrd and M. D. Friedman, Handbook of Elliptic Integrals (1971), and DLMF chapter 22.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from mpmath import mp

from reference.arithmetic import MPMATH, EllipticArithmetic
from reference.problem import ClosedForm
from reference.problems.pendulum.equations import energy
from reference.routes import quadrature
from reference.routes.taylor import Flow

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction

    from reference.problems.pendulum.problem import Pendulum

__all__ = ["Libration", "QuadratureLibration", "TaylorLibration"]


class Libration(ClosedForm):
    """The closed form in one arithmetic: constants of the orbit once, then any time.

    theta(t) = 2 atan(tan(theta0/2) cn u),   theta'(t) = -2 k kc omega0 sn u / dn u,   T = 4 K / omega0
    """

    def __init__(self, m: EllipticArithmetic, theta0: Any, g: Any, length: Any) -> None:
        self.m: EllipticArithmetic = m
        self.theta0, self.g, self.length = theta0, g, length
        self.modulus = m.sin(theta0 / 2)
        self.complementary_modulus = m.cos(theta0 / 2)
        self.omega0 = m.sqrt(g / length)
        self.elliptic = m.elliptic(self.modulus, self.complementary_modulus)
        self._tangent = m.tan(theta0 / 2)

    @property
    def period(self) -> Any:
        return 4 * self.elliptic.first / self.omega0

    @property
    def energy(self) -> Any:
        """The energy at the start, which the motion keeps."""
        return energy(self.m, self.theta0, 0, self.g, self.length)

    @property
    def dperiod_damplitude(self) -> Any:
        """dT/dtheta0 = 2 (E - kc^2 K)/(omega0 k kc), from dK/dk (DLMF 19.4.1)."""
        k, kc = self.modulus, self.complementary_modulus
        return 2 * (self.elliptic.second() - kc * kc * self.elliptic.first) / (self.omega0 * k * kc)

    def zero_crossing(self, j: int) -> Any:
        """The time (2j + 1) T/4 at which theta = 0 for the (j + 1)-th time, j = 0, 1, ..."""
        return (2 * j + 1) * self.period / 4

    def turning_point(self, j: int) -> Any:
        """The time (j + 1) T/2 at which theta' = 0 for the (j + 1)-th time after the start, j = 0, 1, ..."""
        return (j + 1) * self.period / 2

    def state(self, t: Any) -> tuple[Any, Any]:
        """(theta, theta') at t."""
        sn, cn, dn = self.elliptic.functions(self.omega0 * t)
        scale = 2 * self.modulus * self.complementary_modulus * self.omega0
        return 2 * self.m.atan(self._tangent * cn), -scale * sn / dn

    def sensitivity(self, t: Any) -> tuple[Any, Any]:
        """(dtheta/dtheta0, dtheta'/dtheta0) at fixed t.

        With B = E(am u) - kc^2 u - k^2 sn cn/dn, from dcn/dk (Byrd and Friedman 710.52):
        dtheta/dtheta0 = cn/dn^2 + B sn/dn, and its derivative by t.
        """
        u = self.omega0 * t
        sn, cn, dn = self.elliptic.functions(u)
        kk, kkc = self.modulus**2, self.complementary_modulus**2
        b = self.elliptic.epsilon(u) - kkc * u - kk * sn * cn / dn
        db = dn * dn - kkc - kk * (cn * cn - sn * sn + kk * (sn * cn / dn) ** 2)
        rate = -sn / dn + 2 * kk * sn * cn * cn / dn**3 + b * cn / dn**2 + db * sn / dn
        return cn / dn**2 + b * sn / dn, self.omega0 * rate


class QuadratureLibration(Libration):
    """The closed form by mpmath's elliptic functions, and the period from its integral.

    T = (8/omega0) times the integral of (1 + kc^2 sinh^2 s)^(-1/2) over 0 <= s <= asinh(kc^(-1/2)): K's integrand
    after tan phi = sinh s, halved by the symmetry u -> K - u; analytic on the closed interval for every amplitude.
    """

    @property
    def period(self) -> Any:
        kc = self.complementary_modulus
        half = quadrature.integral(lambda s: 1 / mp.sqrt(1 + (kc * mp.sinh(s)) ** 2), 0, mp.asinh(1 / mp.sqrt(kc)))
        return 8 / self.omega0 * half


class TaylorLibration:
    """The rows that the flow of the equation of motion gives by itself."""

    def __init__(self, problem: Pendulum, bits: int) -> None:
        self._problem, self._flow = problem, Flow(problem, bits)
        self._period = float(problem.period())

    def rows(self, row: str, arguments: Sequence[Any]) -> list[tuple[Fraction, ...]]:
        if row == "state":
            return self._flow.at(arguments)
        if row == "sensitivity":
            return [state[2:] for state in self._flow.at(arguments, ("theta",))]
        if row in {"zero_crossing", "turning_point"}:
            component = ("zero_crossing", "turning_point").index(row)
            return self._crossings(component, arguments, (2 * max(arguments) + 2 + component) / 4)
        quarter = self._crossings(0, [0], 0.5)[0][0]
        if row == "period":
            return [(4 * quarter,)]
        ((theta, omega, dtheta, _),) = self._flow.at([quarter], ("theta",))
        if row == "dperiod_damplitude":
            return [(-4 * dtheta / omega,)]
        return [(self._energy(theta, omega),)]

    def _crossings(self, component: int, indices: Sequence[int], periods: float) -> list[tuple[Fraction, ...]]:
        times = self._flow.zeros(component, periods * self._period)
        return [(times[index],) for index in indices]

    def _energy(self, theta: Fraction, omega: Fraction) -> Fraction:
        numbers = [MPMATH.number(value) for value in (theta, omega, self._problem.g, self._problem.length)]
        return quadrature.to_fraction(energy(MPMATH, *numbers))
