"""Adaptive solvers on the problems of a family: error against tolerance, evaluations and seconds, and their events."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.controlled import tolerances
from compare.measure.cases import case_of
from compare.measure.truth import SAMPLES
from compare.scored import some
from compare.solvers.catalogue import SOLVERS, select
from compare.solvers.events import event_of
from compare.solvers.records import SolverEntry, SolverStudy
from compare.solvers.score import Asked, events, score_solver
from compare.solvers.solver import Question
from compare.study import inputs_shown, problems_of, units_of
from reference import __version__
from reference.arithmetic.exact import as_number, exact, positive
from reference.consistency import consistent
from reference.family import Family
from reference.problems.families import USUAL, find_family
from reference.routes.agreement import ROUTES

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from concurrent.futures import Executor

    from compare.solvers.solver import Solver
    from reference.problem import Problem

__all__ = ["DEFAULT_LIMIT", "DEFAULT_RTOL", "QUICK_LIMIT", "QUICK_RTOL", "facts", "questions", "study"]

DEFAULT_RTOL = tuple(float(f"1e-{k}") for k in range(3, 14))
DEFAULT_LIMIT = 200_000
QUICK_RTOL = DEFAULT_RTOL[:-2:2]
QUICK_LIMIT = 150_000
"""What one study takes: of the tolerances of a report the tightest two take half of the time."""
TINY, HUGE = sys.float_info.min, sys.float_info.max


def study(
    problem: Family | str = USUAL,
    t_end: Any = None,
    rtol: Sequence[float] = QUICK_RTOL,
    solvers: Sequence[str] | None = None,
    max_evaluations: int = QUICK_LIMIT,
    progress: Callable[[str], None] | None = None,
    executor: Executor | None = None,
    **inputs: Any,
) -> SolverStudy:
    """Ask solvers for the motions of a family, up to an end at each tolerance.

    Args:
        problem: the family, or its name.
        t_end: the last time in s, or in the problem's own unit; where its march ends by default if None.
        rtol: relative tolerances, each in (0, 1); the absolute one is the same.
        solvers: names of solvers or packages; all if None.
        max_evaluations: of the right-hand side that a solver is granted for one answer.
        progress: called with a line on what is being done.
        executor: takes its share of what is not timed: the events, after all states; solvers are timed here, alone.
        inputs: of the family, by name; of the one that varies a sequence.

    Raises:
        ValueError: an argument is outside its range, or a name unknown.
        TypeError: an argument is of the wrong kind.
    """
    family = problem if isinstance(problem, Family) else find_family(problem)
    problems = problems_of(family, inputs)
    for one in problems:
        consistent(one)
    marching = family.comparison.forms[0][1]
    ends = [marching.end.of(one, None) if t_end is None else exact(t_end, "t_end") for one in problems]
    chosen = SOLVERS if solvers is None else select(some(solvers, "solvers"))
    asked = [list(questions(one, end, rtol, max_evaluations)) for one, end in zip(problems, ends, strict=True)]
    answers: list[Asked] = []
    for solver in chosen:
        for series in asked if solver.version is not None else ():
            if progress is not None:
                progress(solver.name)
            answers += map(Asked, [solver] * len(series), series, score_solver(solver, series))
    found = events(answers, executor, progress)
    return SolverStudy(
        problem=family.comparison.command,
        parameters={
            **inputs_shown(family, inputs, problems),
            "t_end": [series[0].end for series in asked] if len(set(ends)) > 1 else asked[0][0].end,
            "rtol": [question.rtol for question in asked[0]],
            "samples": len(asked[0][0].times) - 1,
        },
        reference={
            "version": __version__,
            "routes": ["enclosure", *ROUTES],
            "definition": problems[0].equation,
            "truth": "the state at exactly the binary64 times asked for"
            + (f", and the {problems[0].event_words}, proven" if event_of(problems[0]) else ", proven"),
        },
        engine=facts(max_evaluations),
        solvers=tuple(_entry(solver) for solver in chosen),
        error_vs_rtol=tuple(answer.cell for answer in answers),
        events=tuple(found),
        cases=tuple(map(case_of, problems)),
        units={**units_of(family), "t_end": problems[0].space.independent},
    )


def facts(limit: int) -> dict[str, Any]:
    """How solvers are called, for the header of a table."""
    return {
        "precision": "float64; a solver is given parameters and starts rounded to it",
        "tolerance": "rtol, and atol = rtol; where a solver takes a step, rtol^(1/order)/rate",
        "evaluations": f"counted in the right-hand side itself; a solver is stopped after {limit}",
        "seconds": "the shortest of three calls, or fewer where they are long; what compiles has compiled before",
    }


def questions(problem: Problem, t_end: Any, rtol: Sequence[float], limit: int) -> Iterator[Question]:
    """The questions of one problem, from the loosest tolerance to the tightest.

    Raises:
        ValueError: an argument is outside its range.
        TypeError: ``rtol`` is no sequence.
    """
    end = exact(t_end, "t_end")
    if not TINY <= end <= HUGE:
        raise ValueError(f"t_end is {as_number(end)}; a positive number within the range of doubles is accepted.")
    times = np.linspace(0.0, float(end), SAMPLES + 1)
    for tolerance in tolerances(rtol):
        yield Question(problem, times, tolerance, positive(limit, "max_evaluations"), event_of(problem))


def _entry(solver: Solver) -> SolverEntry:
    return SolverEntry(
        solver=solver.name,
        package=solver.package,
        version=solver.version,
        install=solver.install,
        call=solver.call,
        dial=solver.dial,
        counts=solver.counts,
        tolerance=solver.tolerance,
    )
