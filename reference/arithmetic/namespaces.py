"""The arithmetics that read an equation: one small namespace each.

An equation takes an arithmetic as its first argument and calls ``m.sin``, ``m.sqrt``, ... on whatever numbers that
arithmetic has.  ``m.number(q)`` turns an exact rational into one of them, rounded at most once.
"""

from __future__ import annotations

import math
import operator
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.arithmetic.balls import BALL, Ball, ComplexBall
from reference.arithmetic.calculus import mpmath_integral, mpmath_root
from reference.arithmetic.elliptic import MpmathElliptic
from reference.arithmetic.precision import mp

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

__all__ = [
    "BALL",
    "JAX",
    "MPMATH",
    "NUMPY",
    "TORCH",
    "Ball",
    "ComplexBall",
    "Heyoka",
    "Jax",
    "Mpmath",
    "Numpy",
    "Term",
    "Torch",
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


class Jax(Numpy):
    """JAX's arrays and tracers; JAX is imported with the first function that is asked for."""

    def __getattr__(self, name: str) -> Any:
        if name not in Numpy.__annotations__:
            raise AttributeError(f"JAX's arithmetic has no {name}.")
        import jax.numpy as jnp

        setattr(self, name, getattr(jnp, name))
        return getattr(jnp, name)


class Torch(Numpy):
    """PyTorch's tensors; its functions take no numbers, so that those of a number are NumPy's."""

    def __getattr__(self, name: str) -> Any:
        if name not in Numpy.__annotations__:
            raise AttributeError(f"PyTorch's arithmetic has no {name}.")
        import torch

        of_tensor, of_number = getattr(torch, name), getattr(NUMPY, name)

        def function(x: Any) -> Any:
            return of_tensor(x) if isinstance(x, torch.Tensor) else of_number(x)

        setattr(self, name, function)
        return function


class Heyoka:
    """heyoka's symbolic expressions; ``number`` gives constants of the floating-point type that will run them.

    heyoka itself takes Python's numbers in an expression for doubles, x/3 for 0.333... x.  Expressions that an equation
    reads as ``terms`` take them as constants of the type.
    """

    def __init__(self, number: Any = float) -> None:
        from reference.arithmetic.compiler import hy

        self._hy = hy
        self._number = number

    def number(self, value: Fraction) -> Any:
        return self._number(value)

    def terms(self, expressions: Iterable[Any]) -> list[Any]:
        """Expressions as an equation reads them."""
        return [Term(self, x) for x in expressions]

    def expression(self, x: Any) -> Any:
        """An expression, of a constant too."""
        if isinstance(x, Term):
            return x.expression
        return x if isinstance(x, self._hy.expression) else self._hy.expression(x)

    def constant(self, value: Any) -> Any:
        """A constant of the type; an expression, or a number of that type, as it is."""
        if isinstance(value, Term):
            return value.expression
        return self._number(Fraction(value)) if isinstance(value, (int, float, Fraction)) else value

    def _of(self, function: Callable[[Any], Any], x: Any) -> Any:
        found = function(self.expression(x))
        return Term(self, found) if isinstance(x, Term) else found

    def sin(self, x: Any) -> Any:
        return self._of(self._hy.sin, x)

    def cos(self, x: Any) -> Any:
        return self._of(self._hy.cos, x)

    def tan(self, x: Any) -> Any:
        return self._of(self._hy.tan, x)

    def asin(self, x: Any) -> Any:
        return self._of(self._hy.asin, x)

    def acos(self, x: Any) -> Any:
        return self._of(self._hy.acos, x)

    def atan(self, x: Any) -> Any:
        return self._of(self._hy.atan, x)

    def sinh(self, x: Any) -> Any:
        return self._of(self._hy.sinh, x)

    def cosh(self, x: Any) -> Any:
        return self._of(self._hy.cosh, x)

    def tanh(self, x: Any) -> Any:
        return self._of(self._hy.tanh, x)

    def exp(self, x: Any) -> Any:
        return self._of(self._hy.exp, x)

    def log(self, x: Any) -> Any:
        return self._of(self._hy.log, x)

    def sqrt(self, x: Any) -> Any:
        return self._of(self._hy.sqrt, x)

    def pi(self) -> Any:
        return self._hy.pi

    def power(self, x: Any, exponent: Fraction) -> Any:
        return self._of(lambda term: term ** self._number(exponent), x)


class Term:
    """An expression of heyoka's whose operands are constants of the type of an arithmetic."""

    __array_ufunc__ = None
    """NumPy's numbers leave arithmetic with terms to the terms, and these to duals and series."""

    def __init__(self, m: Heyoka, expression: Any) -> None:
        self._m, self.expression = m, expression

    def _joined(self, operation: Callable[[Any, Any], Any], other: Any) -> Any:
        if not isinstance(other, Term) and getattr(other, "__array_ufunc__", self) is None:
            return NotImplemented
        return Term(self._m, operation(self.expression, self._m.constant(other)))

    def __add__(self, other: Any) -> Any:
        return self._joined(operator.add, other)

    def __sub__(self, other: Any) -> Any:
        return self._joined(operator.sub, other)

    def __rsub__(self, other: Any) -> Any:
        return self._joined(lambda own, its: its - own, other)

    def __mul__(self, other: Any) -> Any:
        return self._joined(operator.mul, other)

    def __truediv__(self, other: Any) -> Any:
        return self._joined(operator.truediv, other)

    def __rtruediv__(self, other: Any) -> Any:
        return self._joined(lambda own, its: its / own, other)

    def __neg__(self) -> Term:
        return Term(self._m, -self.expression)

    def __pow__(self, power: int) -> Term:
        return Term(self._m, self.expression**power)

    __radd__ = __add__
    __rmul__ = __mul__


MPMATH = Mpmath()
NUMPY = Numpy()
JAX = Jax()
TORCH = Torch()
