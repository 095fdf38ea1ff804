"""The mathematical pendulum, released from rest.

    theta'' = -(g/l) sin theta,     theta(0) = theta0 in (0, pi),  theta'(0) = 0

theta is the angle from the lower rest position in rad, g the acceleration of gravity in m/s^2, l the length in m,
t the time in s.  Closed form in Jacobi's elliptic functions of modulus k = sin(theta0/2), with u = omega0 t and
omega0 = sqrt(g/l); see P. F. Byrd and M. D. Friedman, Handbook of Elliptic Integrals (1971), and DLMF chapter 22.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar

from flint import arb, ctx, fmpq
from mpmath import mp

from reference.arithmetic import BALL, MPMATH, Arithmetic, EllipticArithmetic
from reference.exact import as_number, exact
from reference.limbs import ziv
from reference.problem import ClosedForm, Quantity, Row, SeparableProblem
from reference.routes import quadrature
from reference.routes.taylor import Flow

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.certify import Certified

__all__ = ["Pendulum"]


def angular_acceleration(m: Arithmetic, theta: Any, g: Any, length: Any) -> Any:
    """theta'' = -(g/l) sin theta, in rad/s^2."""
    return -(g / length) * m.sin(theta)


def energy(m: Arithmetic, theta: Any, omega: Any, g: Any, length: Any) -> Any:
    """E = theta'^2/2 - (g/l) cos theta: the energy per m l^2, in 1/s^2."""
    return omega * omega / 2 - g / length * m.cos(theta)


def energy_above_rest(m: Arithmetic, theta: Any, omega: Any, g: Any, length: Any) -> Any:
    """E - Emin = theta'^2/2 + 2 (g/l) sin^2(theta/2), in 1/s^2; without the cancellation of E + g/l."""
    half = m.sin(theta / 2)
    return omega * omega / 2 + 2 * (g / length) * half * half


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


THETA = Quantity("theta", "rad", "angle from the lower rest position", "theta = 2 atan(tan(theta0/2) cn(u, k))")
OMEGA = Quantity("omega", "rad s-1", "angular velocity", "omega = dtheta/dt = -2 k kc omega0 sn(u, k)/dn(u, k)")
ROWS = (
    Row("state", (THETA, OMEGA), "time"),
    Row(
        "sensitivity",
        (
            Quantity(
                "dtheta_damplitude", "1", "sensitivity of the angle to the amplitude", "dtheta/dtheta0 at fixed t"
            ),
            Quantity(
                "domega_damplitude", "s-1", "sensitivity of the velocity to the amplitude", "domega/dtheta0 at fixed t"
            ),
        ),
        "time",
    ),
    Row("period", (Quantity("period", "s", "period", "T = 4 K(k)/omega0, omega0 = sqrt(g/l)"),), "once"),
    Row(
        "energy",
        (Quantity("energy", "s-2", "energy per m l^2", "E = omega^2/2 - (g/l) cos(theta) = -(g/l) cos(theta0)"),),
        "once",
    ),
    Row("modulus", (Quantity("modulus", "1", "elliptic modulus", "k = sin(theta0/2)"),), "once"),
    Row(
        "complementary_modulus",
        (Quantity("complementary_modulus", "1", "complementary elliptic modulus", "kc = cos(theta0/2)"),),
        "once",
    ),
    Row(
        "dperiod_damplitude",
        (Quantity("dperiod_damplitude", "s rad-1", "sensitivity of the period to the amplitude", "dT/dtheta0"),),
        "once",
    ),
    Row(
        "zero_crossing",
        (Quantity("zero_crossing", "s", "times at which theta = 0", "t[j] = (2 j + 1) T/4, j = 0, 1, ..."),),
        "index",
    ),
    Row(
        "turning_point",
        (
            Quantity(
                "turning_point", "s", "times at which omega = 0 after the start", "t[j] = (j + 1) T/2, j = 0, 1, ..."
            ),
        ),
        "index",
    ),
)
NOT_BY_TAYLOR = ("modulus", "complementary_modulus")
TAYLOR_RADIANS = 4000
"""The Taylor route serves times up to omega0 t = TAYLOR_RADIANS: beyond, its work would grow without bound."""
TAYLOR_BITS = 1024
"""The Taylor route serves amplitudes that need at most this working precision."""
MAX_EVENTS = 100_000


@dataclass(frozen=True)
class Events:
    """Proven times in s: where theta = 0, and where theta' = 0 after the start."""

    zero_crossings: tuple[Certified, ...]
    turning_points: tuple[Certified, ...]


@dataclass(frozen=True, repr=False)
class Pendulum(SeparableProblem):
    """The pendulum released from rest at ``theta0``: theta'' = -(g/length) sin theta.

    Args:
        theta0: amplitude in rad, 0 < theta0 < pi.
        g: acceleration of gravity in m/s^2, positive.
        length: length in m, positive.

    Each is exact: a float at its binary64 value, a string or Fraction as the rational it spells.

    Raises:
        ValueError: a parameter is outside its range or not finite.
        TypeError: a parameter is no real number.
    """

    theta0: Fraction
    g: Fraction
    length: Fraction

    name: ClassVar[str] = "pendulum"
    rows: ClassVar[tuple[Row, ...]] = ROWS
    state_names: ClassVar[tuple[str, ...]] = ("theta", "omega")
    positions: ClassVar[int] = 1

    def __init__(self, theta0: Any, g: Any = 9.81, length: Any = 1.0) -> None:
        for name, value in (("theta0", theta0), ("g", g), ("length", length)):
            object.__setattr__(self, name, exact(value, name))
        if not 0 < self.theta0 < 4 or not _below_pi(self.theta0):
            raise ValueError(f"theta0 is {as_number(self.theta0)}; an amplitude with 0 < theta0 < pi is accepted.")
        for name in ("g", "length"):
            if getattr(self, name) <= 0:
                raise ValueError(f"{name} is {as_number(getattr(self, name))}; a positive number is accepted.")

    def __repr__(self) -> str:
        return (
            f"Pendulum(theta0={as_number(self.theta0)!r}, g={as_number(self.g)!r}, length={as_number(self.length)!r})"
        )

    @property
    def parameters(self) -> dict[str, Fraction]:
        return {"g": self.g, "length": self.length}

    @property
    def start(self) -> tuple[Fraction, ...]:
        return self.theta0, Fraction(0)

    @staticmethod
    def velocity(m: Arithmetic, momenta: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:  # noqa: ARG004
        """theta' = omega."""
        return (momenta[0],)

    @staticmethod
    def force(m: Arithmetic, positions: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """omega' = -(g/l) sin theta."""
        return (angular_acceleration(m, positions[0], p["g"], p["length"]),)

    @staticmethod
    def invariant(m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The energy above rest, per m l^2, in 1/s^2."""
        return energy_above_rest(m, y[0], y[1], p["g"], p["length"])

    def rate(self) -> float:
        """omega0: |d(omega')/d(theta)| <= omega0^2."""
        return float(mp.sqrt(MPMATH.number(self.g / self.length)))

    def neighbour(self, rounding: Callable[[Fraction], Fraction]) -> Pendulum:
        """The pendulum from theta0 less 2^-20 of its distance to the nearer of 0 and pi."""
        edge = min(self.theta0, max(Fraction(math.pi) - self.theta0, Fraction(1, 1 << 60)))
        return Pendulum(rounding(self.theta0 - edge / (1 << 20)), self.g, self.length)

    def closed_form(self, m: EllipticArithmetic) -> Libration:
        """The closed form in balls or in mpmath."""
        return Libration(m, m.number(self.theta0), m.number(self.g), m.number(self.length))

    def exact_row(self, row: str, argument: Any) -> tuple[Fraction, ...] | None:
        if argument != 0 or isinstance(argument, int):
            return None
        at_start = {"state": self.start, "sensitivity": (Fraction(1), Fraction(0))}
        return at_start.get(row)

    def working_bits(self, arguments: Sequence[Any]) -> int:
        times = [abs(t) for t in arguments if isinstance(t, Fraction)]
        turns = max(times, default=Fraction(0)) * (1 + self.g / self.length)
        return int(turns).bit_length() + 2 * self._edge_bits

    @property
    def _edge_bits(self) -> int:
        """About -log2 of the distance from theta0 to the nearer of 0 and pi, where digits cancel."""
        with ctx.workprec(4096):
            edge = min(_ball(self.theta0), arb.pi() - _ball(self.theta0)).mid().man_exp()
        return max(0, -(int(edge[0]).bit_length() + int(edge[1])))

    def by_route(
        self, route: str, row: str, arguments: Sequence[Any], digits: int
    ) -> list[tuple[Fraction, ...]] | None:
        bits = int(digits * 3.33) + 2 * self.working_bits(arguments) + 30
        if route == "quadrature":
            return quadrature.rows(lambda: QuadratureLibration(MPMATH, *self._numbers()), row, arguments, bits)
        times = [t for t in arguments if isinstance(t, Fraction)]
        too_long = any(t < 0 or t * t * self.g / self.length > TAYLOR_RADIANS**2 for t in times)
        if row in NOT_BY_TAYLOR or too_long or bits > TAYLOR_BITS:
            return None
        with mp.workprec(bits):
            return TaylorLibration(self, bits).rows(row, arguments)

    def _numbers(self) -> tuple[Any, ...]:
        return MPMATH.number(self.theta0), MPMATH.number(self.g), MPMATH.number(self.length)

    def period(self) -> Certified:
        """T = 4 K(sin(theta0/2)) sqrt(l/g), in s."""
        return self.certified("period")

    def energy(self) -> Certified:
        """E = -(g/l) cos theta0, the energy per m l^2 in 1/s^2."""
        return self.certified("energy")

    def events(self, until: Any) -> Events:
        """The zero crossings (2j + 1) T/4 and turning points j T/2, j = 1, 2, ..., in (0, until].

        Raises:
            ValueError: ``until`` is negative or not finite, or the events before it are more than MAX_EVENTS.
        """
        end = exact(until, "until")
        if end < 0:
            raise ValueError(f"until is {as_number(end)}; a time that is not negative is accepted.")
        count = self._quarters(end)
        if count > MAX_EVENTS:
            raise ValueError(
                f"until is {as_number(end)}, with {count} events before it; at most {MAX_EVENTS} are accepted."
            )
        return Events(
            tuple(self.certified("zero_crossing", j) for j in range((count + 1) // 2)),
            tuple(self.certified("turning_point", j) for j in range(count // 2)),
        )

    def _quarters(self, end: Fraction) -> int:
        """floor(4 end/T), decided in balls."""
        if end == 0:
            return 0

        def floors(_rows: Sequence[int]) -> Sequence[Sequence[arb]]:
            return [[4 * BALL.number(end) / self.closed_form(BALL).period]]

        def whole(quarters: arb) -> int | None:
            floor = quarters.floor().unique_fmpz()
            return None if floor is None else int(floor)

        return ziv(floors, whole, 1, 128 + self.working_bits([end]), f"the number of events of {self!r}")[0][0]


def _ball(value: Fraction) -> arb:
    return arb(fmpq(value.numerator, value.denominator))


def _below_pi(value: Fraction) -> bool:
    """Decide value < pi; a rational is never equal to it."""
    bits = 128
    while True:
        with ctx.workprec(bits):
            gap = arb.pi() - _ball(value)
            if not gap.contains(0):
                return bool(gap > 0)
        bits *= 2
