"""One solver, one question: what it answered, held against the proven states and events.

Who asks for events: this process and others, for no time is measured there.

Calling what others wrote: whatever it does, the caller goes on and knows what it said.
"""

from __future__ import annotations

import contextlib
import ctypes
import math
import os
import sys
import tempfile
import time
import warnings
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Generic, NamedTuple, TypeVar

import numpy as np

from compare.measure.cases import case_of
from compare.measure.truth import errors_of_doubles
from compare.solvers.catalogue import select
from compare.solvers.events import exact_events
from compare.solvers.records import EventCell, SolverCell
from compare.solvers.solver import SolverError, StoppedError
from reference.command.executors import results

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from concurrent.futures import Executor

    from compare.solvers.solver import Answer, Question, Solver
    from reference.problem import Problem

__all__ = ["Asked", "events", "heard", "score_events", "score_solver"]

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
    found: dict[tuple[str, Problem, float], EventCell | None] = {}
    seconds = sum(one.cell.seconds or 0.0 for one in answered if one.solver.events is not None)
    if executor is None or seconds < WORTH_PROCESSES:
        for solver, question, _ in answered:
            _tell(progress, solver.name)
            found[_key(solver.name, question)] = score_events(solver, question, exact[question.problem])
    else:
        longest = sorted(answered, key=lambda one: one.cell.seconds or 0.0, reverse=True)
        tasks = [Task(one.solver.name, one.question, exact[one.question.problem]) for one in longest]
        for task, cell in results(executor, _score, tasks, unfinished="its events were found"):
            _tell(progress, task.solver)
            found[_key(task.solver, task.question)] = cell
    cells = (found[_key(solver.name, question)] for solver, question, _ in answered)
    return [cell for cell in cells if cell is not None]


def _key(solver: str, question: Question) -> tuple[str, Problem, float]:
    return solver, question.problem, question.rtol


def _tell(progress: Callable[[str], None] | None, name: str) -> None:
    if progress is not None:
        progress(f"{name}: events")


def _score(task: Task) -> EventCell | None:
    (solver,) = select([task.solver])
    return score_events(solver, task.question, task.exact)


LENGTH = 160
"""Characters of a message that are repeated."""
Value = TypeVar("Value")


@dataclass(frozen=True)
class Heard(Generic[Value]):
    """What came of a foreign call.

    Attributes:
        value: what it returned; None where it failed.
        failure: its own message, or "" where it did not fail.
        said: its warnings, each once.
        stopped: whether it failed because it was stopped.
    """

    value: Value | None
    failure: str
    said: tuple[str, ...]
    stopped: bool = False


def heard(call: Callable[[], Value]) -> Heard[Value]:
    """Make a foreign call; its failures and warnings are an answer, and what it prints stays off the terminal."""
    value, failure, stopped = None, "", False
    with warnings.catch_warnings(record=True) as caught, _printed() as printed:
        warnings.simplefilter("always")
        try:
            value = call()
        except SolverError as error:
            failure, stopped = _brief(str(error)), isinstance(error, StoppedError)
        except Exception as error:  # noqa: BLE001 - a foreign solver may fail in any way; how it does is what is reported
            failure = _brief(f"{type(error).__name__}: {error}")
    if failure and printed:
        failure = _brief(f"{failure}; it printed: {' '.join(printed)}")
    kinds = (DeprecationWarning, PendingDeprecationWarning, ImportWarning, ResourceWarning)
    told = [_brief(str(warning.message)) for warning in caught if not issubclass(warning.category, kinds)]
    return Heard(value, failure, tuple(dict.fromkeys(told)), stopped)


def _brief(text: str) -> str:
    """The text in one line, cut where it is long."""
    line = " ".join(text.split())
    return line if len(line) <= LENGTH else f"{line[: LENGTH - 3].rstrip()}..."


@contextlib.contextmanager
def _printed() -> Iterator[list[str]]:
    """Collect what is written to the standard streams inside, by Python or by compiled code, as a list of lines."""
    lines: list[str] = []
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as noise:
        with _replaced(noise.fileno()), contextlib.redirect_stdout(noise), contextlib.redirect_stderr(noise):
            yield lines
        noise.seek(0)
        lines += [line.strip() for line in noise if line.strip()]


@contextlib.contextmanager
def _replaced(handle: int) -> Iterator[None]:
    """Let the streams of compiled code, which know nothing of Python's, end in another file."""
    _flush()
    kept = [os.dup(stream) for stream in (1, 2)]
    try:
        for stream in (1, 2):
            os.dup2(handle, stream)
        yield
    finally:
        _flush()
        for stream, copy in zip((1, 2), kept, strict=True):
            os.dup2(copy, stream)
            os.close(copy)


def _flush() -> None:
    for stream in (sys.stdout, sys.stderr):
        stream.flush()
    ctypes.CDLL(None).fflush(None)


CALLS, BRIEF = 3, 0.1
"""A call is made again until CALLS of them or BRIEF seconds are over, and the shortest counts."""


def score_solver(solver: Solver, questions: Sequence[Question]) -> list[SolverCell]:
    """Ask a solver one question after the other, from the loosest tolerance on; a failure is an answer too.

    A solver that had to be stopped is not asked for more.
    """
    cells: list[SolverCell] = []
    for question in questions:
        if not solver.solves(question):
            why = f"it solves {solver.accepts}; {question.problem.name} is none of them"
            cells.append(_cell(solver, question, Heard(None, why, ()), math.nan, suited=False))
        elif cells and cells[-1].stopped:
            why = f"not asked: it was stopped at rtol {next(cell.rtol for cell in cells if cell.stopped):.0e}"
            cells.append(_cell(solver, question, Heard(None, why, (), stopped=True), math.nan))
        else:
            cells.append(_cell(solver, question, *_asked(solver, question)))
    return cells


def _cell(
    solver: Solver, question: Question, found: Heard[Answer], seconds: float, *, suited: bool = True
) -> SolverCell:
    answer = found.value
    errors = np.full((1, len(question.start)), np.nan) if answer is None else _errors(question, answer.states)
    space = question.problem.space
    place, velocity = errors[:, space.places(space.positions)].max(axis=1), errors[:, space.places(space.rates)]
    return SolverCell(
        solver=solver.name,
        rtol=question.rtol,
        used=math.nan if answer is None else answer.used,
        case=case_of(question.problem),
        max_error=float(place.max()),
        end_error=float(place[-1]),
        velocity_error=float(velocity.max()) if velocity.size else math.nan,
        evaluations=None if answer is None else answer.evaluations,
        seconds=None if answer is None else seconds,
        failure=found.failure,
        said="; ".join(found.said),
        stopped=found.stopped,
        suited=suited,
    )


def _errors(question: Question, states: np.ndarray) -> np.ndarray:
    """|states - truth| at exactly the times."""
    errors: np.ndarray = np.abs(errors_of_doubles(question.problem, map(Fraction, question.times.tolist()), states))
    return errors


def _asked(solver: Solver, question: Question) -> tuple[Heard[Answer], float]:
    """The answer, and the seconds of the shortest call after what is compiled has been."""
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
        if not np.isfinite(answer.states).all():
            return Heard(None, "it returned states that are not finite", found.said), math.nan
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
        case=case_of(question.problem),
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
