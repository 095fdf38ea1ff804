"""From what is asked to a report: every group once, on an executor, the finished ones kept until all are.

Finished groups of an unfinished report, kept beside its folder, so that a long report can go on.

One group of a report: a method, a pair with a controlled step or a solver on one problem, over its numbers of steps or
tolerances.
"""

from __future__ import annotations

import hashlib
import json
import math
from dataclasses import asdict, dataclass
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

from compare.controlled import controlled, tolerances
from compare.march import controllers as step_controllers
from compare.march.adaptive import MOST_ATTEMPTS, is_pair, refusal
from compare.march.autonomous import autonomous
from compare.march.march import BRIEF, CLOCKED_RUNS, fits, march_alone
from compare.march.precision import precision
from compare.march.trace import TraceError
from compare.measure.adaptive import Tolerated, score_adaptive
from compare.measure.errors import score_errors
from compare.measure.truth import SAMPLES, Course
from compare.methods import find
from compare.methods.own.step_function import StepFunction, method_at
from compare.report.problems import reported, reported_by
from compare.report.records import Report, WorkPoint
from compare.scored import manner, named, some
from compare.show.output import folder
from compare.solvers.catalogue import SOLVERS, select
from compare.solvers.score import score_solver
from compare.solvers.solver import CALLS
from compare.solvers.study import DEFAULT_LIMIT, DEFAULT_RTOL, facts, questions
from compare.study import STEPS
from reference import __version__
from reference.arithmetic.compiler import hy
from reference.arithmetic.exact import positive
from reference.command.executors import opened, results
from reference.dataset.blocks import partial
from reference.named import program_at
from reference.routes.agreement import ROUTES

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from compare.measure.adaptive import Controlled
    from compare.measure.records import AdaptiveCell, Cell
    from compare.methods.kinds.one_step import Method
    from compare.report.problems import Amplitude
    from compare.solvers.records import SolverCell
    from compare.solvers.solver import Question, Solver
    from reference.dataset.blocks import Partial
    from reference.family import Reported
    from reference.problem import Problem

__all__ = ["DEFAULT_N", "Kept", "Plan", "Task", "plan", "run", "work"]

DIGEST = 64
"""Characters of the SHA-256 in front of a group."""


class Kept:
    """The finished groups of one report, among the finished blocks beside it."""

    def __init__(self, finished: Partial) -> None:
        self._finished = finished

    def put(self, task: Task, points: Sequence[WorkPoint]) -> None:
        """Keep a finished group: it is there as a whole or not at all."""
        text = json.dumps([asdict(point) for point in points])
        self._finished.put(task.key, f"{_digest(text)}{text}".encode())

    def get(self, task: Task) -> tuple[WorkPoint, ...] | None:
        """The finished group, or None where there is none or it is damaged."""
        found = (self._finished.get(task.key) or b"").decode(errors="replace")
        digest, text = found[:DIGEST], found[DIGEST:]
        return tuple(WorkPoint(**fields) for fields in json.loads(text)) if text and digest == _digest(text) else None


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()


@dataclass(frozen=True)
class Own:
    """A method of the user's own, as a worker finds it.

    Attributes:
        home: MODULE:NAME or FILE.py:NAME.
        order: that it claims.
        text, program: what tells the module that it stands in, and all of the user's, from what they were before they
            were changed; of the second a worker may have loaded another part.
    """

    home: str
    order: int
    text: str
    program: str

    def method(self, name: str) -> Method:
        """The method under the name that tables call it.

        Raises:
            ValueError: what stands there has been changed since the report was planned.
        """
        found = method_at(self.home, self.order, name)
        if program_at(self.home)[0] != self.text:
            raise ValueError(f"{self.home} was changed while the report was made; the same command begins anew.")
        return found


@dataclass(frozen=True)
class Task:
    """What one worker is asked for.

    Attributes:
        family, amplitude: the problem.
        name, kind: a method and "method", a pair and "adaptive", or a solver and "solver".
        settings: numbers of steps, or tolerances.
        t_end: the last time, s.
        limit: evaluations of the right-hand side that a solver is granted for one answer.
        own: where a method of the user's own stands; None for any other.
        controller: of the steps of a pair, or "".
    """

    family: str
    amplitude: float | str
    name: str
    kind: str
    settings: tuple[float, ...]
    t_end: float
    limit: int
    own: Own | None = None
    controller: str = ""

    @property
    def label(self) -> str:
        """What tables call it: a pair with its controller."""
        return f"{self.name}, {self.controller}" if self.controller else self.name

    @property
    def key(self) -> str:
        """The task as text; equal tasks have equal keys."""
        return json.dumps(asdict(self), sort_keys=True)

    @property
    def problem(self) -> Problem:
        """The problem itself."""
        return reported_by(self.family).problem(self.amplitude)

    @property
    def method(self) -> Method:
        """The method itself."""
        return find(self.name) if self.own is None else self.own.method(self.name)


def work(task: Task) -> tuple[WorkPoint, ...]:
    """Do what the task asks for; whatever goes wrong with a method or a solver is part of the answer."""
    return _WORK[task.kind](task)


def _marched(task: Task) -> tuple[WorkPoint, ...]:
    method, fmt, end = task.method, precision("float64"), Fraction(task.t_end)
    courses = [Course(task.problem, int(n), end, fmt) for n in task.settings]
    try:
        cells = score_errors(method, courses, fmt)
        alone = march_alone(method, [course.lane for course in courses], fmt)
    except (ValueError, TraceError) as error:  # the method does not fit the problem: others may
        return tuple(_failed(task, n, str(error)) for n in task.settings)
    return tuple(_point(task, cell.n, cell, seconds) for cell, (_, seconds) in zip(cells, alone, strict=True))


def _controlled(task: Task) -> tuple[WorkPoint, ...]:
    """Each tolerance by itself, for its seconds; of a short march the shortest of a few counts."""
    fmt, (controller,), pair = precision("float64"), step_controllers.controllers([task.controller]), task.method
    if not is_pair(pair):
        raise ValueError(f"{pair.name} {refusal(pair, task.problem)}.")
    course = Course(task.problem, SAMPLES, Fraction(task.t_end), fmt)
    points = []
    for rtol in task.settings:
        asked = [Tolerated(controller, Fraction(rtol), Fraction(rtol))]
        clocked: list[float] = []
        while len(clocked) < CLOCKED_RUNS and sum(clocked) <= BRIEF:
            (cell,) = score_adaptive(pair, [course], asked, fmt, MOST_ATTEMPTS, relative=False)
            clocked.append(cell.seconds)
        point = _failed(task, rtol, cell.failure) if cell.failure else _point(task, rtol, cell, min(clocked))
        points.append(point)
    return tuple(points)


def _solved(task: Task) -> tuple[WorkPoint, ...]:
    (solver,) = select([task.name])
    cells = score_solver(solver, list(questions(task.problem, task.t_end, task.settings, task.limit)))
    return tuple(
        _failed(task, cell.rtol, cell.failure) if cell.failure else _point(task, cell.rtol, cell, cell.seconds)
        for cell in cells
    )


_WORK: dict[str, Callable[[Task], tuple[WorkPoint, ...]]] = {
    "method": _marched,
    "adaptive": _controlled,
    "solver": _solved,
}
"""What is done with a task of each kind."""


def _point(task: Task, setting: float, cell: Cell | AdaptiveCell | SolverCell, seconds: float | None) -> WorkPoint:
    return WorkPoint(
        family=task.family,
        amplitude=task.amplitude,
        name=task.label,
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
        name=task.label,
        kind=task.kind,
        setting=setting,
        max_error=math.nan,
        floor=False,
        evaluations=None,
        seconds=None,
        failure=why,
    )


DEFAULT_N = tuple(2**k for k in range(7, 18))


@dataclass(frozen=True)
class Plan:
    """A report before it is run.

    Attributes:
        tasks: its groups.
        missing: packages of solvers that were asked for and are not here, with what installs them.
        left_out: methods and solvers by the problem that does not have what they need.
        parameters: what was asked for.
    """

    tasks: tuple[Task, ...]
    missing: dict[str, str]
    left_out: dict[str, list[str]]
    parameters: dict[str, Any]

    @property
    def identity(self) -> str:
        """A name that two plans share only if they ask for the same, of the same version."""
        text = "\n".join([__version__, hy.__version__, *(task.key for task in self.tasks)])
        return hashlib.sha256(text.encode()).hexdigest()


def plan(
    problems: Sequence[str] | None = None,
    amplitudes: Sequence[Amplitude] | None = None,
    methods: Sequence[str] | None = None,
    solvers: Sequence[str] | None = None,
    n: Sequence[int] = DEFAULT_N,
    rtol: Sequence[float] = DEFAULT_RTOL,
    t_end: float = 10.0,
    max_evaluations: int = DEFAULT_LIMIT,
    adaptive: Sequence[str] = (),
    controllers: Sequence[str] = step_controllers.DEFAULT,
) -> Plan:
    """Put together what a report covers; what is asked wrongly is found here, before anything is computed.

    Args:
        problems: families of problems; all if None.
        amplitudes: how far from rest they start, and for the descent the names of curves; those of each family where
            none of its kind is given.
        methods: methods with a fixed step, or "all"; ``compare.methods.DEFAULT`` if None, and () for none.
        solvers: solvers or packages; all if None, and () for none.
        n: numbers of steps for methods.
        rtol: tolerances for solvers, and for pairs with a controlled step; the absolute ones are the same.
        t_end: the last time in s, or in the problem's own unit; curves and descents end where they do.
        max_evaluations: of the right-hand side that a solver is granted for one answer.
        adaptive: embedded pairs that march with a controlled step, or "all".
        controllers: of their steps.

    Raises:
        ValueError: an argument is outside its range, or a name unknown.
        TypeError: an argument is of the wrong kind.
    """
    kinds = reported(None if problems is None else some(problems, "problems"))
    marched = () if methods == () else named(methods)
    asked = SOLVERS if solvers is None else select(() if solvers == () else some(solvers, "solvers"))
    own = {method.name: _own(method) for method in marched if isinstance(method, StepFunction)}
    counts = tuple(sorted({positive(count, "n") for count in some(n, "n")}))
    free = controlled(adaptive, controllers, rtol) if adaptive else None
    settings = {"method": counts, **dict.fromkeys(("adaptive", "solver"), tuple(tolerances(rtol)))}
    tasks: list[Task] = []
    left_out: dict[str, list[str]] = {}
    given = _given(list(kinds.values()), amplitudes)
    for key, one in kinds.items():
        for amplitude in _amplitudes(one, given):
            problem = one.problem(amplitude)
            end = float(one.end.of(problem, None)) if one.end.each else t_end
            question = next(questions(problem, end, rtol, max_evaluations))
            for name, kind, controller, suits in _suited(question, marched, free, asked):
                if suits:
                    asked_for = (key, amplitude, name, kind, settings[kind], question.end, max_evaluations)
                    tasks.append(Task(*asked_for, own.get(name) if kind == "method" else None, controller))
                else:
                    lacking = left_out.setdefault(one.label(amplitude), [])
                    lacking += [name] * (name not in lacking)
    if not tasks:
        raise ValueError("there is nothing to report on: no method and no solver that is installed is asked for.")
    cases = dict.fromkeys((reported_by(task.family), task.amplitude, task.t_end) for task in tasks)
    parameters = {
        "problems": [one.label(amplitude) for one, amplitude, _ in cases],
        **_ends(cases, t_end),
        "samples": SAMPLES,
        "n": list(counts),
        "rtol": list(settings["solver"]),
        **({} if free is None else {name: free.parameters[name] for name in ("adaptive", "controllers")}),
    }
    return Plan(tuple(tasks), {s.package: s.install for s in asked if s.version is None}, left_out, parameters)


def _own(method: StepFunction) -> Own:
    """Where a method of the user's own is found by the workers of a report.

    Raises:
        ValueError: it is known in this process alone.
    """
    if not method.home:
        raise ValueError(f"{method.name} is known in this process alone; MODULE:NAME or FILE.py:NAME is accepted.")
    return Own(method.home, method.order, *program_at(method.home))


def _ends(cases: Iterable[tuple[Reported, Amplitude, float]], t_end: float) -> dict[str, Any]:
    """Where marches end: all of those that go on for as long as they are asked to, and each that ends of itself."""
    whole = [one for one, _, _ in cases if not one.end.each]
    ends = {one.label(amplitude): end for one, amplitude, end in cases if one.end.each}
    return {**({"t_end": float(t_end)} if whole else {}), **({"ends": ends} if ends else {})}


def _suited(
    question: Question, methods: Sequence[Method], free: Controlled | None, solvers: Sequence[Solver]
) -> Iterator[tuple[str, str, str, bool]]:
    """Methods, pairs and the solvers that are here: name, kind, controller, and whether it fits the problem."""
    yield from ((method.name, "method", "", fits(method, question.problem)) for method in methods)
    if free is not None:
        names = dict.fromkeys(one.controller.name for one in free.asked)
        yield from (
            (pair.name, "adaptive", name, fits(pair, question.problem)) for pair in free.pairs for name in names
        )
    yield from ((s.name, "solver", "", s.solves(question)) for s in solvers if s.version is not None)


def _given(kinds: Sequence[Reported], amplitudes: Sequence[Amplitude] | None) -> tuple[Amplitude, ...]:
    """The numbers and names that are asked for, each as a double or as it is.

    Raises:
        ValueError: there is none, or one that no kind of problems takes.
    """
    given = () if amplitudes is None else some(amplitudes, "amplitudes")
    taken = {one.named for one in kinds}
    for amplitude in given:
        if isinstance(amplitude, str) not in taken:
            what = "names are accepted: they differ in a curve" if taken == {True} else "numbers are accepted"
            raise ValueError(f"amplitudes has {amplitude!r}; of {', '.join(one.name for one in kinds)}, {what}.")
    return tuple(amplitude if isinstance(amplitude, str) else float(amplitude) for amplitude in given)


def _amplitudes(one: Reported, given: Sequence[Amplitude]) -> Sequence[Amplitude]:
    """Those of a family: its own where none of those that are asked for is of its kind."""
    return [amplitude for amplitude in given if isinstance(amplitude, str) == one.named] or one.amplitudes


def run(
    wanted: Plan,
    out: str | os.PathLike[str],
    *,
    jobs: int = 1,
    executor: str = "process",
    progress: Callable[[int, int], None] | None = None,
) -> Report:
    """Run a plan and write its page and what goes with it into the folder ``out``.

    Groups that an earlier, interrupted run has finished are not run again.  ``progress(done, all)`` is called after
    each group.

    Raises:
        BusyError, WorkerError: another run writes the same report; a worker process died.
        OSError: the folder, or what is kept beside it, cannot be written, or was not made by a report.
        ValueError, ImportError: the executor is unknown, or its package is not installed.
    """
    target = Path(out).resolve()
    target.parent.mkdir(parents=True, exist_ok=True)
    with folder(out) as written, partial(target, wanted.identity) as unfinished:
        kept = Kept(unfinished)
        found = dict(_results(wanted, kept, jobs, executor, progress or (lambda _done, _all: None)))
        report = _report(wanted, found, f"{jobs} at a time on the executor '{executor}'")
        from compare.report import page  # which takes a second to import

        written.write(page.files(report))
    return report


def _report(wanted: Plan, found: dict[Task, tuple[WorkPoint, ...]], where: str) -> Report:
    return Report(
        problem="work-precision",
        parameters=wanted.parameters,
        units={"t_end": "s"},
        reference={
            "version": __version__,
            "routes": ["enclosure", *ROUTES],
            "truth": "the state at exactly n h, and at exactly the times that a solver is asked for, proven",
        },
        engine={
            **facts(wanted.tasks[0].limit),
            "methods": f"marched by code compiled by heyoka {hy.__version__}, in float64",
            **({"controlled steps": STEPS} if "adaptive" in wanted.parameters else {}),
            **_manners(wanted, found),
            "clock": f"a march by itself, or the call of a solver; {where}",
        },
        points=tuple(point for task in wanted.tasks for point in found[task]),
        missing=wanted.missing,
        left_out=wanted.left_out,
        counts={solver.name: solver.counts for solver in SOLVERS if solver.counts != CALLS},
    )


def _manners(wanted: Plan, found: dict[Task, tuple[WorkPoint, ...]]) -> dict[str, dict[str, str]]:
    """How the methods of the user's own were marched, those that were."""
    problems: dict[Method, list[Problem]] = {}
    for task in wanted.tasks:
        if task.own is not None and not any(point.failure for point in found[task]):
            problems.setdefault(task.method, []).append(autonomous(task.problem))
    fmt = precision("float64")
    marched = {method.name: manner(method, where, fmt) for method, where in problems.items()}
    return {"own methods": marched} if marched else {}


def _results(
    wanted: Plan, kept: Kept, jobs: int, executor: str, progress: Callable[[int, int], None]
) -> Iterator[tuple[Task, tuple[WorkPoint, ...]]]:
    """Every task with its points: those that are kept, then the others as they finish."""
    pending = []
    for task in wanted.tasks:
        points = kept.get(task)
        if points is None:
            pending.append(task)
        else:
            yield task, points
    done = len(wanted.tasks) - len(pending)
    progress(done, len(wanted.tasks))
    workers = max(1, min(jobs, len(pending))) if jobs > 0 else jobs
    with opened(executor, workers) as pool:
        for task, points in results(pool, work, pending, workers):
            kept.put(task, points)
            done += 1
            progress(done, len(wanted.tasks))
            yield task, points
