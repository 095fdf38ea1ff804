"""Exact numbers among which a value is known to be rational or not: quotients of sums of q x^i T^k pi^j sqrt(d).

q is rational, d a squarefree whole number, x an unknown, such as the parameter of a curve, and T = tan(x/4).  The
products x^i T^k pi^j sqrt(d) are linearly independent over the rationals (pi and the functions x and T are
transcendental), so that equality is decided exactly.

A formula read in these numbers has a value where that is one of them, and nothing is claimed where it is not.  A
function of a constant has the values that are known, such as cos(pi/5); a sine or a cosine of the unknown x is a
quotient of powers of T = tan(x/4).
"""

from __future__ import annotations

from fractions import Fraction
from math import gcd, isqrt
from typing import TYPE_CHECKING, Any, TypeVar

from flint import fmpz

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

__all__ = [
    "COSINES",
    "PI",
    "QUARTER_TANGENT",
    "SURD",
    "UNKNOWN",
    "NotExactError",
    "Surd",
    "exactly",
    "known",
    "rational_root",
    "surd",
]

MAX_TERMS = 200
MAX_BITS = 4000
MAX_FACTORED = 160
"""Whole numbers of up to so many bits are factored under a root."""

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
    if not value:
        return surd(0)
    square = value.numerator * value.denominator
    if isqrt(square) ** 2 == square:
        return surd(Fraction(isqrt(square), value.denominator))
    if square.bit_length() > MAX_FACTORED:
        raise NotExactError
    rest = outside = 1
    for prime, power in fmpz(square).factor():
        rest, outside = rest * int(prime) ** (power % 2), outside * int(prime) ** (power // 2)
    return Surd({(0, 0, 0, rest): Fraction(outside, value.denominator)}, {ONE: Fraction(1)})


def _single(i: int, k: int, j: int) -> Surd:
    """x^i T^k pi^j"""
    return Surd({(i, k, j, 1): Fraction(1)}, {ONE: Fraction(1)})


UNKNOWN, QUARTER_TANGENT, PI = _single(1, 0, 0), _single(0, 1, 0), _single(0, 0, 1)


Answer = TypeVar("Answer")
MAX_HALVES = 12
"""Sines and cosines of the unknown are known up to so many halves of it."""


def _root_sum(*terms: tuple[int, int, int]) -> Surd:
    """The sum of p/q sqrt(d) over the terms (p, q, d)."""
    return sum((Fraction(p, q) * rational_root(Fraction(d)) for p, q, d in terms), surd(0))


COSINES = {
    Fraction(0): surd(1),
    Fraction(1, 12): _root_sum((1, 4, 6), (1, 4, 2)),
    Fraction(1, 6): _root_sum((1, 2, 3)),
    Fraction(1, 5): _root_sum((1, 4, 1), (1, 4, 5)),
    Fraction(1, 4): _root_sum((1, 2, 2)),
    Fraction(1, 3): surd(Fraction(1, 2)),
    Fraction(2, 5): _root_sum((-1, 4, 1), (1, 4, 5)),
    Fraction(5, 12): _root_sum((1, 4, 6), (-1, 4, 2)),
    Fraction(1, 2): surd(0),
}
"""cos(r pi) for the r in [0, 1/2] at which it is a sum of roots."""


def _of_unknown(angle: Surd) -> tuple[Surd, Surd]:
    """Cosine and sine of a whole number of halves of the unknown."""
    halves = (2 * angle / UNKNOWN).rational
    if halves is None or halves.denominator > 1 or abs(halves) > MAX_HALVES:
        raise NotExactError
    scale = 1 + QUARTER_TANGENT**2
    cosine, sine = (1 - QUARTER_TANGENT**2) / scale, 2 * QUARTER_TANGENT / scale
    real, imaginary = surd(1), surd(0)
    for _ in range(abs(int(halves))):
        real, imaginary = real * cosine - imaginary * sine, real * sine + imaginary * cosine
    return real, imaginary if halves > 0 else -imaginary


class SurdArithmetic:
    """The arithmetic of these numbers, as a formula reads it."""

    @staticmethod
    def number(value: Fraction) -> Surd:
        return surd(value)

    @staticmethod
    def pi() -> Surd:
        return PI

    @staticmethod
    def sqrt(x: Any) -> Surd:
        """Of a rational, times pi to an even power."""
        number = surd(x)
        for half in range(-4, 5):
            value = (number / PI ** (2 * half) if half >= 0 else number * PI ** (-2 * half)).rational
            if value is not None:
                root = rational_root(value)
                return root * PI**half if half >= 0 else root / PI**-half
        raise NotExactError

    @staticmethod
    def cos(x: Any) -> Surd:
        """Of a rational multiple of pi, or of the unknown."""
        turns = (surd(x) / PI).rational
        if turns is None:
            return _of_unknown(x)[0]
        turns = abs(turns) % 2
        turns = min(turns, 2 - turns)
        sign, turns = (-1, 1 - turns) if turns > Fraction(1, 2) else (1, turns)
        if turns not in COSINES:
            raise NotExactError
        return sign * COSINES[turns]

    def sin(self, x: Any) -> Surd:
        """Of the same."""
        return _of_unknown(x)[1] if (surd(x) / PI).rational is None else self.cos(PI / 2 - surd(x))

    def tan(self, x: Any) -> Surd:
        return self.sin(x) / self.cos(x)

    def acos(self, x: Any) -> Surd:
        """Where x is one of the known cosines."""
        return self._inverse(x, self.cos, 0, 12)

    def asin(self, x: Any) -> Surd:
        """Where x is one of the known sines."""
        return self._inverse(x, self.sin, -6, 6)

    def atan(self, x: Any) -> Surd:
        """Where x is one of the known tangents."""
        return self._inverse(x, self.tan, -5, 5)

    @staticmethod
    def _inverse(x: Any, function: Callable[[Surd], Surd], low: int, high: int) -> Surd:
        for twelfths in range(low, high + 1):
            angle = PI * Fraction(twelfths, 12)
            if function(angle) == x:
                return angle
        raise NotExactError

    @staticmethod
    def _only_at(place: int, x: Any, value: int) -> Surd:
        if surd(x) != place:
            raise NotExactError
        return surd(value)

    def exp(self, x: Any) -> Surd:
        return self._only_at(0, x, 1)

    def log(self, x: Any) -> Surd:
        return self._only_at(1, x, 0)

    def sinh(self, x: Any) -> Surd:
        return self._only_at(0, x, 0)

    def cosh(self, x: Any) -> Surd:
        return self._only_at(0, x, 1)

    def tanh(self, x: Any) -> Surd:
        return self._only_at(0, x, 0)

    def power(self, x: Any, exponent: Fraction) -> Surd:
        """Of a rational that has this root."""
        value = surd(x).rational
        if value is None or value < 0 or (value == 0 and exponent < 0):
            raise NotExactError
        root = _whole_root(value.numerator, exponent.denominator), _whole_root(value.denominator, exponent.denominator)
        return surd(Fraction(*root) ** exponent.numerator)


def _whole_root(value: int, degree: int) -> int:
    """The root of a whole number, where it is whole."""
    high = 1 << -(-value.bit_length() // degree)
    low = 0
    while low < high:
        middle = (low + high + 1) // 2
        low, high = (middle, high) if middle**degree <= value else (low, middle - 1)
    if low**degree != value:
        raise NotExactError
    return low


SURD = SurdArithmetic()


def exactly(function: Callable[[Any, Any], Any], place: Any) -> Surd | None:
    """function(m, place) in these numbers; None where it is none of them."""
    return known(lambda: surd(function(SURD, surd(place))))


def known(value: Callable[[], Answer]) -> Answer | None:
    """What is found; None where the search leaves these numbers."""
    try:
        return value()
    except NotExactError:
        return None
