"""The arithmetics that read an equation: one small namespace each.

An equation takes an arithmetic as its first argument and calls ``m.sin``, ``m.sqrt``, ... on whatever numbers that
arithmetic has.  ``m.number(q)`` turns an exact rational into one of them, rounded at most once.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from reference.arithmetic.balls import BALL, Ball, ComplexBall
from reference.arithmetic.calculus import mpmath_integral, mpmath_root
from reference.arithmetic.elliptic import MpmathElliptic
from reference.arithmetic.precision import mp

if TYPE_CHECKING:
    from collections.abc import Callable
    from fractions import Fraction

__all__ = [
    "BALL",
    "MPMATH",
    "NUMPY",
    "Ball",
    "ComplexBall",
    "Heyoka",
    "Mpmath",
    "Numpy",
]


class Mpmath:
    """mpmath's numbers at its working precision."""

    elliptic = staticmethod(MpmathElliptic)
    sin = staticmethod(mp.sin)
    cos = staticmethod(mp.cos)
    tan = staticmethod(mp.tan)
    exp = staticmethod(mp.exp)
    log = staticmethod(mp.log)
    asin = staticmethod(mp.asin)
    acos = staticmethod(mp.acos)
    atan = staticmethod(mp.atan)
    tanh = staticmethod(mp.tanh)
    atan2 = staticmethod(mp.atan2)
    sinh = staticmethod(mp.sinh)
    cosh = staticmethod(mp.cosh)
    floor = staticmethod(mp.floor)
    sqrt = staticmethod(mp.sqrt)

    @staticmethod
    def pi() -> Any:
        return +mp.pi

    @staticmethod
    def power(x: Any, exponent: Fraction) -> Any:
        return mp.power(x, mp.mpf(exponent.numerator) / exponent.denominator)

    def integral(self, function: Callable[[Any, Any], Any], low: Any, high: Any) -> Any:
        """The integral of function(m, x), analytic on [low, high]."""
        return mpmath_integral(self, function, low, high)

    def root(self, function: Callable[[Any, Any], Any], low: Any, high: Any) -> Any:
        """The one zero of the monotone function(m, x) in [low, high]."""
        return mpmath_root(self, function, low, high)

    @staticmethod
    def number(value: Fraction) -> Any:
        return mp.mpf(value.numerator) / value.denominator


class Numpy:
    """NumPy arrays and scalars; NumPy is imported with the first function that is asked for."""

    sin: Any
    cos: Any
    tan: Any
    asin: Any
    acos: Any
    atan: Any
    sinh: Any
    cosh: Any
    tanh: Any
    exp: Any
    log: Any
    sqrt: Any

    def __getattr__(self, name: str) -> Any:
        if name not in type(self).__annotations__:
            raise AttributeError(f"NumPy's arithmetic has no {name}.")
        from reference.arithmetic.arrays import np

        setattr(self, name, getattr(np, name))
        return getattr(np, name)

    @staticmethod
    def pi() -> float:
        return math.pi

    @staticmethod
    def power(x: Any, exponent: Fraction) -> Any:
        return x ** float(exponent)

    @staticmethod
    def number(value: Fraction) -> float:
        return float(value)


class Heyoka:
    """heyoka's symbolic expressions; ``number`` gives constants of the floating-point type that will run them."""

    def __init__(self, number: Any = float) -> None:
        from reference.arithmetic.compiler import hy

        self._hy = hy
        self._number = number

    def number(self, value: Fraction) -> Any:
        return self._number(value)

    def _term(self, x: Any) -> Any:
        """An expression, of a constant too."""
        return x if isinstance(x, self._hy.expression) else self._hy.expression(x)

    def sin(self, x: Any) -> Any:
        return self._hy.sin(self._term(x))

    def cos(self, x: Any) -> Any:
        return self._hy.cos(self._term(x))

    def tan(self, x: Any) -> Any:
        return self._hy.tan(self._term(x))

    def asin(self, x: Any) -> Any:
        return self._hy.asin(self._term(x))

    def acos(self, x: Any) -> Any:
        return self._hy.acos(self._term(x))

    def atan(self, x: Any) -> Any:
        return self._hy.atan(self._term(x))

    def sinh(self, x: Any) -> Any:
        return self._hy.sinh(self._term(x))

    def cosh(self, x: Any) -> Any:
        return self._hy.cosh(self._term(x))

    def tanh(self, x: Any) -> Any:
        return self._hy.tanh(self._term(x))

    def exp(self, x: Any) -> Any:
        return self._hy.exp(self._term(x))

    def log(self, x: Any) -> Any:
        return self._hy.log(self._term(x))

    def sqrt(self, x: Any) -> Any:
        return self._hy.sqrt(self._term(x))

    def pi(self) -> Any:
        return self._hy.pi

    def power(self, x: Any, exponent: Fraction) -> Any:
        return self._term(x) ** self._number(exponent)


MPMATH = Mpmath()
NUMPY = Numpy()
