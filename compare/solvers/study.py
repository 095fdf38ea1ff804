"""Adaptive solvers on the released pendulum: error against tolerance, evaluations and seconds, and their events."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.measure.errors import SAMPLES
from compare.scored import some
from compare.solvers.catalogue import SOLVERS, select
from compare.solvers.events import event_of
from compare.solvers.records import SolverEntry, SolverStudy
from compare.solvers.score import Asked, events, score_solver
from compare.solvers.solver import Question
from reference import Pendulum, __version__
from reference.arithmetic.exact import as_number, exact, positive
from reference.routes.agreement import ROUTES

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from concurrent.futures import Executor

    from compare.solvers.solver import Solver
    from reference.problem import Problem

__all__ = ["DEFAULT_LIMIT", "DEFAULT_RTOL", "QUICK_LIMIT", "QUICK_RTOL", "facts", "questions", "study", "tolerances"]

DEFAULT_RTOL = tuple(float(f"1e-{k}") for k in range(3, 14))
DEFAULT_LIMIT = 200_000
QUICK_RTOL = DEFAULT_RTOL[:-2:2]
QUICK_LIMIT = 150_000
"""What one study takes: of the tolerances of a report the tightest two take half of the time."""
TINY, HUGE = sys.float_info.min, sys.float_info.max


def study(
    theta0: Sequence[Any] = (1.0,),
    g: Any = 9.81,
    length: Any = 1.0,
    t_end: Any = 10.0,
    rtol: Sequence[float] = QUICK_RTOL,
    solvers: Sequence[str] | None = None,
    max_evaluations: int = QUICK_LIMIT,
    progress: Callable[[str], None] | None = None,
    executor: Executor | None = None,
) -> SolverStudy:
    """Ask solvers for the pendulum released at each amplitude, over 0 <= t <= t_end at each tolerance.

    Args:
        theta0: amplitudes in rad, each in (0, pi).
        g: acceleration of gravity in m/s^2.
        length: length in m.
        t_end: the last time in s.
        rtol: relative tolerances, each in (0, 1); the absolute one is the same.
        solvers: names of solvers or packages; all if None.
        max_evaluations: of the right-hand side that a solver is granted for one answer.
        progress: called with a line on what is being done.
        executor: takes its share of what is not timed: the events, after all states; solvers are timed here, alone.

    Raises:
        ValueError: an argument is outside its range, or a name unknown.
        TypeError: an argument is of the wrong kind.
    """
    problems = [Pendulum(amplitude, g, length) for amplitude in some(theta0, "theta0")]
    if len({float(problem.theta0) for problem in problems}) < len(problems):
        raise ValueError("theta0 has one amplitude twice, to a double's precision; each is accepted once.")
    chosen = SOLVERS if solvers is None else select(some(solvers, "solvers"))
    asked = [list(questions(problem, t_end, rtol, max_evaluations)) for problem in problems]
    answers: list[Asked] = []
    for solver in chosen:
        for series in asked if solver.version is not None else ():
            if progress is not None:
                progress(solver.name)
            answers += map(Asked, [solver] * len(series), series, score_solver(solver, series))
    found = events(answers, executor, progress)
    return SolverStudy(
        problem="pendulum",
        parameters={
            "theta0": [as_number(problem.theta0) for problem in problems],
            "g": as_number(problems[0].g),
            "length": as_number(problems[0].length),
            "t_end": asked[0][0].end,
            "rtol": [question.rtol for question in asked[0]],
            "samples": len(asked[0][0].times) - 1,
        },
        reference={
            "version": __version__,
            "routes": ["enclosure", *ROUTES],
            "definition": "theta'' = -(g/length) sin(theta), theta(0) = theta0, theta'(0) = 0",
            "truth": "the state at exactly the binary64 times asked for, and the passages through the bottom, proven",
        },
        engine=facts(max_evaluations),
        solvers=tuple(_entry(solver) for solver in chosen),
        error_vs_rtol=tuple(answer.cell for answer in answers),
        events=tuple(found),
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


def tolerances(rtol: Sequence[float]) -> list[float]:
    """The tolerances, each once, from the loosest to the tightest.

    Raises:
        ValueError: one is not in (0, 1), or there is none.
        TypeError: ``rtol`` is no sequence.
    """
    asked = {exact(value, "rtol") for value in some(rtol, "rtol")}
    for tolerance in asked:
        if not TINY <= tolerance < 1:
            raise ValueError(f"rtol is {as_number(tolerance)}; a number with 0 < rtol < 1 is accepted.")
    return sorted(map(float, asked), reverse=True)


def _entry(solver: Solver) -> SolverEntry:
    return SolverEntry(
        solver=solver.name,
        package=solver.package,
        version=solver.version,
        install=solver.install,
        call=solver.call,
        dial=solver.dial,
        counts=solver.counts,
    )
