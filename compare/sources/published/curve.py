"""What the thesis' figure 7 shows: the error of RK4 along the cycloid, whose slope is infinite at its lowest point."""

from __future__ import annotations

import math
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from compare.sources.published.number import Enclosed, double
from reference import CycloidArc
from reference.arithmetic.namespaces import BALL
from reference.problems.cycloid.equations import point_below_cusp, run

if TYPE_CHECKING:
    from flint import arb

    from compare.sources.published.number import Number
    from compare.sources.published.source import Column, Table

__all__ = ["EXACT", "REPRODUCED", "listed_error", "simpson_error"]


def listed_error(angle: float, depth: float, n: int) -> float:
    """|x - x(y)| after n steps, in doubles and in the order of operations of the thesis' listing; R = 1, y upward.

    The slope does not depend on x, so that its second and third values are one; sums go from left to right.
    """

    def slope(y: float) -> float:
        return -math.sqrt(-y / (2.0 - -y))

    x, y = angle - math.sin(angle), math.cos(angle) - 1.0
    h = (-depth - y) / n
    for _ in range(n):
        first, middle, last = slope(y), slope(y + h / 2), slope(y + h)
        x = x + ((first + 2 * middle + 2 * middle + last) / 6) * h
        y = y + h
    return abs(x - (math.acos(1.0 + y) - math.sqrt(y * (-2.0 - y))))


def simpson_error(angle: Fraction, depth: Fraction, n: int) -> arb:
    """The same error without rounding, a ball at the precision in force: Simpson's rule on dx/dy less its integral."""
    start, end = (BALL.number(value) for value in (angle, depth))
    radius = BALL.number(Fraction(1))
    x, y = point_below_cusp(BALL, start, radius)
    h = (end - y) / n
    nodes = [y + h * i / 2 for i in range(2 * n)] + [end]
    slopes: list[Any] = [run(BALL, node, radius) for node in nodes]
    rule = slopes[0] + 4 * sum(slopes[1::2], BALL.number(Fraction(0))) + 2 * sum(slopes[2:-1:2]) + slopes[-1]
    exact_x = CycloidArc(1).closed_form(BALL).state(depth)[0]
    return abs(x + h / 6 * rule - exact_x)


@lru_cache(maxsize=16)
def _listed(table: Table, n: int) -> float:
    return listed_error(float(table.parameters["angle"]), float(table.parameters["depth"]), n)


def _without_rounding(table: Table, n: int) -> arb:
    return simpson_error(Fraction(table.parameters["angle"]), Fraction(table.parameters["depth"]), n)


def _before(table: Table, row: str) -> tuple[int, int]:
    """The number of steps in the row before, and in this one."""
    return next((int(one), int(other)) for one, other in pairwise(table.rows) if other == row)


def _order(table: Table, _column: Column, row: str) -> Number:
    fewer, more = _before(table, row)
    return double(math.log(_listed(table, fewer) / _listed(table, more)) / math.log(more / fewer))


def _exact(table: Table, column: Column, row: str) -> Number:
    what = f"the {column.name} of {table.item} at N = {row}"
    if column.by == "error":
        return Enclosed(lambda: _without_rounding(table, int(row)), what)
    fewer, more = _before(table, row)

    def order() -> arb:
        errors = [_without_rounding(table, n) for n in (fewer, more)]
        return (errors[0] / errors[1]).log() / BALL.number(Fraction(more, fewer)).log()

    return Enclosed(order, what)


REPRODUCED = {
    "figure7": {"error": lambda table, _, row: double(_listed(table, int(row))), "order": _order},
}
"""What computes the entries, by what the columns are computed by."""
EXACT = {"figure7": _exact}
"""The same without rounding."""
