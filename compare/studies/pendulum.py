"""Every method on the released pendulum: error against N, order, energy drift."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.march import march
from compare.methods import METHODS, find
from compare.precision import precision as find_precision
from compare.records import Study, Trace
from compare.score import SAMPLES, Course, fit_order, relative_drift, score_method
from reference import Pendulum
from reference.exact import exact

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from fractions import Fraction

    from compare.method import Method
    from compare.precision import Precision
    from compare.records import Cell, Drift, FittedOrder

__all__ = ["DEFAULT_N", "study"]

DEFAULT_N = tuple(2**k for k in range(7, 21))
TRACE_N = 1024
TRACE_SAMPLES = 512
MAX_N = 10**10


def study(
    theta0: Sequence[Any] = (1.0,),
    g: Any = 9.81,
    length: Any = 1.0,
    t_end: Any = 10.0,
    n: Sequence[int] = DEFAULT_N,
    methods: Sequence[str] | None = None,
    precision: str = "float64",
    traces: bool = False,
    progress: Callable[[str], None] | None = None,
) -> Study:
    """Score methods on the pendulum released at each amplitude, over 0 <= t <= t_end in each number of steps.

    Args:
        theta0: amplitudes in rad, each in (0, pi).
        g: acceleration of gravity in m/s^2.
        length: length in m.
        t_end: end of the march in s.
        n: numbers of steps, each a positive integer.
        methods: names or aliases; all methods if None.
        precision: a format of ``compare.precision``.
        traces: whether to keep trajectories for plots, in TRACE_N steps.
        progress: called with each method's name when it is done.

    Raises:
        ValueError: an argument is outside its range, or a name unknown.
    """
    fmt = find_precision(precision)
    chosen = _chosen(methods)
    end = exact(t_end, "t_end")
    if end <= 0:
        raise ValueError(f"t_end is {float(end)}; a positive number is accepted.")
    problems = [Pendulum(amplitude, g, length) for amplitude in _distinct(theta0, "theta0")]
    courses = [Course(problem, steps, end, fmt) for problem in problems for steps in _step_counts(n)]
    for course in courses:
        course.truth, course.neighbour.truth  # noqa: B018 - computed here once, before the threads share it
    results = _in_threads(chosen, courses, fmt, progress)
    cells = tuple(cell for method_cells, _ in results for cell in method_cells)
    kept, exact_orbits = _traces(chosen, problems, end, fmt) if traces else ((), ())
    return Study(
        problem="pendulum",
        parameters={
            "theta0": [float(problem.theta0) for problem in problems],
            "g": float(problems[0].g),
            "length": float(problems[0].length),
            "t_end": float(end),
            "samples": SAMPLES,
        },
        reference={
            "definition": "theta'' = -(g/length) sin(theta), theta(0) = theta0, theta'(0) = 0",
            "truth": "the state at exactly t = n h, proven correctly rounded; h is t_end/N rounded to the format",
            "limbs": int(courses[0].truth.shape[-1]),
        },
        engine=_engine(fmt),
        error_vs_n=cells,
        order=_orders(chosen, problems, cells),
        energy_drift=tuple(drift for _, drifts in results for drift in drifts),
        traces=kept,
        exact=exact_orbits,
    )


def _chosen(names: Sequence[str] | None) -> tuple[Method, ...]:
    if names is None:
        return METHODS
    return tuple(dict.fromkeys(find(name) for name in _distinct(names, "methods")))


def _distinct(values: Sequence[Any], name: str) -> list[Any]:
    if not len(values):
        raise ValueError(f"{name} is empty; at least one is accepted.")
    return list(dict.fromkeys(values))


def _step_counts(n: Sequence[int]) -> list[int]:
    for count in _distinct(n, "n"):
        if isinstance(count, bool) or not isinstance(count, (int, np.integer)) or not 0 < count <= MAX_N:
            raise ValueError(f"n is {count!r}; a positive integer up to {MAX_N} is accepted.")
    return sorted({int(count) for count in n})


def _in_threads(
    methods: Sequence[Method], courses: Sequence[Course], fmt: Precision, progress: Callable[[str], None] | None
) -> list[tuple[list[Cell], list[Drift]]]:
    """heyoka releases the interpreter lock while it compiles and while it marches: a thread a core."""

    def run(method: Method) -> tuple[list[Cell], list[Drift]]:
        scored = score_method(method, courses, fmt)
        if progress is not None:
            progress(method.name)
        return scored

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(run, methods))


def _orders(methods: Sequence[Method], problems: Sequence[Pendulum], cells: Sequence[Cell]) -> tuple[FittedOrder, ...]:
    return tuple(
        fit_order(
            method, [cell for cell in cells if cell.method == method.name and cell.theta0 == float(problem.theta0)]
        )
        for method in methods
        for problem in problems
    )


def _traces(
    methods: Sequence[Method], problems: Sequence[Pendulum], t_end: Fraction, fmt: Precision
) -> tuple[tuple[Trace, ...], tuple[Trace, ...]]:
    """Every method's trajectory at every amplitude, and the exact one at the same times."""
    courses = [Course(problem, TRACE_N, t_end, fmt, TRACE_SAMPLES) for problem in problems]
    kept = [
        _trace(method.name, course, result.states)
        for method in methods
        for course, result in zip(courses, march(method, [course.lane for course in courses], fmt), strict=True)
    ]
    return tuple(kept), tuple(_trace("exact", course, course.truth[..., 0]) for course in courses)


def _trace(name: str, course: Course, states: np.ndarray) -> Trace:
    """A trajectory with its start put before it."""
    problem = course.problem
    theta, omega = np.vstack([[float(value) for value in problem.start], states.astype(np.float64)]).T
    return Trace(
        method=name,
        n=course.n,
        theta0=float(problem.start[0]),
        time=np.array([0.0, *(float(time) for time in course.times)]),
        theta=theta,
        omega=omega,
        drift=np.concatenate([[0.0], relative_drift(course, states)]),
    )


def _engine(fmt: Precision) -> dict[str, Any]:
    import heyoka

    return {
        "precision": fmt.name,
        "bits": fmt.bits,
        "compiler": f"heyoka {heyoka.__version__}",
        "contraction": "products and sums may be fused, so rounding differs from one processor to another",
    }
