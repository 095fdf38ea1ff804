"""The expansions once more, from nothing but the solution in elliptic functions: Cauchy's integrals in mpmath.

With K = K(sin(a/2)) and the nome q, T/T0 = 2 K/pi, w^2 l/g = (pi/(2 K))^2, and theta is the Fourier series

    theta = sum_n (-1)^n 8 q^(n+1/2)/((2n+1)(1 + q^(2n+1))) cos((2n+1) w t)

(after DLMF 22.11 for theta = 2 asin(k cd)).  All are analytic in the amplitude a for |a| < pi, so that the trapezoidal
rule on |a| = 1 finds their coefficients with an error of pi^-points.
"""

from __future__ import annotations

import math
from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any

from reference.arithmetic.precision import mp
from reference.arithmetic.quadrature import to_fraction
from reference.problems.pendulum.series import Lindstedt

if TYPE_CHECKING:
    from collections.abc import Callable
    from fractions import Fraction

__all__ = ["lindstedt", "period_series"]

KEPT = 8
"""Orders and precisions for which the work is kept: neighbouring amplitudes ask for the same."""


def period_series(order: int) -> tuple[Fraction, ...]:
    """T/T0 to the working precision, as ``series.period_series`` has it exactly."""
    return _coefficients(order, mp.prec, lambda point: point.period)


def lindstedt(order: int) -> Lindstedt:
    """The solution of Lindstedt and Poincare to the working precision, as ``series.lindstedt`` has it exactly."""
    return _lindstedt(order, mp.prec)


@lru_cache(maxsize=KEPT)
def _lindstedt(order: int, bits: int) -> Lindstedt:
    squares = _coefficients(order, bits, lambda point: point.period**-2)
    by_mode = [_coefficients(order, bits, partial(Point.harmonic, n=n)) for n in range(order + 1)]
    harmonics = tuple({2 * n + 1: by_mode[n][j] for n in range(j + 1)} for j in range(order + 1))
    return Lindstedt(squares, harmonics)


class Point:
    """The solution of one complex amplitude a."""

    def __init__(self, a: Any) -> None:
        square = mp.sin(a / 2) ** 2
        first = mp.ellipk(square)
        self.period = 2 * first / mp.pi
        self.nome = mp.exp(-mp.pi * mp.ellipk(1 - square) / first)
        self.root = mp.sqrt(self.nome / a**2)

    def harmonic(self, n: int) -> Any:
        """The amplitude of cos((2n+1) w t) by a: even in a, as the root of q/a^2 is, which is 1/8 at a = 0."""
        odd = 2 * n + 1
        return (-1) ** n * 8 * self.root * self.nome**n / (odd * (1 + self.nome**odd))


@lru_cache(maxsize=KEPT)
def _circle(count: int, bits: int) -> list[tuple[Any, Point]]:
    """``count`` points on a quarter of the circle |a| = 1, between its ends: the others mirror them."""
    with mp.workprec(bits):
        angles = [mp.pi * (2 * i + 1) / (4 * count) for i in range(count)]
        return [(angle, Point(mp.expj(angle))) for angle in angles]


def _coefficients(order: int, bits: int, function: Callable[[Point], Any]) -> tuple[Fraction, ...]:
    """The coefficients of a^0, a^2, ..., a^(2 order) of an even function that is real for real a."""
    spare = bits + 4 * order + 20
    count = math.ceil((spare / math.log2(math.pi) + 2 * order) / 4)
    with mp.workprec(spare):
        values = [(angle, function(point)) for angle, point in _circle(count, spare)]
        return tuple(
            to_fraction(mp.fsum((value * mp.expj(-2 * j * angle)).real for angle, value in values) / count)
            for j in range(order + 1)
        )
