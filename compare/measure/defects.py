"""What a step keeps of the geometry of the exact motion: the symplectic form, and the way back.

The exact flow keeps W = sum dq_i dp_i.  With an energy E(q, q') that is quadratic in the velocities the momenta are its
slopes p = dE/dq', and with P = d(q, p)/d(q, q') the form in (q, q') is P' W P, at the state where it is taken: a step
with the derivative S keeps it if S' (P' W P after the step) S is P' W P before it.  With one degree of freedom this is
det S M(after)/M(before) = 1, M the mass.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from compare.march.equation import BoundSystem
from compare.march.lanes import Lane, initial_invariants
from compare.march.lanewise import obstacle, stepped
from compare.march.march import converged, iterations_for, march
from compare.march.trace import slopes_of
from compare.measure.records import Defect
from compare.measure.result import exactly
from compare.methods.kinds.compensated import Compensated
from compare.methods.own.step_function import StepFunction
from reference.arithmetic.compiler import hy, parameter_rows
from reference.arithmetic.namespaces import Heyoka

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from compare.march.precision import Precision
    from compare.measure.result import Run
    from compare.measure.truth import Course
    from compare.methods.kinds.one_step import Method
    from reference.problem import Problem

__all__ = [
    "CONFINED_SPACING",
    "SPACING",
    "STENCIL",
    "canonical_places",
    "defects",
    "largest_change",
    "symplectic_changes",
    "symplectic_form",
]

STATES = 16
"""States of the exact motion at which the area is measured."""
FURTHER = 4
"""So much of the difference between neighbours bounds what rounding made of one."""
NEXT = 1 + Fraction(1, 1 << 40)
"""Where the way back of a lost march begins once more, over where it ended."""
STENCIL = (5 / 6, -5 / 21, 5 / 84, -5 / 504, 1 / 1260)
"""f'(x) = sum_k c_k (f(x + k d) - f(x - k d))/d, k = 1 ... 5, to order 10 (B. Fornberg, Math. Comp. 51, 1988, 699)."""
SPACING, CONFINED_SPACING = 1 / 50, 1 / 200
"""d over the size of the component: then rounding and truncation are both near 1e-14; the second where a singularity
may be near."""


def defects(runs: Sequence[Run]) -> list[Defect]:
    """A record for each run."""
    problems: dict[Any, list[int]] = {}
    for i, run in enumerate(runs):
        problems.setdefault(run.course.problem, []).append(i)
    found = [NO_FORM] * len(runs)
    for members in problems.values():
        for i, defect in zip(members, _form_defects([runs[i] for i in members]), strict=True):
            found[i] = defect
    ways_back = _ways_back(runs)
    return [
        Defect(
            method=run.method.name,
            n=run.course.n,
            h=float(run.course.h),
            case=run.course.case,
            symplecticity=form.defect,
            reversibility=back.distance,
            symplecticity_rounding=form.rounding,
            reversibility_rounding=max(2 * run.state_rounding, back.rounding),
        )
        for run, form, back in zip(runs, found, ways_back, strict=True)
    ]


class FormDefect(NamedTuple):
    """|S' W S - W|/|W| of a step S and the symplectic form W, the largest, and a bound on rounding's part of it."""

    defect: float
    rounding: float


NO_FORM = FormDefect(math.nan, math.nan)


def _form_defects(runs: Sequence[Run]) -> list[FormDefect]:
    """Of runs of one problem; the step is compiled once."""
    method, course = runs[0].method, runs[0].course
    method = method.base if isinstance(method, Compensated) else method
    problem = course.problem
    if not problem.has_momenta or method.memory(len(problem.state_names), problem.positions):
        return [NO_FORM] * len(runs)
    if isinstance(method, StepFunction) and method.whole:
        return [NO_FORM] * len(runs)
    largest = max(float(run.course.h) for run in runs)
    if obstacle(method, problem, course.fmt):
        step, noise = _differenced(method, course), 2 * sum(map(abs, STENCIL)) / _spacing(problem)
    else:
        step, noise = _compiled(method, course, iterations_for(method, problem, largest, course.fmt.bits)), 1.0
    form = symplectic_form(problem, course.fmt)
    with np.errstate(all="ignore"):
        return [NO_FORM if np.isnan(run.march.states).all() else _form_defect(step, form, run, noise) for run in runs]


def _spacing(problem: Problem) -> float:
    return SPACING if problem.positions == 1 else CONFINED_SPACING


def _differenced(method: Method, course: Course) -> Callable[[np.ndarray, np.ndarray], np.ndarray]:
    """What ``_compiled`` gives, of a step that cannot be: its derivatives by the stencil."""
    places, count = canonical_places(course.problem), len(STENCIL)
    sizes = _spacing(course.problem) * course.conditioning.sizes

    def step(states: np.ndarray, parameters: np.ndarray) -> np.ndarray:
        moved = [states]
        for place in places:
            for shift in (*range(1, count + 1), *range(-count, 0)[::-1]):
                moved.append(states.copy())
                moved[-1][place] += shift * sizes[place]
        times = np.zeros(len(moved) * states.shape[1])
        found, _ = stepped(method, course.problem, course.fmt, np.hstack(moved), np.tile(parameters, len(moved)), times)
        after, *others = np.split(found[places], len(moved), axis=1)
        columns = []
        for i, place in enumerate(places):
            ahead, behind = np.split(np.array(others[2 * count * i : 2 * count * (i + 1)]), 2)
            columns.append(np.tensordot(STENCIL, ahead - behind, axes=1) / sizes[place])
        return np.vstack([found[:, : states.shape[1]], np.stack(columns, axis=1).reshape(-1, after.shape[1])])

    return step


def symplectic_form(problem: Problem, fmt: Precision) -> Callable[[np.ndarray], np.ndarray]:
    """The symplectic form in positions and rates at states [state, lanes]: P' W P, with P = d(q, p)/d(q, q').

    It is [2 n, 2 n, lanes], n the number of positions that have a rate, in the order of ``canonical_places``.
    """
    count, slopes = len(problem.space.pairs), _canonical(problem, fmt)

    def form(states: np.ndarray) -> np.ndarray:
        lanes = states.shape[1]
        plain = _canonical_form(count, lanes, fmt.type)
        if slopes is None:
            return plain
        entries = slopes(
            states, _parameters(problem, fmt, [fmt.number(Fraction(0))] * (1 + len(problem.invariants)), lanes)
        )
        return _congruent(entries.reshape(2 * count, 2 * count, -1), plain)

    return form


def _parameters(problem: Problem, fmt: Precision, first: Sequence[Any], lanes: int) -> np.ndarray:
    """The parameter rows of what is compiled, the same in each lane: h and the levels first."""
    values = [*first, *map(fmt.number, problem.parameters.values())]
    return np.repeat(np.array(values, dtype=fmt.type)[:, None], lanes, axis=1)


def _symbols(problem: Problem, fmt: Precision) -> tuple[list[Any], BoundSystem]:
    """The components of the state, and the equation in them; h is the first parameter."""
    kept = len(problem.invariants)
    variables = [hy.expression(name) for name in problem.state_names]
    symbols = {name: hy.par[i + 1 + kept] for i, name in enumerate(problem.parameters)}
    return variables, BoundSystem(problem, Heyoka(fmt.number), symbols, fmt, [hy.par[1 + i] for i in range(kept)])


def canonical_places(problem: Problem) -> list[int]:
    """Where the positions that have a rate stand, and then their rates."""
    return [place for column in zip(*problem.space.pairs, strict=True) for place in column]


def _compiled(method: Method, course: Course, iterations: int) -> Any:
    """The state after a step, then its derivatives, row by row, then the changes of the last iteration."""
    variables, system = _symbols(course.problem, course.fmt)
    step, changes = method.step(system, tuple(variables), hy.par[0], iterations)
    places = canonical_places(course.problem)
    entries = slopes_of([step[i] for i in places], [variables[i] for i in places])
    return _function([*step, *entries.ravel(), *changes], variables, course.fmt)


def _canonical(problem: Problem, fmt: Precision) -> Any:
    """d(q, p)/d(q, q') row by row, p the energy's slopes by q'; None where the rates are momenta."""
    if problem.space.momenta or problem.positions:
        return None
    variables, system = _symbols(problem, fmt)
    gradient = system.gradient(tuple(variables))
    momenta = [hy.expression(0.0) + gradient[rate] for _, rate in problem.space.pairs]
    places = canonical_places(problem)
    canonical = [*(variables[i] for i in places[: len(momenta)]), *momenta]
    entries = slopes_of(canonical, [variables[i] for i in places])
    return _function(list(entries.ravel()), variables, fmt)


def _function(outputs: list[Any], variables: list[Any], fmt: Precision) -> Callable[[np.ndarray, np.ndarray], Any]:
    """The compiled outputs, as a function of states [state, lanes] and parameters [rows, lanes]."""
    function, rows = hy.cfunc(outputs, vars=variables, **fmt.compiler_options), parameter_rows(outputs)
    return lambda states, parameters: function(np.ascontiguousarray(states), pars=parameters[:rows])


def _form_defect(step: Any, form: Any, run: Run, noise: float) -> FormDefect:
    """At states of the exact motion; and rounding's part: one for an evaluation and their sum, of either product.

    Differences make ``noise`` times as much of it.  A step that is too long carries roundings further: so do starts
    that are apart by one in all components.
    """
    course = run.course
    fmt, problem = course.fmt, course.problem
    chosen = np.linspace(0, len(course.times) - 1, STATES).round().astype(int)
    states = np.stack([_rounded(course, chosen, i) for i in range(len(problem.state_names))])
    parameters = _parameters(problem, fmt, [fmt.number(course.h), *initial_invariants(problem, fmt)], STATES)
    near = states * fmt.number(1 + 2 * fmt.exact_epsilon)
    (defects, products), (others, _) = (_changes(step, form, course, parameters, y) for y in (states, near))
    roundings = noise * fmt.epsilon * (1 + run.march.evaluations / course.n) * products
    apart = np.max(np.abs(defects - others), axis=0)
    return FormDefect(float(np.max(np.abs(defects))), float(np.max(np.maximum(roundings, FURTHER * apart))))


def _changes(
    step: Any, form: Any, course: Course, parameters: np.ndarray, states: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """(S' W S - W)/|W| at each state, entry by entry, and the sum of the sizes of its products."""
    size = 2 * len(course.problem.space.pairs)
    found = step(states, parameters)
    after, entries, changes = np.split(found, [len(states), len(states) + size**2])
    if not converged(float(np.max(np.abs(changes), initial=0.0)), after, states, course.fmt):
        after = np.full_like(after, np.nan)
    return symplectic_changes(entries.reshape(size, size, -1), form(states), form(after))


def symplectic_changes(slopes: np.ndarray, before: np.ndarray, after: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(S' W S - W)/|W|, [entries, lanes], and the largest sum of the sizes of an entry's products, [lanes].

    It is antisymmetric: what is above its diagonal is all of it.

    Args:
        slopes: S, the derivative of a step in positions and rates: [2 n, 2 n, lanes].
        before: the symplectic form W at the state, [2 n, 2 n, lanes].
        after: the same at the state after the step.
    """
    size, above = np.max(np.abs(before), axis=(0, 1)), np.triu_indices(len(slopes), 1)
    changes = (_congruent(slopes, after) - before)[above] / size
    products = np.max(_congruent(np.abs(slopes), np.abs(after))[above], axis=0) / size
    return changes.astype(np.float64), products.astype(np.float64)


def largest_change(changes: np.ndarray) -> np.ndarray:
    """Of changes [entries, lanes] the largest, with its sign; which entry that is may differ from state to state."""
    found: np.ndarray = np.take_along_axis(changes, np.argmax(np.abs(changes), axis=0)[None], axis=0)[0]
    return found


def _canonical_form(count: int, lanes: int, dtype: Any = np.float64) -> np.ndarray:
    """W of positions and momenta: ((0, 1), (-1, 0)), [2 n, 2 n, lanes]."""
    form = np.zeros((2 * count, 2 * count, lanes), dtype=dtype)
    for i in range(count):
        form[i, count + i], form[count + i, i] = 1, -1
    return form


def _congruent(slopes: np.ndarray, form: np.ndarray) -> np.ndarray:
    """S' W S, by sums in the format's own numbers."""
    half = np.sum(form[:, :, None] * slopes[None], axis=1)
    found: np.ndarray = np.sum(slopes[:, :, None] * half[:, None], axis=0)
    return found


def _rounded(course: Course, chosen: np.ndarray, component: int) -> np.ndarray:
    """A component of the exact states, rounded to the format."""
    limbs = course.truth[chosen, component].tolist()
    return course.fmt.array(sum(map(Fraction, parts), Fraction(0)) for parts in limbs)


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
    odd, end = _odd(run.course), [exactly(value) for value in run.march.states[-1]]
    if odd is None or any(value is None for value in end):
        return None
    return tuple(-value if i in odd else value for i, value in enumerate(end) if value is not None)


def _odd(course: Course) -> list[int] | None:
    """Where the components stand whose sign changes with that of time."""
    space = course.problem.space
    return None if space.odd is None else space.places(space.odd)


def _back(course: Course, start: tuple[Fraction, ...]) -> Lane:
    """As many steps from there."""
    return Lane(course.problem, course.n, course.h, (course.n,), start)


def _gaps(course: Course, state: np.ndarray) -> np.ndarray:
    """From the start with its velocity turned round, each component over its size; NaN if the way back was lost."""
    fmt, odd = course.fmt, _odd(course) or []
    starts = [fmt.round(-value if i in odd else value) for i, value in enumerate(course.problem.start)]
    back = [exactly(value) for value in state]
    gaps = [math.nan if value is None else float(value - start) for value, start in zip(back, starts, strict=True)]
    found: np.ndarray = np.divide(gaps, course.conditioning.sizes)
    return found
