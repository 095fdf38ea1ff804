"""Who asks for events: this process and others, for no time is measured there."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from compare.solvers.catalogue import select
from compare.solvers.events import exact_events
from compare.solvers.score import score_events
from reference.command.sharing import shared

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from concurrent.futures import Executor

    import numpy as np

    from compare.solvers.records import EventCell, SolverCell
    from compare.solvers.solver import Question, Solver

__all__ = ["Asked", "events"]


WORTH_PROCESSES = 4.0
"""Seconds of all calls from which others take less time to begin than they save."""


class Asked(NamedTuple):
    """What a solver was asked, and what it answered."""

    solver: Solver
    question: Question
    cell: SolverCell


class Task(NamedTuple):
    """The events of one question, as another process can take it: solvers are known there by their names."""

    solver: str
    question: Question
    exact: np.ndarray


def events(
    asked: Sequence[Asked], executor: Executor | None = None, progress: Callable[[str], None] | None = None
) -> list[EventCell]:
    """Ask for the events of every question; a solver that gave no states is not asked.

    The executor takes its share, the longest first, where that is worth it: an event takes about the time of a state.
    """
    answered = [one for one in asked if not one.cell.failure]
    exact = {one.question.problem: exact_events(one.question.problem, one.question.end) for one in answered}
    found: dict[tuple[str, float, float], EventCell | None] = {}
    seconds = sum(one.cell.seconds or 0.0 for one in answered if one.solver.events is not None)
    if executor is None or seconds < WORTH_PROCESSES:
        for solver, question, _ in answered:
            _tell(progress, solver.name)
            found[_key(solver.name, question)] = score_events(solver, question, exact[question.problem])
    else:
        longest = sorted(answered, key=lambda one: one.cell.seconds or 0.0, reverse=True)
        tasks = [Task(one.solver.name, one.question, exact[one.question.problem]) for one in longest]
        for task, cell in shared(tasks, _score, executor):
            _tell(progress, task.solver)
            found[_key(task.solver, task.question)] = cell
    cells = (found[_key(solver.name, question)] for solver, question, _ in answered)
    return [cell for cell in cells if cell is not None]


def _key(solver: str, question: Question) -> tuple[str, float, float]:
    return solver, float(question.problem.start[0]), question.rtol


def _tell(progress: Callable[[str], None] | None, name: str) -> None:
    if progress is not None:
        progress(f"{name}: events")


def _score(task: Task) -> EventCell | None:
    (solver,) = select([task.solver])
    return score_events(solver, task.question, task.exact)
