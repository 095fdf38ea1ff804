"""Everything that is scored of one method over its courses: errors and drifts always, and what else is asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.measure.defects import defects
from compare.measure.errors import drifts, score_courses
from compare.measure.growth import growths
from compare.measure.period import own_periods
from compare.measure.phase import phases
from compare.measure.result import Run

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from compare.march.precision import Precision
    from compare.measure.truth import Course
    from compare.methods.kinds.one_step import Method

__all__ = ["Found", "score"]

Found = dict[str, list[Any]]
"""Records by the name of their table."""

SCORERS: dict[str, Callable[[Sequence[Run]], list[Any]]] = {
    "phase": phases,
    "growth": growths,
    "period": own_periods,
    "defects": defects,
}


def score(method: Method, courses: Sequence[Course], fmt: Precision, wanted: Sequence[str]) -> Found:
    """March a method over the courses and score it as wanted."""
    cells, marches, roundings = score_courses(method, courses, fmt)
    runs = [Run(method, *found) for found in zip(courses, marches, cells, roundings, strict=True)]
    found: Found = {"error_vs_n": cells, "energy_drift": drifts(method, courses, marches, roundings)}
    for name, scorer in SCORERS.items():
        if name in wanted:
            found[name] = scorer(runs)
    return found
