"""What forms are held against: proven numbers of the reference, at a precision of DIGITS.

An erratum: what is printed, what is right, and one test that the right form passes and every other form fails.
"""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from functools import wraps
from typing import TYPE_CHECKING, Any

from reference.arithmetic.namespaces import MPMATH
from reference.arithmetic.precision import mp

if TYPE_CHECKING:
    from collections.abc import Callable

    from reference.problem import Problem

__all__ = [
    "GRAVITY",
    "REPORT",
    "THESIS",
    "Erratum",
    "along",
    "exactly",
    "near",
    "precisely",
    "proven",
    "rates",
    "rounds_to",
]

REPORT, THESIS = "report", "thesis"
"""The sources, by their keys in the data file of what they print."""


@dataclass(frozen=True)
class Erratum:
    """One slip of a source.

    Attributes:
        source: REPORT or THESIS.
        place: the number of the equation, table, figure or section.
        printed: what stands there.
        right: what is right.
        how: how it was checked, in a sentence.
        touches: which published numbers it changes, in a sentence.
        forms: the printed form and the right one, as ``holds`` takes them.
        slips: near misses of the right form, such as one coefficient off by one, which show how much the test can see.
        holds: the test of a form, by a route that uses none of them.
    """

    source: str
    place: str
    printed: str
    right: str
    how: str
    touches: str
    forms: tuple[Any, Any]
    slips: tuple[Any, ...]
    holds: Callable[[Any], bool]

    def confirmed(self) -> bool:
        """Whether the right form passes the test, and the printed one and every near miss fail it."""
        printed, right = self.forms
        return self.holds(right) and not any(map(self.holds, (printed, *self.slips)))


GRAVITY = Fraction("9.81")
DIGITS = 50
LIMBS = 3
INTERVAL = Fraction(1, 2**40)
"""Between proven states whose difference is a derivative; its error is of the order of the square, 1e-24."""


def precisely(check: Callable[..., bool]) -> Callable[..., bool]:
    """The check, done at DIGITS."""

    @wraps(check)
    def done(form: Any) -> bool:
        with mp.workdps(DIGITS):
            return check(form)

    return done


def proven(problem: Problem, row: str, argument: Any = None) -> tuple[Any, ...]:
    """A row of a problem: the sums of proven limbs."""
    values = problem.values(row, [argument], LIMBS)[0]
    return tuple(MPMATH.number(sum(map(Fraction, limbs), Fraction(0))) for limbs in values.tolist())


def along(problem: Problem, t: str) -> tuple[Any, ...]:
    """The proven state at the time ``t`` as written."""
    return proven(problem, "state", Fraction(t))


def rates(problem: Problem, t: str) -> tuple[Any, ...]:
    """The derivatives of the state at ``t``, from proven states on both sides, to about 20 digits."""
    before, after = (proven(problem, "state", Fraction(t) + side * INTERVAL) for side in (-1, 1))
    return tuple((b - a) / MPMATH.number(2 * INTERVAL) for a, b in zip(before, after, strict=True))


def exactly(text: str) -> Any:
    """The number that a decimal or a quotient spells."""
    return MPMATH.number(Fraction(text))


def near(a: Any, b: Any, tolerance: float = 1e-20) -> bool:
    """Whether two numbers differ by less than the tolerance times 1 + abs(b)."""
    return bool(abs(a - b) < tolerance * (1 + abs(b)))


def rounds_to(value: Any, text: str) -> bool:
    """Whether a number rounds to this decimal, by at most half a unit of its last digit."""
    exponent = int(Decimal(text).as_tuple().exponent)
    return bool(abs(value - exactly(text)) <= mp.mpf(10) ** exponent / 2)
