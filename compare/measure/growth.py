"""How the errors of a march grow with time: as a power of it, whose exponent is read off the samples.

Time is cut into windows, each twice as long as the one before it, and the mean square of the error is taken in each:
half the slope of its logarithm against that of time is the exponent.  The first windows may not know yet how it will go
on, so that the longest run of last windows is taken whose slope has the least interval.

Where the error is rounding it is a random walk, of which one march says little: then the mean is over STARTS marches,
each from a start near the last one's.  By Brouwer's law (D. Brouwer, Astron. J. 46, 1937, 149) random roundings let the
energy walk as sqrt(t), and the phase, which sums it up, as t^(3/2).
"""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from compare.march.march import march
from compare.measure.order_fit import slope_with_interval, student_95
from compare.measure.records import FLOOR_FACTOR, Growth
from compare.measure.result import Run

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

__all__ = ["GROWTH_SAMPLES", "enough", "exponent_of", "growths"]

LEAST_SAMPLES, LEAST_WINDOWS = 8, 4
"""A window has so many samples at least, and an exponent so many windows."""
LAWS = {0.0: "bounded", 0.5: "sqrt t", 1.0: "t", 1.5: "t^3/2", 2.0: "t^2"}
SURE, NEAR = 0.25, 0.1
"""An exponent is of a law if its interval is less than half the way to the next law, and it is as near as this."""


class Exponent(NamedTuple):
    """The exponent of t, the half-width of its 95 % interval, how many windows it was read off, and rounding's part.

    NaN, of no windows, where there are too few, or an error is not a number, or all are zero.
    """

    value: float
    interval: float
    windows: int
    rounding: float

    @property
    def law(self) -> str:
        """The law of the exponent, or "" where it is not clear."""
        if not self.interval < SURE:
            return ""
        nearest = min(LAWS, key=lambda law: abs(law - self.value))
        return LAWS[nearest] if abs(nearest - self.value) <= max(self.interval, NEAR) else ""


NONE = Exponent(math.nan, math.nan, 0, 0.0)


def enough(times: np.ndarray, shortest: float) -> bool:
    """Whether there are enough windows, none of them shorter than ``shortest``."""
    return len(list(_windows(times, shortest))) >= LEAST_WINDOWS


def exponent_of(times: np.ndarray, errors: np.ndarray, shortest: float, rounding: float = 0.0) -> Exponent:
    """The exponent of errors [samples], or of their mean over marches [marches, samples].

    ``rounding`` bounds rounding's part of the last error; of the others it is less by the root of time at least.

    Of several marches the interval covers besides what one of them more or less would change (the jackknife).
    """
    errors = np.atleast_2d(errors)
    largest = float(np.max(np.abs(errors)))
    if not enough(times, shortest) or not 0 < largest < math.inf:
        return NONE
    windows = list(_windows(times, shortest))[::-1]
    squares = np.array([np.mean((errors[:, inside] / largest) ** 2, axis=1) for _, inside in windows])
    ends = np.log([end for end, _ in windows])
    with np.errstate(divide="ignore"):
        sizes = np.log(np.mean(squares, axis=1)) / 2
    if not np.all(np.isfinite(sizes)):
        return NONE
    value, interval, first = min(
        ((*slope_with_interval(ends[i:], sizes[i:]), i) for i in range(len(ends) - LEAST_WINDOWS + 1)),
        key=lambda fit: fit[1],
    )
    ends, squares, sizes = ends[first:], squares[first:], sizes[first:]
    parts = rounding / largest * np.exp((ends - ends[-1]) / 2 - sizes)
    centred = ends - ends.mean()
    doubt = float(np.abs(centred) @ parts / (centred @ centred))
    return Exponent(value, max(interval, _jackknife(ends, squares)), len(ends), doubt)


def _windows(times: np.ndarray, shortest: float) -> Iterator[tuple[float, np.ndarray]]:
    """The end of each window and what lies inside, the last first."""
    end = float(times[-1])
    while True:
        inside = (times > end / 2) & (times <= end)
        if end / 2 < shortest or np.count_nonzero(inside) < LEAST_SAMPLES:
            return
        yield end, inside
        end /= 2


def _jackknife(ends: np.ndarray, squares: np.ndarray) -> float:
    """The half-width of the 95 % interval of the exponent from leaving out each march in turn; 0 of one alone."""
    marches = squares.shape[1]
    if marches == 1:
        return 0.0
    rest = (np.sum(squares, axis=1, keepdims=True) - squares) / (marches - 1)
    found = np.array([slope_with_interval(ends, np.log(one) / 2)[0] for one in rest.T])
    return student_95(marches - 1) * math.sqrt((marches - 1) * float(np.var(found)))


GROWTH_SAMPLES = 1024
LEAST_PERIODS = 2
"""The shortest window of time has so many."""
STARTS = 16


def growths(runs: Sequence[Run]) -> list[Growth]:
    """For each run the growth of its place's error, and where there are such, of its phase's and of its drift.

    Along a curve there is no time to grow in.
    """
    return [found for run in runs if run.course.problem.original.space.along is None for found in _of(run)]


def _of(run: Run) -> Iterator[Growth]:
    course = run.course
    times = np.array([float(time) for time in course.times])
    period = course.problem.cycle()
    shortest = LEAST_PERIODS * period if math.isfinite(period) else 0.0
    told, several = enough(times, shortest), [run]
    for name, errors, bound in _quantities(run):
        known = errors(run) if told else np.full_like(times, math.nan)
        floor = run.cell.floor if name == "place" else bool(np.max(np.abs(known)) <= FLOOR_FACTOR * bound)
        if floor and told and len(several) == 1:
            several = _starts(run)
        runs = several if floor else [run]
        marches = np.array([errors(one) for one in runs]) if told else known
        exponent = exponent_of(times, marches, shortest, 0.0 if floor else bound)
        yield Growth(
            method=run.method.name,
            n=course.n,
            h=float(course.h),
            case=course.case,
            quantity=name,
            exponent=exponent.value,
            interval=exponent.interval,
            law=exponent.law,
            windows=exponent.windows,
            starts=len(runs),
            floor=floor,
            rounding=exponent.rounding,
        )


def _quantities(run: Run) -> Iterator[tuple[str, Callable[[Run], np.ndarray], float]]:
    """What grows: its name, its error at each sample, and a bound on rounding's part of the largest."""
    yield "place", lambda one: one.position_error, run.rounding.position
    if run.orbital_known:
        yield "phase", lambda one: one.orbital[:, 0], run.phase_rounding
    for i, invariant in enumerate(run.course.problem.invariants):
        yield invariant.name, partial(_drift_of, invariant=i), float(run.rounding.drifts[i])


def _drift_of(run: Run, invariant: int) -> np.ndarray:
    drift: np.ndarray = run.drifts[invariant]
    return drift


def _starts(run: Run) -> list[Run]:
    """The run, and others of the same method from starts each near the last: one walk does not tell of walks."""
    courses = [run.course]
    while len(courses) < STARTS:
        courses.append(courses[-1].neighbour)
    marches = march(run.method, [course.lane for course in courses[1:]], run.course.fmt)
    return [run, *(Run(run.method, *one, run.cell, run.rounding) for one in zip(courses[1:], marches, strict=True))]
