"""Exact numbers among which a value is known to be rational or not: quotients of sums of q x^i T^k pi^j sqrt(d).

q is rational, d a squarefree whole number, x an unknown, such as the parameter of a curve, and T = tan(x/4).  The
products x^i T^k pi^j sqrt(d) are linearly independent over the rationals (pi and the functions x and T are
transcendental), so that equality is decided exactly.
"""

from __future__ import annotations

from fractions import Fraction
from math import gcd, isqrt
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["PI", "QUARTER_TANGENT", "UNKNOWN", "NotExactError", "Surd", "rational_root", "surd"]

MAX_TERMS = 200
MAX_BITS = 4000
MAX_FACTOR = 1000
"""Square factors are sought among the primes up to here, and in what they leave as a whole."""

Key = tuple[int, int, int, int]
Sum = dict[Key, Fraction]
"""(i, k, j, d) -> the coefficient of x^i T^k pi^j sqrt(d)."""
ONE: Key = (0, 0, 0, 1)


class NotExactError(ArithmeticError):
    """A value is none of these numbers, or too long."""


class Surd:
    """top/bottom, two sums, the latter not zero."""

    def __init__(self, top: Sum, bottom: Sum) -> None:
        if not bottom:
            raise NotExactError
        if max(len(top), len(bottom)) > MAX_TERMS or any(
            _bits(q) > MAX_BITS for q in (*top.values(), *bottom.values())
        ):
            raise NotExactError
        self.top, self.bottom = top, bottom

    @property
    def is_zero(self) -> bool:
        """Whether the number is zero."""
        return not self.top

    @property
    def rational(self) -> Fraction | None:
        """The rational that the number is, if it is one."""
        key = next(iter(self.bottom))
        ratio = self.top.get(key, Fraction(0)) / self.bottom[key]
        return ratio if self.top == _scaled(self.bottom, ratio) else None

    def __add__(self, other: Any) -> Surd:
        if not isinstance(other, NUMBERS):
            return NotImplemented
        its = surd(other)
        return Surd(_sum(_product(self.top, its.bottom), _product(its.top, self.bottom)), self._below(its))

    def _below(self, other: Surd) -> Sum:
        return _product(self.bottom, other.bottom)

    def __neg__(self) -> Surd:
        return Surd(_scaled(self.top, Fraction(-1)), self.bottom)

    def __sub__(self, other: Any) -> Surd:
        return self + -surd(other) if isinstance(other, NUMBERS) else NotImplemented

    def __rsub__(self, other: Any) -> Surd:
        return surd(other) - self

    def __mul__(self, other: Any) -> Surd:
        if not isinstance(other, NUMBERS):
            return NotImplemented
        its = surd(other)
        return Surd(_product(self.top, its.top), self._below(its))

    def __truediv__(self, other: Any) -> Surd:
        if not isinstance(other, NUMBERS):
            return NotImplemented
        its = surd(other)
        return Surd(_product(self.top, its.bottom), _product(self.bottom, its.top))

    def __rtruediv__(self, other: Any) -> Surd:
        return surd(other) / self

    def __pow__(self, power: int) -> Surd:
        value = surd(1)
        for _ in range(power):
            value = value * self
        return value

    __radd__ = __add__
    __rmul__ = __mul__

    def __eq__(self, other: object) -> bool:
        return (self - other).is_zero

    __hash__ = None  # type: ignore[assignment] # equal numbers may be written in many ways


NUMBERS = (int, Fraction, Surd)
"""What these numbers are joined with by themselves; what else there is, such as a dual, joins itself."""


def surd(value: Any) -> Surd:
    """A whole number or a rational as one of these numbers."""
    if isinstance(value, Surd):
        return value
    if not isinstance(value, (int, Fraction)):
        raise NotExactError
    return Surd({ONE: Fraction(value)} if value else {}, {ONE: Fraction(1)})


def _bits(value: Fraction) -> int:
    return max(value.numerator.bit_length(), value.denominator.bit_length())


def _scaled(a: Sum, factor: Fraction) -> Sum:
    return {key: value * factor for key, value in a.items()} if factor else {}


def _sum(a: Mapping[Key, Fraction], b: Mapping[Key, Fraction]) -> Sum:
    total = dict(a)
    for key, value in b.items():
        total[key] = total.get(key, Fraction(0)) + value
    return {key: value for key, value in total.items() if value}


def _product(a: Sum, b: Sum) -> Sum:
    if len(a) * len(b) > MAX_TERMS**2:
        raise NotExactError
    total: Sum = {}
    for (*powers, d), p in a.items():
        for (*others, e), q in b.items():
            common = gcd(d, e)
            i, k, j = (x + y for x, y in zip(powers, others, strict=True))
            key = i, k, j, d * e // common**2
            total[key] = total.get(key, Fraction(0)) + p * q * common
    return {key: value for key, value in total.items() if value}


def rational_root(value: Fraction) -> Surd:
    """r sqrt(d), the square root of a rational."""
    if value < 0:
        raise NotExactError
    rest, outside, n = value.numerator * value.denominator, 1, 2
    while n <= MAX_FACTOR:
        while rest and rest % n**2 == 0:
            rest, outside = rest // n**2, outside * n
        n += 1
    if isqrt(rest) ** 2 == rest:
        rest, outside = 1, outside * isqrt(rest)
    elif rest > MAX_FACTOR**2:
        raise NotExactError  # it may have a square factor that was not found
    return Surd({(0, 0, 0, rest): Fraction(outside, value.denominator)} if value else {}, {ONE: Fraction(1)})


def _single(i: int, k: int, j: int) -> Surd:
    """x^i T^k pi^j"""
    return Surd({(i, k, j, 1): Fraction(1)}, {ONE: Fraction(1)})


UNKNOWN, QUARTER_TANGENT, PI = _single(1, 0, 0), _single(0, 1, 0), _single(0, 0, 1)
