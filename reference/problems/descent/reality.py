"""Whether the formulas of a curve are real and finite on all of the way, proven by covering it with real balls."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from flint import arb

from reference.arithmetic.balls import BALL
from reference.arithmetic.real_domains import OutsideDomainError, real

if TYPE_CHECKING:
    from collections.abc import Iterable

    from reference.problems.descent.curves import FormulaCurve

__all__ = ["Unreal", "unreal"]

MAX_BOXES = 2000
"""Pieces of the way that are looked at, beyond which there is no proof."""
MAX_HALVINGS = 40


class Unreal:
    """A part of a curve without a value, or without a proof that it has one, and the fraction w of the way there."""

    def __init__(self, failure: OutsideDomainError, w: Fraction) -> None:
        self.why, self.certain, self.pole = str(failure), failure.certain, failure.pole
        self.everywhere = failure.constant
        self.w = w


def unreal(curve: FormulaCurve, places: Iterable[Fraction], released: Fraction) -> Unreal | None:
    """What is not real on the way from ``released`` on, first at the ``places``; None if all of it is proven to be."""
    for w in places:
        found = _at(curve, w, Fraction(0))
        if found is not None and (found.certain or found.everywhere):
            return found
    boxes, seen = [((1 + released) / 2, (1 - released) / 2)], 0
    least = (1 - released) / 2**MAX_HALVINGS
    while boxes:
        w, radius = boxes.pop()
        seen += 1
        found = _at(curve, w, radius)
        if found is None:
            continue
        if found.certain:
            return _at(curve, w, Fraction(0)) or found
        if radius < least or seen > MAX_BOXES:
            return found
        boxes += [(w + radius / 2, radius / 2), (w - radius / 2, radius / 2)]
    return None


def _at(curve: FormulaCurve, w: Fraction, radius: Fraction) -> Unreal | None:
    """What is not proven to be real within ``radius`` of w; at the ends of the parameter themselves, exactly there."""
    around = arb(BALL.number(w), BALL.number(radius))
    parameter = curve.parameter(BALL, around) if radius else curve.end_or_parameter(BALL, w)
    try:
        for formula in (curve.x, curve.y):
            real(formula, parameter)
    except OutsideDomainError as failure:
        return Unreal(failure, w)
    return None
