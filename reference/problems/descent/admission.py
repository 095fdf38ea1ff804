"""Which curves a body can slide down from rest, and the sentence for each that it cannot.

What is admitted is proven: the curve starts downwards or from a cusp as the cycloid's, and the chart of its integrand
(clock.pieces) exists, so that between the start and the end it is real, analytic, below its start and never at a stop.
"""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING

from flint import acb, arb

from reference.balls import BALL, ComplexBall
from reference.names import short
from reference.precision import ctx
from reference.problems.descent.clock import NoChartError, pieces
from reference.problems.descent.curves import Curve, FormulaCurve
from reference.problems.descent.exactly import exactly
from reference.problems.descent.slide import Slide

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["admitted"]

BITS = 256
SAMPLES = 256
BY_PARAMETER = "a curve that is vertical there is accepted by a parameter, 'x = ...; y = ...'"
NEAR = Fraction(1, 10**9)
"""How far around a place where a curve fails it is looked at to find out why."""


@lru_cache(maxsize=256)
def admitted(curve: Curve, released: Fraction) -> Slide:
    """The slide from rest at the fraction ``released`` of the way.

    Raises:
        ValueError: a body at rest does not slide down this curve to its end, or the curve is not smooth.
    """
    with ctx.workprec(BITS):
        _check_ends(curve, released)
        slide = Slide(curve, released, _order(curve, released))
        _check_way(slide)
        try:
            pieces(slide, "slowness")
        except NoChartError as failure:
            raise _refusal(curve, _failing(slide, failure.args[0])) from None
    return slide


def _refusal(curve: Curve, why: str) -> ValueError:
    return ValueError(f"curve '{short(curve.name)}' {why}.")


def _at(curve: Curve, w: Fraction, radius: Fraction = Fraction(0)) -> tuple[arb, arb, arb]:
    """The height, its slope and N around w; not numbers where the curve is not analytic or not real."""
    place = acb(arb(BALL.number(w), BALL.number(radius)))
    height, slope, arc_square = (
        acb(value).real if acb(value).imag.contains(0) else arb.nan()
        for value in curve.profile(ComplexBall(analytic=True), place)
    )
    return height, slope, arc_square


def _check_ends(curve: Curve, released: Fraction) -> None:
    if isinstance(curve, FormulaCurve):
        start, end = curve.start(BALL), curve.end(BALL)
        for name, value in (("start", start), ("end", end)):
            if not value.is_finite():
                raise _refusal(curve, f"does not {name} at a finite real number")
        if start.overlaps(end):
            raise _refusal(curve, "has the same start and end; two ends that differ are accepted")
    (top, *_), (bottom, *_) = (_at(curve, w) for w in (released, Fraction(1)))
    if top.is_finite() and bottom.is_finite() and not top > bottom:
        raise _refusal(curve, "ends no lower than it starts; an end below the start is accepted")


def _order(curve: Curve, released: Fraction) -> int:
    """1 where the curve leaves the start downwards, 2 where it leaves a cusp as the cycloid does."""
    _, slope, arc_square = _at(curve, released)
    if not (slope.is_finite() and arc_square.is_finite()):
        raise _refusal(
            curve,
            f"is not real and analytic with a finite slope at its start; {BY_PARAMETER}",
        )
    if slope < 0:
        return 1
    if slope > 0:
        raise _refusal(curve, "rises from its start; a curve that leaves it downwards is accepted")
    if arc_square > 0:
        raise _refusal(curve, "starts horizontally, where a body at rest stays; a start that slopes down is accepted")
    if not (isinstance(curve, FormulaCurve) and _leaves_a_cusp(curve, released)):
        raise _refusal(
            curve,
            "starts where its parameter stands still (x' = y' = 0) otherwise than in a cusp as the cycloid's, "
            "which alone is accepted",
        )
    return 2


def _leaves_a_cusp(curve: FormulaCurve, released: Fraction) -> bool:
    """Whether x' and y' are exactly zero and y'' < 0."""
    slopes = [exactly(lambda m, w, i=i: curve.slopes(m, w)[i], released) for i in (0, 1)]  # type: ignore[misc]
    if not all(slope is not None and slope.is_zero for slope in slopes):
        return False
    return bool(curve.second_slopes(BALL, BALL.number(released))[1] < 0)


def _check_way(slide: Slide) -> None:
    """Look at many places for one that is proven to be above the start."""
    top, *_ = _at(slide.curve, slide.released)
    for w in _samples(slide.released):
        height, *_ = _at(slide.curve, w)
        if height > top:
            raise _refusal(slide.curve, f"rises above its start at {slide.curve.spelled(w)}")


def _samples(released: Fraction) -> Iterator[Fraction]:
    return (released + (1 - released) * Fraction(i, SAMPLES) for i in range(1, SAMPLES + 1))


def _failing(slide: Slide, u: Fraction) -> str:
    """Why the chart found no way past the place u."""
    with ctx.workprec(BITS):
        w = slide.released + (1 - slide.released) * u ** (3 - slide.order)
        place = slide.curve.spelled(w)
        top, *_ = _at(slide.curve, slide.released)
        height, slope, arc_square = _at(slide.curve, w, NEAR * (1 - slide.released))
    if not (height.is_finite() and slope.is_finite() and arc_square.is_finite()):
        return f"is not real and analytic with a finite slope near {place}; {BY_PARAMETER}"
    if not top > height:
        return f"comes up to the level of its start near {place}, where a body from rest comes to rest"
    if not arc_square > 0:
        return f"has a cusp or a parameter that stands still (x' = y' = 0) near {place}"
    return f"is bent too sharply or has a pole near {place}, for the bound on the work"
