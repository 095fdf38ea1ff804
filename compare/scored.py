"""Methods over problems over numbers of steps: the one run that every study and the public functions share."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from compare.march.lanewise import obstacle
from compare.march.march import fits, lacking
from compare.march.precision import precision as find_precision
from compare.measure.adaptive import score_adaptive
from compare.measure.cases import case_of
from compare.measure.growth import GROWTH_SAMPLES
from compare.measure.order_fit import fit_order
from compare.measure.scores import Found, score
from compare.measure.truth import SAMPLES, Course
from compare.measure.wanted import DEFAULT_SCORES, EXTRAS, chosen_scores
from compare.methods import DEFAULT, METHODS, find
from compare.methods.kinds.compensated import compensate
from reference.arithmetic.exact import as_number, exact
from reference.arithmetic.underflow import require_gradual
from reference.command.executors import results
from reference.consistency import consistent
from reference.problem import Problem

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from concurrent.futures import Executor
    from fractions import Fraction

    from compare.march.precision import Precision
    from compare.measure.adaptive import Controlled
    from compare.measure.records import AdaptiveCell, Case, Cell, Drift, FittedOrder
    from compare.methods.kinds.one_step import Method
    from compare.methods.kinds.protocol import Pair

__all__ = [
    "DEFAULT_N",
    "Scored",
    "energy_drift",
    "error_vs_n",
    "manner",
    "named",
    "score_all",
    "some",
]

DEFAULT_N = tuple(2**k for k in range(7, 21))
MAX_N = 10**10
ALL = "all"
"""What asks for every method."""


@dataclass(frozen=True)
class Scored:
    """The scores of one run: in order of method, then problem, then N.

    Attributes:
        methods: those that were asked for.
        problems: the problems, each with its end in ``t_ends``.
        scores: which were asked for, of ``compare.measure.wanted.SCORES``.
        samples: at how many of its steps a march is compared, at most.
        found: records by the name of their table.
        left_out: methods that do not fit a problem, by the problem's label.
        own: how each of the user's own was marched, by its name.
        adaptive: the errors of pairs with a controlled step; None where none was asked for.
    """

    methods: tuple[Method, ...]
    problems: tuple[Problem, ...]
    t_ends: tuple[Fraction, ...]
    fmt: Precision
    scores: tuple[str, ...]
    samples: int
    found: Found
    left_out: dict[str, tuple[str, ...]]
    own: dict[str, str]
    adaptive: tuple[AdaptiveCell, ...] | None = None

    @property
    def cells(self) -> tuple[Cell, ...]:
        """The errors."""
        return tuple(self.found["error_vs_n"])

    @property
    def drifts(self) -> tuple[Drift, ...]:
        """The drifts of what is conserved."""
        return tuple(self.found["energy_drift"])

    @property
    def cases(self) -> tuple[Case, ...]:
        """The problems in a few words."""
        return tuple(map(case_of, self.problems))

    @property
    def orders(self) -> tuple[FittedOrder, ...]:
        """A fitted order for each method and problem."""
        pairs = ((method, case) for method in self.methods for case in self.cases)
        groups = (
            (method, [cell for cell in self.cells if (cell.method, cell.case) == (method.name, case)])
            for method, case in pairs
        )
        return tuple(fit_order(method, cells) for method, cells in groups if cells)

    def asked(self, name: str) -> tuple[Any, ...] | None:
        """The records of a score that is not always there; None where it was not asked for."""
        return tuple(self.found[name]) if name in self.scores else None


def error_vs_n(problem: Problem, methods: Sequence[str | Method] | None = None, **options: Any) -> tuple[Cell, ...]:
    """Return the error of methods on a problem at each number of steps; options as for ``score_all``."""
    return score_all([problem], methods, **options).cells


def energy_drift(problem: Problem, methods: Sequence[str | Method] | None = None, **options: Any) -> tuple[Drift, ...]:
    """Return the energy drift of methods on a problem at each number of steps; options as for ``score_all``."""
    return score_all([problem], methods, **options).drifts


def score_all(
    problems: Sequence[Problem],
    methods: Sequence[str | Method] | None = None,
    n: Sequence[int] = DEFAULT_N,
    t_end: Any = 10.0,
    precision: str = "float64",
    executor: Executor | None = None,
    progress: Callable[[str], None] | None = None,
    *,
    compensated: bool | Literal["beside"] = False,
    scores: Sequence[str] = DEFAULT_SCORES,
    controlled: Controlled | None = None,
) -> Scored:
    """March methods over 0 <= t <= t_end of each problem in each number of steps, and score them.

    A method that needs positions and momenta, or a conserved quantity, is left out where the problem has none.

    Args:
        problems: problems of any families.
        methods: names or aliases, or "all" for every one, or methods themselves; ``compare.methods.DEFAULT`` if None,
            and () for none where any march with a controlled step.
        n: numbers of steps, each a positive integer.
        t_end: end of the march, in s or the problem's own unit; or a list of one for each problem.
        precision: a format of ``compare.march.precision``.
        executor: where the methods are marched, such as a process pool; in this process if None.
        progress: called with each method's name when it is done.
        compensated: whether every step's additions to the state are compensated for rounding; "beside" marches each
            method both ways.
        scores: what is scored, of ``compare.measure.wanted.SCORES``.
        controlled: which pairs march with a controlled step besides, of ``controlled``; their states are compared at as
            many times.

    Raises:
        ValueError: an argument is outside its range, a name unknown, or no method fits any problem.
        TypeError: an argument is of the wrong kind.
        UnderflowModeError: the processor takes subnormal numbers for zero.
    """
    require_gradual("a comparison")
    for problem in problems:
        if not isinstance(problem, Problem):
            raise TypeError(f"problems holds a {type(problem).__name__}; problems such as Pendulum(1.0) are accepted.")
        consistent(problem)
    fmt, wanted = find_precision(precision), chosen_scores(some(scores, "scores"))
    chosen = () if methods == () and controlled is not None else named(methods)
    if fmt.name != "float64" and (own := [method.name for method in chosen if method.family == "own"]):
        raise ValueError(f"{own[0]} is a step function, with constants in doubles; precision float64 is accepted.")
    if compensated:
        twins = [(compensate(method),) if compensated is True else (method, compensate(method)) for method in chosen]
        chosen = tuple(method for both in twins for method in both)
    ends = _ends(t_end, len(problems))
    samples = GROWTH_SAMPLES if "growth" in wanted else SAMPLES
    pairs = list(zip(problems, ends, strict=True))
    courses = [Course(problem, k, end, fmt, samples) for problem, end in pairs for k in _step_counts(n) if chosen]
    free = [] if controlled is None else [Course(problem, SAMPLES, end, fmt) for problem, end in pairs]
    _hold_own(chosen, courses, fmt)
    for course in (*courses, *free):
        course.truth, course.neighbour.truth, course.conditioning  # noqa: B018 - computed once, before processes share it
    fitting = {method.name: [course for course in courses if fits(method, course.problem)] for method in chosen}
    _hold_some(chosen, courses)
    results = _in_order_of_work(chosen, fitting, (fmt, wanted), executor, progress)
    adaptive = None if controlled is None else _adaptive(controlled, free, fmt, executor, progress)
    tables = ("error_vs_n", "energy_drift", *(name for name in wanted if name in EXTRAS))
    found = {table: [record for method in chosen for record in results[method.name][table]] for table in tables}
    left_out = {
        case_of(problem).label: tuple(
            dict.fromkeys(
                method.name
                for method in (*chosen, *(() if controlled is None else controlled.pairs))
                if not fits(method, problem)
            )
        )
        for problem in problems
    }
    marched = {
        one.name: manner(one, [course.problem for course in courses], fmt)
        for one in chosen
        if one.opaque and fitting[one.name]
    }
    return Scored(chosen, tuple(problems), ends, fmt, wanted, samples, found, left_out, marched, adaptive)


def _hold_some(methods: Sequence[Method], courses: Sequence[Course]) -> None:
    """Refuse methods of which none fits any course.

    Raises:
        ValueError: none does.
    """
    if methods and not any(fits(method, course.problem) for method in methods for course in courses):
        problem = courses[0].problem
        alone = f": it {lacking(methods[0], problem)}" if len(methods) == 1 else ""
        names = ", ".join(method.name for method in methods)
        raise ValueError(f"none of {names} fits {problem.original!r}{alone}; others, such as rk4, are accepted.")


def manner(method: Method, problems: Sequence[Problem], fmt: Precision) -> str:
    """How a method of the user's own is marched on problems that it fits."""
    reasons = dict.fromkeys(obstacle(method, problem, fmt) for problem in dict.fromkeys(problems))
    return "; ".join(f"state by state: {why}" if why else "compiled" for why in reasons)


def _hold_own(methods: Sequence[Method], courses: Sequence[Course], fmt: Precision) -> None:
    """Try the methods of the user's own on every problem, before anything is computed.

    Raises:
        ValueError: two methods have one name, or one does not work on a problem.
    """
    names = [method.name for method in methods]
    for method in methods:
        if names.count(method.name) > 1:
            raise ValueError(f"two methods are called {method.name}; different names are accepted.")
    for problem in dict.fromkeys(course.problem for course in courses):
        for method in methods:
            if fits(method, problem):
                obstacle(method, problem, fmt)


def named(methods: Sequence[str | Method] | None) -> tuple[Method, ...]:
    """The methods of these names or aliases, each once; "all" stands for every one, and None for the default ones.

    A method may stand for itself, such as one that ``compare.method`` made of a step function.

    Raises:
        ValueError: a name is unknown or stands for two methods, or there is none.
        TypeError: ``methods`` is one name, or holds what is neither a name nor a method.
        FileNotFoundError, ImportError: the user's module that a name is of cannot be imported.
    """
    if methods is None:
        return DEFAULT
    found: dict[str, Method] = {}
    for one in some(methods, "methods"):
        for method in METHODS if isinstance(one, str) and one.strip().lower() == ALL else (_method(one),):
            if found.setdefault(method.name, method) != method:
                raise ValueError(f"methods has two of the name {method.name}; each name is accepted once.")
    return tuple(found.values())


def _method(one: str | Method) -> Method:
    if callable(getattr(one, "step", None)):
        return one  # type: ignore[return-value]
    if callable(one):
        raise TypeError(f"methods has {one!r}; compare.method(order=...) makes a method of a step function.")
    return find(str(one))


def _ends(t_end: Any, count: int) -> tuple[Fraction, ...]:
    """The end of the march of each problem."""
    listed = list(t_end) if isinstance(t_end, (list, tuple)) else [t_end] * count
    if len(listed) != count:
        raise ValueError(f"t_end has {len(listed)} numbers for {count} problems; one for each is accepted.")
    ends = tuple(exact(end, "t_end") for end in listed)
    for end in ends:
        if end <= 0:
            raise ValueError(f"t_end is {as_number(end)}; a positive number is accepted.")
    return ends


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


def _adaptive(
    controlled: Controlled,
    courses: Sequence[Course],
    fmt: Precision,
    executor: Executor | None,
    progress: Callable[[str], None] | None,
) -> tuple[AdaptiveCell, ...]:
    """The errors of pairs with a controlled step: pair by pair, those of low order, whose steps are many, begun first.

    Raises:
        ValueError: no pair fits any problem.
    """
    _hold_some(controlled.pairs, courses)
    by_work = sorted(controlled.pairs, key=lambda pair: (pair.family != "implicit", pair.order))
    fitting = [(pair, [course for course in courses if fits(pair, course.problem)]) for pair in by_work]
    function = partial(_score_adaptive, controlled=controlled, fmt=fmt)
    tasks = [task for task in fitting if task[1]]
    found: dict[str, list[AdaptiveCell]] = {}
    for (pair, _), cells in results(executor, function, tasks, unfinished="its marches were scored"):
        found[pair.name] = cells
        if progress is not None:
            progress(pair.name)
    return tuple(cell for pair in controlled.pairs for cell in found.get(pair.name, ()))


def _score_adaptive(task: tuple[Pair, list[Course]], controlled: Controlled, fmt: Precision) -> list[AdaptiveCell]:
    return score_adaptive(*task, controlled.asked, fmt, controlled.most)


def _score(task: tuple[Method, list[Course]], fmt: Precision, wanted: Sequence[str]) -> Found:
    return score(*task, fmt, wanted)


def _in_order_of_work(
    methods: Sequence[Method],
    courses: dict[str, list[Course]],
    asked: tuple[Precision, Sequence[str]],
    executor: Executor | None,
    progress: Callable[[str], None] | None,
) -> dict[str, Found]:
    """Each method's records, the longest marches begun first.

    Processes, not threads: a call of a compiled block is so short that threads would spend their time handing over the
    interpreter's lock.
    """
    by_work = sorted(
        methods,
        key=lambda method: (not method.opaque, method.family != "implicit", -method.evaluations(1)[0], -method.order),
    )
    tasks = [(method, courses[method.name]) for method in by_work]
    scores: dict[str, Found] = {}
    function, unfinished = partial(_score, fmt=asked[0], wanted=asked[1]), "its marches were scored"
    for (method, _), found in results(executor, function, tasks, unfinished=unfinished):
        scores[method.name] = found
        if progress is not None:
            progress(method.name)
    return scores
