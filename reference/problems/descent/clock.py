"""The time and the arc on a curve as functions of the place, and the place as a function of the time, in balls.

The way is cut into pieces.  On each the integrand h, dt/du or ds/du, is expanded in a Taylor series about the
piece's centre c, of half-width r; it is proven to be analytic and bounded by M where |u - c| <= R = REACH r, so that by
Cauchy's estimate the terms from the n-th on are at most M (|u - c|/R)^n/(1 - |u - c|/R).  The pieces are found once
for a curve, the series once for a precision; then a time costs one polynomial, and a place a few.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from flint import acb, arb, arb_poly, arb_series

from reference.arithmetic.balls import BALL, SERIES
from reference.arithmetic.precision import ctx
from reference.problems.descent.analytic import ANALYTIC
from reference.problems.descent.centred import centred

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.problems.descent.slide import Slide

__all__ = ["ChartWorkError", "NoChartError", "Primitive", "arc", "clock", "pieces"]

REACH = 3
OVERLAP = Fraction(5, 4)
"""A piece's series serves places up to this many half-widths from its centre: neighbouring pieces overlap."""
CHART_BITS = (64, 512)
"""Working precisions of a chart, the latter for a curve that falls by little of its height."""
MAX_BOXES = 64
"""Complex balls in which a disc is covered, before it is cut."""
MAX_CUTS = 4
"""How often the squares that cover a disc are cut in four, before it is cut."""
MAX_DEPTH = 40
MAX_DISCS = 2500
"""Discs that are tried for one curve."""
MAX_OPERATIONS = 1_000_000
"""Terms of the curve's formulas that are evaluated in complex balls for one curve."""
CENTRED_COST = 4
Way = tuple[int, "Callable[[Any, acb], Any]"]
"""What an evaluation of the integrand costs, and the integrand."""


class NoChartError(ArithmeticError):
    """A curve could not be cut into pieces on which its integrand is analytic: the place is the argument."""


class ChartWorkError(NoChartError):
    """The bounds on the work were reached at the place that is the argument."""


@dataclass(frozen=True)
class Piece:
    """The places u with |u - centre| <= radius, and a bound of |h| on the disc that is REACH times as wide."""

    centre: Fraction
    radius: Fraction
    bound: arb

    @property
    def first(self) -> bool:
        """Whether it begins at the start, about which it is expanded."""
        return self.centre == 0

    @property
    def end(self) -> Fraction:
        """The place where the next piece begins."""
        return self.centre + self.radius


@lru_cache(maxsize=256)
def pieces(slide: Slide, of: str) -> tuple[Piece, ...]:
    """The pieces of the way, from the start on, for the integrand of this name.

    Raises:
        ChartWorkError: MAX_DISCS or MAX_OPERATIONS are not enough.
        NoChartError: a piece would be shorter than 2^-MAX_DEPTH: the integrand is not analytic near the place.
    """
    low, high = CHART_BITS
    try:
        return _pieces(slide, of, low)
    except ChartWorkError:
        raise
    except NoChartError:
        return _pieces(slide, of, high)


def _pieces(slide: Slide, of: str, bits: int) -> tuple[Piece, ...]:
    """The same at one precision."""
    found: list[Piece] = []
    cover, tried = _Cover(slide, of), 0
    waiting = [(Fraction(0), Fraction(1))]
    while waiting:
        low, high = waiting.pop()
        tried += 1
        if (high - low) * 2**MAX_DEPTH < 1:
            raise NoChartError((low + high) / 2)
        if tried > MAX_DISCS or cover.operations > MAX_OPERATIONS:
            raise ChartWorkError(low)
        centre, radius = (Fraction(0), high) if low == 0 else ((low + high) / 2, (high - low) / 2)
        with ctx.workprec(bits):
            bound = cover.bound(centre, REACH * radius)
        if bound is None:
            middle = (low + high) / 2
            waiting += [(middle, high), (low, middle)]
        else:
            found.append(Piece(centre, radius, bound))
    return tuple(found)


class _Cover:
    """Covers discs with squares on which an integrand is analytic, and counts the work."""

    def __init__(self, slide: Slide, of: str) -> None:
        self._ways: list[Way] = [(slide.curve.size, getattr(slide, of))]
        sharper = centred(slide)
        if sharper is not None:
            self._ways.append((CENTRED_COST * slide.curve.size, getattr(sharper, of)))
        self.operations = 0

    def bound(self, centre: Fraction, reach: Fraction) -> arb | None:
        """A bound of the integrand, real on the real axis, on a disc on which it is proven to be analytic.

        The half of the disc above the real axis is covered with squares, cut in four until the integrand is analytic on
        each of them; None where that takes too much.  The largest squares are tried with sharper enclosures too.
        """
        largest, half = arb(0), reach / 2
        squares, seen = [(centre - half, half, half, 0), (centre + half, half, half, 0)], 0
        while squares:
            x, y, half, cuts = squares.pop()
            if _beyond(abs(x - centre) - half, y - half, reach):
                continue
            seen += 1
            square = acb(arb(BALL.number(x), BALL.number(half)), arb(BALL.number(y), BALL.number(half)))
            value = self._size(square, self._ways[: 1 if cuts else 2])
            if value is not None:
                largest = arb.max(largest, value)
            elif seen + len(squares) > MAX_BOXES or cuts == MAX_CUTS:
                return None
            else:
                half /= 2
                squares += [(x + i * half, y + j * half, half, cuts + 1) for i in (-1, 1) for j in (-1, 1)]
        return largest.upper()

    def _size(self, square: acb, ways: Sequence[Way]) -> arb | None:
        """A bound on a square; None if the integrand is not proven to be analytic there."""
        for cost, function in ways:
            self.operations += cost
            value = acb(function(ANALYTIC, square))
            if value.is_finite():
                return value.abs_upper()
        return None


def _beyond(x: Fraction, y: Fraction, reach: Fraction) -> bool:
    """Whether the nearest corner or side, x and y away, is farther away than ``reach``."""
    return max(x, Fraction(0)) ** 2 + max(y, Fraction(0)) ** 2 > reach**2


@dataclass(frozen=True)
class Expansion:
    """A piece's series of h in x = (u - centre)/radius, its integral, and the integral at which the piece begins."""

    piece: Piece
    begins: arb
    integrand: arb_poly
    integral: arb_poly
    rest: arb
    """The terms left out of h: at most this much, on either side of zero."""

    def total(self, u: arb) -> arb:
        """The integral of h up to the place u."""
        x = self._x(u)
        left = u if self.piece.first else u - BALL.number(self.piece.centre - self.piece.radius)
        return self.begins + self.integral(x) + left * self.rest

    def value(self, u: arb) -> arb:
        """The integrand h at the place u."""
        return self.integrand(self._x(u)) + self.rest

    def _x(self, u: arb) -> arb:
        """Not a number outside of what the series serves."""
        x = (u - BALL.number(self.piece.centre)) / BALL.number(self.piece.radius)
        return x if abs(x) <= BALL.number(OVERLAP) else arb.nan()

    @property
    def bracket(self) -> tuple[arb, arb]:
        """Places that enclose the piece."""
        reach = (1 + OVERLAP) / 2 * self.piece.radius
        return BALL.number(self.piece.centre - reach), BALL.number(self.piece.centre + reach)


def _expansion(slide: Slide, of: str, piece: Piece, begins: arb) -> Expansion:
    """The series of a piece at the precision in force, long enough for it."""
    ratio = OVERLAP / REACH
    terms = math.ceil((ctx.prec + 8) / -math.log2(ratio))
    with SERIES.of_length(terms + 2):
        series = getattr(slide, of)(SERIES, arb_series([BALL.number(piece.centre), BALL.number(piece.radius)]))
    integrand = arb_poly(series.coeffs())
    rest = piece.bound * BALL.number(ratio**series.prec / (1 - ratio))
    integral = integrand.integral() * BALL.number(piece.radius)
    begun = integral if piece.first else integral - integral(arb(-1))
    return Expansion(piece, begins, integrand, begun, arb(0, rest.upper()))


class Primitive:
    """The integral of a positive integrand of a slide up to any place u in [0, 1], and back, at one precision."""

    def __init__(self, slide: Slide, of: str) -> None:
        self._expansions: list[Expansion] = []
        self.total = arb(0)
        for piece in pieces(slide, of):
            self._expansions.append(_expansion(slide, of, piece, self.total))
            self.total = self._expansions[-1].total(BALL.number(piece.end))

    def at(self, u: arb) -> tuple[arb, arb]:
        """The integral up to the place, and the integrand there."""
        here = next((each for each in self._expansions if u.mid() <= BALL.number(each.piece.end)), self._expansions[-1])
        return here.total(u), here.value(u)

    def place(self, total: arb) -> tuple[arb, arb]:
        """The place up to which the integral is ``total``, and the integrand there."""
        if total.is_zero():
            return arb(0), self._expansions[0].value(arb(0))
        here = next(each for each in reversed(self._expansions) if each.begins.mid() <= total.mid())

        def missing(_m: Any, u: Any) -> Any:
            value = here.value(u.value)
            return u.along(here.total(u.value) - total, lambda slope: value * slope)

        u = BALL.root(missing, *here.bracket)
        return u, here.value(u)


@lru_cache(maxsize=32)
def clock(slide: Slide, bits: int) -> Primitive:
    """sqrt(2 g) t as a function of the place, at a precision."""
    with ctx.workprec(bits):
        return Primitive(slide, "slowness")


def arc(slide: Slide) -> arb:
    """The length of the way, at the precision in force."""
    return Primitive(slide, "arc_rate").total
