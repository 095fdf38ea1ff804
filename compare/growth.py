"""How an error grows with time: bounded, as a root of t, as t, ..., read off the samples of a long march.

Time is cut into windows, each twice as long as the one before it, and the root mean square of the error is taken in
each: the slope of its logarithm against that of time is the exponent.  The first windows may not know yet how it will
go on, so that the longest run of last windows is taken whose slope has the least interval.

Where the error is rounding it is a random walk, of which one march says little: then the mean is also over STARTS
marches, each from a start near the last one's.  By Brouwer's law (D. Brouwer, Astron. J. 46, 1937, 149) random
roundings let the energy walk as sqrt(t), and the phase, which sums it up, as t^(3/2).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from compare.aspects import conserves, period_of
from compare.fit import slope_with_interval
from compare.march import march
from compare.records import Growth
from compare.run import Run

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

__all__ = ["GROWTH_SAMPLES", "LAWS", "growth_of", "growths"]

GROWTH_SAMPLES = 1024
LEAST_SAMPLES, LEAST_WINDOWS, LEAST_PERIODS = 8, 4, 2
"""A window has so many samples and periods, and a law so many windows."""
LAWS = {0.0: "bounded", 0.5: "sqrt t", 1.0: "t", 1.5: "t^3/2", 2.0: "t^2"}
STARTS = 16
SURE, NEAR = 0.25, 0.1
"""An exponent is of a law if its interval is less than half the way to the next law, and it is as near as this."""


def growths(runs: Sequence[Run]) -> list[Growth]:
    """For each run the growth of its place's error, and where there are such, of its phase's and of its drift.

    Along a curve there is no time to grow in.
    """
    return [found for run in runs if run.course.aspect.along is None for found in _of(run)]


def _of(run: Run) -> Iterator[Growth]:
    course = run.course
    times = np.array([float(time) for time in course.times])
    period = period_of(course.problem)
    shortest = LEAST_PERIODS * period if math.isfinite(period) else 0.0
    told = len(list(_windows(times, np.ones_like(times), shortest))) >= LEAST_WINDOWS
    runs = _starts(run) if told and run.cell.floor else [run]
    quantities: dict[str, Callable[[Run], np.ndarray]] = {"place": lambda one: one.place}
    if run.orbital_known:
        quantities["phase"] = lambda one: one.orbital[:, 0]
    if conserves(course.problem):
        quantities["energy"] = lambda one: one.drift
    for name, errors in quantities.items():
        known = _mean_square([errors(one) for one in runs]) if told else np.full_like(times, math.nan)
        exponent, interval, windows = growth_of(times, known, shortest)
        yield Growth(
            method=run.method.name,
            n=course.n,
            h=float(course.h),
            case=course.case,
            quantity=name,
            exponent=exponent,
            interval=interval,
            law=_law(exponent, interval),
            windows=windows,
            starts=len(runs),
            floor=run.cell.floor,
        )


def _starts(run: Run) -> list[Run]:
    """The run, and others of the same method from starts each near the last: one walk does not tell of walks."""
    courses = [run.course]
    while len(courses) < STARTS:
        courses.append(courses[-1].neighbour)
    marches = march(run.method, [course.lane for course in courses[1:]], run.course.fmt)
    return [run, *(Run(run.method, *one, run.cell) for one in zip(courses[1:], marches, strict=True))]


def _mean_square(errors: Sequence[np.ndarray]) -> np.ndarray:
    """The root of the mean of the squares over the starts, at each sample."""
    with np.errstate(over="ignore", invalid="ignore"):
        largest = np.max(np.abs(errors), axis=0)
        scaled = np.abs(errors) / np.where(largest > 0, largest, 1.0)
        found: np.ndarray = largest * np.sqrt(np.mean(scaled**2, axis=0))
    return found


def growth_of(times: np.ndarray, errors: np.ndarray, shortest: float) -> tuple[float, float, int]:
    """The exponent of t, the half-width of its 95 % interval, and how many windows, none shorter than ``shortest``.

    NaN where there are fewer than LEAST_WINDOWS windows, or an error is not a number, or all are zero.
    """
    points = list(_windows(times, errors, shortest))
    if len(points) < LEAST_WINDOWS or not np.all(np.isfinite(points)):
        return math.nan, math.nan, 0
    x, y = np.array(points[::-1]).T
    fits = [(*slope_with_interval(x[i:], y[i:]), len(x) - i) for i in range(len(x) - LEAST_WINDOWS + 1)]
    return min(fits, key=lambda fit: fit[1])


def _windows(times: np.ndarray, errors: np.ndarray, shortest: float) -> Iterator[tuple[float, float]]:
    """(log of time, log of the root mean square) of each window, the last first."""
    end = float(times[-1])
    while True:
        inside = (times > end / 2) & (times <= end)
        if end / 2 < shortest or np.count_nonzero(inside) < LEAST_SAMPLES:
            return
        yield math.log(end), _log_size(errors[inside])
        end /= 2


def _log_size(errors: np.ndarray) -> float:
    """The logarithm of the root mean square; not a finite number where it is none."""
    largest = float(np.max(np.abs(errors)))
    if not 0 < largest < math.inf:
        return math.nan
    return math.log(largest) + math.log(float(np.mean((errors / largest) ** 2))) / 2


def _law(exponent: float, interval: float) -> str:
    """The law of an exponent, or "" where it is not clear."""
    if not interval < SURE:
        return ""
    nearest = min(LAWS, key=lambda law: abs(law - exponent))
    return LAWS[nearest] if abs(nearest - exponent) <= max(interval, NEAR) else ""
