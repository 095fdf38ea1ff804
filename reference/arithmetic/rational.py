"""Exact rational arithmetic for equations: what is rational is given exactly, and whatever is not is refused."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from reference.arithmetic.exact import rational_root

__all__ = ["RATIONAL", "IrrationalError", "RationalArithmetic", "rational_root"]


class IrrationalError(ArithmeticError):
    """A value that is not known to be rational."""


class RationalArithmetic:
    """Fractions: roots of squares, and the elementary functions at the one rational where their value is rational.

    Elsewhere these are transcendental (Lindemann 1882).

    Raises:
        IrrationalError: a value is irrational, or an operand is no rational.
    """

    def number(self, value: Fraction) -> Fraction:
        return Fraction(value)

    def sqrt(self, x: Any) -> Fraction:
        root = rational_root(_exact(x)) if x >= 0 else None
        if root is None:
            raise IrrationalError(f"the square root of {x} is irrational.")
        return root

    def power(self, x: Any, exponent: Fraction) -> Fraction:
        """x^exponent of whole exponents and of halves of them."""
        if Fraction(2 * exponent).denominator != 1 or not x:
            raise IrrationalError(f"{x}^{exponent} is not known to be rational.")
        return self.sqrt(x) ** int(2 * exponent) if Fraction(exponent).denominator == 2 else _exact(x) ** int(exponent)

    def __getattr__(self, name: str) -> Any:
        """An elementary function, by its value at the one rational where that is rational."""
        if name not in AT:
            raise IrrationalError(f"{name} is not known to be rational.")
        argument, value = AT[name]

        def function(x: Any) -> Fraction:
            if _exact(x) != argument:
                raise IrrationalError(f"{name}({x}) is irrational.")
            return Fraction(value)

        return function


AT = {
    **dict.fromkeys(("sin", "tan", "asin", "atan", "sinh", "tanh"), (0, 0)),
    **dict.fromkeys(("cos", "exp", "cosh"), (0, 1)),
    **dict.fromkeys(("log", "acos"), (1, 0)),
}
"""The rational argument of each function, and its value there."""


def _exact(x: Any) -> Fraction:
    if not isinstance(x, (int, Fraction)):
        raise IrrationalError(f"{x!r} is no exact rational.")
    return Fraction(x)


RATIONAL = RationalArithmetic()
