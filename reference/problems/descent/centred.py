"""Sharper enclosures of a curve on a ball, for formulas in which much cancels, such as (x + 1)**2 - x**2.

About the centre c of a ball B, f(B) lies in f(c) + f'(c) (B - c) + f''(B) (B - c)^2/2 and f'(B) in
f'(c) + f''(B) (B - c), by Taylor's theorem with the rest as an integral over the segment from c, which is in B
(R. E. Moore, Interval Analysis, 1966, chapter 6, has the mean value form).
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any

from flint import acb

from reference.arithmetic.dual import with_slope
from reference.problems.descent.curves import FormulaCurve

if TYPE_CHECKING:
    from collections.abc import Callable

    from reference.problems.descent.slide import Slide

__all__ = ["centred"]


@dataclass(frozen=True)
class CentredCurve(FormulaCurve):
    """A curve whose profile on a complex ball is enclosed about the ball's centre too."""

    def profile(self, m: Any, w: Any) -> tuple[Any, Any, Any]:
        _, dx = _enclosed(m, self.horizontal, w)
        y, dy = _enclosed(m, self.height, w)
        return y, dy, dx * dx + dy * dy


def centred(slide: Slide) -> Slide | None:
    """The slide with a curve that is enclosed so; None if its curve is no formula."""
    curve = slide.curve
    if not isinstance(curve, FormulaCurve):
        return None
    return replace(slide, curve=CentredCurve(**{field.name: getattr(curve, field.name) for field in fields(curve)}))


def _enclosed(m: Any, function: Callable[[Any, Any], Any], ball: acb) -> tuple[acb, acb]:
    """The function and its slope over a ball."""

    def slope(duals: Any, place: Any) -> Any:
        return with_slope(duals, function, place)[1]

    centre = acb(ball.mid())
    away = ball - centre
    value, over = with_slope(m, function, ball)
    middle, rate = with_slope(m, function, centre)
    bend = with_slope(m, slope, ball)[1]
    nearer = _meet(over, rate + bend * away)
    return _meet(value, middle + rate * away + bend * away * away / 2), nearer


def _meet(one: Any, other: Any) -> acb:
    """What both balls hold; where one is not finite, the other."""
    one, other = acb(one), acb(other)
    if not (one.is_finite() and other.is_finite()):
        return one if one.is_finite() else other
    return acb(one.real.intersection(other.real), one.imag.intersection(other.imag))
