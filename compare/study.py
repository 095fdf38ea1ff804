"""The study of a family: its problems from their inputs, methods scored on them, and what the header says.

One for every family: which inputs it has, which of them varies, which forms of its equations are marched and to where,
the family declares itself.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.controlled import OPTIONS, controlled
from compare.march.block_size import INLINE_SINE
from compare.march.march import fits, march
from compare.measure.records import Study, Trace
from compare.measure.truth import Course
from compare.measure.wanted import DEFAULT_SCORES, EXTRAS
from compare.scored import score_all, some
from reference import __version__
from reference.arithmetic.compiler import hy
from reference.arithmetic.exact import as_number, exact
from reference.family import LEAST_N, Family
from reference.names import unknown
from reference.problems.families import find_family
from reference.routes.agreement import ROUTES

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction

    from compare.march.precision import Precision
    from compare.measure.adaptive import Controlled
    from compare.scored import Scored
    from reference.family import End, Input, Marched
    from reference.problem import Problem

__all__ = ["STEPS", "TRACE_N", "inputs_shown", "problems_of", "study", "units_of"]

TRACE_N = 256
"""Of the numbers of steps that are asked for, trajectories have that nearest to this one."""
STEPS = (
    "of embedded pairs: cut at the end alone; at a sample the state is by a step from the last one before "
    "(docs/work-precision.md)"
)
"""How the steps of pairs are controlled, for the header of a table."""


def study(family: Family | str, form: Sequence[str] | None = None, *, traces: bool = False, **given: Any) -> Study:
    """Score methods on the problems of a family.

    Args:
        family: the family, its name, or the name of its command.
        form: which forms of its equations are marched, of those that its ``comparison`` has; all if None.
        traces: whether to keep trajectories for plots, in that of the numbers of steps which is nearest to TRACE_N.
        given: inputs of the family by name, of which the ``varied`` one is a sequence; the ends of marches by name;
            arguments of ``compare.controlled.controlled``, where pairs march with a controlled step too; and options of
            ``compare.scored.score_all``.

    Raises:
        ValueError: an argument is outside its range, or a name unknown.
        TypeError: an argument is of the wrong kind.
    """
    one = family if isinstance(family, Family) else find_family(family)
    comparison = one.comparison
    forms = _forms(one, form)
    inputs = {name: given.pop(name) for name in (comparison.varied, *comparison.inputs) if name in given}
    ends = {end.name: given.pop(end.name) for end in _ends(forms) if end.name in given}
    free = _controlled({name: given.pop(name) for name in OPTIONS if name in given})
    if free is not None:
        given = {"scores": (*DEFAULT_SCORES, "work"), **given}
    bases = problems_of(one, inputs)
    marched: list[Problem] = []
    lengths: list[Fraction] = []
    header, units = inputs_shown(one, inputs, bases), units_of(one)
    for marching in forms.values():
        problems = [marching.problem(base) for base in bases]
        own = [marching.end.of(problem, ends.get(marching.end.name)) for problem in problems]
        shown = [as_number(marching.end.shown(*pair)) for pair in zip(problems, own, strict=True)]
        header.setdefault(marching.end.name, shown if marching.end.each else shown[0])
        units.setdefault(marching.end.name, problems[0].space.independent)
        marched += problems
        lengths += own
    counts = [1 << k for k in range(LEAST_N.bit_length() - 1, comparison.largest.bit_length())]
    scored = score_all(marched, **{"n": counts, **given, "t_end": lengths, "controlled": free})
    kept, exact_orbits = _traces(scored) if traces else ((), ())
    return Study(
        problem=comparison.command,
        parameters={**header, "samples": scored.samples, **({} if free is None else free.parameters)},
        reference={
            "version": __version__,
            "routes": ["enclosure", *ROUTES],
            "definition": _definition(marched),
            "truth": "the state at exactly t = n h, proven correctly rounded; h is t_end/N rounded to the format",
        },
        engine={**_engine(scored.fmt), **({} if free is None else {"controlled steps": STEPS}), **_notes(scored)},
        cases=scored.cases,
        error_vs_n=scored.cells,
        order=scored.orders,
        energy_drift=scored.drifts,
        scores=scored.scores,
        units=units,
        adaptive=scored.adaptive,
        **{score: scored.asked(score) for score in EXTRAS},
        traces=kept,
        exact=exact_orbits,
    )


def _controlled(asked: dict[str, Any]) -> Controlled | None:
    """What is asked of pairs with a controlled step, if any are."""
    if asked and "adaptive" not in asked:
        raise ValueError(f"{next(iter(asked))} is of pairs with a controlled step; adaptive says which.")
    return controlled(**asked) if asked else None


def problems_of(family: Family, inputs: dict[str, Any]) -> list[Problem]:
    """The problems of a family: one for each value of the input that varies.

    Raises:
        ValueError: an input is unknown or outside its range, or two problems are the same to a double's precision.
    """
    comparison = family.comparison
    accepted = (comparison.varied, *comparison.inputs)
    for name in inputs:
        if name not in accepted:
            raise ValueError(unknown("input", name, accepted))
    values = some(inputs.get(comparison.varied, comparison.values), comparison.varied)
    others = {name: _default(family.input(name)) for name in comparison.inputs}
    others |= {name: value for name, value in inputs.items() if name != comparison.varied}
    others = {name: value for name, value in others.items() if value is not None}
    problems = [family.problem(**{comparison.varied: value}, **others) for value in values]
    told = [tuple(value for value, _ in problem.inputs.values()) for problem in problems]
    if len(set(told)) < len(told):
        precision = "" if family.input(comparison.varied).kind == "text" else ", to a double's precision"
        raise ValueError(f"{comparison.varied} has one {comparison.what} twice{precision}; each is accepted once.")
    return problems


def _default(wanted: Input) -> Any:
    """The default of an input as a value; None where it has none."""
    if wanted.default is None or wanted.kind == "text":
        return wanted.default
    numbers = tuple(map(float, wanted.default.split(",")))
    return numbers if wanted.kind == "pair" else numbers[0]


def _forms(family: Family, wanted: Sequence[str] | None) -> dict[str, Marched]:
    """The forms of a family's equations that are wanted, each once, in their order.

    Raises:
        ValueError: one is unknown.
    """
    known = dict(family.comparison.forms)
    names = list(known) if wanted is None else some(wanted, "form")
    for name in names:
        if name not in known:
            raise ValueError(unknown("form", str(name), known))
    return {name: marching for name, marching in known.items() if name in names}


def _ends(forms: dict[str, Marched]) -> list[End]:
    return [marching.end for marching in forms.values()]


def inputs_shown(family: Family, inputs: dict[str, Any], problems: Sequence[Problem]) -> dict[str, Any]:
    """The inputs as the header gives them: those that were given, and the defaults of those that need one."""
    comparison, wanted = family.comparison, family.input(family.comparison.varied)
    if wanted.kind == "text":
        varied = [next(iter(problem.inputs.values()))[0] for problem in problems]
    else:
        varied = [_shown(wanted, value) for value in inputs.get(comparison.varied, comparison.values)]
    found: dict[str, Any] = {comparison.varied: varied}
    for name in comparison.inputs:
        other = family.input(name)
        value = inputs.get(name, _default(other))
        if value is not None:
            found[name] = _shown(other, value)
    return found


def units_of(family: Family) -> dict[str, str]:
    """The units of the inputs; "" for pure numbers."""
    return {wanted.name: wanted.units.removeprefix("1") for wanted in family.inputs}


def _shown(wanted: Input, value: Any) -> Any:
    """A value of an input as the number, the pair of numbers or the text that it is."""
    if wanted.kind == "text":
        return value
    if wanted.kind == "pair":
        return tuple(as_number(exact(part, wanted.name)) for part in value)
    return as_number(exact(value, wanted.name))


def _definition(problems: Sequence[Problem]) -> str:
    """The equation in a line, or one for each form."""
    forms = dict.fromkeys(problem.form for problem in problems)
    return "; ".join(f"{form.name}: {form.equation}" for form in forms if form) or problems[0].equation


def _notes(scored: Scored) -> dict[str, Any]:
    """What was not marched, how the user's own was, what is lacking to be scored, and why."""
    where: dict[tuple[str, ...], list[str]] = {}
    for label, names in scored.left_out.items():
        if names:
            where.setdefault(names, []).append(label)
    notes = [f"{', '.join(names)} ({'; '.join(labels)})" for names, labels in where.items()]
    lacking = {case.label: {score: why for score, why in case.lacks if score in scored.scores} for case in scored.cases}
    found: dict[str, Any] = {}
    if notes:
        found["left out"] = "what splits kicks from drifts, or keeps an energy: " + "; ".join(notes)
    if any(scored.own.values()):
        found["own methods"] = scored.own
    if any(lacking.values()):
        found["lacking"] = {label: scores for label, scores in lacking.items() if scores}
    return found


def _traces(scored: Scored) -> tuple[tuple[Trace, ...], tuple[Trace, ...]]:
    """Every method's trajectory on every problem, and the exact one at the same times."""
    pairs = zip(scored.problems, scored.t_ends, strict=True)
    asked = {cell.n for cell in scored.cells}
    if not asked:
        return (), ()
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
