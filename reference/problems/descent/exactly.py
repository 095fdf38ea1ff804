"""Formulas read in exact numbers: where the value is one of surds.py, and no claim where it is not.

A function of a constant has the values that are known, such as cos(pi/5); a sine or a cosine of the unknown x is a
quotient of powers of T = tan(x/4).
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any, TypeVar

from reference.problems.descent.surds import PI, QUARTER_TANGENT, UNKNOWN, NotExactError, Surd, rational_root, surd

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["COSINES", "SURD", "exactly", "known"]

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
