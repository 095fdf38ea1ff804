"""The order of a method by algebra, with no step taken: the order conditions hold up to it and one fails beyond it.

Rational and algebraic coefficients are held to the conditions exactly; coefficients that are the zero of order
conditions, in balls so narrow that a condition which holds must have its zero inside and one that fails cannot.
Decimals as printed miss the conditions: these are held to what the method declares that they miss at most.

The order of a one-step method by its own steps, on the equations that Butcher's trees stand for.

The tree with the subtrees t1, ..., tm at its root stands for y' = y_t1 ... y_tm, from zero.  The solution after h is
h^|t|/gamma(t), and a step of any method whose expansion is one in elementary differentials gives h^|t| times its weight
of the tree: for each tree, an order condition.  Taken in exact numbers, the step proves the order as a table would.

See E. Hairer, C. Lubich and G. Wanner, Geometric Numerical Integration (2006), chapter III.1.
"""

from __future__ import annotations

from fractions import Fraction
from functools import cache, lru_cache, reduce
from math import factorial
from operator import mul
from typing import TYPE_CHECKING, Any

from flint import arb, fmpq

from compare.methods.kinds.one_step import EXACT, Splitting, Tableau
from compare.methods.kinds.partitioned import Partitioned
from compare.methods.order.algebraic import Q, enclose
from compare.methods.order.certified_roots import Linear
from compare.methods.order.lyndon_words import coefficient, lyndon_words, nystrom_words
from compare.methods.order.rooted_trees import ElementaryWeights, density, trees
from compare.methods.order.stage_vectors import StageVectors
from reference.arithmetic.precision import PrecisionError, ctx
from reference.arithmetic.series import jet

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from compare.methods.kinds.protocol import Method, State
    from compare.methods.order.algebraic import Coefficient
    from compare.methods.order.rooted_trees import Tree

__all__ = [
    "PROOF_BITS",
    "Forest",
    "order_by_steps",
    "order_of_partitioned",
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


PROOF_BITS = 300
NARROW_BITS = 100
"""A residual that is zero is known to be smaller than 2^-NARROW_BITS; one that is not is far larger."""
LIMIT = 16
"""No order is looked for beyond it."""


def proven_order(method: Method) -> int | None:
    """The order that the coefficients of a method have; None where no algebra of this package decides it."""
    if isinstance(method, Tableau):
        return order_of_tableau(method)
    if isinstance(method, Splitting):
        return order_of_splitting(method)
    if isinstance(method, Partitioned):
        return order_of_partitioned(method)
    own = getattr(method, "proven_order", None)
    return own() if own is not None else None


@cache
def order_of_tableau(method: Tableau, b: tuple[Coefficient, ...] | None = None) -> int:
    """The order of a Runge-Kutta method, or of its stages with other weights, by Butcher's trees."""
    weights = b or method.b
    number = _arithmetic([*weights, *(entry for row in method.matrix for entry in row)], method.residual)
    with ctx.workprec(PROOF_BITS):
        numbers, vectors = list(map(number, weights)), _stage_vectors(method, number)
        return _largest(lambda order: vectors.residuals(numbers, order), method.residual)


@lru_cache(maxsize=1)
def _stage_vectors(method: Tableau, number: Callable[[Coefficient], Any]) -> StageVectors:
    """Of the method that was asked for last: they serve its embedded weights too."""
    return StageVectors([list(map(number, row)) for row in method.matrix])


def order_of_partitioned(method: Partitioned) -> int:
    """The order of a partitioned Runge-Kutta method, by trees of two colours: for separable systems and all others."""
    return _largest(lambda order: _tree_residuals((method.b, method.b), (method.matrix, method.hat), order))


def order_of_splitting(method: Splitting) -> int:
    """The order of a splitting, by words; of a palindromic one it is even, so that odd degrees decide it.

    Where the method is made for it, the velocity is taken to be linear in the momenta.
    """
    with ctx.workprec(PROOF_BITS):
        weights = _numbers([weight for _, weight in method.flows])
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


def _largest(residuals: Callable[[int], Iterator[Any]], most: Fraction = EXACT) -> int:
    """The order up to which all residuals vanish, or are ``most`` at most."""
    bound = enclose(most) if most else None
    orders = range(1, LIMIT + 1)
    return next((k - 1 for k in orders if not all(_vanishes(value, bound) for value in residuals(k))), LIMIT)


def _vanishes(value: Any, bound: arb | None) -> bool:
    """Whether a residual is zero, or where there is a bound below it.

    Raises:
        PrecisionError: its ball is too wide to tell.
    """
    if not isinstance(value, arb):
        return bool(value == 0)
    if bound is not None:
        size = abs(value)
        if not (size < bound or size > bound):
            raise PrecisionError("a condition of order was met in balls too wide to decide it.")
        return bool(size < bound)
    if value.contains(0) and not value.rad() < arb(2) ** -NARROW_BITS:
        raise PrecisionError("a condition of order was met in balls too wide to decide it.")
    return bool(value.contains(0))


def _numbers(coefficients: Sequence[Coefficient]) -> list[Any]:
    return list(map(_arithmetic(coefficients), coefficients))


def _arithmetic(coefficients: Sequence[Coefficient], most: Fraction = EXACT) -> Callable[[Coefficient], Any]:
    """What makes numbers of coefficients: exact ones; balls where they have no exact form, or miss the conditions."""
    kinds = {type(value) for value in coefficients}
    if most or Linear in kinds:
        return _ball
    return _rational if kinds <= {int, Fraction} else _as_it_is


def _ball(value: Coefficient) -> Any:
    return 0 if value == 0 else enclose(value)


def _rational(value: Any) -> fmpq:
    return fmpq(value.numerator, value.denominator)


def _as_it_is(value: Coefficient) -> Any:
    return value
