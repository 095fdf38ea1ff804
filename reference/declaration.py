"""What a problem declares of its values, and what the routes ask of it.

A problem's *rows* are the things that are computed together: one number for the whole motion (a period), one per
index (the zero crossings) or a tuple per time, angle or fraction of the way (the state).  Each route is a *solution*,
an object that answers every row it serves; the closed form in balls, in mpmath, and heyoka's Taylor method differ in
nothing else.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Protocol

from reference.arithmetic.limbs import MAX_BITS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.constants import Constant
    from reference.row_domains import Domain

__all__ = ["ClosedForm", "Declared", "Equation", "Quantity", "Row", "Solution"]


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
    """What the Taylor method integrates: y' = derivative(m, y, p) from its start."""

    @property
    def state_names(self) -> tuple[str, ...]: ...
    @property
    def parameters(self) -> dict[str, Fraction]: ...
    @property
    def start(self) -> tuple[Fraction, ...]: ...
    def derivative(self, m: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]: ...


class Declared(Protocol):
    """What is asked of a problem to prove its rows and to hold the routes against each other."""

    @property
    def max_bits(self) -> int: ...
    @property
    def constants(self) -> tuple[Constant, ...]: ...
    def row(self, name: str) -> Row: ...
    def arguments(self, row: str, arguments: Sequence[Any]) -> list[Any]: ...
    def exact_row(self, row: str, argument: Any) -> tuple[Fraction | None, ...] | None: ...
    def working_bits(self, arguments: Sequence[Any]) -> int: ...
    def closed_form(self, m: Any) -> Solution: ...
    def chart(self, row: str, count: int, bits: int) -> Solution | None: ...
    def by_route(
        self, route: str, row: str, arguments: Sequence[Any], digits: int
    ) -> list[tuple[Fraction, ...]] | None: ...
