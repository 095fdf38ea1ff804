"""Descent on a curve as a problem: what can be asked of it, exact inputs, proven answers."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar

from reference.arithmetic.balls import BALL
from reference.arithmetic.dual import DualArithmetic
from reference.arithmetic.exact import as_number, exact
from reference.arithmetic.limbs import ziv
from reference.arithmetic.namespaces import NUMPY
from reference.arithmetic.precision import ctx
from reference.declaration import ENERGY_ABOVE_REST, Quantity, Row, StateSpace, Trial
from reference.names import said, short
from reference.once import cached_property
from reference.problem import APART, Problem
from reference.problems.descent.admission import admitted
from reference.problems.descent.curves import Curve, CycloidByArc, lagrange, spelled_curve
from reference.problems.descent.equations import energy
from reference.problems.descent.forms import BallDescent, CycloidDescent, QuadratureDescent
from reference.problems.descent.rational import Rational
from reference.problems.descent.taylor import BY_FLOW
from reference.row_domains import FRACTION, ONCE, Domain, Reals

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from flint import arb

    from reference.certified import Certified
    from reference.declaration import ClosedForm, Invariant
    from reference.problems.descent.slide import Slide
    from reference.routes.taylor import Reading

__all__ = ["ROWS", "Descent"]

SQUARES = "N = x_w^2 + y_w^2"
TIME = Reals("time", "t", Fraction(0))
"""To the descent time of each motion."""
ROWS = (
    Row(
        "descent_time",
        (Quantity("descent_time", "s", "time of the descent", f"T = int sqrt(N/(2 g drop)) dw, {SQUARES}"),),
        ONCE,
    ),
    Row(
        "arc_length",
        (Quantity("arc_length", "m", "length of the way", f"int sqrt(N) dw, {SQUARES}"),),
        ONCE,
    ),
    Row(
        "state",
        (
            Quantity(
                "place",
                "1",
                "fraction of the way, of the curve's parameter or of the cycloid's arc",
                f"N w'' = -(g y_w + N_w w'^2/2), {SQUARES}, from rest",
            ),
            Quantity("place_rate", "s-1", "rate of the fraction of the way", "w' = dw/dt = sqrt(2 g drop/N)"),
        ),
        TIME,
    ),
    Row(
        "motion",
        (
            Quantity("x", "m", "horizontal coordinate of the body", "x(w(t))"),
            Quantity("y", "m", "height of the body, upwards, as the curve is written", "y(w(t))"),
            Quantity("speed", "m s-1", "speed of the body", "v = sqrt(2 g drop), drop = y(start) - y"),
            Quantity("velocity_x", "m s-1", "horizontal component of the velocity", "dx/dt = x_w w'"),
            Quantity("velocity_y", "m s-1", "vertical component of the velocity, upwards", "dy/dt = y_w w'"),
        ),
        TIME,
    ),
    Row(
        "passage",
        (
            Quantity("passage_time", "s", "time at which the body passes the place", "t = int sqrt(N/(2 g drop)) dw"),
            Quantity("passage_x", "m", "horizontal coordinate of the place", "x(w)"),
            Quantity("passage_y", "m", "height of the place, upwards, as the curve is written", "y(w)"),
            Quantity("passage_speed", "m s-1", "speed of the body at the place", "v = sqrt(2 g drop)"),
            Quantity("passage_velocity_x", "m s-1", "horizontal component of the velocity there", "v x_w/sqrt(N)"),
        ),
        FRACTION,
    ),
)


DECISION_BITS = 128
END_TOLERANCE = Fraction(1, 10**12)
"""How far from the end of the curve, by its size, the end point may be that was asked for."""


@dataclass(frozen=True, repr=False)
class Descent(Problem):
    """A body released at rest that slides down a curve without friction, dt = ds/sqrt(2 g drop).

    Args:
        curve: a name of the race (line, parabola, cubic, quartic, circular_arc, quarter_ellipse, cycloid), which goes
            from (pi, 2) down to (0, 0); or the height y in m, upwards, as a formula of the horizontal x such as
            "2*(x/pi)**4"; or "x = ...; y = ..." as formulas of a parameter p.
        g: acceleration of gravity in m/s^2, positive.
        start, end: of a formula, where x or p begins and ends: numbers, or constants such as "pi/2".
        released: the fraction of the way at which the body is released, from 0 to below 1.
        to: the end point (x, y) that the curve is meant to reach, which is checked.

    Each number is exact: a float at its binary64 value, a string or Fraction as it spells.  The place of the body is
    the fraction w of the way: of x or p, on the cycloid of the race of its arc.

    Raises:
        ValueError: an input is outside its range, the formula is none, or no body at rest slides down the curve.
        TypeError: an input is of another type.
    """

    curve: Curve
    g: Fraction
    released: Fraction

    name: ClassVar[str] = "descent"
    rows: ClassVar[tuple[Row, ...]] = ROWS
    space: ClassVar[StateSpace] = StateSpace(
        positions=("place",),
        velocities=("place_rate",),
        angles=(),
        odd=("place_rate",),
        along=None,
        scale="largest",
        independent="s",
    )
    invariants: ClassVar[tuple[Invariant, ...]] = (ENERGY_ABOVE_REST,)
    trial: ClassVar[Trial] = Trial(states=((0.2, 0.5), (0.0, 0.5)), parameters={"g": (0.5, 2.0)}, step=(0.001, 0.005))
    by_flow: ClassVar[Mapping[str, Reading]] = BY_FLOW
    max_bits: ClassVar[int] = 2048

    def __init__(
        self, curve: Any, g: Any = 9.81, start: Any = None, end: Any = None, released: Any = 0, to: Any = None
    ) -> None:
        known = curve if isinstance(curve, Curve) else spelled_curve(curve, start, end)
        for name, value in (("curve", known), ("g", exact(g, "g")), ("released", exact(released, "released"))):
            object.__setattr__(self, name, value)
        if self.g <= 0:
            raise ValueError(f"g is {as_number(self.g)}; a positive number is accepted.")
        if not 0 <= self.released < 1:
            raise ValueError(
                f"released is {as_number(self.released)}; a fraction of the way from 0 to below 1 is accepted."
            )
        _ = self.slide
        if to is not None:
            self._check_end(to)

    def __repr__(self) -> str:
        released = f", released={as_number(self.released)!r}" if self.released else ""
        return f"Descent({self.curve.arguments}, g={as_number(self.g)!r}{released})"

    @property
    def slide(self) -> Slide:
        """The curve from the place of release on, admitted."""
        return admitted(self.curve, self.released)

    def _check_end(self, to: Any) -> None:
        if not isinstance(to, (tuple, list)) or len(to) != 2:
            raise ValueError(f"to is {said(to)}; a point (x, y) is accepted.")
        asked = [BALL.number(exact(value, f"to[{i}]")) for i, value in enumerate(to)]
        with ctx.workprec(DECISION_BITS):
            one, start = BALL.number(Fraction(1)), BALL.number(self.released)
            curve = self.curve
            reached = [curve.horizontal(BALL, one), curve.height(BALL, one)]
            size = abs(curve.height(BALL, start) - reached[1]) + abs(curve.horizontal(BALL, start) - reached[0])
            near = [abs(a - b) < size * BALL.number(END_TOLERANCE) for a, b in zip(asked, reached, strict=True)]
        if not all(near):
            shown = ", ".join(f"{float(value.mid()):.6g}" for value in reached)
            raise ValueError(f"to is {said(tuple(to))}, but curve '{short(curve.name)}' ends at ({shown}).")

    @property
    def parameters(self) -> dict[str, Fraction]:
        return {"g": self.g}

    @property
    def start(self) -> tuple[Fraction, ...]:
        """At rest.

        Raises:
            ValueError: at a cusp a body at rest has no equation of motion in the curve's parameter.
        """
        if self.slide.order == 2:
            raise ValueError(f"{self!r} starts at a cusp, where its equation of motion has no start.")
        return self.released, Fraction(0)

    @property
    def equation(self) -> str:
        """Lagrange's equation, and its start."""
        return "N w'' = -(g y_w + N_w w'^2/2), N = x_w^2 + y_w^2, w(0) = w'(0) = 0, w the fraction of the way"

    @property
    def inputs(self) -> dict[str, tuple[Any, str]]:
        released = {"released": (float(self.released), "")} if self.released else {}
        return {"curve": (self.curve.name, ""), **released}

    @property
    def structure(self) -> Any:
        """The curve: its shape stands in the equation."""
        return type(self), self.curve

    def derivative(self, m: Any, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """(w', w'') at the fraction w of the way, in 1/s and 1/s^2."""
        return lagrange(self.curve, m, y[0], y[1], p["g"])

    def invariant(self, m: Any, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The energy for a unit of mass above that of rest at the end of the curve, in m^2/s^2."""
        w, rate = y
        height, _, arc_square = self.curve.profile(m, w)
        return energy(rate, height - self.curve.height(m, m.number(Fraction(1))), arc_square, p["g"])

    def rate(self) -> float:
        """The largest |d(w'')/d(w')| + sqrt|d(w'')/dw| at places along the motion."""
        duals: Any = DualArithmetic(NUMPY, 2)
        until = Fraction(float(self.descent_time())) * (1 - Fraction(1, 16))
        found = [0.0]
        for w, by_time in self.state([until * Fraction(k, 16) for k in range(self.slide.order - 1, 17)]):
            state = duals.variable(w, 0), duals.variable(by_time, 1)
            _, bend = self.derivative(duals, 0, state, {"g": float(self.g)})
            by_place, by_rate = (float(slope) for slope in bend.slopes)
            found.append(abs(by_rate) + abs(by_place) ** 0.5)
        return max(found)

    def neighbour(self, rounding: Callable[[Fraction], Fraction], epsilon: Fraction) -> Descent:
        """Released further on, by 2^-36 of the way that is left or by 16 roundings."""
        shift = max(APART, 16 * epsilon)
        return Descent(self.curve, self.g, released=rounding(self.released + (1 - self.released) * shift))

    def closed_form(self, m: Any) -> ClosedForm:
        """The motion in balls."""
        del m
        form = CycloidDescent if isinstance(self.curve, CycloidByArc) else BallDescent
        return form(self.slide, self.g)

    def quadrature_form(self) -> ClosedForm:
        """The motion by Chebyshev series in mpmath."""
        return QuadratureDescent(self.slide, self.g)

    def within_taylor(self, row: str, arguments: Sequence[Any]) -> bool:
        """Not from a cusp, where the equation of motion has no start."""
        del row, arguments
        return self.slide.order == 1

    def domain(self, row: Row) -> Domain:
        """Places begin at the release, times end with the descent."""
        if row.over == "fraction":
            return Places(row.over, row.domain.name, self.released, Fraction(1))
        return Descending(row.over, row.domain.name, self) if row.over == "time" else row.domain

    def exact_row(self, row: str, argument: Any) -> tuple[Fraction | None, ...] | None:
        """What is rational, exactly."""
        return self._rational.row(row, argument)

    @cached_property
    def _rational(self) -> Rational:
        return Rational(self.slide, self.g)

    def in_time(self, t: Fraction) -> bool:
        """Whether t is no later than the descent time."""
        for end in self._rational.row("descent_time", None) or ():
            return end is not None and t <= end
        if t < self._surely:
            return True

        def left(_rows: Sequence[int]) -> list[list[arb]]:
            form: Any = self.closed_form(BALL)
            return [[form.descent_time - BALL.number(t)]]

        def certain(ball: arb) -> arb | None:
            return ball if ball.is_finite() and not ball.contains(0) else None

        what = f"whether t = {as_number(t)} is before the end of {self!r}"
        return bool(ziv(left, certain, 1, DECISION_BITS, what, self.max_bits)[0][0] > 0)

    @cached_property
    def _surely(self) -> Fraction:
        """A time that is surely before the end, and almost there."""
        return Fraction(float(self.descent_time())) * (1 - Fraction(1, 2**40))

    def working_bits(self, arguments: Sequence[Any]) -> int:
        """More for a time or a way that is small: its digits are lost in those of the whole."""
        ways = [abs(a - self.released) for a in arguments if isinstance(a, Fraction) and a != self.released]
        least = min(ways, default=Fraction(1))
        return 24 + 2 * max(0, least.denominator.bit_length() - least.numerator.bit_length())

    def descent_time(self) -> Certified:
        """The time from the release to the end of the curve, in s."""
        return self.certified("descent_time")

    def arc_length(self) -> Certified:
        """The length of the way, in m."""
        return self.certified("arc_length")


@dataclass(frozen=True)
class Places(Reals):
    """The places from the release to the end of the curve."""

    @property
    def accepted(self) -> str:
        return f"a fraction of the way from {as_number(self.low or Fraction(0))} to 1"


@dataclass(frozen=True)
class Descending(Domain):
    """The times from the release to the end of the curve."""

    descent: Descent

    def contains(self, number: Fraction) -> bool:
        return number == 0 or (number > 0 and self.descent.in_time(number))

    @property
    def accepted(self) -> str:
        seconds = f"{float(self.descent.descent_time()):.6g}"
        return f"a time from 0 to the descent time of {self.descent!r}, {seconds} s,"
