"""A brachistochrone in a central field as a problem: what its two forms and all laws of force share."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from dataclasses import field as known_as
from fractions import Fraction
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any, ClassVar

from reference.arithmetic.exact import as_number, exact, exact_array, rational_root
from reference.arithmetic.limbs import BINARY64_BITS
from reference.arithmetic.namespaces import BALL, MPMATH
from reference.arithmetic.precision import ctx, mp
from reference.declaration import Invariant, StateSpace, Trial
from reference.names import said
from reference.once import cached_property
from reference.problem import Problem
from reference.problems.polar.bodies import BODIES
from reference.problems.polar.boundary import DECISION_BITS, end_of, exponent_near, lowest_point, positive
from reference.problems.polar.numerical import Numerical
from reference.problems.polar.panels import panels_of
from reference.problems.polar.quantities import Z
from reference.problems.polar.taylor import BY_FLOW
from reference.row_domains import Domain

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from reference.arithmetic.protocols import Arithmetic
    from reference.certified import Certified
    from reference.constants import Constant
    from reference.declaration import Row
    from reference.problems.polar.equations import End, Field
    from reference.problems.polar.extremal import Extremal
    from reference.routes.taylor import Reading

__all__ = ["CentralBrachistochrone"]

PI = Fraction(math.pi)
SECONDS = ("time_unit", "descent_seconds", "arrival_seconds", "si_curve", "si_state")
TAYLOR_PSI = 16
TAYLOR_TAU = 32
"""The Taylor route serves 0 <= psi <= TAYLOR_PSI and 0 <= tau <= TAYLOR_TAU sqrt(1 - z0), ten descents or more."""
PASSAGE = 2.0**-40
"""How long in psi the passage of the lowest point must be for the routes that integrate through it."""


@dataclass(frozen=True, repr=False)
class CentralBrachistochrone(Problem):
    """The curve of fastest descent in a central field, from rest at (1, 0), by its lowest point or by its end.

    Subclasses set ``z0`` or ``end``, ``body``, and ``unit``, and name their law of force.
    """

    z0: Fraction | None
    end: tuple[Fraction, Fraction] | None
    r0: Fraction | None
    body: str | None = known_as(compare=False)

    space: ClassVar[StateSpace] = StateSpace(
        positions=("z", "phi"),
        velocities=("z_rate",),
        angles=("phi",),
        odd=("z_rate", "phi"),
        along=None,
        scale="largest",
        independent="",
        order=("z", "z_rate", "phi"),
    )
    invariants: ClassVar[tuple[Invariant, ...]] = (Invariant("energy", ("Invariant", "(I - I0)/I0"), "start"),)
    trial: ClassVar[Trial] = Trial(
        states=((0.5, 0.9), (-0.5, 0.5), (-1.0, 1.0)), parameters={"kappa": (0.5, 2.0)}, step=(0.001, 0.01)
    )
    by_flow: ClassVar[Mapping[str, Reading]] = BY_FLOW
    max_bits: ClassVar[int] = 1 << 14
    field: ClassVar[Field]

    @staticmethod
    def extremal(m: Any, z0: Any, end: End | None = None, unit: tuple[Any, Any] | None = None) -> Extremal:
        """The closed form in balls."""
        raise NotImplementedError

    @property
    def unit(self) -> tuple[Fraction, Fraction] | None:
        """The length in m and the square of the time in s^2 that stand for 1, where they are known."""
        raise NotImplementedError

    def _set_path(self, z0: Any, end: Any) -> None:
        """Take the lowest point or the end.

        Raises:
            ValueError: not exactly one is given, it is out of range, or no smooth extremal reaches the end.
        """
        if (z0 is None) == (end is None):
            raise ValueError("either z0, the lowest point, or end, a pair (R, PHI), is accepted.")
        lowest = None if z0 is None else exact(z0, "z0")
        if lowest is not None and not 0 < lowest < 1:
            raise ValueError(f"z0 is {as_number(lowest)}; a lowest point with 0 < z0 < 1 is accepted.")
        object.__setattr__(self, "z0", lowest)
        object.__setattr__(self, "end", None if end is None else _pair(end))
        _ = self.goal

    def _set_positive(self, name: str, value: Any) -> None:
        """Take a dimension in SI units.

        Raises:
            ValueError: it is not positive.
        """
        number = None if value is None else exact(value, name)
        if number is not None and number <= 0:
            raise ValueError(f"{name} is {as_number(number)}; a positive number is accepted.")
        object.__setattr__(self, name, number)

    @property
    def constants(self) -> tuple[Constant, ...]:
        """G M, where it is that of a body with a name."""
        return () if self.body is None else (BODIES[self.body],)

    def _spelled(self, *dimensions: str) -> str:
        """How the path and the given dimensions are written as arguments: the strength of the field last."""
        if self.z0 is not None:
            path = f"z0={as_number(self.z0)!r}"
        else:
            path = f"end=({', '.join(repr(as_number(value)) for value in self.end or ())})"
        known = [(name, getattr(self, name)) for name in dimensions]
        spelled = [f"{name}={as_number(value)!r}" for name, value in known if value is not None]
        return ", ".join([path, *(spelled if self.body is None else [*spelled[:-1], f"body={self.body!r}"])])

    @cached_property
    def goal(self) -> End | None:
        """The end, and on which branch it lies; None where the lowest point is given."""
        return None if self.end is None else end_of(*self.end, self.field, self.extremal)

    @property
    def after_lowest(self) -> bool:
        """Whether the path has passed its lowest point when it ends."""
        return self.goal is None or self.goal.after

    def serves(self, row: str) -> bool:
        """Whether this form of the problem has the row: z0 where it is found, seconds where the units are known."""
        if row in SECONDS and self.unit is None:
            return False
        return super().serves(row) and (row != "z0" or self.z0 is None)

    def row(self, name: str) -> Row:
        """The row of this name.

        Raises:
            KeyError: there is none.
            ValueError: this form of the problem has no such thing.
        """
        if super().serves(name) and not self.serves(name):
            why = "z0 is given" if name == "z0" else "its dimensions in SI units are not given"
            raise ValueError(f"{name} is not of {self!r}: {why}.")
        return super().row(name)

    def _lowest(self) -> Fraction:
        if self.z0 is None:
            raise ValueError(f"{self!r} has an irrational lowest point; z0 is accepted where a rational one is needed.")
        return self.z0

    @property
    def parameters(self) -> dict[str, Fraction]:
        """kappa, the square of Bouguer's constant.

        Raises:
            ValueError: the problem is given by its end, and kappa is irrational.
        """
        return {"kappa": self.field.kappa(self._lowest())}

    @property
    def start(self) -> tuple[Fraction, ...]:
        return Fraction(1), Fraction(0), Fraction(0)

    @property
    def inputs(self) -> dict[str, tuple[Any, str]]:
        return {"z0": (float(self._lowest()), "")}

    def cycle(self) -> float:
        """Twice the time to the lowest point."""
        return 2 * float(self.certified("descent_time"))

    @property
    def lacks_of_orbits(self) -> str:
        return ""

    @classmethod
    def derivative(cls, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """(z', z'', phi') in tau."""
        acceleration, turn = cls.field.motion(m, y[0], p["kappa"])
        return y[1], acceleration, turn

    @classmethod
    def invariant(cls, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The energy of z alone, which is 1 along the exact motion; the field has no rest to count from."""
        del m
        return cls.field.energy(y[0], y[1], p["kappa"])

    def rate(self) -> float:
        """The root of a bound on |dz''/dz| along the path."""
        with mp.workprec(BINARY64_BITS):
            return float(mp.sqrt(MPMATH.number(self.field.rate_squared(self._lowest()))))

    def closed_form(self, m: Any) -> Extremal:
        """The closed form in balls; in mpmath the form by numerical integration."""
        return _form(self, m is BALL, ctx.prec if m is BALL else mp.prec)

    @cached_property
    def near_lowest(self) -> float:
        """z0 as a float."""
        return float(self.certified("z0")) if self.z0 is None else float(self.z0)

    def by_route(
        self, route: str, row: str, arguments: Sequence[Any], digits: int
    ) -> list[tuple[Fraction, ...]] | None:
        """None too where the lowest point is so near to the centre that no float tells its passage from psi = pi."""
        if panels_of(self.field, self.near_lowest).distance(math.pi) < PASSAGE:
            return None
        return super().by_route(route, row, arguments, digits)

    def within_taylor(self, row: str, arguments: Sequence[Any]) -> bool:
        """Whether every argument is of the first turns of psi, or of a moderate time."""
        over = self.row(row).over
        if over == "psi":
            return all(0 <= psi <= TAYLOR_PSI for psi in arguments)
        scales = {"tau": Fraction(1), "time": Fraction(0) if self.unit is None else self.unit[1]}
        if over not in scales:
            return True
        depth = 1 - (Fraction(self.near_lowest) if self.z0 is None else self.z0)
        limit = TAYLOR_TAU**2 * depth * scales[over]
        return all(t >= 0 and t * t <= limit for t in arguments)

    def half_angle(self) -> Certified:
        """The angle in rad from the release to the lowest point."""
        return self.certified("half_angle")

    def descent_time(self) -> Certified:
        """The dimensionless time from the release to the lowest point."""
        return self.certified("descent_time")

    def arrival_time(self) -> Certified:
        """The dimensionless time to the end, or to where z = 1 again."""
        return self.certified("arrival_time")

    def domain(self, row: Row) -> Domain:
        """Heights on the way begin at the lowest point."""
        if row.domain is not Z:
            return row.domain
        return Reached(Z.over, Z.name, self) if self.z0 is None else replace(Z, low=self.z0)

    def exact_row(self, row: str, argument: Any) -> tuple[Fraction | None, ...] | None:
        """What is rational: the release, kappa and heights of a rational lowest point, and no change to the curve."""
        zero, one = Fraction(0), Fraction(1)
        if row == "kappa" and self.z0 is not None:
            return (self.field.kappa(self.z0),)
        if row == "time_unit" and self.unit is not None:
            return (rational_root(self.unit[1]),)
        if row == "by_height" and (self.z0 is not None or argument == 1):
            z = one if argument == 1 else self.z0 + (1 - self.z0) * argument  # type: ignore[operator]
            return (z, zero, zero) if argument == 1 else (z, None, None)
        if row == "half_angle":
            return (self.end[1] / 2,) if self.end is not None and self.end[0] == 1 else None
        if argument is None or argument != (1 if row == "by_z" else 0):
            return None
        length = None if self.unit is None else self.unit[0]
        at_start: dict[str, tuple[Fraction | None, ...]] = {
            "state": (one, zero, zero),
            "curve": (one, zero, zero),
            "by_z": (zero, zero),
            "neighbour_gap": (zero,),
            "si_curve": (length, zero),
            "si_state": (length, zero, zero),
        }
        return at_start.get(row)

    def working_bits(self, arguments: Sequence[Any]) -> int:
        """The digits of z0 and 1 - z0, or of the end's distances to the limits of what is reached."""
        del arguments
        if self.end is None:
            z0 = self._lowest()
            return _bits(z0) // 2 + 2 * _bits(1 - z0)
        radius, angle = self.end
        return _bits(radius) + _bits(angle) + _bits(self.field.sweep * PI - angle)


def _pair(end: Any) -> tuple[Fraction, Fraction]:
    """The exact radius and angle of an end.

    Raises:
        ValueError: it is no pair of numbers.
        TypeError: it holds what is no number.
    """
    numbers, shape = ([], ()) if isinstance(end, str) else exact_array(end, "end")
    if shape != (2,):
        raise ValueError(f"end is {said(end)}; a pair (R, PHI) is accepted.")
    return numbers[0], numbers[1]


def _bits(part: Fraction) -> int:
    """About -log2 of a small number."""
    return int(1 / abs(part)).bit_length() if part else 0


@lru_cache(maxsize=8)
def _form(problem: CentralBrachistochrone, in_balls: bool, bits: int) -> Extremal:
    """A form at a working precision, which is in force: what its rows share is then computed once."""
    del bits
    m: Any = BALL if in_balls else MPMATH
    extremal = problem.extremal if in_balls else partial(Numerical, problem.field)
    unit = None if problem.unit is None else (m.number(problem.unit[0]), m.number(problem.unit[1]))
    goal = problem.goal
    if goal is None:
        return extremal(m, problem.z0, None, unit)
    return extremal(m, lowest_point(m, goal, extremal, exponent_near(goal, problem.extremal)), goal, unit)


@dataclass(frozen=True)
class Reached(Domain):
    """The heights from the irrational lowest point of a path to the release."""

    path: CentralBrachistochrone

    def contains(self, number: Fraction) -> bool:
        if not 0 < number <= 1:
            return False
        bits = DECISION_BITS + self.path.working_bits([])
        what = f"whether z = {as_number(number)} is above the lowest point of {self.path!r}"
        return positive(lambda: BALL.number(number) - self.path.closed_form(BALL).z0, what, bits)

    @property
    def accepted(self) -> str:
        return f"a number from the lowest point, about {self.path.near_lowest:.6g}, to 1"
