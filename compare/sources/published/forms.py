"""The brachistochrones as curves in singular and in smooth forms, marched over the same piece of the same curve.

Both curves have an angle a in which they are smooth: y = 2 R sin^2(a/2) of the cycloid, and
1 - z = (1 - z0) sin^2(a/2) in the field of a point mass.  By y or z the slope is infinite at the lowest point, a = pi.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any, ClassVar

from compare.march.lanes import Lane
from compare.march.march import march
from compare.march.precision import precision
from compare.methods import find
from compare.show.digits import is_rounding
from compare.sources.published.number import Rounded, Scientific, double
from reference.problems.cycloid.arc import CycloidCurve
from reference.problems.cycloid.equations import point_below_cusp
from reference.problems.polar.paths import PolarByPsi, PolarByZ

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from compare.sources.published.number import Number
    from compare.sources.published.source import Column, Table
    from reference.arithmetic.protocols import Arithmetic
    from reference.declaration import StateSpace
    from reference.problem import Problem

__all__ = ["EXACT", "REPRODUCED", "CycloidByAngle", "Form", "forms"]

MARCHED, WITHOUT_ROUNDING = "float64", "float128"
SPARE = 4
"""Another processor may round so many times worse by chance."""
LIMBS = 4
"""Doubles that hold more than the 113 bits of the wider format."""


@dataclass(frozen=True, init=False, repr=False)
class CycloidByAngle(CycloidCurve):
    """dx/dtheta = R (1 - cos theta), the depth itself: the thesis' (1.30) before its integration; smooth throughout."""

    name: ClassVar[str] = "cycloid by its angle"
    space: ClassVar[StateSpace] = replace(CycloidCurve.space, along="theta", independent="rad")

    @classmethod
    def derivative(cls, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """d(x, theta)/dtheta."""
        _, depth = point_below_cusp(m, y[1], p["radius"])
        return depth, m.number(Fraction(1))


@dataclass(frozen=True)
class Form:
    """A curve by one coordinate.

    Attributes:
        problem: what is marched; its state is (place, coordinate).
        row: the problem's row whose first quantities are the place and what stands beside it, by the coordinate.
        start, end: the coordinate where the march begins and ends.
    """

    problem: Problem
    row: str
    start: Fraction
    end: Fraction

    def errors(self, method: str, counts: Sequence[int], fmt_name: str) -> list[float]:
        """|place - exact| after the last of so many steps of one size, in m or rad, for each number of steps."""
        fmt = precision(fmt_name)
        begin = tuple(map(fmt.round, (*self._places(self.start), self.start)))
        steps = [fmt.round((self.end - self.start) / n) for n in counts]
        lanes = [Lane(self.problem, n, h, (n,), begin) for n, h in zip(counts, steps, strict=True)]
        ends = [begin[-1] + lane.n * lane.h for lane in lanes]
        exact = self.problem.along(self.row, ends, LIMBS)[:, :1]
        found = march(find(method), lanes, fmt)
        return [
            abs(float(fmt.difference(one.states[0, :1], truth)[0])) for one, truth in zip(found, exact, strict=True)
        ]

    def _places(self, along: Fraction) -> list[Fraction]:
        """The components of the state but the coordinate, to far more bits than a format has."""
        limbs = self.problem.along(self.row, [along], LIMBS)[0]
        return [sum(map(Fraction, one), Fraction(0)) for one in limbs[: len(self.problem.state_names) - 1]]


def forms(angle: float, depth: float, z0: float) -> dict[str, Form]:
    """All of them, by the slope: of R = 1 m, from an angle to a depth in m; of the point mass, between the same angles.

    Args:
        angle: where they start, in rad.
        depth: where they end, in m below the cusp, less than 2.
        z0: the lowest point of the other curve over the radius of its release.
    """
    end = 2 * math.asin(math.sqrt(depth / 2))
    first = math.sin(angle / 2) ** 2
    start_y, start_d, end_d = (Fraction(value) for value in (2 * first, (1 - z0) * first, (1 - z0) * depth / 2))
    by_angle = Fraction(angle), Fraction(end)
    return {
        "dx/dy": Form(CycloidCurve(1), "state", start_y, Fraction(depth)),
        "dx/dtheta": Form(CycloidByAngle(1), "curve", *by_angle),
        "dphi/dz": Form(PolarByZ(z0), "state", start_d, end_d),
        "dphi/dpsi": Form(PolarByPsi(z0), "state", *by_angle),
    }


@lru_cache(maxsize=16)
def _errors(table: Table, name: str, method: str, fmt_name: str) -> dict[str, float]:
    """The error in each row of the table."""
    form = forms(*(float(table.parameters[key]) for key in ("angle", "depth", "z0")))[name]
    return dict(zip(table.rows, form.errors(method, list(map(int, table.rows)), fmt_name), strict=True))


def _error(fmt_name: str, table: Table, column: Column, row: str) -> Number:
    return Scientific(_errors(table, column.form, column.method, fmt_name)[row])


def _rounding(table: Table, column: Column, row: str) -> float:
    """A bound on what the doubles make of an error: SPARE times the most that they made with no more steps.

    What they made is told by the march in 113 bits.  It grows with the number of steps, but may be small by chance.
    """
    marched, truth = (_errors(table, column.form, column.method, name) for name in (MARCHED, WITHOUT_ROUNDING))
    upto = table.rows[: table.rows.index(row) + 1]
    return SPARE * max(abs(marched[one] - truth[one]) for one in upto)


def _marched_error(table: Table, column: Column, row: str) -> Number:
    value = _errors(table, column.form, column.method, MARCHED)[row]
    return Rounded(value, _rounding(table, column, row), scientific=True)


def _marched_order(table: Table, column: Column, row: str) -> Number:
    """The order with what the roundings of both errors may make of it; of an error that is rounding nothing is left."""
    errors = _errors(table, column.form, column.method, MARCHED)
    before = table.rows[table.rows.index(row) - 1]
    parts = [_rounding(table, column, one) / errors[one] for one in (before, row)]
    lost = any(is_rounding(1.0, part) for part in parts)
    doubt = math.inf if lost else sum(-math.log1p(-part) for part in parts) / math.log(int(row) / int(before))
    return Rounded(_slope(errors, table, row), doubt)


def _slope(errors: dict[str, float], table: Table, row: str) -> float:
    """The slope of log(error) against log(1/N) from the row before."""
    before = table.rows[table.rows.index(row) - 1]
    return math.log(errors[before] / errors[row]) / math.log(int(row) / int(before))


def _order(fmt_name: str, table: Table, column: Column, row: str) -> Number:
    return double(_slope(_errors(table, column.form, column.method, fmt_name), table, row))


def _ratio(table: Table, _column: Column, row: str) -> Number:
    """The step over what the last node is away from the singularity; the same by y and by z."""
    first, last = math.sin(float(table.parameters["angle"]) / 2) ** 2, float(table.parameters["depth"]) / 2
    return double((last - first) / int(row) / (1 - last))


REFINED: dict[str, Callable[[Table, Column, str], Number]] = {
    "error": partial(_error, WITHOUT_ROUNDING),
    "order": partial(_order, WITHOUT_ROUNDING),
    "ratio": _ratio,
}


def _exact(table: Table, column: Column, row: str) -> Number:
    return REFINED[column.by](table, column, row)


REPRODUCED = {"curves": {"error": _marched_error, "order": _marched_order, "ratio": _ratio}}
"""What computes the entries, by what the columns are computed by."""
EXACT = {"curves": _exact}
"""The same, with a rounding so small that it is not seen."""
