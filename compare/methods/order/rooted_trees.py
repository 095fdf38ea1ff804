"""Butcher's rooted trees, in one colour or, for partitioned methods, in two: sum_i b_i Phi_i(t) = 1/gamma(t) for each.

See E. Hairer, C. Lubich and G. Wanner, Geometric Numerical Integration (2006), chapter III.
"""

from __future__ import annotations

from functools import cache
from itertools import product
from math import prod
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["ElementaryWeights", "Tree", "density", "trees"]

Tree: TypeAlias = tuple[int, tuple["Tree", ...]]
"""A rooted tree: the colour of its root and the sorted subtrees there."""


@cache
def trees(order: int, colours: int = 1) -> tuple[Tree, ...]:
    """Every rooted tree with ``order`` vertices: 1, 1, 2, 4, 9, 20, ... of them in one colour, 2, 4, 14, ... in two."""
    forests = _forests(order - 1, order - 1, colours)
    return tuple(sorted((colour, forest) for colour in range(colours) for forest in forests))


@cache
def _forests(vertices: int, largest: int, colours: int) -> tuple[tuple[Tree, ...], ...]:
    """Every multiset of trees with ``vertices`` vertices in all, none of more than ``largest``."""
    if vertices == 0:
        return ((),)
    found = set()
    for size in range(1, min(vertices, largest) + 1):
        for tree, rest in product(trees(size, colours), _forests(vertices - size, size, colours)):
            found.add(tuple(sorted((tree, *rest))))
    return tuple(found)


def _vertices(tree: Tree) -> int:
    return 1 + sum(_vertices(subtree) for subtree in tree[1])


def density(tree: Tree) -> int:
    """gamma(t): the product over all vertices of the size of the subtree above."""
    return _vertices(tree) * prod(density(subtree) for subtree in tree[1])


class ElementaryWeights:
    """The elementary weights of a Runge-Kutta method, or of a partitioned one with a matrix for each colour.

    The numbers are of any arithmetic that mixes with integers; what is 0 is left out of the sums.  A Rosenbrock method
    has another matrix for a branch that is ``alone`` at its vertex.
    """

    def __init__(self, *matrices: Sequence[Sequence[Any]], alone: Sequence[Sequence[Any]] | None = None) -> None:
        self._rows = list(map(_entries, matrices))
        self._alone = self._rows if alone is None else [_entries(alone)]
        self._sums: dict[tuple[Tree, bool], list[Any]] = {}

    def stages(self, tree: Tree) -> list[Any]:
        """Phi_i(t): the product over the subtrees u at the root of sum_j a_ij Phi_j(u)."""
        values: list[Any] = [1] * len(self._rows[0])
        single = len(tree[1]) == 1 and self._alone is not self._rows
        for subtree in tree[1]:
            if (subtree, single) not in self._sums:
                inner = self.stages(subtree)
                rows = (self._alone if single else self._rows)[subtree[0]]
                sums = [sum((a * inner[j] for j, a in row[1:]), _first(row, inner)) for row in rows]
                self._sums[subtree, single] = sums
            values = [value * total for value, total in zip(values, self._sums[subtree, single], strict=True)]
        return values

    def weight(self, b: Sequence[Any], tree: Tree) -> Any:
        """sum_i b_i Phi_i(t)."""
        return sum(weight * phi for weight, phi in zip(b, self.stages(tree), strict=True))


def _entries(matrix: Sequence[Sequence[Any]]) -> list[list[tuple[int, Any]]]:
    return [[(j, a) for j, a in enumerate(row) if a != 0] for row in matrix]


def _first(row: Sequence[tuple[int, Any]], inner: Sequence[Any]) -> Any:
    return row[0][1] * inner[row[0][0]] if row else 0
