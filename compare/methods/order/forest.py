"""The order of a one-step method by its own steps, on the equations that Butcher's trees stand for.

The tree with the subtrees t1, ..., tm at its root stands for y' = y_t1 ... y_tm, from zero.  The solution after h is
h^|t|/gamma(t), and a step of any method whose expansion is one in elementary differentials gives h^|t| times its weight
of the tree: for each tree, an order condition.  Taken in exact numbers, the step proves the order as a table would.

See E. Hairer, C. Lubich and G. Wanner, Geometric Numerical Integration (2006), chapter III.1.
"""

from __future__ import annotations

from functools import reduce
from operator import mul
from typing import TYPE_CHECKING, Any

from compare.methods.order.algebraic import Q
from compare.methods.order.rooted_trees import density, trees
from reference.arithmetic.series import jet

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction

    from compare.methods.kinds.protocol import Method, State
    from compare.methods.order.rooted_trees import Tree

__all__ = ["Forest", "order_by_steps"]

ALL_TREES = 8
"""Up to this order every tree is tried, 200 in all; beyond it one of each order."""


class Rationals:
    """Exact numbers as an arithmetic: equations of products ask for no functions."""

    @staticmethod
    def number(value: Fraction) -> Fraction:
        return value


class Forest:
    """The equations of some trees, with every subtree of one among them, as a system in exact numbers."""

    positions, level, tiny = 0, None, None

    def __init__(self, known: Sequence[Tree]) -> None:
        self.dimension = len(known)
        self._places = {tree: i for i, tree in enumerate(known)}

    def number(self, value: Any) -> Any:
        return value

    def derivative(self, y: State) -> State:
        return tuple(self._products(y))

    def jet(self, y: State, order: int) -> list[State]:
        arithmetic: Any = Rationals()
        return jet(arithmetic, lambda _, series: self._products(series), y, order)

    def _products(self, y: Sequence[Any]) -> list[Any]:
        factors = ([y[self._places[subtree]] for subtree in subtrees] for _, subtrees in self._places)
        return [reduce(mul, some) if some else Q(1) for some in factors]


def order_by_steps(method: Method) -> int:
    """The order of an explicit method without a memory: one less than that of the first tree that it fails.

    Beyond ALL_TREES a tree of each order is enough for a method that multiplies the product of the subtrees' weights by
    a number that depends on the order alone, as Taylor's does, since f of a series has that product for its weight.
    """
    bushes = ((order, (0, ((0, ()),) * (order - 1))) for order in range(ALL_TREES + 1, method.order + 2))
    known = [(order, tree) for order in range(1, ALL_TREES + 1) for tree in trees(order)] + list(bushes)
    forest: Any = Forest([tree for _, tree in known])
    y, _ = method.step(forest, (Q(0),) * len(known), Q(1))
    failed = [order for (order, tree), weight in zip(known, y, strict=True) if weight * density(tree) != 1]
    return min(failed, default=method.order + 2) - 1
