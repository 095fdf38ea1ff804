"""First derivatives of a closed form, by dual numbers over any arithmetic: a value and its slopes.

A closed form written for balls or for mpmath is read with numbers x + x' e, e^2 = 0: its derivatives come out proven in
balls, and to working precision in mpmath, without a formula being written twice.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from reference.arithmetic.protocols import EllipticArithmetic

__all__ = ["Dual", "DualArithmetic", "with_slope"]


class Dual:
    """value + sum slopes[i] e_i, to first order."""

    __array_ufunc__ = None
    """NumPy's arrays leave arithmetic with duals to the duals."""

    def __init__(self, value: Any, slopes: tuple[Any, ...]) -> None:
        self.value, self.slopes = value, slopes

    def along(self, value: Any, slope: Callable[[Any], Any]) -> Dual:
        """A function of this number: its value, and its slope by each of this one's."""
        return Dual(value, tuple(slope(own) for own in self.slopes))

    def joined(self, other: Dual, value: Any, slope: Callable[[Any, Any], Any]) -> Dual:
        """A function of two numbers: its value, and its slope by each pair of theirs."""
        return Dual(value, tuple(slope(own, its) for own, its in zip(self.slopes, other.slopes, strict=True)))

    def __add__(self, other: Any) -> Dual:
        if isinstance(other, Dual):
            return self.joined(other, self.value + other.value, lambda own, its: own + its)
        return Dual(self.value + other, self.slopes)

    def __neg__(self) -> Dual:
        return self.along(-self.value, lambda own: -own)

    def __sub__(self, other: Any) -> Dual:
        negative: Any = -other
        return self.__add__(negative)

    def __rsub__(self, other: Any) -> Dual:
        return (-self).__add__(other)

    def __mul__(self, other: Any) -> Dual:
        if isinstance(other, Dual):
            value = self.value * other.value
            return self.joined(other, value, lambda own, its: own * other.value + self.value * its)
        return self.along(self.value * other, lambda own: own * other)

    def __truediv__(self, other: Any) -> Dual:
        if isinstance(other, Dual):
            value = self.value / other.value
            return self.joined(other, value, lambda own, its: (own - value * its) / other.value)
        return self.along(self.value / other, lambda own: own / other)

    def __rtruediv__(self, other: Any) -> Dual:
        value = other / self.value
        return self.along(value, lambda own: -value * own / self.value)

    def __pow__(self, power: int) -> Dual:
        return self.along(self.value**power, lambda own: power * self.value ** (power - 1) * own)

    __radd__ = __add__
    __rmul__ = __mul__

    def __gt__(self, other: Any) -> bool:
        return bool(self.value > other)

    def __lt__(self, other: Any) -> bool:
        return bool(self.value < other)

    def __eq__(self, other: object) -> bool:
        return bool(self.value == other)

    def __hash__(self) -> int:
        return hash((self.value, self.slopes))


class DualArithmetic:
    """An arithmetic of duals over the arithmetic ``m``, each with ``width`` slopes."""

    def __init__(self, m: EllipticArithmetic, width: int) -> None:
        self.m, self._width = m, width

    def number(self, value: Fraction) -> Any:
        """A constant needs no slopes."""
        return self.m.number(value)

    def constant(self, value: Any) -> Dual:
        return Dual(value, (self.m.number(Fraction(0)),) * self._width)

    def variable(self, value: Any, place: int) -> Dual:
        """The number whose slope ``place`` is one."""
        slopes = (self.m.number(Fraction(int(i == place))) for i in range(self._width))
        return Dual(value, tuple(slopes))

    def pi(self) -> Any:
        return self.m.pi()

    def _of(self, x: Any, function: Callable[[Any], Any], rate: Callable[[Any, Any], Any]) -> Any:
        """A function of a dual, with rate(x, function(x)) its derivative; of a constant, a constant."""
        if not isinstance(x, Dual):
            return function(x)
        value = function(x.value)
        factor = rate(x.value, value)
        return x.along(value, lambda slope: factor * slope)

    def sin(self, x: Any) -> Any:
        return self._of(x, self.m.sin, lambda a, _: self.m.cos(a))

    def cos(self, x: Any) -> Any:
        return self._of(x, self.m.cos, lambda a, _: -self.m.sin(a))

    def tan(self, x: Any) -> Any:
        return self._of(x, self.m.tan, lambda _, tangent: 1 + tangent * tangent)

    def asin(self, x: Any) -> Any:
        return self._of(x, self.m.asin, lambda a, _: 1 / self.m.sqrt(1 - a * a))

    def acos(self, x: Any) -> Any:
        return self._of(x, self.m.acos, lambda a, _: -1 / self.m.sqrt(1 - a * a))

    def atan(self, x: Any) -> Any:
        return self._of(x, self.m.atan, lambda a, _: 1 / (1 + a * a))

    def sinh(self, x: Any) -> Any:
        return self._of(x, self.m.sinh, lambda a, _: self.m.cosh(a))

    def cosh(self, x: Any) -> Any:
        return self._of(x, self.m.cosh, lambda a, _: self.m.sinh(a))

    def tanh(self, x: Any) -> Any:
        return self._of(x, self.m.tanh, lambda _, tangent: 1 - tangent * tangent)

    def exp(self, x: Any) -> Any:
        return self._of(x, self.m.exp, lambda _, value: value)

    def log(self, x: Any) -> Any:
        return self._of(x, self.m.log, lambda a, _: 1 / a)

    def sqrt(self, x: Any) -> Any:
        return self._of(x, self.m.sqrt, lambda _, root: 1 / (2 * root))

    def power(self, x: Any, exponent: Fraction) -> Any:
        """x to a rational power."""
        factor = self.m.number(exponent)
        return self._of(x, lambda a: self.m.power(a, exponent), lambda a, _: factor * self.m.power(a, exponent - 1))

    def atan2(self, y: Dual, x: Dual) -> Dual:
        norm = y.value * y.value + x.value * x.value
        angle = self.m.atan2(y.value, x.value)
        return y.joined(x, angle, lambda dy, dx: (x.value * dy - y.value * dx) / norm)

    def floor(self, x: Dual) -> Any:
        """A whole number, which small changes leave as it is."""
        return self.m.floor(x.value)

    def elliptic(self, k: Dual, kc: Dual) -> DualElliptic:
        return DualElliptic(self.m.elliptic(k.value, kc.value), k, kc)


def with_slope(m: Any, function: Callable[[Any, Any], Any], x: Any) -> tuple[Any, Any]:
    """function(m, x) and its derivative at x."""
    duals = DualArithmetic(m, 1)
    found = function(duals, duals.variable(x, 0))
    return (found.value, found.slopes[0]) if isinstance(found, Dual) else (found, m.number(Fraction(0)))


class DualElliptic:
    """Jacobi's functions of duals, by their derivatives with respect to u and to the modulus (DLMF 22.13, 19.4).

    With e = E(am u) and X = e - kc^2 u - k^2 sn cn/dn: dsn/dk = -cn dn X/(k kc^2), dcn/dk = sn dn X/(k kc^2),
    ddn/dk = k sn (cn X/kc^2 - sn/dn), de/dk = (e - u)/k - dn^2 X/(k kc^2); de/du = dn^2.
    """

    def __init__(self, base: Any, k: Dual, kc: Dual) -> None:
        self._base, self._k = base, k
        self._kkc = k.value * kc.value**2
        self._kc = kc.value

    @property
    def first(self) -> Dual:
        """K, with dK/dk = (E - kc^2 K)/(k kc^2)."""
        rate = (self._base.second() - self._kc**2 * self._base.first) / self._kkc
        return self._k.along(self._base.first, lambda slope: rate * slope)

    def second(self) -> Dual:
        """E, with dE/dk = (E - K)/k."""
        second = self._base.second()
        rate = (second - self._base.first) / self._k.value
        return self._k.along(second, lambda slope: rate * slope)

    def functions(self, u: Dual) -> tuple[Dual, Dual, Dual]:
        k = self._k.value
        sn, cn, dn, _, x = self._at(u.value)
        return (
            self._moved(u, sn, cn * dn, -cn * dn * x / self._kkc),
            self._moved(u, cn, -sn * dn, sn * dn * x / self._kkc),
            self._moved(u, dn, -k * k * sn * cn, k * sn * (cn * x / self._kc**2 - sn / dn)),
        )

    def epsilon(self, u: Dual) -> Dual:
        """E(am u)."""
        _, _, dn, epsilon, x = self._at(u.value)
        by_k = (epsilon - u.value) / self._k.value - dn * dn * x / self._kkc
        return self._moved(u, epsilon, dn * dn, by_k)

    def _at(self, u: Any) -> tuple[Any, Any, Any, Any, Any]:
        """sn, cn, dn, e and X."""
        k = self._k.value
        sn, cn, dn = self._base.functions(u)
        epsilon = self._base.epsilon(u)
        return sn, cn, dn, epsilon, epsilon - self._kc**2 * u - k * k * sn * cn / dn

    def _moved(self, u: Dual, value: Any, by_u: Any, by_k: Any) -> Dual:
        return u.joined(self._k, value, lambda du, dk: by_u * du + by_k * dk)

    def incomplete(self, phi: Dual) -> Dual:
        """F(phi): only its value is asked for, to count whole turns."""
        return phi.along(self._base.incomplete(phi.value), lambda slope: 0 * slope)
