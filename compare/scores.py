"""From marches to scores: errors against the proven state, observed orders, rounding floors, energy drift.

Every error is taken at exactly t = n h, where the march stands; h is the float that the march used.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from statistics import median
from typing import TYPE_CHECKING

import numpy as np

from compare.march import Lane, StartInvariant, march, sample_steps
from compare.records import Cell, Drift, FittedOrder
from reference.arithmetic import NUMPY

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction

    from compare.march import March
    from compare.method import Method
    from compare.precision import Precision
    from reference.problem import Problem

__all__ = ["SAMPLES", "Course", "fit_order", "relative_drift", "score_errors", "score_method"]

SAMPLES = 128
FLOOR_FACTOR = 10
SLOPE_TOLERANCE = 0.05
MIN_CELLS = 3


@dataclass(frozen=True)
class Course:
    """One cell of a study before any method runs it: a problem, N, and the truth at its sample times."""

    problem: Problem
    n: int
    t_end: Fraction
    fmt: Precision
    samples: int = SAMPLES

    @cached_property
    def h(self) -> Fraction:
        """t_end/N rounded to the format, exactly.

        Raises:
            ValueError: it is smaller than any number of the format.
        """
        h = self.fmt.round(self.t_end / self.n)
        if not self.fmt.number(h):
            raise ValueError(
                f"t_end/n is {float(h):.1e}, which {self.fmt.name} cannot hold; a longer time is accepted."
            )
        return h

    def __post_init__(self) -> None:
        for name, value in zip(self.problem.state_names, self.problem.start, strict=True):
            if value and not self.fmt.number(value):
                raise ValueError(f"{name} starts at {float(value)}, which {self.fmt.name} cannot hold.")

    @cached_property
    def steps(self) -> tuple[int, ...]:
        """The steps after which the state is compared."""
        return sample_steps(self.n, self.samples)

    @cached_property
    def times(self) -> list[Fraction]:
        """n h, exactly."""
        return [step * self.h for step in self.steps]

    @cached_property
    def truth(self) -> np.ndarray:
        """The proven state at the times: float64 limbs [samples, state, limbs], enough for the format."""
        return proven(self.problem, tuple(self.times), max(2, self.fmt.bits // 53 + 2))

    @cached_property
    def neighbour(self) -> Course:
        """The same course from a start close by, whose truncation error is the same and whose rounding is not."""
        return replace(self, problem=self.problem.neighbour(self.fmt.round, self.fmt.exact_epsilon))

    @property
    def roundings(self) -> float:
        """How far N roundings of the first component can lead, carried along as the exact motion carries them.

        The exact motion's growth is that of the distance between this course and its neighbour.
        """
        here, there = self.truth[:, 0, 0], self.neighbour.truth[:, 0, 0]
        start = abs(float(self.problem.start[0] - self.neighbour.problem.start[0]))
        growth = 1 + float(np.max(np.abs(here - there))) / start
        return 8 * self.n * self.fmt.epsilon * growth * float(np.max(np.abs(here)))

    @property
    def lane(self) -> Lane:
        """The march that this course asks for."""
        return Lane(self.problem, self.n, self.h, self.steps)

    def errors(self, result: March) -> np.ndarray:
        """State - truth, float64 [samples, state]."""
        return self.fmt.difference(result.states, self.truth)


@lru_cache(maxsize=64)
def proven(problem: Problem, times: tuple[Fraction, ...], limbs: int) -> np.ndarray:
    """``problem.state``, kept: numbers of steps that are powers of two share their sample times."""
    return problem.state(times, limbs=limbs)


def score_method(method: Method, courses: Sequence[Course], fmt: Precision) -> tuple[list[Cell], list[Drift]]:
    """March a method over every course and score it: one Cell and one Drift a course, in the order given.

    Each course is marched beside its neighbour: their errors differ by rounding alone, as the method and the problem
    carry it along.  A cell within FLOOR_FACTOR of that difference is marked as floor, and so is every finer one; but a
    difference that N roundings cannot account for is of a step too large, not of rounding.
    """
    # A march that overflows is scored as what it is, infinite or not a number; NumPy need not warn of it besides.
    with np.errstate(over="ignore", invalid="ignore"):
        return _scores(method, courses, fmt)


def score_errors(method: Method, courses: Sequence[Course], fmt: Precision) -> list[Cell]:
    """The Cells of ``score_method``, for problems without an energy or a period too."""
    with np.errstate(over="ignore", invalid="ignore"):
        return _cells(method, courses, fmt)[0]


def _scores(method: Method, courses: Sequence[Course], fmt: Precision) -> tuple[list[Cell], list[Drift]]:
    cells, found = _cells(method, courses, fmt)
    return cells, [_drift(method, course, result) for course, result in zip(courses, found, strict=True)]


def _cells(method: Method, courses: Sequence[Course], fmt: Precision) -> tuple[list[Cell], list[March]]:
    marches = march(method, [lane for course in courses for lane in (course.lane, course.neighbour.lane)], fmt)
    found, neighbours = marches[::2], marches[1::2]
    cells: list[Cell] = []
    before: Course | None = None
    for course, result, other in zip(courses, found, neighbours, strict=True):
        previous = cells[-1] if before is not None and before.problem == course.problem else None
        noise = float(np.max(np.abs(course.errors(result) - course.neighbour.errors(other))[:, 0]))
        cells.append(_cell(method, course, result, noise, previous))
        before = course
    return cells, found


def _amplitude(problem: Problem) -> float:
    return float(problem.start[0])


def _cell(method: Method, course: Course, result: March, noise: float, previous: Cell | None) -> Cell:
    errors = np.abs(course.errors(result)[:, 0])
    largest = float(np.max(errors))
    slope = None
    if previous is not None and 0 < largest < math.inf and 0 < previous.max_error < math.inf:
        slope = math.log(previous.max_error / largest) / math.log(course.n / previous.n)
    return Cell(
        method=method.name,
        n=course.n,
        h=float(course.h),
        theta0=_amplitude(course.problem),
        max_error=largest,
        end_error=float(errors[-1]),
        local_order=slope,
        floor=(largest <= FLOOR_FACTOR * noise and noise <= course.roundings)
        or (previous is not None and previous.floor),
        evaluations=result.evaluations,
    )


def _drift(method: Method, course: Course, result: March) -> Drift:
    problem = course.problem
    start = float(course.fmt.number(StartInvariant(problem)))
    periods = np.array([float(time) for time in course.times]) / float(problem.certified("period"))
    slope, interval = slope_with_interval(periods, relative_drift(course, result.states))
    return Drift(
        method=method.name,
        n=course.n,
        h=float(course.h),
        theta0=_amplitude(problem),
        max_drift_above_rest=_ratio(result.max_drift, start),
        max_drift_relative=_ratio(result.max_drift, abs(float(problem.certified("energy")))),
        slope_per_period=slope,
        slope_interval=interval,
    )


def _ratio(drift: float, scale: float) -> float:
    """drift/scale; not a number where the scale is below the range of doubles."""
    return drift / scale if scale else math.nan


def relative_drift(course: Course, states: np.ndarray) -> np.ndarray:
    """(E - E0)/(E0 - Emin) of states [samples, state], computed in the format, as float64.

    Not a number where E0 - Emin is below the range of the format.
    """
    fmt, problem = course.fmt, course.problem
    parameters = {name: fmt.number(value) for name, value in problem.parameters.items()}
    energies = problem.invariant(NUMPY, tuple(np.moveaxis(states, 1, 0)), parameters)
    start = fmt.number(StartInvariant(problem))
    if not start:
        return np.full(len(states), np.nan)
    drift: np.ndarray = ((energies - start) / start).astype(np.float64)
    return drift


def fit_order(method: Method, cells: Sequence[Cell]) -> FittedOrder:
    """Fit one slope of log(max_error) against log(h) over the asymptotic range of one method's cells at one amplitude.

    The range is read off the data, never off the declared order: floor cells and errors above 1 rad are left out, and
    of the rest the longest run is taken in which neighbouring slopes stay within SLOPE_TOLERANCE of the median of the
    three finest.
    """
    usable = [cell for cell in cells if not cell.floor and 0 < cell.max_error <= 1]
    x = [math.log(cell.n) for cell in usable]
    y = [-math.log(cell.max_error) for cell in usable]
    slopes = [(y[i + 1] - y[i]) / (x[i + 1] - x[i]) for i in range(len(usable) - 1)]
    first, last = _longest_run(slopes)
    chosen = usable[first:last] if last - first >= MIN_CELLS else []
    fitted = spread = None
    if chosen:
        fitted, _ = slope_with_interval(np.array(x[first:last]), np.array(y[first:last]))
        spread = max(abs(slope - fitted) for slope in slopes[first : last - 1])
    return FittedOrder(
        method=method.name,
        theta0=cells[0].theta0,
        declared_order=method.order,
        fitted_order=fitted,
        spread=spread,
        cells_used=len(chosen),
        n_range=(chosen[0].n, chosen[-1].n) if chosen else None,
    )


def _longest_run(slopes: Sequence[float]) -> tuple[int, int]:
    """The cells [first, last) of the longest run of slopes near the median of the three finest; the finer of two."""
    best = 0, 0
    first = 0
    for i, slope in enumerate(slopes):
        if abs(slope - median(slopes[-3:])) > SLOPE_TOLERANCE:
            first = i + 1
        elif i + 2 - first >= best[1] - best[0]:
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
