"""The period of a method's own motion: from one upward passage through the bottom to the next.

A passage lies between two steps.  The orbit through the state at each of them gives a phase, which the exact motion
passes through uniformly: the passage is interpolated linearly in it.  So what is read between two steps errs no more
than the method does in one step.
"""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from flint import arb, ctx

from compare.aspects import period_of
from compare.lane import Lane
from compare.march import march
from compare.records import OwnPeriod
from compare.run import SPARE_BITS, as_balls
from compare.submission.orbit import orbits
from reference.arithmetic import BALL

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from compare.course import Course
    from compare.run import Run
    from compare.submission.place import Orbits

__all__ = ["own_periods"]

AROUND = 16
"""Steps before and after an exact passage within which the method's own is looked for."""


def own_periods(runs: Sequence[Run]) -> list[OwnPeriod]:
    """A record for each run whose motion has phases and a period."""
    able = [run for run in runs if run.orbital_known and math.isfinite(period_of(run.course.problem))]
    if not able:
        return []
    lanes = [_lane(run.course) for run in able]
    with np.errstate(over="ignore", invalid="ignore"):
        marches = march(able[0].method, lanes, able[0].course.fmt)
    return [_record(run, lane, result.states) for run, lane, result in zip(able, lanes, marches, strict=True)]


def _lane(course: Course) -> Lane:
    """The steps around the exact motion's first two passages, and no further."""
    period = period_of(course.problem)
    with ctx.workprec(SPARE_BITS):
        known = orbits(course.problem)
        phase = None if known is None else known.truth(Fraction(0)).phase
    since = 0.0 if phase is None else float(phase) % 1.0
    middles = [int((whole - since) * period / float(course.h)) for whole in (1, 2)]
    near = {step for middle in middles for step in range(max(middle - AROUND, 1), middle + AROUND + 1)}
    return Lane(course.problem, max(near), course.h, tuple(sorted(near)))


def _record(run: Run, lane: Lane, states: np.ndarray) -> OwnPeriod:
    course = run.course
    period = error = math.nan
    with ctx.workprec(course.fmt.bits + SPARE_BITS + course.problem.working_bits([lane.n * lane.h])):
        known = orbits(course.problem)
        passages = [] if known is None else list(_passages(known, lane, states))[:2]
        if known is not None and len(passages) == 2:
            own = passages[1] - passages[0]
            period, error = float(own), float(own * _frequency(known) - 1)
    return OwnPeriod(run.method.name, course.n, float(course.h), course.case, period, error, _rounding(run))


def _rounding(run: Run) -> float:
    """A bound on rounding's part of period/exact: that of the phase, which grows with the root of time at least."""
    course = run.course
    part = min(2 * period_of(course.problem) / float(course.t_end), 1.0)
    return run.phase_rounding * math.sqrt(part) / (2 * math.pi) + 4 * course.fmt.epsilon


def _frequency(known: Orbits) -> arb:
    """Of the exact motion: by how much its phase moves on in a unit of time."""
    later, now = known.truth(Fraction(1)).phase, known.truth(Fraction(0)).phase
    return arb("nan") if later is None or now is None else later - now


def _passages(known: Orbits, lane: Lane, states: np.ndarray) -> Iterator[arb]:
    """The times at which the phase passes a whole number."""
    h = BALL.number(lane.h)
    phases = [known.place(state).phase if state else None for state in map(as_balls, states)]
    for (step, before), (following, after) in pairwise(zip(lane.samples, phases, strict=True)):
        if before is None or after is None or following != step + 1:
            continue
        left, past = 1 - before + before.mid().floor(), after - after.mid().floor()
        if left < 1 / 2 and past < 1 / 2:
            yield h * (step + left / (left + past))
