"""What the argument of a row may be: declared with the row, and decided before anything is computed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from reference.arithmetic.binary64 import hexadecimal
from reference.arithmetic.exact import as_number, exact, spelled
from reference.names import short

if TYPE_CHECKING:
    from fractions import Fraction

__all__ = ["ANGLE", "FRACTION", "INDEX", "ONCE", "TIME", "Domain", "Once", "Reals", "Whole"]


@dataclass(frozen=True)
class Domain:
    """What a row is a function of, and which arguments it takes.

    ``over`` is "once", "index" or the name of an exact real, such as "time"; ``name`` is what a sentence calls it.
    """

    over: str
    name: str

    def argument(self, value: Any, row: str) -> Any:
        """The exact argument of the row of this name: None, an int or a Fraction.

        Raises:
            ValueError: the row takes no such argument.
            TypeError: it is no real number.
        """
        del row
        number = exact(value, self.name)
        if not self.contains(number):
            told = number.numerator if self.whole and number.denominator == 1 else as_number(number)
            raise ValueError(f"{self.name} is {short(str(told))}; {self.accepted} is accepted.")
        return number.numerator if self.whole else number

    @property
    def whole(self) -> bool:
        """Whether the arguments are whole numbers."""
        return False

    def contains(self, number: Fraction) -> bool:
        """Whether the row takes this number."""
        raise NotImplementedError

    @property
    def accepted(self) -> str:
        """What is accepted, in words."""
        raise NotImplementedError


@dataclass(frozen=True)
class Once(Domain):
    """No argument: one value for the whole motion."""

    def argument(self, value: Any, row: str) -> None:
        """None.

        Raises:
            ValueError: there is an argument.
        """
        if value is not None:
            kind = type(value).__name__
            raise ValueError(f"{row} takes no argument, but one of type {kind} is given; None is accepted.")


@dataclass(frozen=True)
class Whole(Domain):
    """The whole numbers from 0 on, up to ``high`` where that is not None."""

    high: int | None = None

    @property
    def whole(self) -> bool:
        return True

    def contains(self, number: Fraction) -> bool:
        return number.denominator == 1 and number >= 0 and (self.high is None or number <= self.high)

    @property
    def accepted(self) -> str:
        return f"an integer from 0 {'on' if self.high is None else f'to {self.high}'}"


@dataclass(frozen=True)
class Reals(Domain):
    """The real numbers from ``low`` to ``high``, both included; None is no bound."""

    low: Fraction | None = None
    high: Fraction | None = None

    def contains(self, number: Fraction) -> bool:
        return (self.low is None or self.low <= number) and (self.high is None or number <= self.high)

    @property
    def accepted(self) -> str:
        below = "" if self.low is None else f"{_told(self.low)} <= "
        above = "" if self.high is None else f" <= {_told(self.high)}"
        return f"a number with {below}{self.name}{above}"


def _told(bound: Fraction) -> str:
    """A bound: of a double that is no short decimal, the shortest one and its exact value."""
    text, number = spelled(bound), as_number(bound)
    return f"{number} ({hexadecimal(number)})" if "/" in text and isinstance(number, float) else text


ONCE = Once("once", "the argument")
INDEX = Whole("index", "index")
TIME = Reals("time", "t")
ANGLE = Reals("angle", "angle")
FRACTION = Reals("fraction", "fraction", exact(0), exact(1))
