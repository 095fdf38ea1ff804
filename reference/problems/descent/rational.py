"""Where the values of a descent are rational, exactly: what no ball could decide.

At the start the body is where the curve says and at rest.  At a fraction of the way a place, a speed v = sqrt(2 g drop)
and v x_w/sqrt(N) may be rational.  On a straight line, which falls by the angle a in the direction d = +1 or -1,

    x = x0 + d (g/2) sin(a) cos(a) t^2,  y = y0 - (g/2) sin(a)^2 t^2,  v = g sin(a) t,  t^2 = 2 drop/(g sin(a)^2):

everything may be rational at any time.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING, Any

from flint import ctx

from reference.balls import BALL
from reference.dual import with_slope
from reference.problems.descent.curves import CycloidByArc, FormulaCurve
from reference.problems.descent.surds import SURD, UNKNOWN, NotExactError, Surd, exact_root, exactly, surd

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
    return None if value is None else exact_root(value)


@dataclass(frozen=True)
class Line:
    """The direction of a straight way."""

    sine_square: Surd
    sine_cosine: Surd
    """With the sign of d."""

    def time_square(self, drop: Surd, g: Fraction) -> Surd:
        """t^2 where the body is lower by ``drop``."""
        return 2 * drop / (g * self.sine_square)


@dataclass(frozen=True)
class Rational:
    """The rational values of one descent: None for those that are not known to be rational."""

    slide: Slide
    g: Fraction

    def row(self, row: str, argument: Any) -> Values | None:
        """A row's values at an argument; None if there are no such ones."""
        try:
            found: Values = getattr(self, f"_{row}")(*([] if argument is None else [argument]))
        except NotExactError:
            return None
        return None if all(value is None for value in found) else found

    def _exactly(self, name: str, w: Any) -> Surd | None:
        return exactly(getattr(self.slide.curve, name), w)

    def _drop(self, w: Fraction) -> Surd | None:
        curve, released = self.slide.curve, self.slide.released
        return exactly(lambda m, place: curve.height(m, m.number(released)) - curve.height(m, place), w)

    @cached_property
    def line(self) -> Line | None:
        """The straight line that the way is, if it is known to be one."""
        curve = self.slide.curve
        if not isinstance(curve, FormulaCurve):
            return None
        upright = exactly(lambda m, w: with_slope(m, curve.horizontal, w)[1], UNKNOWN)
        if upright is not None and upright.is_zero:
            return Line(surd(1), surd(0))
        try:
            (dx, dy), (ddx, ddy) = curve.slopes(SURD, UNKNOWN), curve.second_slopes(SURD, UNKNOWN)
            if not surd(dx * ddy - dy * ddx).is_zero:
                return None
            square = dx * dx + dy * dy
            return Line(surd(dy * dy / square), surd(-dx * dy / square))
        except NotExactError:
            return None

    def _descent_time(self) -> Values:
        drop = self._drop(Fraction(1)) if self.line else None
        return (_root(self.line.time_square(drop, self.g)) if self.line and drop else None,)

    def _arc_length(self) -> Values:
        if isinstance(self.slide.curve, CycloidByArc):
            return (4 * (1 - self.slide.released),)
        drop = self._drop(Fraction(1)) if self.line else None
        return (_root(drop * drop / self.line.sine_square) if self.line and drop else None,)

    def _state(self, t: Fraction) -> Values:
        """Of a line, where the height goes as the place: with no second slope along it."""
        released = self.slide.released
        if t == 0:
            return released, Fraction(0) if self.slide.order == 1 else None
        drop = self._drop(Fraction(1)) if self.line and self._even else None
        if self.line is None or drop is None:
            return None, None
        by_square = (1 - released) / self.line.time_square(drop, self.g)
        return _plain(released + by_square * t**2), _plain(2 * by_square * t)

    @property
    def _even(self) -> bool:
        curve = self.slide.curve
        bend = exactly(lambda m, w: curve.second_slopes(m, w)[1], UNKNOWN) if isinstance(curve, FormulaCurve) else None
        return bend is not None and bend.is_zero

    def _motion(self, t: Fraction) -> Values:
        x, y = (self._exactly(name, self.slide.released) for name in ("horizontal", "height"))
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
        x, y = (_plain(self._exactly(name, w)) for name in ("horizontal", "height"))
        if w == self.slide.released:
            return Fraction(0), x, y, Fraction(0), Fraction(0)
        drop = self._drop(w)
        if drop is None:
            upright = self.line is not None and self.line.sine_cosine.is_zero
            return None, x, y, None, Fraction(0) if upright else None
        square = 2 * self.g * drop
        time = _root(self.line.time_square(drop, self.g)) if self.line else None
        return time, x, y, _root(square), self._velocity_x(w, square)

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
