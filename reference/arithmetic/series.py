"""Truncated power series over any arithmetic, and with them the Taylor coefficients of a solution of y' = f(y).

A series is sum_k x[k] t^k.  Its k-th coefficient follows from those of its operands up to the k-th, by the recurrences
of R. E. Moore, Interval Analysis (1966), as A. Jorba and M. Zou, Experimental Mathematics 14 (2005), 99, proposition
2.1, list them; the other functions follow from their derivatives in the same way.  So an equation is read once, with
series for numbers, and then (k+1) y[k+1] = [f(y)][k] gives one coefficient after another: p of them for O(p^2)
operations.  (``balls.BallSeries`` has all its coefficients at once, and is made of balls.)
"""

from __future__ import annotations

from fractions import Fraction
from functools import reduce
from operator import add, mul
from typing import TYPE_CHECKING, Any

from reference.once import cached_property

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.arithmetic.protocols import ElementaryArithmetic

__all__ = ["Series", "SeriesArithmetic", "jet"]


def _nothing(x: Any) -> bool:
    """Whether a coefficient is zero whatever the numbers are: then it is the integer 0."""
    return isinstance(x, int) and x == 0


def _times(a: Any, b: Any) -> Any:
    return 0 if _nothing(a) or _nothing(b) else a * b


def _over(a: Any, b: Any) -> Any:
    return 0 if _nothing(a) else a / b


class Series:
    """A power series that computes its coefficients one after another and keeps them.

    All series of one computation stand on a ``tape`` in the order in which they were made, which is one in which their
    next coefficients can be computed: from the first to the last, none asks for much, however deep a formula is.
    """

    __array_ufunc__ = None
    """NumPy's arrays leave arithmetic with series to the series."""

    def __init__(self, tape: list[Series], coefficient: Callable[[int], Any]) -> None:
        self._tape, self._coefficient = tape, coefficient
        self._known: list[Any] = []
        self._sparse = False
        tape.append(self)

    def term(self, k: int) -> Any:
        """x[k]; the integer 0 where it is zero whatever the numbers are."""
        known = self._known
        while len(known) <= k:
            found = self._coefficient(len(known))
            if type(found) is int and found == 0:
                self._sparse = True
            known.append(found)
        return known[k]

    def times(self, other: Series, k: int, low: int, high: int) -> Any:
        """sum_j x[j] y[k - j] over low <= j < high: over 0 <= j <= k, the coefficient of the product."""
        if low >= high:
            return 0
        if len(self._known) < high:
            self.term(high - 1)
        if len(other._known) <= k - low:
            other.term(k - low)
        mine, its = self._known[low:high], other._known[k - high + 1 : k - low + 1]
        if self._sparse or other._sparse:
            products = (_times(*pair) for pair in zip(mine, reversed(its), strict=True))
            terms = [product for product in products if not _nothing(product)]
            return reduce(add, terms) if terms else 0
        return reduce(add, map(mul, mine, reversed(its)))

    @cached_property
    def slope(self) -> Series:
        """x', on no tape since it is one coefficient ahead."""
        return Series([], lambda k: _times(k + 1, self.term(k + 1)))

    def _made(self, coefficient: Callable[[int], Any]) -> Series:
        return Series(self._tape, coefficient)

    def _constant(self, value: Any) -> Series:
        return self._made(lambda k: 0 if k else value)

    def __add__(self, other: Any) -> Series:
        if isinstance(other, Series):
            return self._made(lambda k: self.term(k) + other.term(k))
        return self._made(lambda k: self.term(k) if k else self.term(0) + other)

    def __neg__(self) -> Series:
        return self._made(lambda k: -self.term(k))

    def __sub__(self, other: Any) -> Series:
        if isinstance(other, Series):
            return self._made(lambda k: self.term(k) - other.term(k))
        return self._made(lambda k: self.term(k) if k else self.term(0) - other)

    def __rsub__(self, other: Any) -> Series:
        return self._made(lambda k: -self.term(k) if k else other - self.term(0))

    def __mul__(self, other: Any) -> Series:
        if isinstance(other, Series):
            return self._made(lambda k: self.times(other, k, 0, k + 1))
        return self._made(lambda k: _times(self.term(k), other))

    def __truediv__(self, other: Any) -> Series:
        if isinstance(other, Series):
            return _quotient(self, other)
        return self._made(lambda k: _over(self.term(k), other))

    def __rtruediv__(self, other: Any) -> Series:
        return _quotient(self._constant(other), self)

    def __pow__(self, power: int) -> Any:
        """x to a whole power, by products."""
        if power < 1:
            return 1 / self**-power if power else 1
        if power == 1:
            return self
        half = self ** (power // 2)
        square = half * half
        return square * self if power % 2 else square

    __radd__ = __add__
    __rmul__ = __mul__


def _quotient(a: Series, b: Series) -> Series:
    """q = a/b from q b = a:  q[k] = (a[k] - sum_{j=1}^k b[j] q[k-j])/b[0]."""
    q = Series(
        b._tape,  # noqa: SLF001
        lambda k: _over(a.term(k) - b.times(q, k, 1, k + 1), b.term(0)),
    )
    return q


class SeriesArithmetic:
    """An arithmetic of power series over the arithmetic ``m``; constants stay numbers of ``m``.

    A function F has F(x)' = F'(x) x':  k F[k] = sum_{j<k} F'[j] (k-j) x[k-j], where F' may depend on F itself.
    """

    def __init__(self, m: ElementaryArithmetic) -> None:
        self.m = m
        self.tape: list[Series] = []
        self._circles: dict[tuple[str, Series], tuple[Series, Series]] = {}
        self._parts: dict[int, Any] = {}

    def number(self, value: Fraction) -> Any:
        return self.m.number(value)

    def pi(self) -> Any:
        return self.m.pi()

    def series(self, value: Any) -> Series:
        """A number as a series; a series as it is."""
        return value if isinstance(value, Series) else Series(self.tape, lambda k: 0 if k else value)

    def part(self, x: Any, k: int) -> Any:
        """x/k."""
        if k < 2 or _nothing(x):
            return x
        if k not in self._parts:
            self._parts[k] = self.m.number(Fraction(1, k))
        return x * self._parts[k]

    def _grown(self, first: Callable[[], Any], slope: Callable[[], Series], x: Series) -> Series:
        """The series that starts with ``first`` and has the derivative slope x'."""
        return Series(self.tape, lambda k: self.part(slope().times(x.slope, k - 1, 0, k), k) if k else first())

    def _of(self, x: Any, function: Callable[[Any], Any], slope: Callable[[Series, Series], Any]) -> Any:
        """A function of a series, with slope(x, function(x)) its derivative; of a constant, a constant."""
        if not isinstance(x, Series):
            return function(x)
        found = self._grown(lambda: function(x.term(0)), lambda: rate, x)
        rate = slope(x, found)
        return found

    def _circle(self, x: Series, first: str, second: str, sign: int) -> tuple[Series, Series]:
        """Two functions at once, with first' = second and second' = sign first."""
        if (first, x) not in self._circles:
            sine = self._grown(lambda: getattr(self.m, first)(x.term(0)), lambda: cosine, x)
            cosine = self._grown(lambda: getattr(self.m, second)(x.term(0)), lambda: turned, x)
            turned = sine if sign > 0 else -sine
            self._circles[first, x] = sine, cosine
        return self._circles[first, x]

    def sin(self, x: Any) -> Any:
        return self._circle(x, "sin", "cos", -1)[0] if isinstance(x, Series) else self.m.sin(x)

    def cos(self, x: Any) -> Any:
        return self._circle(x, "sin", "cos", -1)[1] if isinstance(x, Series) else self.m.cos(x)

    def sinh(self, x: Any) -> Any:
        return self._circle(x, "sinh", "cosh", 1)[0] if isinstance(x, Series) else self.m.sinh(x)

    def cosh(self, x: Any) -> Any:
        return self._circle(x, "sinh", "cosh", 1)[1] if isinstance(x, Series) else self.m.cosh(x)

    def tan(self, x: Any) -> Any:
        return self._of(x, self.m.tan, lambda _, tangent: 1 + tangent * tangent)

    def tanh(self, x: Any) -> Any:
        return self._of(x, self.m.tanh, lambda _, tangent: 1 - tangent * tangent)

    def asin(self, x: Any) -> Any:
        return self._of(x, self.m.asin, lambda a, _: 1 / self.sqrt(1 - a * a))

    def acos(self, x: Any) -> Any:
        return self._of(x, self.m.acos, lambda a, _: -1 / self.sqrt(1 - a * a))

    def atan(self, x: Any) -> Any:
        return self._of(x, self.m.atan, lambda a, _: 1 / (1 + a * a))

    def exp(self, x: Any) -> Any:
        return self._of(x, self.m.exp, lambda _, value: value)

    def log(self, x: Any) -> Any:
        return self._of(x, self.m.log, lambda a, _: 1 / a)

    def sqrt(self, x: Any) -> Any:
        """r from r^2 = x:  r[k] = (x[k] - sum_{j=1}^{k-1} r[j] r[k-j])/(2 r[0])."""
        if not isinstance(x, Series):
            return self.m.sqrt(x)

        def coefficient(k: int) -> Any:
            if k == 0:
                return self.m.sqrt(x.term(0))
            return _over(x.term(k) - root.times(root, k, 1, k), 2 * root.term(0))

        root = Series(self.tape, coefficient)
        return root

    def power(self, x: Any, exponent: Fraction) -> Any:
        """p = x^e from x p' = e p x':  x[0] p[k] = (1+e)/k sum_{j=1}^k j x[j] p[k-j] - sum_{j=1}^k x[j] p[k-j]."""
        if not isinstance(x, Series):
            return self.m.power(x, exponent)

        def coefficient(k: int) -> Any:
            if k == 0:
                return self.m.power(x.term(0), exponent)
            moved = x.slope.times(found, k - 1, 0, k)
            scaled = _times(moved, self.m.number((1 + exponent) / k))
            return _over(scaled - x.times(found, k, 1, k + 1), x.term(0))

        found = Series(self.tape, coefficient)
        return found


def jet(
    m: ElementaryArithmetic, derivative: Callable[[Any, Sequence[Any]], Sequence[Any]], y: Sequence[Any], order: int
) -> list[tuple[Any, ...]]:
    """y[1], ..., y[order]: the normalized derivatives y^(k)/k! at ``y`` of the solution of y' = derivative(m, y).

    A component that is zero whatever the numbers are is the integer 0.
    """
    arithmetic = SeriesArithmetic(m)
    rates: list[Series] = []

    def component(place: int, value: Any) -> Series:
        return Series(arithmetic.tape, lambda k: arithmetic.part(rates[place].term(k - 1), k) if k else value)

    state = [component(place, value) for place, value in enumerate(y)]
    rates += map(arithmetic.series, derivative(arithmetic, state))
    for k in range(order):
        for series in arithmetic.tape:
            series.term(k)
    return [tuple(series.term(k) for series in state) for k in range(1, order + 1)]
