"""The linearised pendulum theta'' = -(g/l) theta: what the pendulum is at small angles, and nowhere else."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar

from reference.arithmetic import quadrature
from reference.arithmetic.exact import as_number, exact
from reference.arithmetic.limbs import BINARY64_BITS
from reference.arithmetic.namespaces import BALL, MPMATH
from reference.arithmetic.precision import mp
from reference.declaration import ENERGY_ABOVE_REST
from reference.once import cached_property
from reference.orbits import HarmonicOrbits
from reference.problem import APART, SeparableProblem
from reference.problems.pendulum.equations import ABOUT_REST, SWING, of_the_start
from reference.problems.pendulum.motions import Rest
from reference.problems.pendulum.quantities import LINEAR_ROWS
from reference.problems.pendulum.taylor import TAYLOR_RADIANS, a_radian
from reference.routes.taylor import Along, Period

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from reference.arithmetic.protocols import Arithmetic, EllipticArithmetic
    from reference.certified import Certified
    from reference.declaration import Invariant, Row, StateSpace, Trial
    from reference.input_condition import InputCondition
    from reference.orbits import Orbits
    from reference.routes.taylor import Reading

__all__ = ["LinearPendulum", "linear_acceleration", "linear_energy"]


def linear_acceleration(theta: Any, g: Any, length: Any) -> Any:
    """theta'' = -(g/l) theta, in rad/s^2."""
    return -(g / length) * theta


def linear_energy(theta: Any, omega: Any, g: Any, length: Any) -> Any:
    """(theta'^2 + (g/l) theta^2)/2: the energy per m l^2, in 1/s^2, zero at rest."""
    return (omega * omega + g / length * theta * theta) / 2


@dataclass(frozen=True, repr=False)
class LinearPendulum(SeparableProblem):
    """The linearised pendulum theta'' = -(g/length) theta from any start.

    Args:
        theta0: angle of the start in rad.
        g: acceleration of gravity in m/s^2, positive.
        length: length in m, positive.
        omega0: angular velocity of the start in rad/s.

    Each is exact: a float at its binary64 value, a string or Fraction as the rational it spells.

    Raises:
        ValueError: a parameter is outside its range or not finite.
        TypeError: a parameter is no real number.
    """

    theta0: Fraction
    g: Fraction
    length: Fraction
    omega0: Fraction

    name: ClassVar[str] = "linear pendulum"
    rows: ClassVar[tuple[Row, ...]] = LINEAR_ROWS
    space: ClassVar[StateSpace] = SWING
    invariants: ClassVar[tuple[Invariant, ...]] = (ENERGY_ABOVE_REST,)
    trial: ClassVar[Trial] = ABOUT_REST
    by_flow: ClassVar[Mapping[str, Reading]] = {
        "state": Along(),
        "energy": Along(lambda route, state: linear_energy(*state, **route.parameters), at=a_radian),
        "period": Period(lambda _m, y: y[0], per_period=2),
    }

    def __init__(self, theta0: Any, g: Any = 9.81, length: Any = 1.0, omega0: Any = 0) -> None:
        for name, value in (("theta0", theta0), ("g", g), ("length", length), ("omega0", omega0)):
            object.__setattr__(self, name, exact(value, name))
        for name in ("g", "length"):
            if getattr(self, name) <= 0:
                raise ValueError(f"{name} is {as_number(getattr(self, name))}; a positive number is accepted.")

    def __repr__(self) -> str:
        inputs = (f"{name}={as_number(getattr(self, name))!r}" for name in ("theta0", "g", "length", "omega0"))
        return f"LinearPendulum({', '.join(inputs)})"

    @property
    def _at_rest(self) -> bool:
        return self.theta0 == self.omega0 == 0

    @property
    def parameters(self) -> dict[str, Fraction]:
        return {"g": self.g, "length": self.length}

    @property
    def start(self) -> tuple[Fraction, ...]:
        return self.theta0, self.omega0

    @property
    def equation(self) -> str:
        """theta'' = -(g/length) theta, and its start."""
        return "theta'' = -(g/length) theta, theta(0) = theta0, theta'(0) = omega0"

    @property
    def inputs(self) -> dict[str, tuple[Any, str]]:
        return of_the_start(self.theta0, self.omega0)

    def time_units(self) -> dict[str, float]:
        """Its period, and sqrt(length/g), in which its equation is without numbers."""
        return {**super().time_units(), "units of sqrt(length/g)": math.sqrt(self.length / self.g)}

    @staticmethod
    def velocity(m: Arithmetic, momenta: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """theta' = omega."""
        return (momenta[0],)

    @staticmethod
    def force(m: Arithmetic, t: Any, positions: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """omega' = -(g/l) theta."""
        return (linear_acceleration(positions[0], p["g"], p["length"]),)

    @staticmethod
    def invariant(m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The energy per m l^2, in 1/s^2."""
        return linear_energy(y[0], y[1], p["g"], p["length"])

    def rate(self) -> float:
        """sqrt(g/l)."""
        with mp.workprec(BINARY64_BITS):
            return float(mp.sqrt(MPMATH.number(self.g / self.length)))

    def neighbour(self, rounding: Callable[[Fraction], Fraction], epsilon: Fraction) -> LinearPendulum:
        """The pendulum whose start is nearer to rest by 2^-36, or by 16 roundings."""
        nearer = 1 - max(APART, 16 * epsilon)
        return LinearPendulum(rounding(self.theta0 * nearer), self.g, self.length, rounding(self.omega0 * nearer))

    def orbits(self) -> Orbits:
        return HarmonicOrbits(self.start, (BALL.number(self.g) / BALL.number(self.length)).sqrt())

    def input_condition(self) -> InputCondition:
        from reference.problems.pendulum.input_condition import LinearCondition

        return LinearCondition(self)

    @property
    def lacks_of_orbits(self) -> str:
        return ""

    def closed_form(self, m: EllipticArithmetic) -> Linear:
        """Cosine and sine, in balls or in mpmath."""
        return Linear(m, *self._numbers(m))

    def quadrature_form(self) -> MatrixExponential:
        """The matrix exponential by its power series, and the period from an integral."""
        return MatrixExponential(MPMATH, *self._numbers(MPMATH))

    def _numbers(self, m: Any) -> tuple[Any, ...]:
        return (*(m.number(value) for value in (self.theta0, self.omega0, self.g, self.length)), 0)

    def within_taylor(self, row: str, arguments: Sequence[Any]) -> bool:
        """Whether every time lies in 0 <= sqrt(g/l) t <= TAYLOR_RADIANS; a pendulum at rest shows no period."""
        if row == "period" and self._at_rest:
            return False
        times = [t for t in arguments if isinstance(t, Fraction)]
        return all(t >= 0 and t * t * self.g / self.length <= TAYLOR_RADIANS**2 for t in times)

    def exact_row(self, row: str, argument: Any) -> tuple[Fraction, ...] | None:
        """The energy, and the start: at any other time the state is transcendental (Lindemann), unless it is rest."""
        if row == "energy":
            return (linear_energy(self.theta0, self.omega0, self.g, self.length),)
        return self.start if row == "state" and (argument == 0 or self._at_rest) else None

    def working_bits(self, arguments: Sequence[Any]) -> int:
        latest = max((abs(t) for t in arguments if isinstance(t, Fraction)), default=Fraction(0))
        return int(latest * (1 + self.g / self.length)).bit_length()

    def period(self) -> Certified:
        """T = 2 pi sqrt(l/g) in s, whatever the amplitude."""
        return self.certified("period")

    def energy(self) -> Certified:
        """E = (omega0^2 + (g/l) theta0^2)/2, the energy per m l^2 in 1/s^2."""
        return self.certified("energy")


class Linear(Rest):
    """The closed form."""

    @property
    def period(self) -> Any:
        return 2 * self.m.pi() / self.w

    @property
    def energy(self) -> Any:
        return linear_energy(self.theta0, self.omega0, self.g, self.length)


class MatrixExponential(Linear):
    """The same without a cosine: exp(A t) of the equation's matrix A; T = (8/w) times the integral of 1/(1 + x^2)."""

    @cached_property
    def period(self) -> Any:
        return 8 / self.w * quadrature.integral(lambda x: 1 / (1 + x * x), 0, 1)

    def state(self, t: Any) -> tuple[Any, Any]:
        """(theta, theta') at t, by less than a period of the exponential's power series."""
        rest = t - mp.nint(t / self.period) * self.period
        moved = mp.expm(mp.matrix([[0, rest], [-rest * self.w**2, 0]]), method="taylor")
        theta, omega = moved * mp.matrix([self.theta0, self.omega0])
        return theta, omega
