"""Quadrature rules for an extremal: Gauss's over panels as wide as the integrand is smooth, and the trapezoidal rule.

The latter's error falls geometrically for a periodic function: for f of period 2 pi, analytic and |f| <= M in the strip
|Im x| <= a, the rule with n points is within 4 pi M/(exp(a n) - 1) of the integral (L. N. Trefethen and J. A. C.
Weideman, SIAM Review 56, 385, 2014, theorem 3.2).
"""

from __future__ import annotations

import cmath
import math
from bisect import bisect_right
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from flint import acb, arb

from reference.arithmetic.namespaces import BALL, ComplexBall
from reference.arithmetic.precision import ctx, mp

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.problems.polar.equations import Field

__all__ = ["Panels", "Schedule", "panels_of", "periodic_ball", "periodic_mpmath"]

MAX_POINTS = 1 << 13
SPLITS = 14
BOUND_BITS = 64


def periodic_ball(function: Callable[[Any, Any], Any], widths: list[float]) -> arb | None:
    """A ball around the integral over 0 <= x <= 2 pi of a real function(m, x); None where it would take too long.

    ``widths`` are of strips to try, the widest first.
    """
    for width in widths:
        points = math.ceil(ctx.prec * math.log(2) / width)
        if points > MAX_POINTS:
            return None
        bound = _bound(function, width)
        if bound is not None:
            step = 2 * arb.pi() / points
            total = sum((function(BALL, step * i) for i in range(points)), arb(0))
            error = 4 * arb.pi() * bound / ((arb(width) * points).exp() - 1)
            return step * total + error * arb(0, 1)
    return None


def _bound(function: Callable[[Any, Any], Any], width: float) -> arb | None:
    """A bound of |f| over the upper half of the strip, its mirror image by symmetry; None where none is found."""
    m = ComplexBall(analytic=True)
    largest = arb(0)
    with ctx.workprec(BOUND_BITS):
        pending = [(0.0, 6.3, 0.0, width, SPLITS)]
        while pending:
            left, right, low, high, splits = pending.pop()
            box = acb(_between(left, right), _between(low, high))
            value = abs(acb(function(m, box)))
            if value.is_finite():
                largest = largest.max(value.abs_upper())
            elif splits == 0:
                return None
            elif right - left > high - low:
                middle = (left + right) / 2
                pending += [(left, middle, low, high, splits - 1), (middle, right, low, high, splits - 1)]
            else:
                middle = (low + high) / 2
                pending += [(left, right, low, middle, splits - 1), (left, right, middle, high, splits - 1)]
    return largest


def _between(low: float, high: float) -> arb:
    return arb((low + high) / 2, (high - low) / 2 * (1 + 1e-12))


def periodic_mpmath(function: Callable[[Any], Any]) -> Any:
    """The same in mpmath's numbers, by doubling the points until half the digits stand: by then all do.

    Raises:
        ArithmeticError: they do not stand.
    """
    points, step = 32, mp.pi / 16
    total = mp.fsum(function(step * i) for i in range(points))
    rule, change = step * total, mp.inf
    while change > abs(rule) * mp.mpf(2) ** (-(mp.prec + 8) / 2):
        if points > MAX_POINTS:
            raise ArithmeticError(f"the trapezoidal rule did not settle with {points} points.")
        total += mp.fsum(function(step * (i + mp.mpf(1) / 2)) for i in range(points))
        points, step, before = 2 * points, step / 2, rule
        rule = step * total
        change = abs(rule - before)
    return rule


NEARNESS = 4
"""A panel reaches from its middle at most this part of the way to the nearest singularity: per node of Gauss's rule an
integral gains at least log2(4 + sqrt(17)) = 3 bits twice."""
FLOAT_NODES = 12
FLOATS: Any = math
"""What the rates of a field ask of an arithmetic, the module has for floats."""


class Panels:
    """The panels of an interval that keep away from the singularities of an integrand in the complex plane.

    Of each conjugate pair one point is enough; with a period they repeat.
    """

    def __init__(self, singular: Sequence[complex], period: float | None = None) -> None:
        self._singular, self._period = singular, period

    def distance(self, x: float) -> float:
        """From a real x to the nearest singularity."""
        if self._period is not None:
            x %= self._period
        return min(abs(x - point) for point in self._singular)

    def between(self, low: float, high: float) -> list[float]:
        """The ends of the panels from low to high, the first left out."""
        middle = (low + high) / 2
        if NEARNESS * abs(high - low) <= 2 * self.distance(middle) or middle in (low, high):
            return [high]
        return [*self.between(low, middle), *self.between(middle, high)]


def panels_of(field: Field, z0: float) -> Panels:
    """For the rates of an extremal in psi."""
    squares = (complex(*point) for point in field.singular(FLOATS, inner(z0)))
    first = [2 * cmath.acos(cmath.sqrt(square)) for square in squares]
    return Panels(first + [2 * math.pi - point for point in first], 2 * math.pi)


def inner(z0: float) -> float:
    """A lowest point that is neither 0 nor 1 where it is rounded to a float: for guesses, and for distances."""
    return min(max(z0, 1e-300), 1 - 2.0**-53)


@lru_cache(maxsize=1)
def _rule() -> list[tuple[float, float]]:
    """Gauss's nodes and weights on [-1, 1]."""
    with ctx.workprec(BOUND_BITS):
        rule = [arb.legendre_p_root(FLOAT_NODES, i, weight=True) for i in range(FLOAT_NODES)]
    return [(float(node), float(weight)) for node, weight in rule]


class Schedule:
    """tau at the ends of panels from the release to the lowest point, in floats: where to look for a given tau."""

    def __init__(self, field: Field, z0: float) -> None:
        self._field, self._z0 = field, inner(z0)
        self._psi = [0.0, *panels_of(field, z0).between(0.0, math.pi)]
        self._tau = [0.0]
        for low, high in zip(self._psi[:-1], self._psi[1:], strict=True):
            self._tau.append(self._tau[-1] + self._passed(low, high))

    def _rate(self, psi: float) -> float:
        rate: float = self._field.rates(FLOATS, self._z0, math.sin(psi / 2) ** 2, math.cos(psi / 2) ** 2)[1]
        return rate

    def _passed(self, low: float, high: float) -> float:
        half = (high - low) / 2
        return half * sum(weight * self._rate(low + half + half * node) for node, weight in _rule())

    def psi_at(self, part: float) -> float:
        """psi at a part of the descent time from -1 to 1, to about the accuracy of floats."""
        if part < 0:
            return -self.psi_at(-part)
        tau = part * self._tau[-1]
        i = min(bisect_right(self._tau, tau), len(self._tau) - 1)
        start, low, high = self._psi[i - 1], self._psi[i - 1], self._psi[i]
        psi = (low + high) / 2
        for _ in range(60):
            late = self._tau[i - 1] + self._passed(start, psi) - tau
            low, high = (low, psi) if late > 0 else (psi, high)
            moved = psi - late / self._rate(psi)
            if not low <= moved <= high:
                moved = (low + high) / 2
            if abs(moved - psi) <= 1e-15 * psi:
                return moved
            psi = moved
        return psi
