"""The tautochrone, Huygens' pendulum, as a problem: by its angle, and by its arc length."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar

from reference.arithmetic.exact import as_number, exact
from reference.arithmetic.limbs import Interval, interval, ziv
from reference.arithmetic.namespaces import BALL, MPMATH
from reference.arithmetic.precision import mp
from reference.declaration import ENERGY_ABOVE_REST, Form, StateSpace, Trial
from reference.once import cached_property
from reference.orbits import HarmonicOrbits
from reference.problem import APART, Problem, SeparableProblem
from reference.problems.cycloid.equations import (
    ARC_SPACE,
    ARC_TRIAL,
    angular_acceleration,
    arc_acceleration,
    arc_energy,
    arc_frequency,
    swing_energy,
)
from reference.problems.cycloid.orbits import CycloidOrbits
from reference.problems.cycloid.quantities import PENDULUM_ROWS, SWING_ROWS, exponent, positive_number
from reference.problems.cycloid.swing import ArcSwing, QuadratureArcSwing, QuadratureSwing, Swing
from reference.problems.cycloid.taylor import PENDULUM_BY_FLOW, SWING_BY_FLOW

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from flint import arb

    from reference.arithmetic.protocols import Arithmetic, EllipticArithmetic
    from reference.certified import Certified
    from reference.declaration import Invariant, Row
    from reference.orbits import Orbits
    from reference.routes.taylor import Reading

__all__ = ["CycloidalPendulum", "Swinging", "Tautochrone"]

DECISION_BITS = 128
TAYLOR_WORK = 500
"""The Taylor route serves what takes at most this: w t, times the bits of the distance from the cusp, beside which the
steps are short, times the square of the precision in units of what 60 digits take.  Some seconds."""
ZERO = Fraction(0)


class Swinging(Problem):
    """What the angle and the arc length have in common."""

    radius: Fraction
    g: Fraction

    @property
    def parameters(self) -> dict[str, Fraction]:
        return {"radius": self.radius, "g": self.g}

    @property
    def cusp_bits(self) -> int:
        """About -log2 of the distance of the start's angle from the cusp."""
        return 0

    @property
    def rest_bits(self) -> int:
        """About -log2 of the distance of the start from rest, which heyoka's absolute tolerance must resolve."""
        return max(0, 1 - exponent(abs(self.start[0])))

    def quadrature_form(self) -> Swing | ArcSwing:
        """The closed form in mpmath, with the times by an integral."""
        raise NotImplementedError

    @property
    def lacks_of_orbits(self) -> str:
        return ""

    def _w(self) -> arb:
        """w in balls."""
        return (BALL.number(self.g) / BALL.number(self.radius)).sqrt() / 2

    def frequency(self) -> float:
        """w = sqrt(g/(4 R)) in rad/s."""
        return float(arc_frequency(MPMATH, MPMATH.number(self.radius), MPMATH.number(self.g)))

    def within_taylor(self, row: str, arguments: Sequence[Any]) -> bool:
        """Whether no time is negative and the latest is within TAYLOR_WORK; a period takes three quarters of itself."""
        times = arguments if self.row(row).over == "time" else [Fraction(3 * float(self.descent_time()))]
        words = 1 + self.working_bits(times) / 128
        latest = TAYLOR_WORK / ((1 + self.cusp_bits) * words**2 * self.frequency())
        return all(0 <= t <= latest for t in times)

    def exact_row(self, row: str, argument: Any) -> tuple[Fraction | None, ...] | None:
        """The start, and the rate of the arc length there: at rest."""
        if argument != 0:
            return None
        return {"state": self.start, "arc": (None, ZERO)}.get(row)

    def working_bits(self, arguments: Sequence[Any]) -> int:
        times = [abs(t) for t in arguments if t is not None]
        turns = max(times, default=ZERO) * (1 + self.g / self.radius)
        return int(turns).bit_length() + self.cusp_bits + self.rest_bits

    def descent_time(self) -> Certified:
        """pi sqrt(R/g) in s: from every start to the bottom."""
        return self.certified("descent_time")

    def period(self) -> Certified:
        """4 pi sqrt(R/g) in s."""
        return self.certified("period")

    def energy(self) -> Certified:
        """Kinetic and potential energy per mass above rest at the bottom, in m^2/s^2."""
        return self.certified("energy")


@dataclass(frozen=True, repr=False)
class Tautochrone(Swinging):
    """A bead released from rest on the cycloid x = R (theta + sin theta), height R (1 - cos theta).

    It is at the bottom after pi sqrt(R/g), wherever it starts: 2 asin(sin(angle/2) cos(sqrt(g/(4 R)) t)) is the angle.
    By the theorem of Lindemann and Weierstrass neither angle, velocity nor position is rational, but at the start.

    Args:
        angle: theta at the start in rad, 0 < |angle| < pi.
        radius: R of the rolling circle in m, positive.
        g: acceleration of gravity in m/s^2, positive.

    Each is exact: a float at its binary64 value, a string or Fraction as the rational it spells.

    Raises:
        ValueError: a parameter is outside its range or not finite.
        TypeError: a parameter is no real number.
    """

    angle: Fraction
    radius: Fraction
    g: Fraction

    name: ClassVar[str] = "tautochrone"
    rows: ClassVar[tuple[Row, ...]] = SWING_ROWS
    space: ClassVar[StateSpace] = StateSpace(
        positions=("angle",),
        velocities=("angular_velocity",),
        angles=("angle",),
        odd=("angular_velocity",),
        along=None,
        scale="largest",
        independent="s",
    )
    invariants: ClassVar[tuple[Invariant, ...]] = (ENERGY_ABOVE_REST,)
    trial: ClassVar[Trial] = Trial(
        states=((-2.0, 2.0), (-1.0, 1.0)), parameters={"radius": (0.5, 2.0), "g": (0.5, 2.0)}, step=(0.001, 0.01)
    )
    by_flow: ClassVar[Mapping[str, Reading]] = SWING_BY_FLOW
    form: ClassVar[Form] = Form(
        "angle", "by the angle", "theta'' = tan(theta/2) (theta'^2/2 - g/(2 R)), theta(0) = angle, theta'(0) = 0"
    )

    def __init__(self, angle: Any, radius: Any = 1.0, g: Any = 9.81) -> None:
        for name, value in (("angle", angle), ("radius", radius), ("g", g)):
            object.__setattr__(self, name, exact(value, name))
        if self.angle == 0 or self._below_cusp < 0:
            raise ValueError(f"angle is {as_number(self.angle)}; an angle with 0 < |angle| < pi is accepted.")
        for name in ("radius", "g"):
            positive_number(name, getattr(self, name))

    def __repr__(self) -> str:
        angle, radius, g = (as_number(value) for value in (self.angle, self.radius, self.g))
        return f"Tautochrone(angle={angle!r}, radius={radius!r}, g={g!r})"

    @cached_property
    def _below_cusp(self) -> Fraction:
        """pi - |angle|, to some digits and certainly of its sign."""

        def told(ball: arb) -> Interval | None:
            return None if ball.contains(0) else interval(ball)

        def gap(_rows: Sequence[int]) -> list[list[arb]]:
            return [[BALL.pi() - BALL.number(abs(self.angle))]]

        what = f"the sign of pi - {as_number(abs(self.angle))}"
        (((low, _, scale),),) = ziv(gap, told, 1, DECISION_BITS, what)
        return low * Fraction(2) ** scale

    @property
    def start(self) -> tuple[Fraction, ...]:
        return self.angle, ZERO

    @property
    def inputs(self) -> dict[str, tuple[Any, str]]:
        return {"angle": (float(self.angle), "rad")}

    def orbits(self) -> Orbits:
        return CycloidOrbits(self.start, self._w())

    @classmethod
    def derivative(cls, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """theta' = omega, omega' = tan(theta/2) (omega^2/2 - g/(2 R))."""
        return y[1], angular_acceleration(m, y[0], y[1], p["radius"], p["g"])

    @staticmethod
    def invariant(m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The energy per mass above rest at the bottom, in m^2/s^2."""
        return swing_energy(m, y[0], y[1], p["radius"], p["g"])

    def rate(self) -> float:
        """2 w/cos(angle/2): it bounds |d(omega')/d(omega)| and the root of |d(omega')/d(theta)| over the motion."""
        with mp.workprec(64 + 2 * self.cusp_bits):
            return 2 * self.frequency() / float(mp.cos(MPMATH.number(self.angle) / 2))

    def neighbour(self, rounding: Callable[[Fraction], Fraction], epsilon: Fraction) -> Tautochrone:
        """The start nearer to rest by 2^-36 of its way to 0 or to the cusp, or by 16 roundings."""
        size = abs(self.angle)
        shift = max(min(size, self._below_cusp) * APART, 16 * epsilon * size)
        moved = self.angle - shift if self.angle > 0 else self.angle + shift
        return Tautochrone(rounding(moved), self.radius, self.g)

    @property
    def cusp_bits(self) -> int:
        return max(0, 1 - exponent(self._below_cusp))

    def closed_form(self, m: EllipticArithmetic) -> Swing:
        """The closed form in balls or in mpmath."""
        return Swing(m, *(m.number(value) for value in (self.angle, self.radius, self.g)))

    def quadrature_form(self) -> Swing:
        return QuadratureSwing(MPMATH, *(MPMATH.number(value) for value in (self.angle, self.radius, self.g)))


@dataclass(frozen=True, repr=False)
class CycloidalPendulum(SeparableProblem, Swinging):
    """The same bead by its arc length from the bottom: s'' = -(g/(4 R)) s, released from rest at s = arc.

    The cusp, s = 4 R, is a start like any other; from there the motion is that of the brachistochrone.

    Args:
        arc: arc length at the start in m, 0 < |arc| <= 4 R.
        radius: R of the rolling circle in m, positive.
        g: acceleration of gravity in m/s^2, positive.

    Raises:
        ValueError: a parameter is outside its range or not finite.
        TypeError: a parameter is no real number.
    """

    arc: Fraction
    radius: Fraction
    g: Fraction

    name: ClassVar[str] = "cycloidal pendulum"
    rows: ClassVar[tuple[Row, ...]] = PENDULUM_ROWS
    space: ClassVar[StateSpace] = ARC_SPACE
    invariants: ClassVar[tuple[Invariant, ...]] = (ENERGY_ABOVE_REST,)
    trial: ClassVar[Trial] = ARC_TRIAL
    by_flow: ClassVar[Mapping[str, Reading]] = PENDULUM_BY_FLOW
    form: ClassVar[Form] = Form("arc", "by the arc", "s'' = -(g/(4 R)) s, s(0) = arc, s'(0) = 0")

    def __init__(self, arc: Any, radius: Any = 1.0, g: Any = 9.81) -> None:
        for name, value in (("arc", arc), ("radius", radius), ("g", g)):
            object.__setattr__(self, name, exact(value, name))
        for name in ("radius", "g"):
            positive_number(name, getattr(self, name))
        if not 0 < abs(self.arc) <= 4 * self.radius:
            raise ValueError(f"arc is {as_number(self.arc)}; an arc length with 0 < |arc| <= 4 radius is accepted.")

    def __repr__(self) -> str:
        arc, radius, g = (as_number(value) for value in (self.arc, self.radius, self.g))
        return f"CycloidalPendulum(arc={arc!r}, radius={radius!r}, g={g!r})"

    @property
    def start(self) -> tuple[Fraction, ...]:
        return self.arc, ZERO

    @property
    def inputs(self) -> dict[str, tuple[Any, str]]:
        return {"arc": (float(self.arc), "m")}

    def orbits(self) -> Orbits:
        return HarmonicOrbits(self.start, self._w())

    @staticmethod
    def velocity(m: Arithmetic, momenta: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """The rate of the arc length."""
        return (momenta[0],)

    @staticmethod
    def force(m: Arithmetic, t: Any, positions: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """s'' = -(g/(4 R)) s."""
        return (arc_acceleration(positions[0], p["radius"], p["g"]),)

    @staticmethod
    def invariant(m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The energy per mass above rest at the bottom, in m^2/s^2."""
        return arc_energy(y[0], y[1], p["radius"], p["g"])

    def rate(self) -> float:
        """w: |d(s'')/ds| = w^2."""
        return self.frequency()

    def neighbour(self, rounding: Callable[[Fraction], Fraction], epsilon: Fraction) -> CycloidalPendulum:
        """The start nearer to the bottom by 2^-36 of its way, or by 16 roundings."""
        smaller = 1 - max(APART, 16 * epsilon)
        return CycloidalPendulum(rounding(self.arc * smaller), self.radius, self.g)

    def exact_row(self, row: str, argument: Any) -> tuple[Fraction | None, ...] | None:
        """The start, and the energy, which is rational."""
        energy = (self.g * self.arc**2 / (8 * self.radius),)
        return energy if row == "energy" else super().exact_row(row, argument)

    def closed_form(self, m: EllipticArithmetic) -> ArcSwing:
        """The closed form in balls or in mpmath."""
        return ArcSwing(m, *(m.number(value) for value in (self.arc, self.radius, self.g)))

    def quadrature_form(self) -> ArcSwing:
        return QuadratureArcSwing(MPMATH, *(MPMATH.number(value) for value in (self.arc, self.radius, self.g)))
