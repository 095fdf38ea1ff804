"""Nystrom's trees, of q'' = F(q): sum_i b_i Phi_i(t) = 1/gamma(t) for the momenta, and the like for the positions.

A vertex stands for a force.  From it go leaves, for velocities, and subtrees, for forces that have moved its place.
See E. Hairer, S. P. Norsett and G. Wanner, Solving Ordinary Differential Equations I (1993), section II.14.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from math import prod
from typing import TYPE_CHECKING, Any, TypeAlias

from flint import fmpq

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["NystromTree", "NystromWeights", "nystrom_density", "nystrom_trees"]

NystromTree: TypeAlias = tuple[int, tuple["NystromTree", ...]]
"""How many velocities the force at the root has, and the sorted subtrees there."""


@cache
def nystrom_trees(order: int) -> tuple[NystromTree, ...]:
    """Every tree whose part of the momenta goes with h^order: 1, 1, 2, 3, 6, 10, 20, 36, 72, 137, ... of them."""
    if order < 1:
        return ()
    found = [(velocities, forest) for velocities in range(order) for forest in _forests(order - 1 - velocities, order)]
    return tuple(sorted(found))


@cache
def _forests(size: int, largest: int) -> tuple[tuple[NystromTree, ...], ...]:
    """Every multiset of trees whose orders, one added to each, sum to ``size``, none of an order above ``largest``."""
    if size == 0:
        return ((),)
    found = set()
    for order in range(1, min(size - 1, largest) + 1):
        for tree in nystrom_trees(order):
            for rest in _forests(size - order - 1, order):
                found.add(tuple(sorted((tree, *rest))))
    return tuple(found)


def _order(tree: NystromTree) -> int:
    velocities, subtrees = tree
    return 1 + velocities + sum(_order(subtree) + 1 for subtree in subtrees)


@cache
def nystrom_density(tree: NystromTree) -> int:
    """gamma(t): the order times that of each subtree, which is integrated once more, and so on above."""
    _, subtrees = tree
    return _order(tree) * prod(nystrom_density(subtree) * (_order(subtree) + 1) for subtree in subtrees)


class NystromWeights:
    """The elementary weights of a Runge-Kutta-Nystrom method, whose nodes and matrix are of any arithmetic."""

    def __init__(self, nodes: Sequence[Any], matrix: Sequence[Sequence[Any]]) -> None:
        self._nodes = list(map(_fast, nodes))
        self._rows = [[(j, _fast(a)) for j, a in enumerate(row) if a != 0] for row in matrix]
        self._stages: dict[NystromTree, list[Any]] = {}

    def weight(self, b: Sequence[Any], tree: NystromTree) -> Any:
        """sum_i b_i Phi_i(t)."""
        terms = [_fast(weight) * phi for weight, phi in zip(b, self._phi(tree), strict=True) if weight != 0]
        return sum(terms[1:], terms[0])

    def _phi(self, tree: NystromTree) -> list[Any]:
        """Phi_i(t): c_i to the number of velocities, times sum_j a_ij Phi_j(u) for each subtree u."""
        if tree not in self._stages:
            velocities, subtrees = tree
            values: list[Any] = [node**velocities for node in self._nodes]
            for subtree in subtrees:
                inner = self._phi(subtree)
                moved = [sum(a * inner[j] for j, a in row) for row in self._rows]
                values = [value * place for value, place in zip(values, moved, strict=True)]
            self._stages[tree] = values
        return self._stages[tree]


def _fast(value: Any) -> Any:
    """A rational as FLINT's, whose long numerators it multiplies many times as fast."""
    return fmpq(value.numerator, value.denominator) if isinstance(value, (int, Fraction)) else value
