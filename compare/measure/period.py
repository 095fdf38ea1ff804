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
from flint import arb

from compare.march.lanes import Lane
from compare.march.march import march
from compare.measure.orbital import early_conditioning
from compare.measure.records import OwnPeriod
from compare.measure.result import SPARE_BITS, as_balls
from reference.arithmetic.namespaces import BALL
from reference.arithmetic.precision import ctx

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from compare.measure.result import Run
    from compare.measure.truth import Course
    from reference.orbits import Orbits

__all__ = ["own_periods"]

AROUND = 16
"""Steps before and after a middle within which a passage is looked for."""
NEAR = 1 / 4
"""A method whose phase is less than so many turns off at the exact passages has its own nearest to them."""
Middles = tuple[int, int]


def own_periods(runs: Sequence[Run]) -> list[OwnPeriod]:
    """A record for each run whose motion has phases and a period.

    The passages are looked for where the exact motion has them; and where a method of a low order has none there, once
    more where its phase at those steps says.
    """
    able = [run for run in runs if run.orbital_known and math.isfinite(run.course.problem.cycle())]
    found = _looked_for(able, [_middles(run.course) for run in able])
    again = {i: moved for i, (_, moved) in enumerate(found) if moved is not None}
    late = iter(_looked_for([able[i] for i in again], list(again.values())))
    return [next(late)[0] if i in again else record for i, (record, _) in enumerate(found)]


def _looked_for(runs: Sequence[Run], middles: Sequence[Middles]) -> list[tuple[OwnPeriod, Middles | None]]:
    """The record of each run from steps around two middles, and where else the passages are, if they are not there."""
    if not runs:
        return []
    lanes = [_lane(run.course, around) for run, around in zip(runs, middles, strict=True)]
    with np.errstate(over="ignore", invalid="ignore"):
        marches = march(runs[0].method, lanes, runs[0].course.fmt)
    kept = [result.states for result in marches]
    return [_record(*found) for found in zip(runs, lanes, middles, kept, strict=True)]


def _middles(course: Course) -> Middles:
    """The steps of the exact motion's first two passages."""
    turns = course.problem.cycle() / float(course.h)
    with ctx.workprec(SPARE_BITS):
        known = course.problem.orbits()
        phase = None if known is None else known.truth(Fraction(0)).phase
    since = 0.0 if phase is None else float(phase) % 1.0
    return int((1 - since) * turns), int((2 - since) * turns)


def _lane(course: Course, middles: Middles) -> Lane:
    """The steps around the middles, and no further."""
    near = {step for middle in middles for step in range(max(middle - AROUND, 1), max(middle, 1) + AROUND + 1)}
    return Lane(course.problem, max(near), course.h, tuple(sorted(near)))


def _record(run: Run, lane: Lane, middles: Middles, states: np.ndarray) -> tuple[OwnPeriod, Middles | None]:
    course, moved = run.course, None
    period = error = math.nan
    with ctx.workprec(course.fmt.bits + SPARE_BITS + course.problem.working_bits([lane.n * lane.h])):
        known = course.problem.orbits()
        if known is not None:
            phases = [known.place(state).phase if state else None for state in map(as_balls, states)]
            passages = list(_passages(lane, phases))[:2]
            if len(passages) == 2:
                own = passages[1] - passages[0]
                period, error = float(own), float(own * _frequency(known) - 1)
            else:
                moved = _moved(
                    dict(zip(lane.samples, phases, strict=True)), middles, course.problem.cycle() / float(lane.h)
                )
    return OwnPeriod(run.method.name, course.n, float(course.h), course.case, period, error, _rounding(run)), moved


def _moved(phases: dict[int, arb | None], middles: Middles, turn: float) -> Middles | None:
    """Where the passages are by the phases at the middles, ``turn`` steps a turn; None where that is not clear."""
    found = []
    for middle in middles:
        phase = phases.get(middle)
        ahead = math.nan if phase is None else float(phase - (phase + 0.5).mid().floor())
        if not abs(ahead) < NEAR:
            return None
        found.append(max(middle - round(ahead * turn), 1))
    return (found[0], found[1]) if tuple(found) != middles else None


def _rounding(run: Run) -> float:
    """A bound on rounding's part of period/exact: that of the phase by then; roundings add up as the root of time."""
    course, end = run.course, 2 * run.course.problem.cycle()
    part = min(end / float(course.t_end), 1.0)
    led = early_conditioning(course.problem, Fraction(end)).phase
    return (run.rounding.steps * math.sqrt(part) * led / (2 * math.pi) + 4) * course.fmt.epsilon


def _frequency(known: Orbits) -> arb:
    """Of the exact motion: by how much its phase moves on in a unit of time."""
    later, now = known.truth(Fraction(1)).phase, known.truth(Fraction(0)).phase
    return arb("nan") if later is None or now is None else later - now


def _passages(lane: Lane, phases: Sequence[arb | None]) -> Iterator[arb]:
    """The times at which the phase passes a whole number."""
    h = BALL.number(lane.h)
    for (step, before), (following, after) in pairwise(zip(lane.samples, phases, strict=True)):
        if before is None or after is None or following != step + 1:
            continue
        left, past = 1 - before + before.mid().floor(), after - after.mid().floor()
        if left < 1 / 2 and past < 1 / 2:
            yield h * (step + left / (left + past))
