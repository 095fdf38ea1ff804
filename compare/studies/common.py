"""What the studies of all families share: from problems to a study, its header, its trajectories for figures."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.march.march import INLINE_SINE, march
from compare.measure.records import Study, Trace
from compare.measure.truth import Course
from compare.study import fits, score_all
from reference import __version__
from reference.arithmetic.compiler import hy
from reference.arithmetic.exact import as_number, exact
from reference.names import unknown
from reference.problem import Problem
from reference.routes.agreement import ROUTES

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction

    from compare.march.precision import Precision
    from compare.study import Scored

__all__ = ["SHORTER_N", "TRACE_N", "distinct", "forms_of", "made", "positive_end"]

SHORTER_N = tuple(2**k for k in range(7, 18))
"""Numbers of steps for families that take longer than the pendulum, or are shown in several forms."""
TRACE_N = 256
"""Of the numbers of steps that are asked for, trajectories have that nearest to this one."""


def made(
    name: str, problems: Sequence[Problem], definition: Any, parameters: dict[str, Any], *, traces: bool, **options: Any
) -> Study:
    """Score methods on the problems, and put the study together.

    Args:
        name: of the study.
        problems: what the methods are marched on.
        definition: the equation in a line, or one for each form.
        parameters: what the header says of the problems, and where their marches end.
        traces: whether to keep trajectories for plots, in that of the numbers of steps which is nearest to TRACE_N.
        options: of ``score_all``.
    """
    scored = score_all(problems, **options)
    kept, exact_orbits = _traces(scored) if traces else ((), ())
    return Study(
        problem=name,
        parameters={**parameters, "samples": scored.samples},
        reference={
            "version": __version__,
            "routes": ["enclosure", *ROUTES],
            "definition": definition if isinstance(definition, str) else "; ".join(map(": ".join, definition.items())),
            "truth": "the state at exactly t = n h, proven correctly rounded; h is t_end/N rounded to the format",
        },
        engine={**_engine(scored.fmt), **_notes(scored)},
        cases=scored.cases,
        error_vs_n=scored.cells,
        order=scored.orders,
        energy_drift=scored.drifts,
        scores=scored.scores,
        phase=scored.asked("phase"),
        growth=scored.asked("growth"),
        period=scored.asked("period"),
        defects=scored.asked("defects"),
        traces=kept,
        exact=exact_orbits,
    )


def forms_of(wanted: Sequence[str], known: Sequence[str]) -> tuple[str, ...]:
    """The forms of a family's equations that are wanted, each once, in their order.

    Raises:
        ValueError: one is unknown.
    """
    for name in wanted:
        if name not in known:
            raise ValueError(unknown("form", str(name), known))
    return tuple(name for name in known if name in wanted)


def positive_end(value: Any, name: str) -> Fraction:
    """Where a march ends.

    Raises:
        ValueError: it is not positive or not finite.
    """
    end = exact(value, name)
    if end <= 0:
        raise ValueError(f"{name} is {as_number(end)}; a positive number is accepted.")
    return end


def distinct(values: Sequence[Any], name: str, what: str) -> None:
    """Refuse values, numbers as doubles, of which two are the same.

    Raises:
        ValueError: there are such.
    """
    if len(set(values)) < len(values):
        precision = "" if isinstance(values[0], Problem) else ", to a double's precision"
        raise ValueError(f"{name} has one {what} twice{precision}; each is accepted once.")


def _notes(scored: Scored) -> dict[str, str]:
    """What was not marched, and why."""
    where: dict[tuple[str, ...], list[str]] = {}
    for label, names in scored.left_out.items():
        if names:
            where.setdefault(names, []).append(label)
    notes = [f"{', '.join(names)} ({'; '.join(labels)})" for names, labels in where.items()]
    return {"left out": "what splits kicks from drifts, or keeps an energy: " + "; ".join(notes)} if notes else {}


def _traces(scored: Scored) -> tuple[tuple[Trace, ...], tuple[Trace, ...]]:
    """Every method's trajectory on every problem, and the exact one at the same times."""
    pairs = zip(scored.problems, scored.t_ends, strict=True)
    asked = {cell.n for cell in scored.cells}
    n = min(asked, key=lambda count: (abs(math.log(count / TRACE_N)), count))
    courses = [Course(problem, n, end, scored.fmt, TRACE_N) for problem, end in pairs]
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
    drifts = course.drifts(states)
    return Trace(
        method=name,
        n=course.n,
        case=course.case,
        time=np.array([0.0, *(float(time) for time in course.times)]),
        states=np.vstack([start, states.astype(np.float64)]),
        drifts=np.hstack([np.zeros((len(drifts), 1)), drifts]),
    )


def _engine(fmt: Precision) -> dict[str, Any]:
    return {
        "precision": fmt.name,
        "bits": fmt.bits,
        "compiler": f"heyoka {hy.__version__}",
        "sine": f"heyoka's vector library; from {INLINE_SINE:.0e} evaluations in a march, inlined (compare.march.sine)",
        "contraction": "products and sums may be fused, so rounding differs from one processor to another; what it may "
        "change is not printed",
    }
