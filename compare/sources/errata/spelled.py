"""Formulas as they are spelled in an entry, turned into what computes them, so that the text shown is the form checked.

The notation is that of print: powers are raised digits, a factor follows a factor, sin and cos take the next factor.
What touches binds closer than what stands apart: ``g/2a`` is g/(2 a), ``cos 3ωt`` is cos(3 ω t), and ``5/512 ω²`` is
(5/512) ω².  An equation is its left side less its right side.
"""

from __future__ import annotations

import operator
import re
from fractions import Fraction
from math import factorial
from typing import TYPE_CHECKING, Any

from reference.arithmetic.precision import mp

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["spelled"]

_RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
_FUNCTIONS: dict[str, Callable[[Any], Any]] = {"√": mp.sqrt, "cos": mp.cos, "sin": mp.sin, "acos": mp.acos}
_CONSTANTS: dict[str, Callable[[], Any]] = {"π": lambda: +mp.pi, "½": lambda: Fraction(1, 2)}
_OPEN, _CLOSE = "([", ")]"


def spelled(text: str, *names: str) -> Callable[..., Any]:
    """The formula as a function of these names, in their order; numbers are exact, functions mpmath's.

    Raises:
        ValueError: something in the text is neither a name nor part of a formula.
    """
    words = sorted((*names, *_FUNCTIONS), key=len, reverse=True)
    token = re.compile(rf"\s*(?:(?P<word>{'|'.join(map(re.escape, words))})|(?P<other>\d+(?:\.\d+)?|[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+|.))")
    tokens = [(match.start(match.lastgroup or 0) > match.start(), match[0].strip()) for match in token.finditer(text)]

    def compute(*values: Any) -> Any:
        return _Reader(text, tokens, dict(zip(names, values, strict=True))).equation()

    return compute


class _Reader:
    """One computation along the tokens, each with whether a blank stands before it."""

    def __init__(self, text: str, tokens: list[tuple[bool, str]], values: dict[str, Any]) -> None:
        self._text = text
        self._tokens = tokens
        self._values = values
        self._at = 0

    def equation(self) -> Any:
        """The whole text."""
        found = self._sum()
        if self._take("="):
            found = operator.sub(*_of_one_kind(found, self._sum()))
        if self._at < len(self._tokens):
            raise ValueError(f"{self._next()!r} in {self._text!r} is not part of a formula.")
        return found

    def _next(self) -> str:
        return self._tokens[self._at][1] if self._at < len(self._tokens) else ""

    def _apart(self) -> bool:
        """Whether a blank stands before the next token."""
        return self._at < len(self._tokens) and self._tokens[self._at][0]

    def _take(self, *wanted: str) -> str:
        found = self._next()
        if found not in wanted:
            return ""
        self._at += 1
        return found

    def _sum(self) -> Any:
        found = -self._product() if self._take("−", "-") else self._product()
        while sign := self._take("+", "−", "-"):
            found, term = _of_one_kind(found, self._product())
            found = found + term if sign == "+" else found - term
        return found

    def _product(self) -> Any:
        found = self._group()
        while True:
            if self._take("/"):
                found = operator.truediv(*_of_one_kind(found, self._group()))
            elif self._take("·") or self._begins_a_factor():
                found = operator.mul(*_of_one_kind(found, self._group()))
            else:
                return found

    def _group(self) -> Any:
        """Factors that touch each other."""
        found = self._factor()
        while self._begins_a_factor() and not self._apart():
            found = operator.mul(*_of_one_kind(found, self._factor()))
        return found

    def _begins_a_factor(self) -> bool:
        sign = self._next()
        known = {*self._values, *_FUNCTIONS, *_CONSTANTS, *_OPEN}
        return sign in known or sign[:1].isdecimal()

    def _factor(self) -> Any:
        name = self._next()
        self._at += 1
        if name in _FUNCTIONS:
            return self._applied(_FUNCTIONS[name])
        return self._raised(self._atom(name))

    def _applied(self, function: Callable[[Any], Any]) -> Any:
        """Of the factor after the function's name; a power between them is the function's."""
        power = self._power()
        argument = self._factor() if self._next() in _OPEN else self._group()
        return function(argument) ** power

    def _atom(self, sign: str) -> Any:
        if sign in self._values:
            return self._values[sign]
        if sign in _CONSTANTS:
            return _CONSTANTS[sign]()
        if sign and sign in _OPEN:
            found = self._sum()
            if not self._take(*_CLOSE):
                raise ValueError(f"a bracket in {self._text!r} is not closed.")
            return found
        if sign[:1].isdecimal():
            number = Fraction(sign)
            return Fraction(factorial(int(number))) if self._take("!") else number
        raise ValueError(f"{sign!r} in {self._text!r} is not part of a formula.")

    def _raised(self, base: Any) -> Any:
        return base ** self._power()

    def _power(self) -> int:
        raised = self._next()
        if not raised or ord(raised[0]) not in _RAISED:
            return 1
        self._at += 1
        return int(raised.translate(_RAISED))


def _of_one_kind(left: Any, right: Any) -> tuple[Any, Any]:
    """The two sides of an operation; mpmath before 1.4 takes a fraction on its right side alone."""
    return (mp.convert(left) if isinstance(left, Fraction) and isinstance(right, mp.mpf) else left), right
