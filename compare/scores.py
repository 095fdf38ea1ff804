"""From marches to scores: errors against the proven state, observed orders, rounding floors, energy drift.

Every error is taken at exactly t = n h, where the march stands; h is the float that the march used.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from compare.aspects import conserves, period_of
from compare.course import SAMPLES, Course, proven
from compare.fit import fit_order, slope_with_interval, student_95
from compare.march import march
from compare.records import Cell, Drift

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.march import March
    from compare.method import Method
    from compare.precision import Precision

__all__ = [
    "SAMPLES",
    "Course",
    "fit_order",
    "proven",
    "score_errors",
    "score_method",
    "slope_with_interval",
    "student_95",
]

FLOOR_FACTOR = 10


def score_method(method: Method, courses: Sequence[Course], fmt: Precision) -> tuple[list[Cell], list[Drift]]:
    """March a method over every course and score it: a Cell a course, and a Drift where something is conserved.

    Each course is marched beside its neighbour: their errors differ by rounding alone, as the method and the problem
    carry it along.  A cell within FLOOR_FACTOR of that difference is marked as floor, and so is every finer one; but a
    difference that N roundings cannot account for is of a step too large, not of rounding.
    """
    cells, marches = _scored(method, courses, fmt)
    found = zip(courses, marches, strict=True)
    with np.errstate(over="ignore", invalid="ignore"):
        drifts = [_drift(method, course, result) for course, result in found if conserves(course.problem)]
    return cells, drifts


def score_errors(method: Method, courses: Sequence[Course], fmt: Precision) -> list[Cell]:
    """The Cells of ``score_method``, with errors in the units of the state itself."""
    return _scored(method, courses, fmt, relative=False)[0]


def _scored(
    method: Method, courses: Sequence[Course], fmt: Precision, *, relative: bool = True
) -> tuple[list[Cell], list[March]]:
    # A march that overflows is scored as what it is, infinite or not a number; NumPy need not warn of it besides.
    with np.errstate(over="ignore", invalid="ignore"):
        marches = march(method, [lane for course in courses for lane in (course.lane, course.neighbour.lane)], fmt)
        found, neighbours = marches[::2], marches[1::2]
        cells: list[Cell] = []
        before: Course | None = None
        for course, result, other in zip(courses, found, neighbours, strict=True):
            previous = cells[-1] if before is not None and before.problem == course.problem else None
            cells.append(_cell(method, course, (result, other), previous, course.units if relative else None))
            before = course
    return cells, found


def _cell(
    method: Method, course: Course, marches: tuple[March, March], previous: Cell | None, units: np.ndarray | None
) -> Cell:
    aspect, units = course.aspect, np.ones_like(course.sizes) if units is None else units
    signed = course.errors(marches[0].states)
    errors = np.abs(signed) / units
    noise = np.abs(signed - course.neighbour.errors(marches[1].states)) / units
    place, velocity = (_Norms(errors[:, list(components)]) for components in (aspect.places, aspect.rates))
    rounding = _Norms(noise[:, list(aspect.places)]).largest
    slope = None
    if previous is not None and 0 < place.largest < math.inf and 0 < previous.max_error < math.inf:
        slope = math.log(previous.max_error / place.largest) / math.log(course.n / previous.n)
    return Cell(
        method=method.name,
        n=course.n,
        h=float(course.h),
        case=course.case,
        max_error=place.largest,
        end_error=place.last,
        local_order=slope,
        floor=(place.largest <= FLOOR_FACTOR * rounding and rounding <= course.roundings)
        or (previous is not None and previous.floor),
        evaluations=marches[0].evaluations,
        rms_error=place.mean_square,
        max_velocity_error=velocity.largest,
        end_velocity_error=velocity.last,
        rms_velocity_error=velocity.mean_square,
        digits=_digits(_Norms(np.abs(signed / course.sizes)[:, list(aspect.places)]).largest, course.fmt.bits),
        jacobians=marches[0].jacobians,
    )


class _Norms:
    """The sizes of errors [samples, components]; at a sample the largest of the components counts."""

    def __init__(self, errors: np.ndarray) -> None:
        self._errors = np.max(errors, axis=1) if errors.size else np.array([math.nan])

    @property
    def largest(self) -> float:
        return float(np.max(self._errors))

    @property
    def last(self) -> float:
        return float(self._errors[-1])

    @property
    def mean_square(self) -> float:
        """The root of the mean square, without overflow."""
        largest = self.largest
        if not (0 < largest < math.inf):
            return largest
        return largest * math.sqrt(float(np.mean((self._errors / largest) ** 2)))


def _digits(relative: float, bits: int) -> float:
    """-log10 of a relative error, at least 0 and at most what the format holds."""
    held = bits * math.log10(2)
    if math.isnan(relative):
        return math.nan
    return min(max(-math.log10(relative), 0.0), held) if relative else held


def _drift(method: Method, course: Course, result: March) -> Drift:
    problem = course.problem
    period = period_of(problem)
    cycles = np.array([float(time) for time in course.times]) / (period if math.isfinite(period) else 1.0)
    slope, interval = slope_with_interval(cycles, course.drift(result.states))
    energy = abs(float(problem.certified("energy"))) if problem.serves("energy") else course.level
    return Drift(
        method=method.name,
        n=course.n,
        h=float(course.h),
        case=course.case,
        max_drift_above_rest=_ratio(result.max_drift, course.level),
        max_drift_relative=_ratio(result.max_drift, energy),
        slope_per_period=slope,
        slope_interval=interval,
    )


def _ratio(drift: float, scale: float) -> float:
    """drift/scale; not a number where the scale is below the range of doubles."""
    return drift / scale if scale else math.nan
