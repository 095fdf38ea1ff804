"""Every method on the released pendulum: error against N, order, energy drift."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from compare.march import INLINE_SINE, march
from compare.records import Study, Trace
from compare.scores import SAMPLES, Course, relative_drift
from compare.scoring import DEFAULT_N, score_all, some
from reference import Pendulum, __version__
from reference.certify import ROUTES
from reference.compiler import hy
from reference.exact import as_number

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from concurrent.futures import Executor

    from compare.precision import Precision
    from compare.scoring import Scored

__all__ = ["DEFAULT_N", "study"]

TRACE_N = 256
TRACE_SAMPLES = TRACE_N


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
    executor: Executor | None = None,
) -> Study:
    """Score methods on the pendulum released at each amplitude, over 0 <= t <= t_end in each number of steps.

    Args:
        theta0: amplitudes in rad, each in (0, pi).
        g: acceleration of gravity in m/s^2.
        length: length in m.
        t_end: end of the march in s.
        n: numbers of steps, each a positive integer.
        methods: names or aliases; ``compare.methods.DEFAULT`` if None.
        precision: a format of ``compare.precision``.
        traces: whether to keep trajectories for plots, in TRACE_N steps.
        progress: called with each method's name when it is done.
        executor: where the methods are marched, such as a process pool; in this process if None.

    Raises:
        ValueError: an argument is outside its range, or a name unknown.
    """
    problems = [Pendulum(amplitude, g, length) for amplitude in some(theta0, "theta0")]
    if len({float(problem.theta0) for problem in problems}) < len(problems):
        raise ValueError("theta0 has one amplitude twice, to a double's precision; each is accepted once.")
    scored = score_all(problems, methods, n, t_end, precision, executor, progress)
    kept, exact_orbits = _traces(scored) if traces else ((), ())
    return Study(
        problem="pendulum",
        parameters=_parameters(problems, scored),
        reference={
            "version": __version__,
            "routes": ["enclosure", *ROUTES],
            "definition": "theta'' = -(g/length) sin(theta), theta(0) = theta0, theta'(0) = 0",
            "truth": "the state at exactly t = n h, proven correctly rounded; h is t_end/N rounded to the format",
        },
        engine=_engine(scored.fmt),
        error_vs_n=scored.cells,
        order=scored.orders,
        energy_drift=scored.drifts,
        traces=kept,
        exact=exact_orbits,
    )


def _parameters(problems: Sequence[Pendulum], scored: Scored) -> dict[str, Any]:
    """What was marched: floats where they are exact, else the decimal or fraction."""
    return {
        "theta0": [as_number(problem.theta0) for problem in problems],
        "g": as_number(problems[0].g),
        "length": as_number(problems[0].length),
        "t_end": as_number(scored.t_end),
        "samples": SAMPLES,
    }


def _traces(scored: Scored) -> tuple[tuple[Trace, ...], tuple[Trace, ...]]:
    """Every method's trajectory at every amplitude, and the exact one at the same times."""
    courses = [Course(problem, TRACE_N, scored.t_end, scored.fmt, TRACE_SAMPLES) for problem in scored.problems]
    lanes = [course.lane for course in courses]
    kept = [
        _trace(method.name, course, result.states)
        for method in scored.methods
        for course, result in zip(courses, march(method, lanes, scored.fmt), strict=True)
    ]
    return tuple(kept), tuple(_trace("exact", course, course.truth[..., 0]) for course in courses)


def _trace(name: str, course: Course, states: np.ndarray) -> Trace:
    """A trajectory with its start put before it."""
    start = [float(value) for value in course.problem.start]
    theta, omega = np.vstack([start, states.astype(np.float64)]).T
    return Trace(
        method=name,
        n=course.n,
        theta0=start[0],
        time=np.array([0.0, *(float(time) for time in course.times)]),
        theta=theta,
        omega=omega,
        drift=np.concatenate([[0.0], relative_drift(course, states)]),
    )


def _engine(fmt: Precision) -> dict[str, Any]:
    return {
        "precision": fmt.name,
        "bits": fmt.bits,
        "compiler": f"heyoka {hy.__version__}",
        "sine": f"heyoka's vector library; from {INLINE_SINE:.0e} evaluations in a march, inlined (compare.sine)",
        "contraction": "products and sums may be fused, so rounding differs from one processor to another",
    }
