"""Numbers that are power series in the step: what a user's step is given instead of h, to read off its order.

A step that does nothing but arithmetic gives its own series in h, with the coefficients that it has.  A branch on
something that changes with h has no series, and is refused.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from reference.arithmetic.namespaces import MPMATH
from reference.arithmetic.precision import mp
from reference.arithmetic.series import Series, SeriesArithmetic

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["Expansion", "Expansions", "NoSeriesError"]


class NoSeriesError(TypeError):
    """What was asked of a series has no series, or hangs on more of it than its beginning."""


class Expansions:
    """The arithmetic of series in h > 0, at mpmath's working precision.

    Attributes:
        terms: how many of them tell whether a number depends on h.
    """

    def __init__(self, terms: int) -> None:
        self.terms = terms
        self.m = SeriesArithmetic(MPMATH)

    def step(self) -> Expansion:
        """The series of the step itself."""
        return Expansion(self, Series(self.m.tape, lambda k: mp.mpf(1) if k == 1 else 0))

    def constant(self, value: Any) -> Expansion:
        """A number that does not depend on h."""
        return Expansion(self, self.m.series(mp.mpf(float(value))))

    def number(self, value: Fraction) -> Expansion:
        """An exact rational."""
        return Expansion(self, self.m.series(MPMATH.number(value)))

    def pi(self) -> Expansion:
        """The number pi."""
        return Expansion(self, self.m.series(MPMATH.pi()))

    def power(self, x: Any, exponent: Fraction) -> Expansion:
        """x^exponent."""
        return Expansion(self, self.m.power(x.series if isinstance(x, Expansion) else mp.mpf(float(x)), exponent))

    def known(self, last: int) -> None:
        """Compute the terms of all series up to the last, in an order in which none waits for another."""
        for k in range(last + 1):
            for series in self.m.tape:
                series.term(k)

    def __getattr__(self, name: str) -> Any:
        """The functions of an arithmetic: sin, cos, sqrt, ..."""
        function = getattr(self.m, name)
        return lambda x: Expansion(self, function(x.series if isinstance(x, Expansion) else mp.mpf(float(x))))


class Expansion:
    """A series as a number of a user's: it mixes with real numbers and with NumPy's arrays of objects."""

    def __init__(self, home: Expansions, series: Any) -> None:
        self.home, self.series = home, home.m.series(series)

    def terms(self) -> list[Any]:
        """Its first coefficients."""
        self.home.known(self.home.terms)
        return [self.series.term(k) for k in range(self.home.terms + 1)]

    def _with(self, other: Any, operation: Callable[[Any, Any], Any]) -> Any:
        if isinstance(other, Expansion):
            return Expansion(self.home, operation(self.series, other.series))
        if isinstance(other, (int, float, np.integer, np.floating, Fraction)):
            return Expansion(self.home, operation(self.series, _number(other)))
        return NotImplemented

    def __add__(self, other: Any) -> Any:
        return self._with(other, lambda a, b: a + b)

    def __sub__(self, other: Any) -> Any:
        return self._with(other, lambda a, b: a - b)

    def __rsub__(self, other: Any) -> Any:
        return self._with(other, lambda a, b: b - a)

    def __mul__(self, other: Any) -> Any:
        return self._with(other, lambda a, b: a * b)

    def __truediv__(self, other: Any) -> Any:
        return self._with(other, lambda a, b: a / b)

    def __rtruediv__(self, other: Any) -> Any:
        return self._with(other, lambda a, b: b / a)

    def __pow__(self, power: Any) -> Any:
        """X^power, whole or not; no series may be the exponent."""
        if isinstance(power, (int, np.integer)):
            return Expansion(self.home, self.series ** int(power))
        if isinstance(power, (float, np.floating)):
            whole = float(power).is_integer()
            power = Fraction(float(power))
            return self ** int(power) if whole else Expansion(self.home, self.home.m.power(self.series, power))
        return NotImplemented

    __radd__ = __add__
    __rmul__ = __mul__

    def __neg__(self) -> Expansion:
        return Expansion(self.home, -self.series)

    def __pos__(self) -> Expansion:
        return self

    def __abs__(self) -> Expansion:
        """For small enough epsilon it is the one or the other."""
        first = next((term for term in self.terms() if term), 0)
        return -self if first < 0 else self

    def __getattr__(self, name: str) -> Any:
        """x.sin() and the like, which NumPy's functions call of objects."""
        if name not in FUNCTIONS:
            raise AttributeError(name)
        return lambda: Expansion(self.home, getattr(self.home.m, FUNCTIONS[name])(self.series))

    def _less(self, other: Any) -> float:
        """The sign of self - other, which must not depend on h.

        Raises:
            NoSeriesError: it does.
        """
        difference = self._with(other, lambda a, b: a - b)
        if not isinstance(difference, Expansion):
            raise NoSeriesError(f"a series in the step is compared with a {type(other).__name__}.")
        terms = difference.terms()
        if any(terms[1:]):
            raise NoSeriesError("a branch depends on the step.")
        return float(terms[0])

    def __lt__(self, other: Any) -> bool:
        return self._less(other) < 0

    def __le__(self, other: Any) -> bool:
        return self._less(other) <= 0

    def __gt__(self, other: Any) -> bool:
        return self._less(other) > 0

    def __ge__(self, other: Any) -> bool:
        return self._less(other) >= 0

    def __eq__(self, other: object) -> bool:
        return self._less(other) == 0

    def __ne__(self, other: object) -> bool:
        return self._less(other) != 0

    __hash__ = None  # type: ignore[assignment]  # equality hangs on coefficients

    def __bool__(self) -> bool:
        return self != 0


FUNCTIONS = {name: name for name in ("sin", "cos", "tan", "exp", "log", "sqrt", "sinh", "cosh", "tanh")}
FUNCTIONS |= {"arcsin": "asin", "arccos": "acos", "arctan": "atan"}
"""What NumPy calls a function, and what an arithmetic does."""


def _number(value: Any) -> Any:
    """A real number as mpmath's, exactly."""
    if isinstance(value, Fraction):
        return MPMATH.number(value)
    return mp.mpf(int(value)) if isinstance(value, (int, np.integer)) else mp.mpf(float(value))
