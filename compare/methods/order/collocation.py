"""Collocation methods: everything follows from the nodes, the zeros of a polynomial with rational coefficients.

c_i are the zeros,  a_ij = integral of l_j from 0 to c_i,  b_j = integral of l_j from 0 to 1,  l_j the polynomial of
Lagrange that is 1 at c_j and 0 at the other nodes.  A node that is rational is exact, the others are enclosed to any
precision.  See E. Hairer, S. P. Nørsett and G. Wanner, Solving Ordinary Differential Equations I (1993), section II.7.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import comb
from typing import TYPE_CHECKING, Any

from flint import arb, arb_poly, fmpz_poly

from compare.methods.order.certified_roots import GUARD_BITS, Linear
from reference.arithmetic.precision import ctx

if TYPE_CHECKING:
    from compare.methods.order.algebraic import Coefficient

__all__ = ["Collocation", "legendre"]

NODE_BITS = 128


def legendre(degree: int) -> tuple[int, ...]:
    """Legendre's polynomial moved to [0, 1], its integer coefficients with the constant first."""
    return tuple((-1) ** (degree + k) * comb(degree, k) * comb(degree + k, k) for k in range(degree + 1))


@dataclass(frozen=True)
class Collocation:
    """The collocation method on the zeros of a polynomial.

    Attributes:
        name: of the method.
        polynomial: integer coefficients, the constant first; all zeros are real, simple and in [0, 1].
    """

    name: str
    polynomial: tuple[int, ...]

    @property
    def stages(self) -> int:
        return len(self.polynomial) - 1

    def enclosures(self) -> list[arb]:
        """Balls around the nodes, the entries of the matrix row after row, and the weights."""
        return _enclosures(self.polynomial, ctx.prec)

    def table(self) -> tuple[tuple[tuple[Coefficient, ...], ...], tuple[Coefficient, ...]]:
        """The matrix and the weights: rows sum exactly to the nodes, and weights to 1."""
        size = self.stages
        nodes = [self._node(i) for i in range(size)]
        rows = tuple(
            self._row(node, size + size * i) if node != 0 else (Fraction(0),) * size for i, node in enumerate(nodes)
        )
        return rows, self._row(Fraction(1), size + size * size)

    def _row(self, total: Any, first: int) -> tuple[Coefficient, ...]:
        """Coordinates from a place on, the last of them what is left of their sum."""
        known = [Linear(self, {first + j: Fraction(1)}) for j in range(self.stages - 1)]
        return (*known, total - sum(known[1:], known[0]))

    def _node(self, place: int) -> Coefficient:
        """The node, as a fraction where it is one."""
        for factor, _ in fmpz_poly(list(self.polynomial)).factor()[1]:
            if factor.degree() == 1:
                value = Fraction(-int(factor[0]), int(factor[1]))
                if _nodes(self.polynomial, NODE_BITS)[place].contains(arb(value.numerator) / value.denominator):
                    return value
        return Linear(self, {place: Fraction(1)})


@lru_cache(maxsize=64)
def _enclosures(polynomial: tuple[int, ...], bits: int) -> list[arb]:
    with ctx.workprec(bits + GUARD_BITS):
        nodes = _nodes(polynomial, ctx.prec)
        primitives = [_lagrange(nodes, j).integral() for j in range(len(nodes))]
        return [*nodes, *(primitive(end) for end in (*nodes, arb(1)) for primitive in primitives)]


@lru_cache(maxsize=64)
def _nodes(polynomial: tuple[int, ...], bits: int) -> list[arb]:
    """The zeros in order, apart from each other."""
    with ctx.workprec(bits):
        return sorted((value.real for value, _ in fmpz_poly(list(polynomial)).complex_roots()), key=float)


def _lagrange(nodes: list[arb], place: int) -> arb_poly:
    """The polynomial that is 1 at one node and 0 at the others."""
    found = arb_poly([1])
    for k, node in enumerate(nodes):
        if k != place:
            scale = 1 / (nodes[place] - node)
            found = found * arb_poly([-node * scale, scale])
    return found
