"""What a family of problems says of itself: its inputs, what is printed, stored and compared of it.

Every command reads families of this form and no other: ``reference at``, a study, solvers, a score, a report, the
dataset.  A family that stands in no table of ours is named by where it is: ``MODULE:NAME`` or ``FILE.py:NAME``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from reference.arithmetic.exact import as_number, exact
from reference.names import each_once, short, unknown

if TYPE_CHECKING:
    from collections.abc import Callable
    from fractions import Fraction

    from reference.layout import Group, Layout
    from reference.problem import Problem

LEAST_N = 128
"""The least of the numbers of steps where none is given."""

__all__ = ["LEAST_N", "Comparison", "End", "Family", "Input", "Marched", "Reported", "no_groups", "positive_end"]


@dataclass(frozen=True)
class Input:
    """Something that a command asks for, with its default as it would be typed.

    Attributes:
        name: its name, in Python and at the command line.
        units: its units; "" for what has none.
        help: what it is, in words.
        default: as it would be typed; None where it has to be given, or may be left out.
        optional: whether it is left to the problem where it is not given.
        kind: how it is spelt: a number, two numbers with a comma between them, or a name or formula.
        over: where it is the argument of rows: what those are a function of.
    """

    name: str
    units: str
    help: str
    default: str | None = None
    optional: bool = False
    kind: Literal["number", "pair", "text"] = "number"
    over: str = ""


def positive_end(problem: Problem, end: Any, name: str) -> Fraction:
    """The length of a march to a positive end.

    Raises:
        ValueError: it is not positive, or no finite number.
    """
    del problem
    value = exact(end, name)
    if value <= 0:
        raise ValueError(f"{name} is {as_number(value)}; a positive number is accepted.")
    return value


@dataclass(frozen=True)
class End:
    """Where the march of a problem ends.

    Attributes:
        name: of the option, such as "t_end".
        help: what it is, with its units and its default.
        default: the end where none is given; None where the problem itself says it.
        length: from (problem, end or None, name) to how far the march goes, an exact positive number.
        shown: from (problem, length) to the end as it is given.
    """

    name: str
    help: str
    default: float | None
    length: Callable[[Any, Any, str], Fraction] = positive_end
    shown: Callable[[Any, Fraction], Fraction] = lambda _problem, length: length

    @property
    def each(self) -> bool:
        """Whether every problem has an end of its own."""
        return self.default is None

    def of(self, problem: Problem, given: Any) -> Fraction:
        """How far the march of a problem goes.

        Raises:
            ValueError: the end that is given is outside its range.
        """
        return self.length(problem, self.default if given is None else given, self.name)


T_END = End("t_end", "end of the march in s (default 10)", 10.0)


@dataclass(frozen=True)
class Marched:
    """One form of a family's equations, as methods are marched on it.

    Attributes:
        end: where its march ends.
        problem: from the family's problem to the one that is marched.
    """

    end: End = T_END
    problem: Callable[[Any], Problem] = lambda problem: problem


@dataclass(frozen=True)
class Comparison:
    """How methods are compared on a family.

    Attributes:
        command: what ``python -m compare`` calls it.
        help: what is done, in words.
        varied: the input that may be given several times.
        values: its values where none is given.
        what: what one such value is called, such as "angle".
        inputs: the other inputs that are asked for.
        forms: the forms of the equations that are marched, by their names; one of the name "" where there is one.
        largest: the largest of the numbers of steps where none is given; they begin with 128.
    """

    command: str
    help: str
    varied: str
    values: tuple[Any, ...]
    what: str
    inputs: tuple[str, ...] = ()
    forms: tuple[tuple[str, Marched], ...] = (("", Marched()),)
    largest: int = 1 << 17


@dataclass(frozen=True)
class Reported:
    """The problems of a report that differ in one number, or in one name.

    Attributes:
        name: as the command line spells it.
        symbol: what the number or the name is.
        units: the number's; "" where it has none.
        error_units: the error's; "" where it has none, or errors of several units are compared.
        amplitudes: the numbers or names of a report that names none.
        problem: from one of them to the problem, its other parameters as they come.
        end: where its march ends.
    """

    name: str
    symbol: str
    units: str
    error_units: str
    amplitudes: tuple[float | str, ...]
    problem: Callable[[Any], Problem]
    end: End = T_END

    @property
    def named(self) -> bool:
        """Whether its problems differ in a name."""
        return isinstance(self.amplitudes[0], str)

    def label(self, amplitude: float | str) -> str:
        """One of its problems in words."""
        shown = amplitude if isinstance(amplitude, str) else repr(amplitude)
        return f"{self.name}, {self.symbol} = {shown} {self.units}".rstrip()


def no_groups() -> tuple[Group, ...]:
    """Nothing is stored."""
    return ()


@dataclass(frozen=True)
class Family:
    """A family of problems.

    Attributes:
        name: as the command line spells it.
        help: what it is, in words.
        problem: from the inputs to the problem.
        inputs: what is asked for; those with ``over`` are arguments of rows.
        rows: what is printed of it: a row that is asked once always, another one where its argument is given.
        comparison: how methods are compared on it.
        reported: what a report shows of it.
        layouts: the groups that a dataset can hold of it.
        core, full: the groups of the two profiles, with their numbers.

    Raises:
        ValueError: the declaration contradicts itself, or lacks something.
    """

    name: str
    help: str
    problem: Callable[..., Problem]
    inputs: tuple[Input, ...]
    rows: tuple[str, ...]
    comparison: Comparison
    reported: tuple[Reported, ...]
    layouts: tuple[Layout, ...] = ()
    core: Callable[[], tuple[Group, ...]] = no_groups
    full: Callable[[], tuple[Group, ...]] = no_groups

    def __post_init__(self) -> None:
        self._hold_comparison()
        names = [asked.name for asked in self.inputs]
        each_once(f"the family {short(self.name)}", names)
        for name in (self.comparison.varied, *self.comparison.inputs):
            if name not in names:
                raise ValueError(unknown(f"the input of the comparison of {short(self.name)},", name, names))
        for layout in self.layouts:
            if not (layout.statement and layout.difficulty):
                lacking = "difficulty" if layout.statement else "statement"
                raise ValueError(f"the group {layout.path} of {short(self.name)} does not declare its {lacking}.")

    def _hold_comparison(self) -> None:
        """Refuse what a command could make nothing of.

        Raises:
            TypeError, ValueError: something is of another kind, or empty.
        """
        if not callable(self.problem):
            raise TypeError(f"problem of {self.name} is {self.problem!r}; what makes a problem of inputs is accepted.")
        comparison = self.comparison
        for wanted in self.inputs:
            if wanted.over and wanted.name in {comparison.varied, *comparison.inputs}:
                raise ValueError(f"{wanted.name} of {self.name} is the argument of a row; an input is accepted.")
        for name, value in (
            ("values", comparison.values),
            ("forms", comparison.forms),
            ("inputs", self.inputs),
            ("rows", self.rows),
            *(("amplitudes", one.amplitudes) for one in self.reported),
        ):
            if not isinstance(value, tuple) or not value:
                raise TypeError(f"{name} of {self.name} is {value!r}; a tuple with something in it is accepted.")
        if comparison.largest < LEAST_N:
            raise ValueError(f"largest of {self.name} is {comparison.largest}; {LEAST_N} or more is accepted.")

    @property
    def has_closed_form(self) -> bool:
        """Whether its problems declare their solution; without, their flow is proven."""
        from reference.problem import Problem

        return getattr(self.problem, "closed_form", None) is not Problem.closed_form

    def input(self, name: str) -> Input:
        """The input of this name."""
        return next(wanted for wanted in self.inputs if wanted.name == name)
