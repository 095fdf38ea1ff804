"""What a step keeps of the geometry of the exact motion: area in phase space, and the way back.

With the energy M(q) q'^2/2 + V(q) the momentum is M q', so that the area that the exact motion keeps is M dq dq': the
determinant of a step in (q, q') counts with M after the step over M before it.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from compare.march.aspects import conserves
from compare.march.equation import BoundSystem, plain_system
from compare.march.lanes import Lane, start_level
from compare.march.march import converged, iterations_for, march
from compare.march.trace import slopes_of
from compare.measure.records import Defect
from compare.measure.result import exactly
from compare.methods.kinds.compensated import Compensated
from reference.arithmetic.compiler import hy
from reference.arithmetic.namespaces import Heyoka

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.measure.result import Run
    from compare.measure.truth import Course
    from compare.methods.kinds.one_step import Method

__all__ = ["defects"]

STATES = 16
"""States of the exact motion at which the area is measured."""
FURTHER = 4
"""So much of the difference between neighbours bounds what rounding made of one."""
NEXT = 1 + Fraction(1, 1 << 40)
"""Where the way back of a lost march begins once more, over where it ended."""
PAIR = 2
"""Position and velocity are the first components of every state that has both."""


def defects(runs: Sequence[Run]) -> list[Defect]:
    """A record for each run."""
    areas: dict[Any, list[int]] = {}
    for i, run in enumerate(runs):
        areas.setdefault(run.course.problem, []).append(i)
    found = [NO_AREA] * len(runs)
    for members in areas.values():
        for i, defect in zip(members, _areas([runs[i] for i in members]), strict=True):
            found[i] = defect
    ways_back = _ways_back(runs)
    return [
        Defect(
            method=run.method.name,
            n=run.course.n,
            h=float(run.course.h),
            case=run.course.case,
            symplecticity=area.defect,
            reversibility=back.distance,
            symplecticity_rounding=area.rounding,
            reversibility_rounding=max(2 * run.state_rounding, back.rounding),
        )
        for run, area, back in zip(runs, found, ways_back, strict=True)
    ]


class Area(NamedTuple):
    """|det - 1| of a step, the largest, and a bound on rounding's part of it."""

    defect: float
    rounding: float


NO_AREA = Area(math.nan, math.nan)


def _areas(runs: Sequence[Run]) -> list[Area]:
    """|det - 1| of runs of one problem; the step is compiled once."""
    method, course = runs[0].method, runs[0].course
    method = method.base if isinstance(method, Compensated) else method
    problem = course.problem
    dimension = len(problem.state_names)
    if not (conserves(problem) and course.aspect.rates) or method.memory(dimension, getattr(problem, "positions", 0)):
        return [NO_AREA] * len(runs)
    largest = max(float(run.course.h) for run in runs)
    function = _compiled(method, course, iterations_for(method, problem, largest, course.fmt.bits))
    with np.errstate(all="ignore"):
        return [NO_AREA if np.isnan(run.march.states).all() else _area(function, run) for run in runs]


def _compiled(method: Method, course: Course, iterations: int) -> Any:
    """The state after a step, then its derivatives, row by row, then the changes of the last iteration."""
    problem, fmt = course.problem, course.fmt
    variables = [hy.expression(name) for name in problem.state_names]
    symbols = {name: hy.par[i + 2] for i, name in enumerate(problem.parameters)}
    system = BoundSystem(problem, Heyoka(fmt.number), symbols, fmt, hy.par[1])
    step, changes = method.step(system, tuple(variables), hy.par[0], iterations)
    entries = slopes_of(step[:PAIR], variables[:PAIR])
    return hy.cfunc([*step, *entries.ravel(), *changes], vars=variables, **fmt.compiler_options)


def _area(function: Any, run: Run) -> Area:
    """At states of the exact motion; and rounding's part: one for an evaluation and their sum, of either product.

    A step that is too long carries roundings further: so do starts that are apart by one in all components.
    """
    course = run.course
    fmt, problem = course.fmt, course.problem
    chosen = np.linspace(0, len(course.times) - 1, STATES).round().astype(int)
    states = np.stack([_rounded(course, chosen, i) for i in range(len(problem.state_names))])
    values = [fmt.number(course.h), start_level(problem, fmt), *map(fmt.number, problem.parameters.values())]
    parameters = np.repeat(np.array(values, dtype=fmt.type)[:, None], STATES, axis=1)
    near = states * fmt.number(1 + 2 * fmt.exact_epsilon)
    (defects, products), (others, _) = (_determinants(function, course, parameters, y) for y in (states, near))
    roundings = fmt.epsilon * (1 + run.march.evaluations / course.n) * products
    apart = np.abs(defects - others)
    return Area(float(np.max(np.abs(defects))), float(np.max(np.maximum(roundings, FURTHER * apart))))


def _determinants(
    function: Any, course: Course, parameters: np.ndarray, states: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """det - 1 of the step at each state, and the sum of the sizes of its two products."""
    found = function(np.ascontiguousarray(states), pars=parameters)
    after, (a, b, c, d), changes = np.split(found, [len(states), len(states) + PAIR**2])
    if not converged(float(np.max(np.abs(changes), initial=0.0)), after, course.fmt):
        after = np.full_like(after, np.nan)
    masses = [_mass(course, parameters, y) for y in (states, after)]
    ratio = masses[1] / masses[0]
    defects = (a * d - b * c) * ratio - course.fmt.number(Fraction(1))
    products = (np.abs(a * d) + np.abs(b * c)) * np.abs(ratio)
    return defects.astype(np.float64), products.astype(np.float64)


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


class WayBack(NamedTuple):
    """The distance from the start after turning round at the end and going back, and rounding's part of a lost one."""

    distance: float
    rounding: float


def _ways_back(runs: Sequence[Run]) -> list[WayBack]:
    """Of each run; where it is lost also from an end close by, which tells how far the way back carries roundings."""
    found = [WayBack(math.nan, 0.0)] * len(runs)
    ends = {i: end for i, run in enumerate(runs) if (end := _turned(run)) is not None}
    near = {
        i: tuple(runs[i].course.fmt.round(value * NEXT) for value in end) for i, end in ends.items() if runs[i].lost
    }
    if ends:
        lanes = [_back(runs[i].course, end) for starts in (ends, near) for i, end in starts.items()]
        with np.errstate(over="ignore", invalid="ignore"):
            marches = march(runs[0].method, lanes, runs[0].course.fmt)
            gaps = [_gaps(runs[i].course, result.states[-1]) for i, result in zip([*ends, *near], marches, strict=True)]
        others = dict(zip(near, gaps[len(ends) :], strict=True))
        for i, gap in zip(ends, gaps, strict=False):
            apart = float(np.max(np.abs(gap - others[i]))) if i in near else 0.0
            found[i] = WayBack(float(np.max(np.abs(gap))), FURTHER * apart if math.isfinite(apart) else math.inf)
    return found


def _turned(run: Run) -> tuple[Fraction, ...] | None:
    """Where the way back begins: at the end, turned round; None where that means nothing, or the end is no number."""
    odd, end = run.course.aspect.odd, [exactly(value) for value in run.march.states[-1]]
    if odd is None or any(value is None for value in end):
        return None
    return tuple(-value if i in odd else value for i, value in enumerate(end) if value is not None)


def _back(course: Course, start: tuple[Fraction, ...]) -> Lane:
    """As many steps from there."""
    return Lane(course.problem, course.n, course.h, (course.n,), start)


def _gaps(course: Course, state: np.ndarray) -> np.ndarray:
    """From the start with its velocity turned round, each component over its size; NaN if the way back was lost."""
    fmt, odd = course.fmt, course.aspect.odd or ()
    starts = [fmt.round(-value if i in odd else value) for i, value in enumerate(course.problem.start)]
    back = [exactly(value) for value in state]
    gaps = [math.nan if value is None else float(value - start) for value, start in zip(back, starts, strict=True)]
    found: np.ndarray = np.divide(gaps, course.reach.sizes)
    return found
