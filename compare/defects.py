"""What a step keeps of the geometry of the exact motion: area in phase space, and the way back.

With the energy M(q) q'^2/2 + V(q) the momentum is M q', so that the area that the exact motion keeps is M dq dq': the
determinant of a step in (q, q') counts with M after the step over M before it.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.aspects import conserves
from compare.bound import BoundSystem, plain_system
from compare.compensated import Compensated
from compare.lane import Lane, start_level
from compare.march import iterations_for, march
from compare.records import Defect
from compare.run import exactly
from compare.stepmap import slopes_of
from reference.arithmetic import Heyoka
from reference.compiler import hy

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.course import Course
    from compare.method import Method
    from compare.run import Run

__all__ = ["defects"]

STATES = 16
"""States of the exact motion at which the area is measured."""
PAIR = 2
"""Position and velocity are the first components of every state that has both."""


def defects(runs: Sequence[Run]) -> list[Defect]:
    """A record for each run."""
    areas: dict[Any, list[int]] = {}
    for i, run in enumerate(runs):
        areas.setdefault(run.course.problem, []).append(i)
    found = [math.nan] * len(runs)
    for members in areas.values():
        for i, defect in zip(members, _areas([runs[i] for i in members]), strict=True):
            found[i] = defect
    ways_back = _ways_back(runs)
    return [
        Defect(run.method.name, run.course.n, float(run.course.h), run.course.case, area, way_back, *_roundings(run))
        for run, area, way_back in zip(runs, found, ways_back, strict=True)
    ]


def _roundings(run: Run) -> tuple[float, float]:
    """Bounds on rounding's part of each defect: one for an evaluation and their sum; there and back of the state."""
    evaluations = run.march.evaluations / run.course.n
    return run.course.fmt.epsilon * (1 + evaluations), 2 * run.phase_rounding


def _areas(runs: Sequence[Run]) -> list[float]:
    """|det - 1| of runs of one problem; the step is compiled once."""
    method, course = runs[0].method, runs[0].course
    method = method.base if isinstance(method, Compensated) else method
    problem = course.problem
    dimension = len(problem.state_names)
    if not (conserves(problem) and course.aspect.rates) or method.memory(dimension, getattr(problem, "positions", 0)):
        return [math.nan] * len(runs)
    largest = max(float(run.course.h) for run in runs)
    function = _compiled(method, course, iterations_for(method, problem, largest, course.fmt.bits))
    with np.errstate(all="ignore"):
        return [_area(function, run.course) for run in runs]


def _compiled(method: Method, course: Course, iterations: int) -> Any:
    """The state after a step, then its derivatives, row by row."""
    problem, fmt = course.problem, course.fmt
    variables = [hy.expression(name) for name in problem.state_names]
    symbols = {name: hy.par[i + 2] for i, name in enumerate(problem.parameters)}
    system = BoundSystem(problem, Heyoka(fmt.number), symbols, fmt, hy.par[1])
    step, _ = method.step(system, tuple(variables), hy.par[0], iterations)
    entries = slopes_of(step[:PAIR], variables[:PAIR])
    return hy.cfunc([*step, *entries.ravel()], vars=variables, **fmt.compiler_options)


def _area(function: Any, course: Course) -> float:
    fmt, problem = course.fmt, course.problem
    chosen = np.linspace(0, len(course.times) - 1, STATES).round().astype(int)
    states = np.stack([_rounded(course, chosen, i) for i in range(len(problem.state_names))])
    values = [fmt.number(course.h), start_level(problem, fmt), *map(fmt.number, problem.parameters.values())]
    parameters = np.repeat(np.array(values, dtype=fmt.type)[:, None], STATES, axis=1)
    found = function(np.ascontiguousarray(states), pars=parameters)
    after, (a, b, c, d) = found[: len(states)], found[len(states) :]
    masses = [_mass(course, parameters, y) for y in (states, after)]
    defect = np.abs(((a * d - b * c) * masses[1] / masses[0] - fmt.number(Fraction(1))).astype(np.float64))
    return float(np.max(defect))


def _rounded(course: Course, chosen: np.ndarray, component: int) -> np.ndarray:
    """A component of the exact states, rounded to the format."""
    limbs = course.truth[chosen, component].tolist()
    return course.fmt.array(sum(map(Fraction, parts), Fraction(0)) for parts in limbs)


def _mass(course: Course, parameters: np.ndarray, y: np.ndarray) -> Any:
    """M = d2E/dq'2: what the energy's slope by q' gains from q' = 0 to q' = 1."""
    system, fmt = plain_system(course.problem, course.fmt, parameters), course.fmt
    still, moving = y.copy(), y.copy()
    still[1], moving[1] = fmt.number(Fraction(0)), fmt.number(Fraction(1))
    return system.gradient(tuple(moving))[1] - system.gradient(tuple(still))[1]


def _ways_back(runs: Sequence[Run]) -> list[float]:
    """The distance from the start after turning round at the end and going back."""
    found = [math.nan] * len(runs)
    lanes = {i: lane for i, run in enumerate(runs) if (lane := _turned(run)) is not None}
    if lanes:
        with np.errstate(over="ignore", invalid="ignore"):
            marches = march(runs[0].method, list(lanes.values()), runs[0].course.fmt)
            for i, result in zip(lanes, marches, strict=True):
                found[i] = _distance(runs[i].course, result.states[-1])
    return found


def _turned(run: Run) -> Lane | None:
    """The way back from where the march ended; None where turning round means nothing, or it was lost."""
    course, odd = run.course, run.course.aspect.odd
    end = [exactly(value) for value in run.march.states[-1]]
    if odd is None or any(value is None for value in end):
        return None
    start = tuple(-value if i in odd else value for i, value in enumerate(end) if value is not None)
    return Lane(course.problem, course.n, course.h, (course.n,), start)


def _distance(course: Course, state: np.ndarray) -> float:
    """From the start with its velocity turned round, each component over its size; NaN if the way back was lost."""
    fmt, odd = course.fmt, course.aspect.odd or ()
    starts = [fmt.round(-value if i in odd else value) for i, value in enumerate(course.problem.start)]
    back = [exactly(value) for value in state]
    gaps = [math.nan if value is None else abs(float(value - start)) for value, start in zip(back, starts, strict=True)]
    return float(np.max(np.divide(gaps, course.reach.sizes)))
