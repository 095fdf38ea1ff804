"""The order of a method by algebra, with no step taken: the order conditions hold up to it and one fails beyond it.

Rational and algebraic coefficients are held to the conditions exactly; coefficients that are the zero of order
conditions, in balls so narrow that a condition which holds must have its zero inside and one that fails cannot.

The order of a one-step method by its own steps, on the equations that Butcher's trees stand for.

The tree with the subtrees t1, ..., tm at its root stands for y' = y_t1 ... y_tm, from zero.  The solution after h is
h^|t|/gamma(t), and a step of any method whose expansion is one in elementary differentials gives h^|t| times its weight
of the tree: for each tree, an order condition.  Taken in exact numbers, the step proves the order as a table would.

See E. Hairer, C. Lubich and G. Wanner, Geometric Numerical Integration (2006), chapter III.1.
"""

from __future__ import annotations

from fractions import Fraction
from functools import reduce
from math import factorial
from operator import mul
from typing import TYPE_CHECKING, Any

from flint import fmpq

from compare.methods.kinds.one_step import Splitting, Tableau
from compare.methods.kinds.partitioned import Partitioned
from compare.methods.kinds.rosenbrock import Rosenbrock
from compare.methods.order.algebraic import PROOF_BITS, Q, provable, vanishes
from compare.methods.order.lyndon_words import coefficient, lyndon_words, nystrom_words
from compare.methods.order.rooted_trees import ElementaryWeights, density, trees
from reference.arithmetic.precision import ctx
from reference.arithmetic.series import jet

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from compare.methods.kinds.protocol import Method, State
    from compare.methods.order.algebraic import Coefficient
    from compare.methods.order.rooted_trees import Tree

__all__ = [
    "PROOF_BITS",
    "Forest",
    "order_by_assumptions",
    "order_by_steps",
    "order_of_partitioned",
    "order_of_rosenbrock",
    "order_of_splitting",
    "order_of_tableau",
    "proven_order",
]

ALL_TREES = 8
"""Up to this order every tree is tried, 200 in all; beyond it one of each order."""


class Rationals:
    """Exact numbers as an arithmetic: equations of products ask for no functions."""

    @staticmethod
    def number(value: Fraction) -> Fraction:
        return value


class Forest:
    """The equations of some trees, with every subtree of one among them, as a system in exact numbers."""

    positions, initial_invariant, tiny = 0, None, None

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


LIMIT = 12
"""No order is looked for beyond it."""


def proven_order(method: Method) -> int | None:
    """The order that the coefficients of a method have; None where no algebra of this package decides it."""
    if isinstance(method, Tableau):
        return order_of_tableau(method)
    if isinstance(method, Splitting):
        return order_of_splitting(method)
    if isinstance(method, Partitioned):
        return order_of_partitioned(method)
    if isinstance(method, Rosenbrock):
        return order_of_rosenbrock(method)
    own = getattr(method, "proven_order", None)
    return own() if own is not None else None


def order_of_tableau(method: Tableau, b: Sequence[Coefficient] | None = None) -> int:
    """The order of a Runge-Kutta method, or of its stages with other weights, by Butcher's trees."""
    with ctx.workprec(PROOF_BITS):
        values = _quick(provable([*(b or method.b), *(entry for row in method.matrix for entry in row)]))
        size = method.stages
        weights, entries = values[:size], values[size:]
        matrix = [entries[i * size : (i + 1) * size] for i in range(size)]
        found = order_by_assumptions(matrix, weights)
        return found or _largest(lambda order: _tree_residuals((weights,), (matrix,), order))


def _quick(values: list[Any]) -> list[Any]:
    """Fractions as FLINT's, whose arithmetic takes a tenth of the time; other numbers as they are."""
    if all(isinstance(value, (int, Fraction)) for value in values):
        return [fmpq(value.numerator, value.denominator) for value in values]
    return values


def order_by_assumptions(matrix: Sequence[Sequence[Any]], b: Sequence[Any]) -> int | None:
    """The order by Butcher's simplifying assumptions, where they decide it: p of the quadrature, if it is reached.

    B(p): sum_i b_i c_i^(k-1) = 1/k for k <= p;  C(q): sum_j a_ij c_j^(k-1) = c_i^k/k for k <= q;
    D(r): sum_i b_i c_i^(k-1) a_ij = b_j (1 - c_j^k)/k for k <= r.  With p <= q + r + 1 and p <= 2 q + 2 the order is at
    least p, and at most so because B(p + 1) fails (J. C. Butcher 1964, Math. Comp. 18, 50).
    """
    stages = range(len(b))
    c = [_sum(row) for row in matrix]
    powers = [[1] * len(b)]
    for _ in range(2 * len(b)):
        powers.append([value * node for value, node in zip(powers[-1], c, strict=True)])

    def quadrature(k: int) -> bool:
        return vanishes(_sum([b[i] * powers[k - 1][i] for i in stages]) * k - 1)

    def stages_of(k: int) -> bool:
        return all(vanishes(_sum([matrix[i][j] * powers[k - 1][j] for j in stages]) * k - powers[k][i]) for i in stages)

    def columns_of(k: int) -> bool:
        sums = (_sum([b[i] * powers[k - 1][i] * matrix[i][j] for i in stages]) for j in stages)
        return all(vanishes(total * k - b[j] * (1 - powers[k][j])) for j, total in enumerate(sums))

    p, q, r = (
        next(k for k in range(1, 2 * len(b) + 2) if k == 2 * len(b) + 1 or not holds(k)) - 1
        for holds in (quadrature, stages_of, columns_of)
    )
    return p if p <= min(q + r + 1, 2 * q + 2) else None


def _sum(values: Sequence[Any]) -> Any:
    return sum(values[1:], values[0])


def order_of_partitioned(method: Partitioned) -> int:
    """The order of a partitioned Runge-Kutta method, by trees of two colours: for separable systems and all others."""
    return _largest(lambda order: _tree_residuals((method.b, method.b), (method.matrix, method.hat), order))


def order_of_rosenbrock(method: Rosenbrock, m: Sequence[Coefficient] | None = None) -> int:
    """The order of a Rosenbrock method, or of its stages with other weights, by trees.

    The Jacobian stands at the beginning of the step: where a vertex has one branch only its weights are beta_ij,
    elsewhere alpha_ij (E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, 1996, theorem IV.7.4).
    """
    with ctx.workprec(PROOF_BITS):
        slopes, (weights,) = method.slopes(m or method.m)
        elementary = ElementaryWeights(slopes.alpha, alone=slopes.beta)
        return _largest(lambda order: (elementary.weight(weights, tree) * density(tree) - 1 for tree in trees(order)))


def order_of_splitting(method: Splitting) -> int:
    """The order of a splitting, by words; of a palindromic one it is even, so that odd degrees decide it.

    Where the method is made for it, the velocity is taken to be linear in the momenta.
    """
    with ctx.workprec(PROOF_BITS):
        weights = provable([weight for _, weight in method.flows])
        factors = [{kind: weight} for (kind, _), weight in zip(method.flows, weights, strict=True)]
        words = nystrom_words if method.nystrom else lyndon_words

        def residuals(degree: int) -> Iterator[Any]:
            if method.symmetric and degree % 2 == 0:
                return
            for word in words(degree):
                yield coefficient(word, factors) * factorial(degree) - 1

        return _largest(residuals)


def _tree_residuals(weights: Sequence[Sequence[Any]], matrices: Sequence[Any], order: int) -> Iterator[Any]:
    elementary = ElementaryWeights(*matrices)
    for tree in trees(order, len(matrices)):
        yield elementary.weight(weights[tree[0]], tree) * density(tree) - 1


def _largest(residuals: Callable[[int], Iterator[Any]]) -> int:
    """The order up to which all residuals vanish."""
    return next(
        (order - 1 for order in range(1, LIMIT + 1) if not all(vanishes(value) for value in residuals(order))), LIMIT
    )
