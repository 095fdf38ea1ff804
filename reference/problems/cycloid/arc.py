"""The cycloid as a curve, given by its radius: x as a function of the depth, and point by angle."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar

from reference.arithmetic import quadrature
from reference.arithmetic.exact import as_number, exact
from reference.arithmetic.namespaces import MPMATH
from reference.arithmetic.precision import mp
from reference.declaration import ClosedForm, Form, Row, StateSpace, Trial
from reference.problem import APART, Problem
from reference.problems.cycloid.equations import point_below_cusp, run
from reference.problems.cycloid.quantities import CURVE_ROWS, HEIGHT, exponent, positive_number
from reference.problems.cycloid.taylor import CURVE_BY_FLOW

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from reference.arithmetic.protocols import Arithmetic, EllipticArithmetic
    from reference.declaration import Invariant
    from reference.routes.taylor import Reading
    from reference.row_domains import Domain

__all__ = ["CycloidArc", "CycloidCurve"]

ZERO = Fraction(0)
TAYLOR_RADIANS = 1000


class Curve(ClosedForm):
    """x = R (theta - sin theta), y = R (1 - cos theta), sin^2(theta/2) = y/(2 R)."""

    def __init__(self, m: EllipticArithmetic, radius: Fraction) -> None:
        self.m: EllipticArithmetic = m
        self.exact_radius, self.radius = radius, m.number(radius)

    def rows(self, row: str, arguments: Sequence[Any]) -> list[tuple[Any, ...]]:
        """Depths are not rounded before 2 R - y is taken, which may be zero."""
        return [self.state(y) for y in arguments] if row == "state" else super().rows(row, arguments)

    def state(self, y: Fraction) -> tuple[Any, Any]:
        """(x, y) at the depth y."""
        m, part = self.m, y / (2 * self.exact_radius)
        half = m.atan2(m.sqrt(m.number(part)), m.sqrt(m.number(1 - part)))
        return point_below_cusp(m, 2 * half, self.radius)

    def curve(self, angle: Any) -> tuple[Any, Any]:
        """(x, y) at an angle."""
        return point_below_cusp(self.m, angle, self.radius)


class QuadratureCurve(Curve):
    """x as the integral of dx/dy, with y = 2 R sin^2(b): of 4 R sin^2(b) db."""

    def state(self, y: Fraction) -> tuple[Any, Any]:
        half = mp.asin(mp.sqrt(self.m.number(y / (2 * self.exact_radius))))
        mean = quadrature.integral(lambda v: (v * mp.sinc(half * v)) ** 2, mp.mpf(0), mp.mpf(1))
        return 4 * self.radius * half**3 * mean, self.m.number(y)

    def curve(self, angle: Any) -> tuple[Any, Any]:
        return self.radius * (angle - mp.sin(angle)), self.radius * (1 - mp.cos(angle))


@dataclass(frozen=True, repr=False)
class CycloidArc(Problem):
    """The cycloid from its cusp, dx/dy = sqrt(y/(2 R - y)), y downward.

    Its independent variable is the depth y, "height" in the thesis: ``state(y)`` is (x, y), for 0 <= y <= 2 R.  Of the
    numbers x for rational y only x(0) = 0 is rational (Lindemann 1882: an angle and its cosine are not both algebraic).

    Args:
        radius: R in m, positive; exact.

    Raises:
        ValueError: the radius is not positive or not finite.
        TypeError: it is no real number.
    """

    radius: Fraction

    name: ClassVar[str] = "cycloid arc"
    rows: ClassVar[tuple[Row, ...]] = CURVE_ROWS
    space: ClassVar[StateSpace] = StateSpace(
        positions=("x",), angles=(), odd=None, along="y", scale="largest", independent="m"
    )
    invariants: ClassVar[tuple[Invariant, ...]] = ()
    trial: ClassVar[Trial] = Trial(
        states=((-3.0, 3.0), (0.1, 0.6)), parameters={"radius": (0.5, 2.0)}, step=(0.001, 0.005)
    )
    by_flow: ClassVar[Mapping[str, Reading]] = CURVE_BY_FLOW
    form: ClassVar[Form] = Form(
        "curve", "curve dx/dy", "dx/dy = sqrt(y/(2 R - y)), x(0) = 0, y the depth below the cusp"
    )

    def __init__(self, radius: Any = 1) -> None:
        object.__setattr__(self, "radius", exact(radius, "radius"))
        positive_number("radius", self.radius)

    def __repr__(self) -> str:
        return f"CycloidArc(radius={as_number(self.radius)!r})"

    @property
    def parameters(self) -> dict[str, Fraction]:
        return {"radius": self.radius}

    @property
    def start(self) -> tuple[Fraction, ...]:
        return ZERO, ZERO

    @property
    def inputs(self) -> dict[str, tuple[Any, str]]:
        return {"radius": (float(self.radius), "m")}

    def domain(self, row: Row) -> Domain:
        """Depths end at the lowest point, 2 R."""
        return replace(HEIGHT, high=2 * self.radius) if row.domain is HEIGHT else row.domain

    @classmethod
    def derivative(cls, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """d(x, y)/dy = (sqrt(y/(2 R - y)), 1), with a square root's singularity at both ends."""
        return run(m, y[1], p["radius"]), m.number(Fraction(1))

    def closed_form(self, m: EllipticArithmetic) -> Curve:
        """The closed form in balls or in mpmath."""
        return Curve(m, self.radius)

    def quadrature_form(self) -> Curve:
        """The integral of dx/dy, by mpmath."""
        return QuadratureCurve(MPMATH, self.radius)

    def within_taylor(self, row: str, arguments: Sequence[Any]) -> bool:
        """Whether every angle lies in 0 <= theta <= TAYLOR_RADIANS; every height does."""
        return row == "state" or all(0 <= angle <= TAYLOR_RADIANS for angle in arguments)

    def exact_row(self, row: str, argument: Any) -> tuple[Fraction | None, ...] | None:
        """The cusp, and the depth itself."""
        if argument == 0:
            return ZERO, ZERO
        return (None, argument) if row == "state" else None

    def working_bits(self, arguments: Sequence[Any]) -> int:
        """An argument is an angle or a depth: it loses digits where it is small, and as a depth beside 2 R."""
        parts = [abs(a) for a in arguments] + [abs(part) for a in arguments for part in self._parts(a)]
        return max((max(0, exponent(part), -2 * exponent(part)) for part in parts if part), default=0)

    def _parts(self, y: Fraction) -> tuple[Fraction, Fraction]:
        """sin^2 and cos^2 of half of the angle at the depth y."""
        part = y / (2 * self.radius)
        return part, 1 - part


@dataclass(frozen=True, init=False, repr=False)
class CycloidCurve(CycloidArc):
    """dx/dy = sqrt(y/(2 R - y)) from the cusp down, singular at the lowest point y = 2 R."""

    def __repr__(self) -> str:
        return f"CycloidCurve(radius={as_number(self.radius)!r})"

    def rate(self) -> float:
        """Zero: dx/dy does not depend on x."""
        return 0.0

    def neighbour(self, rounding: Callable[[Fraction], Fraction], epsilon: Fraction) -> CycloidCurve:
        """The curve whose radius is larger by 2^-36 of itself, or by 16 roundings."""
        return CycloidCurve(rounding(self.radius * (1 + max(APART, 16 * epsilon))))
