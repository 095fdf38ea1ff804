"""Slopes and what they are worth: the order over the asymptotic range, lines with intervals."""

from __future__ import annotations

import math
from statistics import median
from typing import TYPE_CHECKING

import numpy as np

from compare.measure.records import FittedOrder

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.measure.records import Cell
    from compare.methods.kinds.one_step import Method

__all__ = ["fit_order", "longest_run", "slope_with_interval", "student_95"]

SLOPE_TOLERANCE = 0.05
MIN_CELLS = 3
SELDOM = 0.25
"""Of its bound rounding is seldom more than so much, and mostly an eighth."""
CLEAR = 0.001
"""The spread is that of slopes which rounding changes by no more, where there are two of them."""
NO_POWER = 0.003
"""By about so much of itself an error of the asymptotic range departs from a power of h."""


def fit_order(method: Method, cells: Sequence[Cell]) -> FittedOrder:
    """Fit one slope of log(max_error) against log(h) over the asymptotic range of one method's cells on one case.

    The range is read off the data, never off the declared order: floor cells and errors above 1 (rad, or the place's
    own size) are left out, and of the rest the longest run is taken in which neighbouring slopes stay within
    SLOPE_TOLERANCE of the median of the three finest.
    """
    usable = [cell for cell in cells if not cell.floor and 0 < cell.max_error <= 1]
    x = [math.log(cell.n) for cell in usable]
    y = [-math.log(cell.max_error) for cell in usable]
    slopes = [(y[i + 1] - y[i]) / (x[i + 1] - x[i]) for i in range(len(usable) - 1)]
    first, last = longest_run(slopes, median(slopes[-3:]), SLOPE_TOLERANCE) if slopes else (0, 0)
    chosen = usable[first:last] if last - first >= MIN_CELLS else []
    fitted = spread = None
    rounding = spread_rounding = 0.0
    if chosen:
        fitted, rounding = _weighted_slope(np.array(x[first:last]), np.array(y[first:last]), chosen)
        pairs = [
            (abs(slope - fitted), SELDOM * cell.order_rounding)
            for slope, cell in zip(slopes[first : last - 1], chosen[1:], strict=True)
        ]
        clear = [pair for pair in pairs if pair[1] <= CLEAR]
        spread, spread_rounding = max(clear if len(clear) > 1 else pairs)
        spread_rounding += rounding
    return FittedOrder(
        method=method.name,
        case=cells[0].case,
        declared_order=method.order,
        fitted_order=fitted,
        spread=spread,
        cells_used=len(chosen),
        n_range=(chosen[0].n, chosen[-1].n) if chosen else None,
        rounding=rounding,
        spread_rounding=spread_rounding,
    )


def _weighted_slope(x: np.ndarray, y: np.ndarray, cells: Sequence[Cell]) -> tuple[float, float]:
    """The least-squares slope of y = -log(error) against x, and what rounding can make of it.

    A cell weighs the less the more of it may be rounding, which of several cells is seldom more than SELDOM.
    """
    relative = np.array([SELDOM * cell.rounding / cell.max_error for cell in cells])
    weights = 1 / (NO_POWER**2 + relative**2)
    centred = x - weights @ x / weights.sum()
    shares = weights * centred / (weights * centred @ centred)
    return float(shares @ y), float(np.linalg.norm(shares * relative))


def longest_run(slopes: Sequence[float], near: float, tolerance: float, least_end: int = 0) -> tuple[int, int]:
    """The cells [first, last) of the longest run of slopes near a number, the finer of two; (0, 0) where none is.

    A run that ends before the slope at ``least_end`` does not count.
    """
    best, first = (0, 0), 0
    for i, slope in enumerate(slopes):
        if abs(slope - near) > tolerance:
            first = i + 1
        elif i >= least_end and i + 2 - first >= best[1] - best[0]:
            best = first, i + 2
    return best


def slope_with_interval(x: np.ndarray, y: np.ndarray) -> tuple[float, float]:
    """The least-squares slope of y against x and the half-width of its 95 % interval; NaN below three points."""
    if len(x) < 3 or not np.all(np.isfinite(y)):
        return math.nan, math.nan
    scale = float(np.max(x) - np.min(x))
    centred = (x - x.mean()) / scale
    spread = float(centred @ centred)
    slope = float(centred @ (y - y.mean())) / spread
    residual = y - y.mean() - slope * centred
    freedom = len(x) - 2
    half = student_95(freedom) * math.sqrt(float(residual @ residual) / freedom / spread)
    return slope / scale, half / scale


def student_95(freedom: int) -> float:
    """The two-sided 95 % quantile of Student's t, by the expansion at infinity of Abramowitz and Stegun 26.7.5.

    Exact in closed form for one and two degrees of freedom; within 0.3 % from three on.
    """
    if freedom == 1:
        return math.tan(0.475 * math.pi)
    if freedom == 2:
        return 0.95 * math.sqrt(2 / (1 - 0.95 * 0.95))
    x = 1.959963984540054
    terms = (
        (x**3 + x) / 4,
        (5 * x**5 + 16 * x**3 + 3 * x) / 96,
        (3 * x**7 + 19 * x**5 + 17 * x**3 - 15 * x) / 384,
        (79 * x**9 + 776 * x**7 + 1482 * x**5 - 1920 * x**3 - 945 * x) / 92160,
    )
    return x + math.fsum(term / freedom ** (i + 1) for i, term in enumerate(terms))
