"""Which curves a body can slide down from rest, and the sentence for each that it cannot.

What is admitted is proven: every part of its formulas is real and finite on all of the way (reality.unreal), the curve
starts downwards or from a cusp as the cycloid's, and the chart of its integrand (clock.pieces) exists, so that between
the start and the end it is analytic, below its start and never at a stop.
"""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING

from flint import acb, arb

from reference.arithmetic.balls import BALL
from reference.arithmetic.precision import ctx
from reference.arithmetic.real_domains import OutsideDomainError, real
from reference.arithmetic.surds import exactly
from reference.names import short
from reference.problems.descent.analytic import ANALYTIC
from reference.problems.descent.clock import MAX_DEPTH, MAX_DISCS, MAX_OPERATIONS, ChartWorkError, NoChartError, pieces
from reference.problems.descent.curves import Curve, FormulaCurve
from reference.problems.descent.reality import Unreal, unreal
from reference.problems.descent.slide import Slide

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["admitted"]

BITS = 256
SAMPLES = 256
APART = f"are not proven with {BITS} bits to differ"
REAL = "a curve that is real and finite on all of its way is accepted"
BY_PARAMETER = "a curve that is vertical there is accepted by a parameter, 'x = ...; y = ...'"
NEAR = Fraction(8, 2**MAX_DEPTH)
"""How far around a place where a curve fails, as a part of its way, it is looked at to find out why."""


@lru_cache(maxsize=256)
def admitted(curve: Curve, released: Fraction) -> Slide:
    """The slide from rest at the fraction ``released`` of the way.

    Raises:
        ValueError: a body at rest does not slide down this curve to its end, or the curve is not smooth.
    """
    with ctx.workprec(BITS):
        doubt = _check_formulas(curve, released) if isinstance(curve, FormulaCurve) else None
        _check_ends(curve, released)
        slide = Slide(curve, released, _order(curve, released, doubt))
        if doubt is not None and doubt.pole:
            raise _doubtful(curve, doubt)
        _check_way(slide)
        try:
            pieces(slide, "slowness")
        except NoChartError as failure:
            raise _without_chart(slide, failure) from None
        if doubt is not None:
            raise _doubtful(curve, doubt)
    return slide


def _refusal(curve: Curve, why: str) -> ValueError:
    return ValueError(f"curve '{short(curve.name)}' {why}.")


def _at(curve: Curve, w: Fraction, radius: Fraction = Fraction(0)) -> tuple[arb, arb, arb]:
    """The height, its slope and N around w; not numbers where the curve is not analytic or not real."""
    place = _around(w, radius)
    height, slope, arc_square = (
        acb(value).real if acb(value).imag.contains(0) else arb.nan() for value in curve.profile(ANALYTIC, place)
    )
    return height, slope, arc_square


def _around(w: Fraction, radius: Fraction) -> acb:
    return acb(arb(BALL.number(w), BALL.number(radius)))


def _check_formulas(curve: FormulaCurve, released: Fraction) -> Unreal | None:
    """Refuse a curve without a value at a place of the way; return what could not be proven to have one."""
    for name, formula in (("start", curve.start), ("end", curve.end)):
        try:
            _ = real(formula)
        except OutsideDomainError as failure:
            raise _refusal(curve, f"does not {name} at a finite real number: {failure}") from None
    if curve.start(BALL).overlaps(curve.end(BALL)):
        same = exactly(lambda m, _: curve.start(m) - curve.end(m), 0)
        fails = "has the same start and end" if same is not None and same.is_zero else f"has ends that {APART}"
        raise _refusal(curve, f"{fails}; two ends that differ are accepted")
    found = unreal(curve, (released, *_samples(released)), released)
    if found is None or not (found.certain or found.everywhere):
        return found
    if not found.certain:
        raise _doubtful(curve, found)
    place = "" if found.everywhere else f" at {curve.spelled(found.w)}"
    raise _refusal(curve, f"is not real and finite{place}: {found.why}; {REAL}")


def _doubtful(curve: Curve, found: Unreal) -> ValueError:
    """The refusal of a curve with a part that could not be proven to have a value."""
    place = "" if found.everywhere else f" near {curve.spelled(found.w)}"
    return _refusal(curve, f"could not be proven to be real and finite{place}: {found.why}; {REAL}")


def _check_ends(curve: Curve, released: Fraction) -> None:
    (top, *_), (bottom, *_) = (_at(curve, w) for w in (released, Fraction(1)))
    if top.is_finite() and bottom.is_finite() and not top > bottom:
        fails = "ends no lower than it starts" if top <= bottom else f"is not proven with {BITS} bits to end lower"
        raise _refusal(curve, f"{fails}; an end below the start is accepted")


def _order(curve: Curve, released: Fraction, doubt: Unreal | None) -> int:
    """1 where the curve leaves the start downwards, 2 where it leaves a cusp as the cycloid does."""
    _, slope, arc_square = _at(curve, released)
    if not (slope.is_finite() and arc_square.is_finite()):
        if doubt is not None and doubt.pole:
            raise _doubtful(curve, doubt)
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


def _without_chart(slide: Slide, failure: NoChartError) -> ValueError:
    """The refusal of a curve on which no way was found past a place u."""
    (u,) = failure.args
    w = slide.released + (1 - slide.released) * u ** (3 - slide.order)
    place = slide.curve.spelled(w)
    if isinstance(failure, ChartWorkError):
        return _refusal(
            slide.curve,
            f"could not be proven to be smooth from {place} on within the bounds on the work, {MAX_DISCS} pieces tried "
            f"and {MAX_OPERATIONS} operations; a shorter way, fewer bends or a shorter formula is accepted",
        )
    return _refusal(slide.curve, _failing(slide, w, place))


def _failing(slide: Slide, w: Fraction, place: str) -> str:
    """Why there is no chart around the place w, however short its pieces."""
    radius = min(NEAR * (1 - slide.released), (w - slide.released) / 8)
    with ctx.workprec(BITS):
        top, *_ = _at(slide.curve, slide.released)
        height, slope, arc_square = _at(slide.curve, w, radius)
        still = all(acb(one).contains(0) for one in slide.curve.slopes(ANALYTIC, _around(w, radius)))
    if not (height.is_finite() and slope.is_finite() and arc_square.is_finite()):
        return f"is not real and analytic with a finite slope near {place}; {BY_PARAMETER}"
    if not top > height:
        return (
            f"comes up to the level of its start near {place}, where a body from rest comes to rest, or too near to it "
            "to be told apart"
        )
    if still:
        return f"has a cusp or a parameter that stands still (x' = y' = 0) near {place}"
    if w == slide.released or (w - slide.released) * 2**MAX_DEPTH < 1 - slide.released:
        return (
            f"bends at its start within less than 2^-{(3 - slide.order) * MAX_DEPTH} of its way, so small is its slope "
            "beside its curvature there; a steeper start is accepted"
        )
    return (
        f"has a pole near {place} or bends there within less than 2^-{MAX_DEPTH} of its way; "
        f"a curve that bends less sharply is accepted"
    )
