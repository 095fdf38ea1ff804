"""The family of a problem that is proven by its flow: what is asked, compared, reported and stored of it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from reference.arithmetic.binary64 import nearest
from reference.arithmetic.exact import as_number, exact
from reference.family import Comparison, End, Family, Input, Marched, Reported
from reference.flow_problem import CONDITION, CONSERVED, CROSSINGS, END, has_event, is_rational
from reference.layout import Coordinate, Group, Layout

if TYPE_CHECKING:
    from collections.abc import Mapping
    from fractions import Fraction

    from reference.flow_problem import FlowProblem

__all__ = ["Given", "flow_family"]

TIMES, FULL_TIMES = 400, 20_000
"""Times of a trajectory in the two profiles, in even parts of the time until which it is proven."""
TIME = Coordinate("time", "1", "time since the start", "k parts of the whole time, each rounded once to binary64")
CROSSING = Coordinate("event", "1", "number of the event", "0, 1, 2, ...", whole=True)
MULTIPLE = Coordinate("multiple", "1", "multiple of the end of the march", "1, 2, ...", whole=True)


@dataclass(frozen=True)
class Given:
    """A problem of a class from its declared start but for some inputs: a group of a dataset."""

    kind: Any
    given: tuple[tuple[str, str], ...] = ()

    def __call__(self) -> FlowProblem:
        problem: FlowProblem = self.kind(**dict(self.given))
        return problem

    @property
    def program(self) -> Any:
        """What it is made by: a class, or of an equation of the user's his function."""
        return getattr(self.kind, "program", self.kind)

    @property
    def path(self) -> str:
        """Of its group."""
        besides = "".join(f"_{name}_{_in_a_name(text)}" for name, text in self.given)
        return f"/flow/{self.kind.name.replace('-', '_')}{besides}"

    @property
    def inputs(self) -> str:
        """The exact numbers and starts, as texts."""
        kind, given = self.kind, dict(self.given)
        texts = {**kind.numbers, **dict(zip(kind.space.components, kind.begins, strict=True)), **given}
        return "; ".join(f"{name} = {text}" for name, text in texts.items())


def _in_a_name(text: str) -> str:
    """A number as it may stand in the name of a group."""
    return "".join(letter if letter.isalnum() else "_" for letter in text)


def flow_family(kind: Any, words: str, *, varied: str = "") -> Family:
    """The family of a problem that is proven by its flow.

    Args:
        kind: the problem.
        words: what it is, in a few words.
        varied: the input that a study varies; of itself the first one that is rational.
    """
    declared: FlowProblem = kind()
    first = varied or next(name for name in kind.input_names() if is_rational(declared, name))
    start = dict(zip(kind.space.components, kind.begins, strict=True))
    inputs = tuple(
        Input(
            name,
            kind.units.get(name, "1"),
            f"{kind.meanings.get(name, name)} (default {kind.numbers.get(name) or start[name]})",
            optional=True,
        )
        for name in kind.input_names()
    )
    value = _default(declared, first)
    event = has_event(kind)
    crossing = Input("index", "", f"which of the {kind.event_words}, from 0 on", optional=True, over="index")
    end = float(exact(kind.t_end))
    marched = Marched(End("t_end", f"end of the march (default {end:g})", end))
    groups = tuple(Given(kind, tuple(one.items())) for one in ({}, *kind.variants))
    return Family(
        name=kind.name,
        help=words,
        problem=kind,
        inputs=(*inputs, Input("t", "1", "time", optional=event, over="time"), *((crossing,) if event else ())),
        rows=("state", *((CROSSINGS,) if event else ())),
        comparison=Comparison(
            kind.name,
            f"score integrators on {words}",
            first,
            (value,),
            kind.meanings.get(first, first),
            tuple(name for name in kind.input_names() if name != first),
            forms=(("", marched),),
        ),
        reported=(Reported(kind.name, first, "", "", (value,), _With(kind, first), marched.end),),
        layouts=tuple(_layout(given, words) for given in groups),
        core=_Groups(groups, words, TIMES),
        full=_Groups(groups, words, FULL_TIMES),
    )


def _default(problem: FlowProblem, name: str) -> Any:
    """The declared number: a double where it is one, else exact."""
    values: Mapping[str, Fraction] = {
        **dict(zip(problem.space.components, problem.start, strict=True)),
        **problem.parameters,
    }
    told = as_number(values[name])
    return told if isinstance(told, float) else values[name]


@dataclass(frozen=True)
class _With:
    """A problem with another value of one input."""

    kind: Any
    name: str

    def __call__(self, value: Any) -> FlowProblem:
        problem: FlowProblem = self.kind(**{self.name: value})
        return problem


@dataclass(frozen=True)
class _Groups:
    """The groups of a profile, with so many times each."""

    given: tuple[Given, ...]
    words: str
    times: int

    def __call__(self) -> tuple[Group, ...]:
        return tuple(self._group(one) for one in self.given)

    def _group(self, given: Given) -> Group:
        kind = given.kind
        until = exact(kind.until or kind.t_end)
        numbers: dict[str, Any] = {"time": [float(nearest(until * k / self.times)) for k in range(self.times + 1)]}
        numbers["multiple"] = list(range(1, max(1, int(until / exact(kind.t_end))) + 1))
        if kind.invariants:
            numbers["invariant"] = list(range(len(kind.invariants)))
        if kind.crossings and has_event(kind):
            numbers["event"] = list(range(kind.crossings))
        return Group(_layout(given, self.words), {}, numbers)


def _layout(given: Given, words: str) -> Layout:
    """How a group of a flow looks."""
    kind, problem = given.kind, given()
    over = {"time": replace(TIME, units=kind.space.independent or "1"), "multiple": MULTIPLE}
    if kind.invariants:
        names = tuple(one.name.replace(" ", "_") for one in kind.invariants)
        over["invariant"] = Coordinate("invariant", "1", "what is conserved", "labels", meanings=names)
    if kind.crossings and has_event(kind):
        over["index"] = CROSSING
    stored = [
        row for row in problem.rows if row.name in {"state", CONDITION, END, CONSERVED, CROSSINGS} and row.over in over
    ]
    return Layout(
        path=given.path,
        long_name=words,
        instances=(),
        over=over,
        parameters=(),
        rows=tuple(stored),
        problem=given,
        reference=kind.source,
        statement=f"{kind.equation}",
        difficulty=kind.difficulty,
        inputs=given.inputs,
    )
