"""The arithmetics that read an equation: one small namespace each.

An equation takes an arithmetic as its first argument and calls ``m.sin``, ``m.sqrt``, ... on whatever numbers that
arithmetic has.  ``m.number(q)`` turns an exact rational into one of them, rounded at most once.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from flint import acb, arb, fmpq
from mpmath import mp

from reference.calculus import ball_integral, ball_root, mpmath_integral, mpmath_root
from reference.elliptic import BallElliptic, MpmathElliptic

if TYPE_CHECKING:
    from collections.abc import Callable
    from fractions import Fraction

__all__ = [
    "BALL",
    "MPMATH",
    "NUMPY",
    "Arithmetic",
    "Ball",
    "CalculusArithmetic",
    "ComplexBall",
    "EllipticArithmetic",
    "Heyoka",
    "Mpmath",
    "Numpy",
]


class Arithmetic(Protocol):
    """What an equation of motion may ask for."""

    def number(self, value: Fraction) -> Any: ...
    def sin(self, x: Any) -> Any: ...
    def cos(self, x: Any) -> Any: ...
    def sqrt(self, x: Any) -> Any: ...


class EllipticArithmetic(Arithmetic, Protocol):
    """What a closed form may ask for besides."""

    def pi(self) -> Any: ...
    def atan(self, x: Any) -> Any: ...
    def atan2(self, y: Any, x: Any) -> Any: ...
    def sinh(self, x: Any) -> Any: ...
    def cosh(self, x: Any) -> Any: ...
    def floor(self, x: Any) -> Any: ...
    def elliptic(self, k: Any, kc: Any) -> Any: ...


class CalculusArithmetic(EllipticArithmetic, Protocol):
    """What a closed form may ask for that is an integral or a zero."""

    def integral(self, function: Callable[[Any, Any], Any], low: Any, high: Any) -> Any: ...
    def root(self, function: Callable[[Any, Any], Any], low: Any, high: Any) -> Any: ...


class Ball:
    """Arb's real balls at the precision of ``flint.ctx``."""

    elliptic = staticmethod(BallElliptic)

    @staticmethod
    def number(value: Fraction) -> arb:
        return arb(fmpq(value.numerator, value.denominator))

    @staticmethod
    def sin(x: arb) -> arb:
        return x.sin()

    @staticmethod
    def cos(x: arb) -> arb:
        return x.cos()

    @staticmethod
    def pi() -> arb:
        return arb.pi()

    @staticmethod
    def atan(x: arb) -> arb:
        return x.atan()

    @staticmethod
    def atan2(y: arb, x: arb) -> arb:
        return arb.atan2(y, x)

    @staticmethod
    def sinh(x: arb) -> arb:
        return x.sinh()

    @staticmethod
    def cosh(x: arb) -> arb:
        return x.cosh()

    @staticmethod
    def floor(x: arb) -> arb:
        """The integer below every point of the ball; not a number where there is more than one."""
        whole = x.floor().unique_fmpz()
        return arb.nan() if whole is None else arb(whole)

    @staticmethod
    def sqrt(x: arb) -> arb:
        return x.sqrt()

    @staticmethod
    def integral(function: Callable[[Any, Any], Any], low: Any, high: Any) -> arb:
        """The integral of function(m, x), real and analytic on [low, high]."""
        return ball_integral(ComplexBall, function, low, high)

    def root(self, function: Callable[[Any, Any], Any], low: Any, high: Any) -> arb:
        """The one zero of the monotone function(m, x) in [low, high], its ends exact or balls."""
        return ball_root(self, function, low, high)


class ComplexBall:
    """Arb's complex balls, for the integrands of ``Ball.integral``.

    Where ``analytic`` is set, a function that is not analytic on the whole of its argument gives no number.
    """

    def __init__(self, analytic: bool) -> None:
        self.analytic = analytic

    @staticmethod
    def number(value: Fraction) -> acb:
        return acb(fmpq(value.numerator, value.denominator))

    @staticmethod
    def sin(x: Any) -> acb:
        return acb(x).sin()

    @staticmethod
    def cos(x: Any) -> acb:
        return acb(x).cos()

    @staticmethod
    def sinh(x: Any) -> acb:
        return acb(x).sinh()

    @staticmethod
    def cosh(x: Any) -> acb:
        return acb(x).cosh()

    @staticmethod
    def pi() -> acb:
        return acb.pi()

    def sqrt(self, x: Any) -> acb:
        return acb(x).sqrt(analytic=self.analytic)


class Mpmath:
    """mpmath's numbers at its working precision."""

    elliptic = staticmethod(MpmathElliptic)
    sin = staticmethod(mp.sin)
    cos = staticmethod(mp.cos)
    atan = staticmethod(mp.atan)
    atan2 = staticmethod(mp.atan2)
    sinh = staticmethod(mp.sinh)
    cosh = staticmethod(mp.cosh)
    floor = staticmethod(mp.floor)
    sqrt = staticmethod(mp.sqrt)

    @staticmethod
    def pi() -> Any:
        return +mp.pi

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
    """NumPy arrays and scalars."""

    sin = staticmethod(np.sin)
    cos = staticmethod(np.cos)
    sqrt = staticmethod(np.sqrt)

    @staticmethod
    def number(value: Fraction) -> float:
        return float(value)


class Heyoka:
    """heyoka's symbolic expressions; ``number`` gives constants of the floating-point type that will run them."""

    def __init__(self, number: Any = float) -> None:
        from reference.compiler import hy

        self._hy = hy
        self._number = number

    def number(self, value: Fraction) -> Any:
        return self._number(value)

    def sin(self, x: Any) -> Any:
        return self._hy.sin(x)

    def cos(self, x: Any) -> Any:
        return self._hy.cos(x)

    def sqrt(self, x: Any) -> Any:
        return self._hy.sqrt(x)


BALL = Ball()
MPMATH = Mpmath()
NUMPY = Numpy()
