"""Expansions of the pendulum's libration in powers of its amplitude, to any order, in exact rational arithmetic.

    T/T0 = 1 + a^2/16 + 11 a^4/3072 + ...,       T0 = 2 pi sqrt(l/g)
    theta(t) = sum_j a^(2j+1) sum_m c[j][m] cos(m w t),   w^2 l/g = 1 - a^2/8 + 7 a^4/1536 - ...

The first is the series of (2/pi) K(sin(a/2)); the second is found by the method of Lindstedt and Poincare (A. H.
Nayfeh, Perturbation Methods, 1973, section 3.1) with theta(0) = a, theta'(0) = 0 in every order.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from math import comb, factorial
from typing import TYPE_CHECKING, Any

from flint import fmpq, fmpq_poly

from reference.arithmetic.exact import counted

if TYPE_CHECKING:
    from reference.arithmetic.protocols import EllipticArithmetic

__all__ = ["Lindstedt", "lindstedt", "period_series", "polynomial"]

MAX_ORDER = 100
"""In a second or two; each doubling takes some thirty times as long."""


def period_series(order: int) -> tuple[Fraction, ...]:
    """The coefficients of a^0, a^2, ..., a^(2 order) in T/T0.

    Raises:
        ValueError: ``order`` is not an integer from 0 to MAX_ORDER.
    """
    checked(order)
    modulus = [Fraction(0)] + [Fraction((-1) ** (j + 1), 2 * factorial(2 * j)) for j in range(1, order + 1)]
    power, total = [Fraction(1)] + [Fraction(0)] * order, [Fraction(0)] * (order + 1)
    for n in range(order + 1):
        weight = Fraction(comb(2 * n, n), 4**n) ** 2
        total = [sum_ + weight * term for sum_, term in zip(total, power, strict=True)]
        power = _product(power, modulus)
    return tuple(total)


def _product(a: list[Fraction], b: list[Fraction]) -> list[Fraction]:
    """The product of two truncated series."""
    return [sum((a[i] * b[n - i] for i in range(n + 1)), Fraction(0)) for n in range(len(a))]


def checked(order: Any) -> int:
    """``order``, if it is one that is served."""
    return counted(order, "order", MAX_ORDER)


Harmonics = dict[int, Fraction]
"""c[m] of sum_m c[m] cos(m x), m >= 0."""


@dataclass(frozen=True)
class Lindstedt:
    """The solution of Lindstedt and Poincare to one order.

    Attributes:
        frequency_squared: the coefficients of a^0, a^2, ... in w^2 l/g.
        harmonics: for a^1, a^3, ... the coefficients c[m] of cos(m w t).
    """

    frequency_squared: tuple[Fraction, ...]
    harmonics: tuple[Harmonics, ...]

    def angle(self, m: EllipticArithmetic, amplitude: Any, g: Any, length: Any, t: Any) -> Any:
        """theta at t in an arithmetic: rad, for t in s, amplitude in rad, g in m/s^2, length in m."""
        square = amplitude * amplitude
        frequency = m.sqrt(polynomial(m, self.frequency_squared, square) * g / length)
        waves = max(mode for harmonic in self.harmonics for mode in harmonic)
        cosines = {mode: m.cos(mode * frequency * t) for mode in range(1, waves + 1, 2)}
        total, power = 0, amplitude
        for harmonic in self.harmonics:
            total = total + power * sum(m.number(value) * cosines[mode] for mode, value in harmonic.items())
            power = power * square
        return total


def polynomial(m: EllipticArithmetic, coefficients: tuple[Fraction, ...], x: Any) -> Any:
    """sum_j coefficients[j] x^j in an arithmetic."""
    value = m.number(coefficients[-1])
    for coefficient in reversed(coefficients[:-1]):
        value = value * x + m.number(coefficient)
    return value


def lindstedt(order: int) -> Lindstedt:
    """The solution up to a^(2 order + 1), with the frequency up to a^(2 order).

    In order j the unknowns are u_j = sum_m c[j][m] cos(m x) and W_j of W = w^2 l/g = 1 + sum_j W_j a^(2j):
    u_j'' + u_j = -(all that earlier orders give) - W_j u_0''.  W_j removes the resonant cos x, each other cos(m x) is
    divided by 1 - m^2, and cos x is added so that u_j(0) = 0.

    Raises:
        ValueError: ``order`` is not an integer from 0 to MAX_ORDER.
    """
    return _lindstedt(checked(order))


@cache
def _lindstedt(order: int) -> Lindstedt:
    sines, w = Sines(), [fmpq(1)]
    bent = [_bent(sines.angle[0])]
    for j in range(1, order + 1):
        forcing = sum((w[i] * bent[j - i] * Z_SQUARED**i for i in range(1, j)), sines.earlier())
        resonant = forcing[j + 1]
        w.append(2 * resonant)
        found = [fmpq(0) if abs(m) == 1 else -forcing[i] / (1 - m * m) for i, m in _modes(j)]
        found[j] = found[j + 1] = -sum(found, fmpq(0)) / 2
        sines.add(fmpq_poly(found))
        bent.append(_bent(sines.angle[j]))
    return Lindstedt(tuple(map(_fraction, w)), tuple(_harmonics(j, u) for j, u in enumerate(sines.angle)))


Z_SQUARED = fmpq_poly([0, 1])


class Sines:
    """sin(theta) and cos(theta) of theta = sum_j a^(2j+1) u_j, coefficient by coefficient, u_0 = cos x.

    By d(sin theta)/da = cos(theta) dtheta/da and d(cos theta)/da = -sin(theta) dtheta/da.  A coefficient of a^n is a
    sum of cosines (z^m + z^-m)/2, z = exp(i x), m <= n of n's parity: here z^n times it, as a polynomial in z^2.
    """

    def __init__(self) -> None:
        start = fmpq_poly([fmpq(1, 2), fmpq(1, 2)])
        self.angle, self.sine, self.cosine = [start], [start], [fmpq_poly([1])]

    def earlier(self) -> fmpq_poly:
        """The next coefficient of sin(theta) without the next one of theta."""
        j = len(self.angle)
        self.cosine.append(self._convolved(self.sine, j - 1) * fmpq(-1, 2 * j))
        self._earlier = self._convolved(self.cosine, j) * fmpq(1, 2 * j + 1)
        return self._earlier

    def add(self, angle: fmpq_poly) -> None:
        """Take the next coefficient of theta."""
        self.angle.append(angle)
        self.sine.append(self._earlier + angle)

    def _convolved(self, factor: list[fmpq_poly], last: int) -> fmpq_poly:
        """Of dtheta/da and a factor: sum_k (2k+1) u_k factor[last - k] over the u_k that are known."""
        known = enumerate(self.angle[: last + 1])
        return sum(((2 * k + 1) * u * factor[last - k] for k, u in known), fmpq_poly([0]))


def _modes(j: int) -> list[tuple[int, int]]:
    """The places in a coefficient of a^(2j+1) and the m of z^m that stands there."""
    return list(enumerate(range(-(2 * j + 1), 2 * j + 2, 2)))


def _bent(u: fmpq_poly) -> fmpq_poly:
    """The second derivative by x."""
    return fmpq_poly([-m * m * u[i] for i, m in _modes(u.degree() // 2)])


def _harmonics(j: int, u: fmpq_poly) -> Harmonics:
    return {m: _fraction(2 * u[i]) for i, m in _modes(j) if m > 0 and u[i] != 0}


def _fraction(value: fmpq) -> Fraction:
    return Fraction(int(value.p), int(value.q))
