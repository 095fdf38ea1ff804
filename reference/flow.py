"""An equation of the user's own, as formulas or a Python function: any that is smooth is proven by its flow.

    Flow(
        {"x": "v", "v": "mu*(1 - x**2)*v - x"},
        {"x": "2", "v": "0"},
        numbers={"mu": "5"},
    ).certified("state", 10).digits(30)

or the same in a file, which every command takes for a family:

    name = "oscillator"
    t_end = "20"

    [equation]
    x = "v"
    v = "mu*(1 - x**2)*v - x"

    [start]
    x = "2"
    v = "0"

    [numbers]
    mu = "5"

Formulas are those of ``Expression``: nothing of a file is ever run.
"""

from __future__ import annotations

import copyreg
import inspect
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import TYPE_CHECKING, Any, ClassVar

from reference.arithmetic.exact import exact
from reference.arithmetic.formula import FUNCTIONS, Expression
from reference.declaration import Invariant, StateSpace
from reference.flow_families import flow_family
from reference.flow_problem import FlowProblem, start_formulas
from reference.names import each_once, short, unknown

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction
    from pathlib import Path

    from reference.family import Family

__all__ = ["TIME_NAME", "Flow", "flow_from"]

TIME_NAME = "t"
"""What formulas call the time."""
T_END = "10"
Formulas = tuple[tuple[str, str], ...]
Derivative = Callable[..., Any]


@dataclass(frozen=True)
class Told:
    """What is said of an equation, in texts; ``Flow`` describes it."""

    name: str
    equation: Formulas | Derivative
    start: Formulas
    numbers: Formulas
    where: Formulas
    invariants: Formulas
    event: str
    t_end: str
    rates: tuple[str, ...]
    angles: tuple[str, ...]
    odd: tuple[str, ...] | None
    autonomous: bool
    source: str
    about: str = field(compare=False)


def Flow(  # noqa: N802 - a problem, as its class would be
    equation: Mapping[str, str] | Derivative,
    start: Mapping[str, Any],
    *,
    numbers: Mapping[str, Any] | None = None,
    where: Mapping[str, str] | None = None,
    invariants: Mapping[str, str] | None = None,
    event: str = "",
    name: str = "flow",
    t_end: Any = T_END,
    rates: Sequence[str] = (),
    angles: Sequence[str] = (),
    odd: Sequence[str] | None = None,
    autonomous: bool = True,
    source: str = "",
    about: str = "",
) -> FlowProblem:
    """A problem of y' = f(t, y), whose state is proven by its flow.

    Args:
        equation: a formula for the derivative of each component, of components, numbers, names of ``where`` and the
            time t; or a function derivative(m, t, y, p) as a problem has it, m being the arithmetic.
        start: of each component, in the order of the state: a number, or a formula of the numbers.
        numbers: the parameters by name, each a number.
        where: formulas that others make use of by their names; each may use those before it.
        invariants: formulas of what every exact motion conserves, by name; an energy stands first.
        event: a formula whose zeros are the crossings, "" where there is none.
        name: what it is called, in letters, digits, - and _.
        t_end: where a march ends if nothing else is asked.
        rates: the components that are velocities of the first ones, in their order; () where none are.
        angles: the components that are angles in rad.
        odd: the components whose sign changes with that of time; None where turning back means nothing.
        autonomous: of a function, whether it is without the time; formulas tell it themselves.
        source: where it is published.
        about: what it is, in a few words.

    Raises:
        ValueError: a formula is none, or a name is unknown, twice, or missing.
        TypeError: something is of another kind.
    """
    texts = _texts("equation", equation) if isinstance(equation, Mapping) else equation
    if not callable(texts) and not isinstance(texts, tuple):
        raise TypeError(f"equation is {short(repr(equation))}; formulas by name, or a function, are accepted.")
    told = Told(
        name=_text("name", name),
        equation=texts,
        start=_texts("start", start),
        numbers=_texts("numbers", numbers or {}),
        where=_texts("where", where or {}),
        invariants=_texts("invariants", invariants or {}),
        event=_text("event", event),
        t_end=_text("t_end", t_end),
        rates=tuple(rates),
        angles=tuple(angles),
        odd=None if odd is None else tuple(odd),
        autonomous=bool(autonomous),
        source=_text("source", source),
        about=_text("about", about),
    )
    return _kind(told)()


def _text(name: str, value: Any) -> str:
    """A text, or the exact value of a number.

    Raises:
        TypeError, ValueError: it is neither.
    """
    if isinstance(value, str):
        return value
    return str(exact(value, name))


def _texts(name: str, values: Any) -> Formulas:
    if not isinstance(values, Mapping) or not all(isinstance(key, str) for key in values):
        raise TypeError(f"{name} is {short(repr(values))}; texts or numbers by name are accepted.")
    return tuple((key, _text(f"{name} of {key}", value)) for key, value in values.items())


class _Kind(type):
    """The class of what is told of an equation, by which another process makes it again."""


def _reduced(kind: Any) -> tuple[Any, ...]:
    return _kind, (kind.told,)


copyreg.pickle(_Kind, _reduced)


class _Own(FlowProblem, metaclass=_Kind):
    """What all equations of the user's share; each is a class of its own, made of what is told of it."""

    told: ClassVar[Told]
    formulas: ClassVar[Mapping[str, Expression]]

    def __reduce__(self) -> tuple[Any, ...]:
        return _again, (self.told, self.given)

    def derivative(self, m: Any, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        if callable(self.told.equation):
            return tuple(self.told.equation(m, t, y, p))
        values = self._values(m, y, p, t)
        return tuple(self.formulas[f"equation of {name}"](m, values) for name in self.space.components)

    def _values(self, m: Any, y: Sequence[Any], p: Mapping[str, Any], t: Any = None) -> dict[str, Any]:
        """Everything that formulas name."""
        values = {**p, **dict(zip(self.space.components, y, strict=True)), TIME_NAME: t}
        for name, _ in self.told.where:
            values[name] = self.formulas[f"where of {name}"](m, values)
        return values


def _method(place: int) -> str:
    """The method that gives an invariant: the first is that of any problem."""
    return f"invariant_{place}" if place else "invariant"


def _conserved(what: str) -> Callable[..., Any]:
    """The method of an invariant, or of the event."""

    def value(self: Any, m: Any, y: Sequence[Any], p: Mapping[str, Any] | None = None) -> Any:
        return self.formulas[what](m, self._values(m, y, self.parameters_in(m) if p is None else p))

    return value


def _again(told: Told, given: tuple[tuple[str, Fraction], ...]) -> FlowProblem:
    """A problem that was sent to another process."""
    return _kind(told)(**dict(given))


@lru_cache(maxsize=256)
def _kind(told: Told) -> type[FlowProblem]:
    """The class of an equation's problems.

    Raises:
        ValueError: what is told contradicts itself.
    """
    components = tuple(name for name, _ in told.start)
    _hold(told, components)
    formulas, timed = _formulas(told, components)
    members: dict[str, Any] = {
        "told": told,
        "formulas": formulas,
        "name": told.name,
        "space": StateSpace(
            positions=tuple(name for name in components if name not in told.rates),
            velocities=told.rates,
            angles=told.angles,
            odd=told.odd,
            along=None,
            scale="largest",
            independent="",
            order=components,
        ),
        "numbers": dict(told.numbers),
        "begins": tuple(text for _, text in told.start),
        "equation": _in_a_line(told),
        "invariants": tuple(
            Invariant(name, (name[:1].upper() + name[1:], f"({name} - start)/start"), "start", _method(i))
            for i, (name, _) in enumerate(told.invariants)
        ),
        "t_end": told.t_end,
        "source": told.source or "its user",
        "difficulty": "of its user's choice",
        "autonomous": told.autonomous if callable(told.equation) else not timed,
        "__module__": __name__,
        "__doc__": told.about,
    }
    members |= {_method(i): _conserved(f"invariant {name}") for i, (name, _) in enumerate(told.invariants)}
    if told.event:
        members |= {"event": _conserved("event"), "event_words": f"zeros of {told.event}"}
    if callable(told.equation):
        members["program"] = told.equation
    kind: Any = _Kind(told.name, (_Own,), members)
    for name, text in told.numbers:
        exact(text, name)
    start_formulas(kind)
    made: type[FlowProblem] = kind
    return made


def _hold(told: Told, components: tuple[str, ...]) -> None:
    """Refuse names that are missing, unknown or twice.

    Raises:
        ValueError: one is.
    """
    if not components:
        raise ValueError(f"the start of {told.name} is empty; a number for each component is accepted.")
    if not all(one.isidentifier() and one.isascii() for one in told.name.split("-")):
        raise ValueError(f"name is '{short(told.name)}'; letters, digits, - and _ are accepted.")
    names = [*components, *(name for name, _ in (*told.numbers, *told.where))]
    for name in names:
        if not (name.isidentifier() and name.isascii()) or name in {TIME_NAME, "pi", *FUNCTIONS}:
            raise ValueError(f"'{short(name)}' names no component or number; one such as x or omega_0 is accepted.")
    each_once(f"the equation {told.name}", names)
    given = components if callable(told.equation) else tuple(name for name, _ in told.equation)
    for kind, several in (("equation", given), ("rates", told.rates)):
        for name in several:
            if name not in components:
                raise ValueError(unknown(f"the {kind} of {told.name}: the component", name, components))
    for name in components:
        if name not in given:
            raise ValueError(f"the equation of {told.name} has none for {name}; a formula for each is accepted.")


def _formulas(told: Told, components: tuple[str, ...]) -> tuple[dict[str, Expression], bool]:
    """Every formula by what it is, and whether the equation depends on the time.

    Raises:
        ValueError: one is no formula of what there is, or depends on the time where nothing may.
    """
    names = [*components, *(name for name, _ in told.numbers), TIME_NAME]
    timed, found = {TIME_NAME}, dict[str, Expression]()

    def read(what: str, text: str) -> bool:
        found[what] = Expression.parse(text, tuple(names), what)
        return not timed.isdisjoint(found[what].names)

    for name, text in told.where:
        if read(f"where of {name}", text):
            timed.add(name)
        names.append(name)
    equation = () if callable(told.equation) else told.equation
    depends = [read(f"equation of {name}", text) for name, text in equation]
    still = [(f"invariant {name}", text) for name, text in told.invariants]
    for what, text in (*still, *((("event", told.event),) if told.event else ())):
        if read(what, text):
            raise ValueError(f"the {what} '{short(text)}' depends on the time; one of the state alone is accepted.")
    return found, any(depends)


def _in_a_line(told: Told) -> str:
    """The equation with its start."""
    begins = ", ".join(f"{name}(0) = {text}" for name, text in told.start)
    if callable(told.equation):
        return f"y' = {getattr(told.equation, '__name__', 'f')}(t, y), {begins}"
    where = "; ".join(f"{name} = {text}" for name, text in told.where)
    rates = ", ".join(f"{name}' = {text}" for name, text in told.equation)
    return f"{rates}{' with ' * bool(where)}{where}, {begins}"


KEYS = tuple(one for one in inspect.signature(Flow).parameters if one != "autonomous")


@lru_cache(maxsize=64)
def flow_from(path: Path) -> Family:
    """The family of an equation that a file tells.

    Raises:
        FileNotFoundError: there is no such file.
        ValueError: it is no TOML, has an unknown key or lacks one, or what it tells contradicts itself.
        TypeError: a value is of another kind.
    """
    if not path.is_file():
        raise FileNotFoundError(f"there is no file '{path}'.")
    try:
        told = tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ValueError(f"'{path}' is no TOML file: {' '.join(str(error).split())}.") from None
    for name in told:
        if name not in KEYS:
            raise ValueError(unknown(f"'{path}': the key", name, KEYS))
    for name in ("equation", "start"):
        if name not in told:
            raise ValueError(f"'{path}' has no {name}; a table [{name}] with a text for each component is accepted.")
    return flow_family(type(Flow(**{"name": path.stem, **told})), str(told.get("about", path.stem)))
