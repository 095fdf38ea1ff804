"""One group of a report: a method or a solver on one problem, over its numbers of steps or tolerances."""

from __future__ import annotations

import json
import math
from dataclasses import asdict, dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from compare.march.march import march_alone
from compare.march.precision import precision
from compare.march.trace import TraceError
from compare.measure.errors import Course, score_errors
from compare.methods import find
from compare.report.families import family
from compare.report.records import WorkPoint
from compare.solvers.catalogue import select
from compare.solvers.score import score_solver
from compare.solvers.study import questions

if TYPE_CHECKING:
    from compare.measure.records import Cell
    from compare.solvers.records import SolverCell
    from reference.problem import Problem

__all__ = ["Task", "work"]


@dataclass(frozen=True)
class Task:
    """What one worker is asked for.

    Attributes:
        family, amplitude: the problem.
        name, kind: a method and "method", or a solver and "solver".
        settings: numbers of steps, or tolerances.
        t_end: the last time, s.
        limit: evaluations of the right-hand side that a solver is granted for one answer.
    """

    family: str
    amplitude: float | str
    name: str
    kind: str
    settings: tuple[float, ...]
    t_end: float
    limit: int

    @property
    def key(self) -> str:
        """The task as text; equal tasks have equal keys."""
        return json.dumps(asdict(self), sort_keys=True)

    @property
    def problem(self) -> Problem:
        """The problem itself."""
        return family(self.family).build(self.amplitude)


def work(task: Task) -> tuple[WorkPoint, ...]:
    """Do what the task asks for; whatever goes wrong with a method or a solver is part of the answer."""
    return _marched(task) if task.kind == "method" else _solved(task)


def _marched(task: Task) -> tuple[WorkPoint, ...]:
    method, fmt, end = find(task.name), precision("float64"), Fraction(task.t_end)
    courses = [Course(task.problem, int(n), end, fmt) for n in task.settings]
    try:
        cells = score_errors(method, courses, fmt)
        alone = march_alone(method, [course.lane for course in courses], fmt)
    except (ValueError, TraceError) as error:  # the method does not fit the problem: others may
        return tuple(_failed(task, n, str(error)) for n in task.settings)
    return tuple(_point(task, cell.n, cell, seconds) for cell, (_, seconds) in zip(cells, alone, strict=True))


def _solved(task: Task) -> tuple[WorkPoint, ...]:
    (solver,) = select([task.name])
    cells = score_solver(solver, list(questions(task.problem, task.t_end, task.settings, task.limit)))
    return tuple(
        _failed(task, cell.rtol, cell.failure) if cell.failure else _point(task, cell.rtol, cell, cell.seconds)
        for cell in cells
    )


def _point(task: Task, setting: float, cell: Cell | SolverCell, seconds: float | None) -> WorkPoint:
    return WorkPoint(
        family=task.family,
        amplitude=task.amplitude,
        name=task.name,
        kind=task.kind,
        setting=setting,
        max_error=float(cell.max_error),
        floor=bool(cell.floor),
        evaluations=cell.evaluations,
        seconds=seconds,
        failure="",
    )


def _failed(task: Task, setting: float, why: str) -> WorkPoint:
    return WorkPoint(
        family=task.family,
        amplitude=task.amplitude,
        name=task.name,
        kind=task.kind,
        setting=setting,
        max_error=math.nan,
        floor=False,
        evaluations=None,
        seconds=None,
        failure=why,
    )
