"""Methods over problems over numbers of steps: the one run that every study and the public functions share."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.compensated import compensate
from compare.methods import DEFAULT, find
from compare.precision import precision as find_precision
from compare.scores import Course, fit_order, score_method
from reference.exact import as_number, exact
from reference.problem import Problem

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from concurrent.futures import Executor
    from fractions import Fraction

    from compare.method import Method
    from compare.precision import Precision
    from compare.records import Cell, Drift, FittedOrder

__all__ = ["DEFAULT_N", "Scored", "energy_drift", "error_vs_n", "score_all", "some"]

DEFAULT_N = tuple(2**k for k in range(7, 21))
MAX_N = 10**10


@dataclass(frozen=True)
class Scored:
    """The scores of one run: in order of method, then problem, then N."""

    methods: tuple[Method, ...]
    problems: tuple[Problem, ...]
    t_end: Fraction
    fmt: Precision
    cells: tuple[Cell, ...]
    drifts: tuple[Drift, ...]

    @property
    def orders(self) -> tuple[FittedOrder, ...]:
        """A fitted order for each method and problem."""
        return tuple(
            fit_order(method, [cell for cell in self.cells if (cell.method, cell.theta0) == (method.name, theta0)])
            for method in self.methods
            for theta0 in (float(problem.start[0]) for problem in self.problems)
        )


def error_vs_n(problem: Problem, methods: Sequence[str] | None = None, **options: Any) -> tuple[Cell, ...]:
    """Return the error of methods on a problem at each number of steps; options as for ``score_all``."""
    return score_all([problem], methods, **options).cells


def energy_drift(problem: Problem, methods: Sequence[str] | None = None, **options: Any) -> tuple[Drift, ...]:
    """Return the energy drift of methods on a problem at each number of steps; options as for ``score_all``."""
    return score_all([problem], methods, **options).drifts


def score_all(
    problems: Sequence[Problem],
    methods: Sequence[str] | None = None,
    n: Sequence[int] = DEFAULT_N,
    t_end: Any = 10.0,
    precision: str = "float64",
    executor: Executor | None = None,
    progress: Callable[[str], None] | None = None,
    *,
    compensated: bool = False,
) -> Scored:
    """March methods over 0 <= t <= t_end of each problem in each number of steps, and score them.

    Args:
        problems: problems of one family.
        methods: names or aliases; ``compare.methods.DEFAULT`` if None.
        n: numbers of steps, each a positive integer.
        t_end: end of the march, s.
        precision: a format of ``compare.precision``.
        executor: where the methods are marched, such as a process pool; in this process if None.
        progress: called with each method's name when it is done.
        compensated: whether every step's additions to the state are compensated for rounding.

    Raises:
        ValueError: an argument is outside its range, or a name unknown.
        TypeError: an argument is of the wrong kind.
    """
    if not all(isinstance(problem, Problem) for problem in problems):
        raise TypeError(f"problems holds a {type(problems[0]).__name__}; problems such as Pendulum(1.0) are accepted.")
    fmt = find_precision(precision)
    chosen = DEFAULT if methods is None else tuple(dict.fromkeys(find(name) for name in some(methods, "methods")))
    if compensated:
        chosen = tuple(compensate(method) for method in chosen)
    end = exact(t_end, "t_end")
    if end <= 0:
        raise ValueError(f"t_end is {as_number(end)}; a positive number is accepted.")
    courses = [Course(problem, steps, end, fmt) for problem in problems for steps in _step_counts(n)]
    for course in courses:
        course.truth, course.neighbour.truth  # noqa: B018 - computed here once, before processes share it
    scores = _in_order_of_work(chosen, courses, fmt, executor, progress)
    cells = tuple(cell for method in chosen for cell in scores[method.name][0])
    drifts = tuple(drift for method in chosen for drift in scores[method.name][1])
    return Scored(chosen, tuple(problems), end, fmt, cells, drifts)


def some(values: Any, name: str) -> list[Any]:
    """``values`` as a list, if it is a sequence with something in it.

    Raises:
        TypeError: it is a string or one value.
        ValueError: it is empty.
    """
    if isinstance(values, (str, bytes)) or not isinstance(values, Iterable):
        raise TypeError(f"{name} is {values!r}; a sequence such as [{values!r}] is accepted.")
    found = list(values)
    if not found:
        raise ValueError(f"{name} is empty; at least one is accepted.")
    return found


def _step_counts(n: Sequence[int]) -> list[int]:
    for count in some(n, "n"):
        if isinstance(count, bool) or not isinstance(count, (int, np.integer)) or not 0 < count <= MAX_N:
            raise ValueError(f"n is {count!r}; a positive integer up to {MAX_N} is accepted.")
    return sorted({int(count) for count in n})


def _in_order_of_work(
    methods: Sequence[Method],
    courses: Sequence[Course],
    fmt: Precision,
    executor: Executor | None,
    progress: Callable[[str], None] | None,
) -> dict[str, tuple[list[Cell], list[Drift]]]:
    """Each method's cells and drifts, the longest marches begun first.

    This process takes from the end of the queue what the executor has not begun.  Processes, not threads: a call of a
    compiled block is so short that threads would spend their time handing over the interpreter's lock.
    """
    task = partial(score_method, courses=courses, fmt=fmt)
    by_work = sorted(methods, key=lambda method: (method.family != "implicit", -method.evaluations(1)[0]))
    queued = {method.name: executor.submit(task, method) for method in by_work} if executor is not None else {}
    scores: dict[str, tuple[list[Cell], list[Drift]]] = {}

    def keep(method: Method, result: tuple[list[Cell], list[Drift]]) -> None:
        scores[method.name] = result
        if progress is not None:
            progress(method.name)

    for method in reversed(by_work):
        if not queued or queued[method.name].cancel():
            keep(method, task(method))
    for method in by_work:
        if method.name not in scores:
            keep(method, queued[method.name].result())
    return scores
