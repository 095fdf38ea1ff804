"""The brachistochrone to an end point, as a problem: exact parameters, proven answers."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar

from reference.arithmetic.exact import as_number, exact, rational_root
from reference.arithmetic.namespaces import BALL, MPMATH
from reference.arithmetic.precision import mp
from reference.arithmetic.quadrature import to_fraction
from reference.declaration import ENERGY_ABOVE_REST, Form
from reference.once import cached_property
from reference.orbits import HarmonicOrbits
from reference.problem import APART, SeparableProblem
from reference.problems.cycloid.brachistochrone import Brachistochrone, QuadratureBrachistochrone
from reference.problems.cycloid.equations import ARC_SPACE, ARC_TRIAL, arc_acceleration, arc_energy
from reference.problems.cycloid.quantities import DESCENT_ROWS, exponent, positive_number
from reference.problems.cycloid.taylor import BRACHISTOCHRONE_BY_FLOW

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    import numpy as np
    from flint import arb

    from reference.arithmetic.protocols import Arithmetic, CalculusArithmetic
    from reference.certified import Certified
    from reference.declaration import Invariant, Row, StateSpace, Trial
    from reference.orbits import Orbits
    from reference.routes.taylor import Reading

__all__ = ["Cycloid"]

TAYLOR_RADIANS = 1000
"""The Taylor route serves times up to sqrt(g/R) t = TAYLOR_RADIANS."""
RADIUS_BITS = 1024
"""The radius, which is no rational number, is a parameter of the equation of motion to this precision."""
ZERO = Fraction(0)


@dataclass(frozen=True, repr=False)
class Cycloid(SeparableProblem):
    """The curve of quickest descent from rest at (0, 0) to an end point, without friction.

    It is x = R (theta - sin theta), y = R (1 - cos theta), y downward.  Its motion is that of a bead on a wire: at the
    end point it is at t = ``descent_time``, and then it goes on along the cycloid, swinging from cusp to cusp.

    The slope dy/dx at the end point, p, obeys (1 + p^2) acot(p) - p = end_x/end_y.  Were p algebraic, so were acot(p);
    but the cotangent of an algebraic number other than 0 is transcendental (Lindemann 1882).  The same argument shows
    that radius, end angle, descent time, arc length and the points within the curve are transcendental.

    Args:
        end_x: horizontal distance to the end point in m, positive.
        end_y: depth of the end point in m, positive.
        g: acceleration of gravity in m/s^2, positive.

    Each is exact: a float at its binary64 value, a string or Fraction as the rational it spells.

    Raises:
        ValueError: a parameter is not positive or not finite.
        TypeError: a parameter is no real number.
    """

    end_x: Fraction
    end_y: Fraction
    g: Fraction

    name: ClassVar[str] = "cycloid"
    rows: ClassVar[tuple[Row, ...]] = DESCENT_ROWS
    space: ClassVar[StateSpace] = ARC_SPACE
    invariants: ClassVar[tuple[Invariant, ...]] = (ENERGY_ABOVE_REST,)
    trial: ClassVar[Trial] = ARC_TRIAL
    by_flow: ClassVar[Mapping[str, Reading]] = BRACHISTOCHRONE_BY_FLOW
    form: ClassVar[Form] = Form(
        "motion", "motion", "s'' = g (1 - s/(4 R)), s the arc length from the cusp, at rest at s = 0"
    )

    def __init__(self, end_x: Any, end_y: Any, g: Any = 9.81) -> None:
        for name, value in (("end_x", end_x), ("end_y", end_y), ("g", g)):
            object.__setattr__(self, name, exact(value, name))
            positive_number(name, getattr(self, name))

    def __repr__(self) -> str:
        end_x, end_y, g = (as_number(value) for value in (self.end_x, self.end_y, self.g))
        return f"Cycloid(end_x={end_x!r}, end_y={end_y!r}, g={g!r})"

    @cached_property
    def parameters(self) -> dict[str, Fraction]:
        """The parameters of the equation of motion: g, and the radius to RADIUS_BITS bits."""
        with mp.workprec(RADIUS_BITS + 2 * self._edge_bits):
            radius = to_fraction(self.quadrature_form().radius)
        return {"radius": radius, "g": self.g}

    @property
    def start(self) -> tuple[Fraction, ...]:
        return ZERO, ZERO

    @property
    def inputs(self) -> dict[str, tuple[Any, str]]:
        return {"end_x": (float(self.end_x), "m"), "end_y": (float(self.end_y), "m")}

    def cycle(self) -> float:
        """2 pi sqrt(4 R/g): from cusp to cusp and back."""
        return 2 * math.pi / self.rate()

    def orbits(self) -> Orbits:
        radius: arb = self.closed_form(BALL).radius
        return HarmonicOrbits(self.start, (BALL.number(self.g) / radius).sqrt() / 2, 4 * radius)

    @property
    def lacks_of_orbits(self) -> str:
        return ""

    @staticmethod
    def velocity(m: Arithmetic, momenta: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """The rate of the arc length."""
        return (momenta[0],)

    @staticmethod
    def force(m: Arithmetic, t: Any, positions: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """s'' = g (1 - s/(4 R)), s from the start."""
        return (arc_acceleration(positions[0] - 4 * p["radius"], p["radius"], p["g"]),)

    @staticmethod
    def invariant(m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The energy per mass above rest at the bottom, in m^2/s^2."""
        return arc_energy(y[0] - 4 * p["radius"], y[1], p["radius"], p["g"])

    def rate(self) -> float:
        """sqrt(g/(4 R)): |d(s'')/ds| = g/(4 R)."""
        return math.pi / (2 * self._quarter_swing)

    def neighbour(self, rounding: Callable[[Fraction], Fraction], epsilon: Fraction) -> Cycloid:
        """The descent to an end point whose x is smaller by 2^-36 of itself, or by 16 roundings.

        Every descent starts at (0, 0); it is the radius that differs.
        """
        return Cycloid(rounding(self.end_x * (1 - max(APART, 16 * epsilon))), self.end_y, self.g)

    def closed_form(self, m: CalculusArithmetic) -> Brachistochrone:
        """The closed form in balls or in mpmath."""
        return Brachistochrone(m, *(m.number(value) for value in (self.end_x, self.end_y, self.g)))

    def quadrature_form(self) -> QuadratureBrachistochrone:
        """The same by other formulas in mpmath, with integrals for lengths and times."""
        return QuadratureBrachistochrone(MPMATH, *(MPMATH.number(v) for v in (self.end_x, self.end_y, self.g)))

    def within_taylor(self, row: str, arguments: Sequence[Any]) -> bool:
        """Whether every time lies in 0 <= sqrt(g/R) t <= TAYLOR_RADIANS; the rest is always in reach."""
        if self.row(row).over != "time":
            return True
        latest = Fraction(TAYLOR_RADIANS * self._quarter_swing / math.pi)
        return all(0 <= t <= latest for t in arguments)

    @cached_property
    def _quarter_swing(self) -> float:
        """pi sqrt(R/g): from cusp to bottom."""
        return math.pi * float(self.certified("descent_time")) / float(self.certified("end_angle"))

    def exact_row(self, row: str, argument: Any) -> tuple[Fraction | None, ...] | None:
        """The ends of the curve, the start of the motion, and the time on the chord where it is a square root's."""
        if row == "chord_time":
            return (rational_root(2 * (self.end_x**2 + self.end_y**2) / (self.g * self.end_y)),)
        if argument == 0:
            return (ZERO,) * len(self.row(row).quantities)
        return (self.end_x, self.end_y) if row in {"curve", "arc"} and argument == 1 else None

    def working_bits(self, arguments: Sequence[Any]) -> int:
        """An argument is a fraction or a time: as either it loses digits where it is small, as a time where it is late.

        A time t is the angle sqrt(g/R) t, with R about x or y^3/x^2, whichever is larger.
        """
        radius = max(self.end_x, self.end_y**3 / self.end_x**2)
        sizes = [exponent(abs(a)) for a in arguments if a]
        turned = [size + exponent(self.g / radius) // 2 for size in sizes]
        return self._edge_bits + max((max(0, size, -2 * size) for size in sizes + turned), default=0)

    @property
    def _edge_bits(self) -> int:
        """What the end point's slope and a gap of times lose: 5 log2(end_y/end_x), or log2(end_x/end_y)."""
        ratio = exponent(self.end_x / self.end_y)
        return max(ratio, -5 * ratio)

    def curve(self, fraction: Any, limbs: int = 1) -> np.ndarray:
        """(x, y) in m after fractions of the descent time, as ``state`` gives the state.

        Raises:
            ValueError: a fraction is not within [0, 1].
        """
        return self.along("curve", fraction, limbs)

    def radius(self) -> Certified:
        """R in m, of the rolling circle."""
        return self.certified("radius")

    def end_angle(self) -> Certified:
        """theta in rad at the end point, 0 < theta < 2 pi."""
        return self.certified("end_angle")

    def descent_time(self) -> Certified:
        """T = theta sqrt(R/g) in s: no curve is quicker."""
        return self.certified("descent_time")

    def chord_gap(self) -> Certified:
        """By how much the descent on the straight chord takes longer, in s."""
        return self.certified("chord_gap")

    def neighbour_gap(self, epsilon: Any) -> Certified:
        """By how much the descent takes longer in s where y is multiplied by 1 + epsilon sin(pi theta/theta_B).

        Raises:
            ValueError: ``epsilon`` is not within [-1/2, 1/2].
        """
        return self.certified("neighbour_gap", epsilon)
