"""Integrals of periodic functions by the trapezoidal rule, whose error falls geometrically.

For f of period 2 pi, analytic and |f| <= M in the strip |Im x| <= a, the rule with n points is within
4 pi M/(exp(a n) - 1) of the integral (L. N. Trefethen and J. A. C. Weideman, SIAM Review 56, 385, 2014, theorem 3.2).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from flint import acb, arb

from reference.arithmetic.namespaces import BALL, ComplexBall
from reference.arithmetic.precision import ctx, mp

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["periodic_ball", "periodic_mpmath"]

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
