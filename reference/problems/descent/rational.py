"""Where the values of a descent are rational, exactly: what no ball could decide.

At the start the body is where the curve says and at rest.  At a fraction of the way a place, a speed v = sqrt(2 g drop)
and v x_w/sqrt(N) may be rational.  On a straight line, which falls by the angle a in the direction d = +1 or -1,

    x = x0 + d (g/2) sin(a) cos(a) t^2,  y = y0 - (g/2) sin(a)^2 t^2,  v = g sin(a) t,  t^2 = 2 drop/(g sin(a)^2):

everything may be rational at any time.  So may be the time, the place and the length on the cycloid by its angle.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.arithmetic.balls import BALL
from reference.arithmetic.dual import with_slope
from reference.arithmetic.exact import rational_root
from reference.arithmetic.precision import ctx
from reference.arithmetic.surds import SURD, UNKNOWN, Surd, exactly, known, surd
from reference.once import cached_property
from reference.problems.descent.curves import CycloidByArc, FormulaCurve

if TYPE_CHECKING:
    from reference.problems.descent.slide import Slide

__all__ = ["Rational"]

SIGN_BITS = 256
Values = tuple[Fraction | None, ...]


def _plain(value: Surd | None) -> Fraction | None:
    return None if value is None else value.rational


def _root(square: Surd | None) -> Fraction | None:
    """The square root of a square that is known, where it is rational."""
    value = _plain(square)
    return None if value is None else rational_root(value)


@dataclass(frozen=True)
class Line:
    """The direction of a straight way."""

    sine_square: Surd
    sine_cosine: Surd
    """With the sign of d."""

    def time_square(self, drop: Surd, g: Fraction) -> Surd:
        """t^2 where the body is lower by ``drop``."""
        return 2 * drop / (g * self.sine_square)


def _straight(curve: FormulaCurve) -> Line | None:
    (dx, dy), (ddx, ddy) = curve.slopes(SURD, UNKNOWN), curve.second_slopes(SURD, UNKNOWN)
    square = dx * dx + dy * dy
    return Line(surd(dy * dy / square), surd(-dx * dy / square)) if surd(dx * ddy - dy * ddx).is_zero else None


def _bent(curve: FormulaCurve, released: Fraction) -> bool:
    """Whether a curve is proven to be no straight line, by its curvature at a place: it takes less than an identity."""
    with ctx.workprec(SIGN_BITS):
        place = BALL.number((1 + 2 * released) / 3)
        (dx, dy), (ddx, ddy) = curve.slopes(BALL, place), curve.second_slopes(BALL, place)
        return bool(dx * ddy - dy * ddx != 0)


@dataclass(frozen=True)
class Parameter:
    """The parameter p from ``start`` to ``end``, the square of the arc for a unit of it, and the drop if known."""

    start: Surd
    end: Surd
    unit_square: Surd
    drop: Surd | None

    @property
    def way(self) -> Surd:
        return self.end - self.start

    def pace_square(self, g: Fraction) -> Fraction | None:
        """p'^2 = 2 g drop/N, where it is constant: on a cycloid that starts at its cusp, by its angle."""
        drop = self.drop
        return None if drop is None else known(lambda: (2 * g * drop / self.unit_square).rational or None)

    def arc_square(self) -> Surd | None:
        """The square of the length: of a circle, N = k, and of the cycloid's and the cardioid's, N = k (1 +- cos p).

        sqrt(k (1 - cos p)) = sqrt(2 k) |sin(p/2)| has the integral 2 sqrt(2 k) cos(p/2), and its sign does not change
        on the way, as N has no zero there; that of 1 + cos p has 2 sqrt(2 k) sin(p/2).
        """
        if (k := self.unit_square.rational) is not None:
            return k * self.way * self.way
        for sign, primitive in ((-1, SURD.cos), (1, SURD.sin)):
            if (k := (self.unit_square / (1 + sign * SURD.cos(UNKNOWN))).rational) is not None:
                span = primitive(self.end / 2) - primitive(self.start / 2)
                return 8 * k * span * span
        return None


def _parameter(curve: FormulaCurve, released: Fraction) -> Parameter:
    start, end = (curve.parameter(SURD, surd(w)) for w in (released, 1))
    dx, dy = (with_slope(SURD, formula, UNKNOWN)[1] for formula in (curve.x, curve.y))
    drop = exactly(lambda m, p: curve.y(m, start) - curve.y(m, p), UNKNOWN)
    return Parameter(start, end, surd(dx * dx + dy * dy), drop)


@dataclass(frozen=True)
class Rational:
    """The rational values of one descent: None for those that are not known to be rational."""

    slide: Slide
    g: Fraction

    def row(self, row: str, argument: Any) -> Values | None:
        """A row's values at an argument; None if there are no such ones."""
        found: Values | None = known(lambda: getattr(self, f"_{row}")(*([] if argument is None else [argument])))
        return None if found is None or all(value is None for value in found) else found

    def _point(self, w: Fraction) -> tuple[Surd | None, Surd | None]:
        """x and y at w."""
        curve = self.slide.curve
        if not isinstance(curve, FormulaCurve):
            return exactly(curve.horizontal, w), exactly(curve.height, w)
        x, y = (
            known(lambda formula=formula: surd(formula(SURD, curve.end_or_parameter(SURD, w))))  # type: ignore[misc]
            for formula in (curve.x, curve.y)
        )
        return x, y

    def _drop(self, w: Fraction) -> Surd | None:
        curve, released = self.slide.curve, self.slide.released
        return exactly(lambda m, place: curve.height(m, m.number(released)) - curve.height(m, place), w)

    @cached_property
    def line(self) -> Line | None:
        """The straight line that the way is, if it is known to be one."""
        curve = self.slide.curve
        if not isinstance(curve, FormulaCurve):
            return None
        if _bent(curve, self.slide.released):
            return None
        upright = exactly(lambda m, w: with_slope(m, curve.horizontal, w)[1], UNKNOWN)
        if upright is not None and upright.is_zero:
            return Line(surd(1), surd(0))
        return known(lambda: _straight(curve))

    @cached_property
    def parameter(self) -> Parameter | None:
        """What is simple in the curve's parameter p, if that is known."""
        curve = self.slide.curve
        if not isinstance(curve, FormulaCurve):
            return None
        return known(lambda: _parameter(curve, self.slide.released))

    def _descent_time(self) -> Values:
        return (self._time(Fraction(1)),)

    def _time(self, w: Fraction) -> Fraction | None:
        """When the body passes w."""
        if self.parameter is not None and (pace := self.parameter.pace_square(self.g)) is not None:
            way = self.parameter.way * (w - self.slide.released) / (1 - self.slide.released)
            return _root(way * way / pace)
        drop = self._drop(w) if self.line else None
        return _root(self.line.time_square(drop, self.g)) if self.line and drop else None

    def _arc_length(self) -> Values:
        if isinstance(self.slide.curve, CycloidByArc):
            return (4 * (1 - self.slide.released),)
        if self.parameter is not None and (square := known(self.parameter.arc_square)) is not None:
            return (_root(square),)
        drop = self._drop(Fraction(1)) if self.line else None
        return (_root(drop * drop / self.line.sine_square) if self.line and drop else None,)

    def _state(self, t: Fraction) -> Values:
        """Where the place goes as the time, or on a line as the height: with no second slope along it."""
        released, left = self.slide.released, 1 - self.slide.released
        if self.parameter is not None and (pace := self.parameter.pace_square(self.g)) is not None:
            rate = _root(pace / (self.parameter.way * self.parameter.way))
            if rate is not None:
                return released + left * rate * t, left * rate
        if t == 0:
            return released, Fraction(0) if self.slide.order == 1 else None
        drop = self._drop(Fraction(1)) if self.line and self._even else None
        if self.line is None or drop is None:
            return None, None
        by_square = left / self.line.time_square(drop, self.g)
        return _plain(released + by_square * t**2), _plain(2 * by_square * t)

    @property
    def _even(self) -> bool:
        curve = self.slide.curve
        bend = exactly(lambda m, w: curve.second_slopes(m, w)[1], UNKNOWN) if isinstance(curve, FormulaCurve) else None
        return bend is not None and bend.is_zero

    def _motion(self, t: Fraction) -> Values:
        x, y = self._point(self.slide.released)
        if t == 0:
            return _plain(x), _plain(y), Fraction(0), Fraction(0), Fraction(0)
        if self.line is None:
            return (None,) * 5
        going, falling = self.g * t * self.line.sine_cosine, self.g * t * self.line.sine_square
        return (
            None if x is None else _plain(x + going * t / 2),
            None if y is None else _plain(y - falling * t / 2),
            _root(self.g * t * falling),
            _plain(going),
            _plain(-falling),
        )

    def _passage(self, w: Fraction) -> Values:
        x, y = map(_plain, self._point(w))
        if w == self.slide.released:
            return Fraction(0), x, y, Fraction(0), Fraction(0)
        drop = self._drop(w)
        if drop is None:
            upright = self.line is not None and self.line.sine_cosine.is_zero
            return self._time(w), x, y, None, Fraction(0) if upright else None
        return self._time(w), x, y, _root(2 * self.g * drop), self._velocity_x(w, 2 * self.g * drop)

    def _velocity_x(self, w: Fraction, speed_square: Surd) -> Fraction | None:
        """v x_w/sqrt(N), by its square and the sign of x_w."""
        curve = self.slide.curve

        def part(m: Any, place: Any) -> Any:
            _, slope, arc_square = curve.profile(m, place)
            return 1 - slope * slope / arc_square

        share = exactly(part, w)
        size = None if share is None else _root(speed_square * share)
        if not size:
            return size
        with ctx.workprec(SIGN_BITS):
            dx, _ = curve.slopes(BALL, BALL.number(w))
        return size if dx > 0 else -size if dx < 0 else None
