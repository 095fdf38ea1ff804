"""How the errors of a march grow with time: bounded, as a root of t, as t, ...

Where the error is rounding it is a random walk, of which one march says little: then the mean is over STARTS marches,
each from a start near the last one's.  By Brouwer's law (D. Brouwer, Astron. J. 46, 1937, 149) random roundings let the
energy walk as sqrt(t), and the phase, which sums it up, as t^(3/2).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from compare.aspects import conserves, period_of
from compare.laws import enough, exponent_of
from compare.march import march
from compare.records import Growth
from compare.run import Run

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

__all__ = ["GROWTH_SAMPLES", "growths"]

GROWTH_SAMPLES = 1024
LEAST_PERIODS = 2
"""The shortest window of time has so many."""
STARTS = 16


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
    told = enough(times, shortest)
    runs = _starts(run) if told and run.cell.floor else [run]
    quantities: dict[str, Callable[[Run], np.ndarray]] = {"place": lambda one: one.place}
    if run.orbital_known:
        quantities["phase"] = lambda one: one.orbital[:, 0]
    if conserves(course.problem):
        quantities["energy"] = lambda one: one.drift
    for name, errors in quantities.items():
        known = [errors(one) for one in runs] if told else [np.full_like(times, math.nan)]
        exponent = exponent_of(times, np.array(known), shortest)
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
            floor=run.cell.floor,
        )


def _starts(run: Run) -> list[Run]:
    """The run, and others of the same method from starts each near the last: one walk does not tell of walks."""
    courses = [run.course]
    while len(courses) < STARTS:
        courses.append(courses[-1].neighbour)
    marches = march(run.method, [course.lane for course in courses[1:]], run.course.fmt)
    return [run, *(Run(run.method, *one, run.cell, run.rounding) for one in zip(courses[1:], marches, strict=True))]
