"""From marches to scores: errors against the proven state, observed orders, rounding floors, energy drift.

Every error is taken at exactly t = n h, where the march stands; h is the float that the march used.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from compare.march.march import march
from compare.measure.order_fit import slope_with_interval
from compare.measure.records import Cell, Drift
from compare.measure.rounding import roundings_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from compare.march.lanes import March
    from compare.march.precision import Precision
    from compare.measure.rounding import Rounding
    from compare.measure.truth import Course
    from compare.methods.kinds.one_step import Method
    from reference.problem import Problem

__all__ = [
    "Sizes",
    "drifts",
    "score_courses",
    "score_errors",
    "score_method",
]


def score_method(method: Method, courses: Sequence[Course], fmt: Precision) -> tuple[list[Cell], list[Drift]]:
    """March a method over every course and score it: a Cell a course, and a Drift an invariant."""
    cells, marches, roundings = score_courses(method, courses, fmt)
    return cells, drifts(method, courses, marches, roundings)


def score_errors(method: Method, courses: Sequence[Course], fmt: Precision) -> list[Cell]:
    """The Cells of ``score_method``, with errors in the units of the state itself."""
    return score_courses(method, courses, fmt, relative=False)[0]


def score_courses(
    method: Method, courses: Sequence[Course], fmt: Precision, *, relative: bool = True
) -> tuple[list[Cell], list[March], list[Rounding]]:
    """March a method over every course: a Cell a course, what the march gave, and what rounding made of it.

    Errors are in each case's unit, or where they are not ``relative`` in the units of the state itself.
    """
    # A march that overflows is scored as what it is, infinite or not a number; NumPy need not warn of it besides.
    with np.errstate(over="ignore", invalid="ignore"):
        marches = march(method, [course.lane for course in courses], fmt)
        errors = [course.errors(result.states) for course, result in zip(courses, marches, strict=True)]
        roundings = roundings_of(method, courses, marches, errors, fmt)
        cells: list[Cell] = []
        before: Course | None = None
        for course, result, signed, rounding in zip(courses, marches, errors, roundings, strict=True):
            previous = cells[-1] if before is not None and before.problem == course.problem else None
            cells.append(_cell(method, course, result, Sizes(course, signed, rounding, relative=relative), previous))
            before = course
    return cells, marches, roundings


def drifts(
    method: Method, courses: Sequence[Course], marches: Sequence[March], roundings: Sequence[Rounding]
) -> list[Drift]:
    """The drift of each invariant of each march."""
    with np.errstate(over="ignore", invalid="ignore"):
        return [
            drift
            for course, result, rounding in zip(courses, marches, roundings, strict=True)
            for drift in _drifts(method, course, result, rounding)
        ]


def _cell(method: Method, course: Course, result: March, sizes: Sizes, previous: Cell | None) -> Cell:
    place, velocity = sizes.place, sizes.velocity
    slope, slope_rounding = None, 0.0
    if previous is not None and 0 < place.largest < math.inf and 0 < previous.max_error < math.inf:
        ratio = math.log(course.n / previous.n)
        slope = math.log(previous.max_error / place.largest) / ratio
        slope_rounding = (sizes.rounding / place.largest + previous.rounding / previous.max_error) / ratio
    return Cell(
        method=method.name,
        n=course.n,
        h=float(course.h),
        case=course.case,
        max_error=place.largest,
        end_error=place.last,
        local_order=slope,
        floor=sizes.floor,
        evaluations=result.evaluations,
        rms_error=place.mean_square,
        max_velocity_error=velocity.largest,
        end_velocity_error=velocity.last,
        rms_velocity_error=velocity.mean_square,
        digits=sizes.digits,
        jacobians=result.jacobians,
        rounding=sizes.rounding,
        velocity_rounding=sizes.velocity_rounding,
        order_rounding=slope_rounding,
    )


class Sizes:
    """The errors [samples, state] of a course in sizes, of its place and of its velocity, and rounding's part."""

    def __init__(self, course: Course, signed: np.ndarray, rounding: Rounding, *, relative: bool) -> None:
        errors, space = np.abs(signed), course.problem.space
        places, rates = space.places(space.positions), space.places(space.rates)
        units = course.conditioning.units if relative else np.ones_like(course.conditioning.units)
        scaled, rounded = errors / units, rounding.state / units
        self.floor = rounding.floor
        self.rounding = rounding.position if relative else float(np.max(rounded[places]))
        self.velocity_rounding = float(np.max(rounded[rates], initial=0.0))
        self.place, self.velocity = _Norms(scaled[:, places]), _Norms(scaled[:, rates])
        self.digits = _digits(_Norms((errors / course.conditioning.sizes)[:, places]).largest, course.fmt.bits)


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


def _drifts(method: Method, course: Course, result: March, rounding: Rounding) -> Iterator[Drift]:
    """Of every invariant; the first is told relative to the energy too, where that has a value beside its scale."""
    period, energy = _scales(course.problem)
    cycles = np.array(course.steps) * (float(course.h) / (period if math.isfinite(period) else 1.0))
    told = zip(
        course.problem.invariants,
        course.scales,
        result.max_drifts,
        course.drifts(result.states),
        map(float, rounding.drifts),
        strict=True,
    )
    for place, (invariant, scale, largest, drift, bound) in enumerate(told):
        slope, interval = slope_with_interval(cycles, drift)
        other = scale if energy is None or place else energy
        yield Drift(
            method=method.name,
            n=course.n,
            h=float(course.h),
            case=course.case,
            invariant=invariant.name,
            max_drift_above_rest=_ratio(largest, scale),
            max_drift_relative=_ratio(largest, other),
            slope_per_period=slope,
            slope_interval=interval,
            rounding=bound,
            slope_rounding=2 * bound / float(cycles[-1]),
            relative_rounding=_ratio(bound * scale, other),
        )


@lru_cache(maxsize=256)
def _scales(problem: Problem) -> tuple[float, float | None]:
    """The period, and the absolute value of the energy where the problem has one besides its invariant."""
    return problem.cycle(), abs(float(problem.certified("energy"))) if problem.serves("energy") else None


def _ratio(drift: float, scale: float) -> float:
    """drift/scale; not a number where the scale is below the range of doubles."""
    return drift / scale if scale else math.nan
