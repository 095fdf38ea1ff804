"""What the studies of all families share: from problems to a study, its header, its trajectories for figures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from compare.aspects import conserves
from compare.course import Course
from compare.march import INLINE_SINE, march
from compare.records import Study, Trace
from compare.scoring import fits, score_all
from reference import __version__
from reference.certify import ROUTES
from reference.compiler import hy
from reference.exact import as_number

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.precision import Precision
    from compare.scoring import Scored
    from reference.problem import Problem

__all__ = ["TRACE_N", "distinct", "made"]

TRACE_N = 256
TRACE_SAMPLES = TRACE_N


def made(
    name: str, problems: Sequence[Problem], definition: str, parameters: dict[str, Any], *, traces: bool, **options: Any
) -> Study:
    """Score methods on the problems, and put the study together.

    Args:
        name: of the study.
        problems: what the methods are marched on.
        definition: the equation, in a line.
        parameters: what the header says of the problems.
        traces: whether to keep trajectories for plots, in TRACE_N steps.
        options: of ``score_all``.
    """
    scored = score_all(problems, **options)
    kept, exact_orbits = _traces(scored) if traces else ((), ())
    ends = [as_number(end) for end in dict.fromkeys(scored.t_ends)]
    return Study(
        problem=name,
        parameters={**parameters, "t_end": ends[0] if len(ends) == 1 else ends, "samples": scored.samples},
        reference={
            "version": __version__,
            "routes": ["enclosure", *ROUTES],
            "definition": definition,
            "truth": "the state at exactly t = n h, proven correctly rounded; h is t_end/N rounded to the format",
        },
        engine=_engine(scored.fmt),
        cases=scored.cases,
        error_vs_n=scored.cells,
        order=scored.orders,
        energy_drift=scored.drifts,
        scores=scored.scores,
        notes=_notes(scored),
        phase=scored.asked("phase"),
        growth=scored.asked("growth"),
        period=scored.asked("period"),
        defects=scored.asked("defects"),
        traces=kept,
        exact=exact_orbits,
    )


def distinct(values: Sequence[Any], name: str, what: str) -> None:
    """Refuse values that a double cannot tell apart.

    Raises:
        ValueError: there are such.
    """
    if len(set(map(float, values))) < len(values):
        raise ValueError(f"{name} has one {what} twice, to a double's precision; each is accepted once.")


def _notes(scored: Scored) -> tuple[str, ...]:
    """What was not marched, and why."""
    return tuple(
        f"left out where {label}: {', '.join(names)}, which split kicks from drifts or keep an energy"
        for label, names in scored.left_out.items()
        if names
    )


def _traces(scored: Scored) -> tuple[tuple[Trace, ...], tuple[Trace, ...]]:
    """Every method's trajectory on every problem, and the exact one at the same times."""
    pairs = zip(scored.problems, scored.t_ends, strict=True)
    courses = [Course(problem, TRACE_N, end, scored.fmt, TRACE_SAMPLES) for problem, end in pairs]
    kept = []
    for method in scored.methods:
        fitting = [course for course in courses if fits(method, course.problem)]
        with np.errstate(over="ignore", invalid="ignore"):
            marches = march(method, [course.lane for course in fitting], scored.fmt)
            kept += [_trace(method.name, *found) for found in zip(fitting, [m.states for m in marches], strict=True)]
    return tuple(kept), tuple(_trace("exact", course, course.truth[..., 0]) for course in courses)


def _trace(name: str, course: Course, states: np.ndarray) -> Trace:
    """A trajectory with its start put before it."""
    start = [float(value) for value in course.problem.start]
    drift = course.drift(states) if conserves(course.problem) else np.full(len(states), np.nan)
    return Trace(
        method=name,
        n=course.n,
        case=course.case,
        time=np.array([0.0, *(float(time) for time in course.times)]),
        states=np.vstack([start, states.astype(np.float64)]),
        drift=np.concatenate([[0.0], drift]),
    )


def _engine(fmt: Precision) -> dict[str, Any]:
    return {
        "precision": fmt.name,
        "bits": fmt.bits,
        "compiler": f"heyoka {hy.__version__}",
        "sine": f"heyoka's vector library; from {INLINE_SINE:.0e} evaluations in a march, inlined (compare.sine)",
        "contraction": "products and sums may be fused, so rounding differs from one processor to another",
    }
