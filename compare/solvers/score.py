"""One solver, one question: what it answered, held against the proven states and events."""

from __future__ import annotations

import math
import time
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from compare.march.aspects import aspect_of
from compare.march.precision import precision
from compare.solvers.foreign import Heard, heard
from compare.solvers.records import EventCell, SolverCell

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from compare.solvers.solver import Answer, Question, Solver
    from reference.problem import Problem

__all__ = ["score_events", "score_solver"]

LIMBS = 2
CALLS, BRIEF = 3, 0.1
"""A call is made again until CALLS of them or BRIEF seconds are over, and the shortest counts."""


def score_solver(solver: Solver, questions: Sequence[Question]) -> list[SolverCell]:
    """Ask a solver one question after the other, from the loosest tolerance on; a failure is an answer too.

    A solver that had to be stopped is not asked for more.
    """
    cells: list[SolverCell] = []
    for question in questions:
        if cells and cells[-1].stopped:
            why = f"not asked: it was stopped at rtol {next(cell.rtol for cell in cells if cell.stopped):.0e}"
            cells.append(_cell(solver, question, Heard(None, why, (), stopped=True), math.nan))
        else:
            cells.append(_cell(solver, question, *_asked(solver, question)))
    return cells


def _cell(solver: Solver, question: Question, found: Heard[Answer], seconds: float) -> SolverCell:
    answer = found.value
    errors = np.full((1, len(question.start)), np.nan) if answer is None else _errors(question, answer.states)
    aspect = aspect_of(question.problem)
    place, velocity = errors[:, list(aspect.places)].max(axis=1), errors[:, list(aspect.rates)]
    return SolverCell(
        solver=solver.name,
        rtol=question.rtol,
        used=math.nan if answer is None else answer.used,
        theta0=float(question.problem.start[0]),
        max_error=float(place.max()),
        end_error=float(place[-1]),
        velocity_error=float(velocity.max()) if velocity.size else math.nan,
        evaluations=None if answer is None else answer.evaluations,
        seconds=None if answer is None else seconds,
        failure=found.failure,
        said="; ".join(found.said),
        stopped=found.stopped,
    )


def _errors(question: Question, states: np.ndarray) -> np.ndarray:
    """|states - truth| at exactly the times."""
    truth = _truth(question.problem, tuple(question.times.tolist()))
    errors: np.ndarray = np.abs(precision("float64").difference(states, truth))
    return errors


@lru_cache(maxsize=64)
def _truth(problem: Problem, times: tuple[float, ...]) -> np.ndarray:
    """The proven state, kept: every solver is asked at the same times."""
    return problem.state(list(map(Fraction, times)), limbs=LIMBS)


def _asked(solver: Solver, question: Question) -> tuple[Heard[Answer], float]:
    """The answer, and the seconds of the shortest call after what is compiled has been."""
    if not solver.solves(question):
        return Heard(None, f"it solves {solver.accepts}; {question.problem.name} is none of them", ()), math.nan
    prepared = heard(lambda: solver.prepare(question))
    if prepared.value is None:
        return Heard(None, prepared.failure, prepared.said, prepared.stopped), math.nan
    run: Callable[[], Answer] = prepared.value
    shortest, spent = math.inf, 0.0
    for _ in range(CALLS):
        found, seconds = heard(lambda: _timed(run)), math.nan
        if found.value is None:
            return Heard(None, found.failure, found.said, found.stopped), math.nan
        answer, seconds = found.value
        if answer.states.shape != (len(question.times), len(question.start)):
            return Heard(None, f"it returned states of shape {answer.states.shape}", found.said), math.nan
        shortest, spent = min(shortest, seconds), spent + seconds
        if spent > BRIEF:
            break
    return Heard(answer, "", tuple(dict.fromkeys([*prepared.said, *found.said]))), shortest


def _timed(run: Callable[[], Answer]) -> tuple[Answer, float]:
    began = time.perf_counter()
    answer = run()
    return answer, time.perf_counter() - began


def score_events(solver: Solver, question: Question, exact: np.ndarray) -> EventCell | None:
    """Ask a solver for the events and hold them against the exact ones, float64 limbs [events, limbs].

    None where the solver has no event function or there is nothing to find.
    """
    if solver.events is None or question.event is None or not len(exact) or not solver.solves(question):
        return None
    ask = solver.events
    found = heard(lambda: [float(t) for t in ask(question)])
    wanted = exact[:1] if solver.first_only else exact
    errors, spurious = _matched(sorted(found.value or []), wanted)
    return EventCell(
        solver=solver.name,
        rtol=question.rtol,
        theta0=float(question.problem.start[0]),
        expected=len(wanted),
        matched=len(errors),
        spurious=spurious,
        max_error=max(errors, default=math.nan),
        first_only=solver.first_only,
        failure=found.failure,
    )


def _matched(found: Sequence[float], exact: np.ndarray) -> tuple[list[float], int]:
    """|found - exact| of the exact events that were found, and how many times were found besides.

    A time stands for the exact event next to it, if it is nearer than half the way to the next one; of two that stand
    for one event the nearer counts.
    """
    times = exact[:, 0]
    reach = float(np.diff(times).min()) / 2 if len(times) > 1 else math.inf
    nearest: dict[int, float] = {}
    for time_found in found:
        place = int(np.argmin(np.abs(times - time_found)))
        error = abs(_difference(time_found, exact[place]))
        if error < reach:
            nearest[place] = min(error, nearest.get(place, math.inf))
    return list(nearest.values()), len(found) - len(nearest)


def _difference(value: float, limbs: np.ndarray) -> float:
    """value - the sum of the limbs, which are of falling size."""
    difference = value
    for limb in limbs:
        difference -= float(limb)
    return difference
