"""What forms are held against: proven numbers of the reference, at a precision of DIGITS."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from functools import wraps
from typing import TYPE_CHECKING, Any

from reference.arithmetic.namespaces import MPMATH
from reference.arithmetic.precision import mp

if TYPE_CHECKING:
    from collections.abc import Callable

    from reference.problem import Problem

__all__ = ["GRAVITY", "along", "exactly", "near", "precisely", "proven", "rates", "rounds_to"]

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
