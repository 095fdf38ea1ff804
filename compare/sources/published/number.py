"""Numbers that can be asked for their decimal of so many places, correctly rounded."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Protocol

from compare.show.digits import decided, is_rounding, starred
from reference.arithmetic.limbs import fixed, to_fixed, ziv

if TYPE_CHECKING:
    from collections.abc import Callable

    from flint import arb

__all__ = ["Enclosed", "Exact", "Number", "Rounded", "Scientific", "double"]

SPARE_BITS = 64


class Number(Protocol):
    """A number by its decimals; ``reference.Certified`` is one."""

    def fixed(self, places: int) -> str:
        """The decimal of so many places, correctly rounded."""


@dataclass(frozen=True)
class Exact:
    """A rational number."""

    value: Fraction

    def fixed(self, places: int) -> str:
        """The decimal of so many places, correctly rounded."""
        return fixed(self.value, places)


def double(value: float) -> Exact:
    """A double at its exact value."""
    return Exact(Fraction(value))


@dataclass(frozen=True)
class Scientific:
    """A double that may be far below 1, such as an error."""

    value: float

    def fixed(self, places: int) -> str:
        """A digit, so many places, and a power of ten."""
        return f"{self.value:.{places}e}"


@dataclass(frozen=True)
class Rounded:
    """A number that a march in a format gave, with a bound on what rounding made of it.

    Attributes:
        value: the number.
        rounding: the bound; infinite where nothing of the number is decided.
        scientific: whether it may be far below 1, such as an error; if not, such as an order, it has decimal places.
    """

    value: float
    rounding: float
    scientific: bool = False

    def fixed(self, places: int) -> str:
        """All its digits, whether decided or not: for programs."""
        return (Scientific(self.value) if self.scientific else double(self.value)).fixed(places)

    @property
    def shown(self) -> str:
        """For readers: no digit that rounding may have made, and * where it may have made half of the number."""
        if self.scientific:
            return starred(self.value, self.rounding)
        if is_rounding(self.value, self.rounding):
            return "*"
        return decided(self.value, self.rounding, (".2f", ".1f", ".0f"))


@dataclass(frozen=True)
class Enclosed:
    """A real number known by balls around it, at the precision in force."""

    ball: Callable[[], arb]
    what: str

    def fixed(self, places: int) -> str:
        """The decimal of so many places, proven correctly rounded.

        Raises:
            WorkBoundError: it cannot be decided within the bound on the working precision.
        """
        of_ball, _ = to_fixed(places)
        bits = math.ceil(places * math.log2(10)) + SPARE_BITS
        ((found,),) = ziv(lambda _: [[self.ball()]], of_ball, 1, bits, self.what)
        return found
