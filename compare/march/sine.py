"""A sine for lanes of doubles, written in the symbols that heyoka compiles.

A march spends most of its time in the sine.  The vector library that heyoka calls is good to one unit in the last
place and spills every lane around each call; this sine is inlined, takes half the time, and is within two units plus
1e-25 |x| for |x| <= 2^26.  It enters a step times h, so that its last bit is far below the rounding of the state that
it is added to.  It takes longer to compile, and so is for long marches of many lanes.

x is reduced by n pi, n = round(x/pi), with pi in two pieces of which the first is so short that its product with n is
exact (Cody and Waite, Software Manual for the Elementary Functions, 1980); then sin r = r + r^3 P(r^2), |r| <= pi/2.
"""

from __future__ import annotations

from functools import cache
from typing import Any

from reference.arithmetic.compiler import hy
from reference.arithmetic.namespaces import Heyoka
from reference.arithmetic.precision import mp

__all__ = ["LaneArithmetic", "sine"]

TERMS = 8
PIECE_BITS = 27
SHIFTER = 1.5 * 2.0**52
"""(x + SHIFTER) - SHIFTER is x rounded to the nearest integer, for |x| <= 2^51."""


class LaneArithmetic(Heyoka):
    """heyoka's symbols with the sine of this module."""

    def sin(self, x: Any) -> Any:
        return self._of(sine, x)


def sine(x: Any) -> Any:
    """sin x as an expression; not a number or without meaning beyond |x| = 2^51, where n has no room."""
    leading, rest = _pieces_of_pi()
    n = _nearest(x * (1 / leading))
    r = x - n * leading - n * rest
    z = r * r
    s = r + (r * z) * _horner(_coefficients(), z)
    odd = n - 2.0 * _nearest(0.5 * n)
    return s - 2.0 * ((odd * odd) * s)


def _nearest(x: Any) -> Any:
    return (x + SHIFTER) - SHIFTER


def _horner(coefficients: tuple[float, ...], z: Any) -> Any:
    """The polynomial with these coefficients, lowest first."""
    value = hy.expression(coefficients[-1])
    for coefficient in reversed(coefficients[:-1]):
        value = coefficient + z * value
    return value


@cache
def _pieces_of_pi() -> tuple[float, float]:
    """pi as a number of PIECE_BITS bits and the double nearest to the rest."""
    with mp.workprec(200):
        unit = mp.mpf(2) ** (2 - PIECE_BITS)
        leading = mp.nint(mp.pi / unit) * unit
        return float(leading), float(mp.pi - leading)


@cache
def _coefficients() -> tuple[float, ...]:
    """P with sin r = r + r^3 P(r^2), by interpolation at Chebyshev's points of 0 <= r^2 <= (pi/2)^2 to 1.3e-18."""
    with mp.workprec(200):
        points = [(mp.pi**2 / 8) * (1 + mp.cos(mp.pi * (2 * k + 1) / (2 * TERMS))) for k in range(TERMS)]
        powers = mp.matrix([[z**j for j in range(TERMS)] for z in points])
        values = mp.matrix([(mp.sinc(mp.sqrt(z)) - 1) / z for z in points])
        return tuple(float(coefficient) for coefficient in mp.lu_solve(powers, values))
