"""The order of a method by algebra: exact, with no step taken.

Runge-Kutta methods by Butcher's rooted trees, sum_i b_i Phi_i(t) = 1/gamma(t); splittings by comparing the product of
exponentials with exp(h(A + B)) in the free associative algebra of A and B, word by word.
See E. Hairer, C. Lubich and G. Wanner, Geometric Numerical Integration (2006), chapters III.1 and III.5.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from itertools import product
from math import factorial, prod
from typing import TYPE_CHECKING, TypeAlias

from compare.algebraic import Coefficient, Q

if TYPE_CHECKING:
    from compare.method import Splitting, Tableau

__all__ = ["order_of_splitting", "order_of_tableau", "trees"]

Tree: TypeAlias = tuple["Tree", ...]
"""A rooted tree: the sorted tuple of the subtrees at its root."""


@cache
def trees(order: int) -> tuple[Tree, ...]:
    """Every rooted tree with ``order`` vertices: 1, 1, 2, 4, 9, 20, ... of them."""
    return tuple(sorted(_forests(order - 1, order - 1)))


@cache
def _forests(vertices: int, largest: int) -> tuple[Tree, ...]:
    """Every multiset of trees with ``vertices`` vertices in all, none of more than ``largest``."""
    if vertices == 0:
        return ((),)
    found = set()
    for size in range(1, min(vertices, largest) + 1):
        for tree, rest in product(trees(size), _forests(vertices - size, size)):
            found.add(tuple(sorted((tree, *rest))))
    return tuple(found)


def _vertices(tree: Tree) -> int:
    return 1 + sum(_vertices(subtree) for subtree in tree)


def _density(tree: Tree) -> int:
    """gamma(t): the product over all vertices of the size of the subtree above."""
    return _vertices(tree) * prod(_density(subtree) for subtree in tree)


def _weights(method: Tableau, tree: Tree) -> list[Coefficient]:
    """The stage values of the elementary weight: Phi_i(t) = product over subtrees of sum_j a_ij Phi_j."""
    values: list[Coefficient] = [Q(1)] * method.stages
    for subtree in tree:
        inner = _weights(method, subtree)
        sums = [sum((a * w for a, w in zip(row, inner, strict=True)), Q(0)) for row in method.matrix]
        values = [value * total for value, total in zip(values, sums, strict=True)]
    return values


def order_of_tableau(method: Tableau, limit: int = 12) -> int:
    """The largest p <= limit for which every order condition of every tree up to p vertices holds exactly."""
    for order in range(1, limit + 1):
        for tree in trees(order):
            weight = sum((b * w for b, w in zip(method.b, _weights(method, tree), strict=True)), Q(0))
            if weight != Fraction(1, _density(tree)):
                return order - 1
    return limit


Series: TypeAlias = dict[tuple[str, ...], Coefficient]


def _times_exponential(series: Series, letter: str, weight: Coefficient, degree: int) -> Series:
    """series * exp(weight letter), truncated after words of ``degree`` letters."""
    result: Series = {}
    for word, coefficient in series.items():
        term: Coefficient = coefficient
        for power in range(degree - len(word) + 1):
            term = coefficient if power == 0 else term * weight / power
            extended = word + (letter,) * power
            result[extended] = result.get(extended, Q(0)) + term
    return result


def order_of_splitting(method: Splitting, limit: int = 8) -> int:
    """The largest p <= limit for which every word of up to p letters has the coefficient of exp(A + B) exactly."""
    for degree in range(1, limit + 1):
        series: Series = {(): Q(1)}
        for letter, weight in method.flows:
            series = _times_exponential(series, letter, weight, degree)
        if any(
            series.get(word, Q(0)) != Fraction(1, factorial(degree))
            for word in product(("kick", "drift"), repeat=degree)
        ):
            return degree - 1
    return limit
