"""Whole chunks judged exactly, one after the other here, or of a long file in other processes too."""

from __future__ import annotations

from contextlib import ExitStack
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from compare.files.judge import Judge

if TYPE_CHECKING:
    from collections.abc import Callable
    from concurrent.futures import Executor, Future
    from types import TracebackType

    from compare.files.chunk import Chunk
    from compare.files.scales import Point
    from reference.problem import Problem

__all__ = ["Crew"]

WORTH_PROCESSES = 6
"""Chunks in one process, from which on others are begun: about the work that their beginning costs."""
AHEAD = 2
"""Chunks on their way to each process."""


class Task(NamedTuple):
    """A chunk, after so many rows, in an input that holds so many digits, and has this least last place."""

    problem: Problem
    held: float
    last_place: float
    before: int
    chunk: Chunk


class Crew:
    """Judges chunks; a context that ends the processes that it began.

    Attributes:
        ahead: how many chunks may be waited for.
    """

    def __init__(self, judge: Judge, others: int | None = None) -> None:
        self._judge, self._stack = judge, ExitStack()
        self._others = others
        self._executor: Executor | None = None
        self._flying: list[Future[list[Point]]] = []
        self._chunks = 0
        self.ahead = 0

    def __enter__(self) -> Crew:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._stack.__exit__(kind, error, trace)

    def points(self, chunk: Chunk) -> Callable[[], list[Point]]:
        """Judge every row of the next chunk; what is found may have to be waited for, in the order of the chunks.

        Raises:
            ValueError: the times do not increase, or a number is not finite, or an angle is in degrees.
        """
        judge = self._judge
        if not judge.rows or chunk.doubles is None or not chunk.increases_from(judge.last):
            found = judge.points(chunk.rows())
            return lambda: self._turned(found)
        judge.expect(chunk.doubles.digits, chunk.doubles.last)
        task = Task(judge.problem, judge.held, judge.last_place, judge.rows, chunk)
        judge.pass_over(len(chunk), chunk.rows([len(chunk) - 1])[0].t)
        future = self._submitted(task)
        if future is None:
            found = _exact(task)
            return lambda: self._turned(found)
        return lambda: self._turned(_answer(future))

    def _turned(self, points: list[Point]) -> list[Point]:
        self._judge.turns.add(np.array([point.errors for point in points]))
        return points

    def _submitted(self, task: Task) -> Future[list[Point]] | None:
        """The task on its way to another process; None where there is none that is free."""
        self._chunks += 1
        if self._others == 0 or self._chunks <= WORTH_PROCESSES:
            return None
        if self._executor is None:
            from reference.command.executors import other_cores, processes

            self._others = other_cores() if self._others is None else self._others
            if not self._others:
                return None
            self._executor = self._stack.enter_context(processes(self._others))
            self.ahead = AHEAD * self._others
        self._flying = [future for future in self._flying if not future.done()]
        if len(self._flying) >= self.ahead:
            return None
        self._flying.append(self._executor.submit(_exact, task))
        return self._flying[-1]


def _exact(task: Task) -> list[Point]:
    judge = Judge(task.problem)
    judge.expect(task.held, task.last_place)
    judge.rows = task.before
    return judge.some(range(len(task.chunk)), task.chunk.rows())


def _answer(future: Future[list[Point]]) -> list[Point]:
    from reference.command.executors import answer

    return answer(future, "its rows were judged")
