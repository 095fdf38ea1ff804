"""How the errors of a march grow with time: bounded, as a root of t, as t, ...

Where the error is rounding it is a random walk, of which one march says little: then the mean is over STARTS marches,
each from a start near the last one's.  By Brouwer's law (D. Brouwer, Astron. J. 46, 1937, 149) random roundings let the
energy walk as sqrt(t), and the phase, which sums it up, as t^(3/2).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from compare.march.aspects import conserves, period_of
from compare.march.march import march
from compare.measure.laws import enough, exponent_of
from compare.measure.records import FLOOR_FACTOR, Growth
from compare.measure.result import Run

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
    yield "place", lambda one: one.place, run.rounding.place
    if run.orbital_known:
        yield "phase", lambda one: one.orbital[:, 0], run.phase_rounding
    if conserves(run.course.problem):
        yield "energy", lambda one: one.drift, run.rounding.drift


def _starts(run: Run) -> list[Run]:
    """The run, and others of the same method from starts each near the last: one walk does not tell of walks."""
    courses = [run.course]
    while len(courses) < STARTS:
        courses.append(courses[-1].neighbour)
    marches = march(run.method, [course.lane for course in courses[1:]], run.course.fmt)
    return [run, *(Run(run.method, *one, run.cell, run.rounding) for one in zip(courses[1:], marches, strict=True))]
