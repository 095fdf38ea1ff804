"""What a problem declares of its values, and what the routes ask of it.

A problem's *rows* are the things that are computed together: one number for the whole motion (a period), one per
index (the zero crossings) or a tuple per time, angle or fraction of the way (the state).  Each route is a *solution*,
an object that answers every row it serves; the closed form in balls, in mpmath, and heyoka's Taylor method differ in
nothing else.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Literal, Protocol

from reference.arithmetic.limbs import MAX_BITS

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from reference.constants import Constant
    from reference.row_domains import Domain

__all__ = [
    "ENERGY_ABOVE_REST",
    "ClosedForm",
    "Declared",
    "Equation",
    "Form",
    "Invariant",
    "Quantity",
    "Row",
    "Solution",
    "StateSpace",
    "Trial",
    "WorkingBits",
]


@dataclass(frozen=True)
class Quantity:
    """A named number with its units and its defining equation in one line."""

    name: str
    units: str
    long_name: str
    definition: str


@dataclass(frozen=True)
class Row:
    """Quantities that are computed together, and what they are a function of.

    ``domain`` says which arguments the row takes; ``lacks`` pairs each route that cannot give the row with the reason;
    ``max_bits`` is the working precision at which a proof is given up, lower where the row takes an integral.
    """

    name: str
    quantities: tuple[Quantity, ...]
    domain: Domain
    lacks: tuple[tuple[str, str], ...] = ()
    max_bits: int = MAX_BITS

    @property
    def over(self) -> str:
        """What the row is a function of: "once", "index" or the name of an exact real, such as "time"."""
        return self.domain.over


Interval = tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class StateSpace:
    """How a state is read: what each of its components is, and in what its error is measured.

    Attributes:
        positions: the components whose error is the position error, in the order of the state.
        velocities: the rates of the first positions, in their order; () where there are none, or ``momenta`` are.
        momenta: the momenta conjugate to the positions, in their order; () where there are none.
        angles: the positions that are angles in rad, counted on from turn to turn.
        odd: the components whose sign changes with that of time (the reversor); None where turning back means nothing.
        along: the component that the others are a function of, the last of the state; None where that is the time,
            which stands outside of the state.
        scale: what the error of a component is measured in: "units", its own, or "largest", its largest value.
        independent: the units of what the state is a function of; "" for a pure number.
        axes: what the axes of a phase portrait are called; () where the quantities of the state say it.
        order: the components in the order of the state, where that is not positions, rates, along.

    Raises:
        ValueError: the declaration contradicts itself.
    """

    positions: tuple[str, ...]
    velocities: tuple[str, ...] = ()
    momenta: tuple[str, ...] = ()
    angles: tuple[str, ...]
    odd: tuple[str, ...] | None
    along: str | None
    scale: Literal["units", "largest"]
    independent: str
    axes: tuple[str, ...] = ()
    order: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        self._hold_kinds()
        declared = (*self.positions, *self.rates, *(() if self.along is None else (self.along,)))
        if not self.positions:
            raise ValueError("positions is empty; a state has at least one.")
        if self.velocities and self.momenta:
            raise ValueError("velocities and momenta are both given; one of them is accepted.")
        if len(self.rates) > len(self.positions):
            raise ValueError("there are more velocities or momenta than positions; one for each is accepted.")
        if len(set(declared)) < len(declared) or (self.order and sorted(self.order) != sorted(declared)):
            raise ValueError(f"the components {', '.join(self.order or declared)} are not each declared once.")
        for name in (*self.angles, *(self.odd or ())):
            if name not in declared:
                raise ValueError(f"{name} is no component of the state; {', '.join(declared)} are.")
        for name in self.angles:
            if name not in self.positions:
                raise ValueError(f"the angle {name} is no position; {', '.join(self.positions)} are.")

    def _hold_kinds(self) -> None:
        """Refuse what is of another kind than it is declared to be.

        Raises:
            TypeError, ValueError: something is.
        """
        for name in ("positions", "velocities", "momenta", "angles", "order", *(() if self.odd is None else ("odd",))):
            value = getattr(self, name)
            if not isinstance(value, tuple) or not all(isinstance(one, str) for one in value):
                raise TypeError(f"{name} is {value!r}; a tuple of names is accepted.")
            if len(set(value)) < len(value):
                raise ValueError(f"{name} is {value!r}; each name is accepted once.")
        if self.scale not in {"units", "largest"}:
            raise ValueError(f"scale is {self.scale!r}; 'units' or 'largest' is accepted.")
        if not isinstance(self.independent, str):
            raise TypeError(f"independent is {self.independent!r}; units such as 's', or '', are accepted.")

    @property
    def components(self) -> tuple[str, ...]:
        """The names of the state's components, in its order."""
        along = () if self.along is None else (self.along,)
        return self.order or (*self.positions, *self.rates, *along)

    @property
    def rates(self) -> tuple[str, ...]:
        """The velocities or the momenta."""
        return self.velocities or self.momenta

    def places(self, names: Sequence[str]) -> list[int]:
        """Where components stand in the state."""
        return [self.components.index(name) for name in names]

    @property
    def pairs(self) -> list[tuple[int, int]]:
        """Where each position that has a rate stands, and where its rate does."""
        return list(zip(self.places(self.positions), self.places(self.rates), strict=False))


@dataclass(frozen=True)
class Form:
    """One of the forms of a family's equations.

    Attributes:
        name: as the command line spells it.
        words: the same in a table.
        equation: the equation in one line, with its start.
    """

    name: str
    words: str
    equation: str


@dataclass(frozen=True)
class Invariant:
    """A quantity that every exact motion conserves.

    Attributes:
        name: what it is called, such as "energy".
        drift: its title in a table and its relative change in symbols, such as ("Energy", "(E - E0)/(E0 - Emin)").
        scale: what its change is divided by: "start", its absolute value there, or "kinetic", the kinetic energy of
            the start, which ``Problem.kinetic`` gives.
        value: the method of the problem that gives it in any arithmetic, called with (m, y, p).
    """

    name: str
    drift: tuple[str, str]
    scale: Literal["start", "kinetic"]
    value: str = "invariant"

    def __post_init__(self) -> None:
        if self.scale not in {"start", "kinetic"}:
            raise ValueError(f"scale of {self.name} is {self.scale!r}; 'start' or 'kinetic' is accepted.")
        if not isinstance(self.drift, tuple) or len(self.drift) != 2:
            raise TypeError(f"drift of {self.name} is {self.drift!r}; a title and a formula are accepted.")


@dataclass(frozen=True, kw_only=True)
class Trial:
    """Where a compiled step is tried: intervals of states, parameters and step sizes in which the equation is real.

    A block takes many steps from there, and must stay where it is.
    """

    states: tuple[Interval, ...]
    parameters: Mapping[str, Interval]
    step: Interval


ENERGY_ABOVE_REST = Invariant("energy", ("Energy", "(E - E0)/(E0 - Emin)"), "start")
"""An energy that is counted from that of rest, so that its own start is the scale of its drift."""


class Solution(Protocol):
    """One route to the truth about one problem."""

    def rows(self, row: str, arguments: Sequence[Any]) -> list[tuple[Any, ...]]:
        """The values of a row at each of its arguments: exact times, indices, or one None."""


class ClosedForm:
    """A solution that writes each row as an attribute or method of its name, in the arithmetic ``m``."""

    m: Any

    def rows(self, row: str, arguments: Sequence[Any]) -> list[tuple[Any, ...]]:
        if list(arguments) == [None]:
            return [(getattr(self, row),)]
        values = (getattr(self, row)(self.m.number(a) if isinstance(a, Fraction) else a) for a in arguments)
        return [value if isinstance(value, tuple) else (value,) for value in values]


class Equation(Protocol):
    """What the Taylor method integrates: y' = derivative(m, t, y, p) from its start."""

    @property
    def state_names(self) -> tuple[str, ...]: ...
    @property
    def parameters(self) -> Mapping[str, Fraction]: ...
    @property
    def start(self) -> tuple[Fraction, ...]: ...
    @property
    def structure(self) -> Any: ...
    def start_in(self, m: Any) -> list[Any]: ...
    def derivative(self, m: Any, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]: ...


class WorkingBits(Protocol):
    """How many working bits the rows of a problem take; only speed depends on it."""

    def bits(self, row: str, arguments: Sequence[Any], component: int | None = None) -> int:
        """Those that all quantities of a row, or one, are expected to lose, beyond what guards every decision."""
        ...

    def more(self, missing: int, bits: int) -> int:
        """What to take after so many, by which so many are missing to the guarded accuracy of a value."""
        ...

    def foresee(self, row: str, arguments: Sequence[Any], bits: int) -> None:
        """Learn what a proof of these loses, before it is made in so many bits."""
        ...

    def prepare(self, asked: Sequence[tuple[str, Sequence[Any]]], bits: int) -> None:
        """Make ready for many rows with their arguments, of which values are wanted to so many bits."""
        ...

    def of_route(self, row: str, arguments: Sequence[Any], bits: int) -> int:
        """Those of a route that proves nothing and is held to so many."""
        ...


class Declared(Protocol):
    """What is asked of a problem to prove its rows and to hold the routes against each other."""

    @property
    def max_bits(self) -> int: ...
    @property
    def has_closed_form(self) -> bool: ...
    @property
    def constants(self) -> tuple[Constant, ...]: ...
    def row(self, name: str) -> Row: ...
    def arguments(self, row: str, arguments: Sequence[Any]) -> list[Any]: ...
    def exact_row(self, row: str, argument: Any) -> tuple[Fraction | None, ...] | None: ...
    @property
    def working(self) -> WorkingBits: ...
    def enclosure_form(self) -> Solution: ...
    def chart(self, row: str, count: int, bits: int) -> Solution | None: ...
    def by_route(
        self, route: str, row: str, arguments: Sequence[Any], digits: int
    ) -> list[tuple[Fraction, ...]] | None: ...
