"""Expansions of the pendulum's libration in powers of its amplitude, to any order, in exact rational arithmetic.

    T/T0 = 1 + a^2/16 + 11 a^4/3072 + ...,       T0 = 2 pi sqrt(l/g)
    theta(t) = sum_j a^(2j+1) sum_m c[j][m] cos(m w t),   w^2 l/g = 1 - a^2/8 + 7 a^4/1536 - ...

The first is the series of (2/pi) K(sin(a/2)); the second is found by the method of Lindstedt and Poincare (A. H.
Nayfeh, Perturbation Methods, 1973, section 3.1) with theta(0) = a, theta'(0) = 0 in every order.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import comb, factorial
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from reference.arithmetic import EllipticArithmetic

__all__ = ["Lindstedt", "lindstedt", "period_series"]

MAX_ORDER = 200


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
    if isinstance(order, bool) or not isinstance(order, int) or not 0 <= order <= MAX_ORDER:
        raise ValueError(f"order is {order!r}; an integer from 0 to {MAX_ORDER} is accepted.")
    return order


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
        frequency = m.sqrt(_horner(m, self.frequency_squared, square) * g / length)
        waves = max(mode for harmonic in self.harmonics for mode in harmonic)
        cosines = {mode: m.cos(mode * frequency * t) for mode in range(1, waves + 1, 2)}
        total, power = 0, amplitude
        for harmonic in self.harmonics:
            total = total + power * sum(m.number(value) * cosines[mode] for mode, value in harmonic.items())
            power = power * square
        return total


def _horner(m: EllipticArithmetic, coefficients: tuple[Fraction, ...], x: Any) -> Any:
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
    checked(order)
    u: list[Harmonics] = [{1: Fraction(1)}]
    w = [Fraction(1)]
    for j in range(1, order + 1):
        forcing = _sine_part(u, j)
        for i in range(1, j):
            for mode, value in u[j - i].items():
                forcing[mode] = forcing.get(mode, Fraction(0)) - w[i] * mode * mode * value
        w.append(forcing.pop(1, Fraction(0)))
        found = {mode: -value / (1 - mode * mode) for mode, value in forcing.items() if value}
        found[1] = -sum(found.values(), Fraction(0))
        u.append(found)
    return Lindstedt(tuple(w), tuple(u))


def _sine_part(u: list[Harmonics], j: int) -> Harmonics:
    """The coefficient of a^(2j+1) in sin(theta) - theta, theta = sum_i a^(2i+1) u_i with i < j."""
    total: Harmonics = {}
    cube: list[Harmonics] = _times(_times(u, u, j), u, j)
    square, power = _times(u, u, j), cube
    for n in range(1, j + 1):
        sign = Fraction((-1) ** n, factorial(2 * n + 1))
        for mode, value in power[j - n].items():
            total[mode] = total.get(mode, Fraction(0)) + sign * value
        power = _times(power, square, j)
    return total


def _times(a: list[Harmonics], b: list[Harmonics], length: int) -> list[Harmonics]:
    """The first ``length`` coefficients of a product of series whose coefficients are sums of cosines."""
    result: list[Harmonics] = [{} for _ in range(length)]
    for i, left in enumerate(a[:length]):
        for k, right in enumerate(b[: length - i]):
            into = result[i + k]
            for p, x in left.items():
                for q, y in right.items():
                    for mode in (p + q, abs(p - q)):
                        into[mode] = into.get(mode, Fraction(0)) + x * y / 2
    return result
