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
from functools import cache, lru_cache, partial, reduce
from math import factorial
from operator import mul
from typing import TYPE_CHECKING, Any

from flint import fmpq

from compare.methods.kinds.nystrom import RungeKuttaNystrom
from compare.methods.kinds.one_step import Splitting, Tableau
from compare.methods.kinds.partitioned import Partitioned
from compare.methods.kinds.rosenbrock import Rosenbrock
from compare.methods.order.algebraic import EXACT, PROOF_BITS, Algebraic, Q, enclose, vanishes
from compare.methods.order.lyndon_words import (
    KICK,
    coefficient,
    exponent,
    lyndon_words,
    necessary_nystrom_words,
    nystrom_words,
)
from compare.methods.order.nystrom_trees import NystromWeights, nystrom_density, nystrom_trees
from compare.methods.order.rooted_trees import ElementaryWeights, density, trees
from compare.methods.order.stage_vectors import StageVectors
from reference.arithmetic.precision import ctx
from reference.arithmetic.series import jet

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from compare.methods.kinds.nystrom import EmbeddedNystrom
    from compare.methods.kinds.protocol import Method, State
    from compare.methods.order.algebraic import Coefficient
    from compare.methods.order.lyndon_words import Word
    from compare.methods.order.rooted_trees import Tree

__all__ = [
    "PROOF_BITS",
    "Forest",
    "generalised_order",
    "order_by_assumptions",
    "order_by_steps",
    "order_of_nystrom",
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


LIMIT = 16
"""No order is looked for beyond it."""
SMALL_KICKS = 3
"""Words with fewer kicks are the same for velocities that are linear in the momenta and for others."""


def proven_order(method: Method) -> int | None:
    """The order that the coefficients of a method have; None where no algebra of this package decides it."""
    if isinstance(method, Tableau):
        return order_of_tableau(method)
    if isinstance(method, Splitting):
        return order_of_splitting(method)
    if isinstance(method, Partitioned):
        return order_of_partitioned(method)
    if isinstance(method, RungeKuttaNystrom):
        return order_of_nystrom(method)
    if isinstance(method, Rosenbrock):
        return order_of_rosenbrock(method)
    own = getattr(method, "proven_order", None)
    return own() if own is not None else None


@cache
def order_of_tableau(method: Tableau, b: tuple[Coefficient, ...] | None = None) -> int:
    """The order of a Runge-Kutta method, or of its stages with other weights, by Butcher's trees."""
    weights = b or method.b
    number = _arithmetic([*weights, *(entry for row in method.matrix for entry in row)], method.residual)
    with ctx.workprec(PROOF_BITS):
        numbers, vectors = list(map(number, weights)), _stage_vectors(method, number)
        if not method.residual and (found := order_by_assumptions(vectors.matrix, numbers)) is not None:
            return found
        return _largest(lambda order: vectors.residuals(numbers, order), method.residual)


@lru_cache(maxsize=1)
def _stage_vectors(method: Tableau, number: Callable[[Coefficient], Any]) -> StageVectors:
    """Of the method that was asked for last: they serve its embedded weights too."""
    return StageVectors([list(map(number, row)) for row in method.matrix])


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
        return _largest(partial(_word_residuals, method, _exponents(method), range(LIMIT + 1)))


def generalised_order(method: Splitting) -> tuple[int, ...]:
    """The orders of a splitting where its kicks are small, one for each power of them that it states, the last for all.

    A word with k kicks is a part of the error with the power epsilon^k.
    """
    with ctx.workprec(PROOF_BITS):
        factors, stated = _exponents(method), range(1, len(method.generalised) + 1)
        kicks = [range(k, LIMIT + 1) if k == len(stated) else range(k, k + 1) for k in stated]
        return tuple(_largest(partial(_word_residuals, method, factors, some)) for some in kicks)


def _exponents(method: Splitting) -> list[dict[Word, Any]]:
    weights = _numbers([weight for _, weight in method.flows])
    return [exponent(kind, weight) for (kind, _), weight in zip(method.flows, weights, strict=True)]


def _word_residuals(method: Splitting, factors: Sequence[dict[Word, Any]], kicks: range, degree: int) -> Iterator[Any]:
    """Of the words of a degree that have so many kicks; with two or fewer, Nystrom's words are all."""
    if method.symmetric and degree % 2 == 0:
        return
    reduced = method.nystrom and kicks.stop > SMALL_KICKS
    words = necessary_nystrom_words(degree)[0] if reduced else lyndon_words(degree)
    for word in words:
        if word.count(KICK) in kicks:
            yield coefficient(word, factors) * factorial(degree) - 1
    if reduced:
        nystrom_words(degree)  # raises where all of these do not decide


def _tree_residuals(weights: Sequence[Sequence[Any]], matrices: Sequence[Any], order: int) -> Iterator[Any]:
    elementary = ElementaryWeights(*matrices)
    for tree in trees(order, len(matrices)):
        yield elementary.weight(weights[tree[0]], tree) * density(tree) - 1


def order_of_nystrom(method: RungeKuttaNystrom, other: EmbeddedNystrom | None = None) -> int:
    """The order of an explicit Runge-Kutta-Nystrom method, or of its stages with other weights, by Nystrom's trees.

    Up to order p the momenta have the trees of up to p vertices, the positions those of up to p - 1.
    """
    with ctx.workprec(PROOF_BITS):
        size, weights = method.stages, other or method
        rows = [entry for row in method.matrix for entry in row]
        values = _numbers([*method.c, *weights.b_bar, *weights.b, *rows])
        nodes, b_bar, b = (values[i * size : (i + 1) * size] for i in range(3))
        entries = values[3 * size :]
        stages = NystromWeights(nodes, [entries[i * size : (i + 1) * size] for i in range(size)])

        def residuals(order: int) -> Iterator[Any]:
            for tree in nystrom_trees(order):
                yield stages.weight(b, tree) * nystrom_density(tree) - 1
            for tree in nystrom_trees(order - 1):
                yield stages.weight(b_bar, tree) * nystrom_density(tree) * order - 1

        return _largest(residuals)


def _largest(residuals: Callable[[int], Iterator[Any]], most: Fraction = EXACT) -> int:
    """The order up to which all residuals vanish, or are ``most`` at most."""
    bound = enclose(most) if most else None
    orders = range(1, LIMIT + 1)
    return next((k - 1 for k in orders if not all(vanishes(value, bound) for value in residuals(k))), LIMIT)


def _numbers(coefficients: Sequence[Coefficient]) -> list[Any]:
    return list(map(_arithmetic(coefficients), coefficients))


def _arithmetic(coefficients: Sequence[Coefficient], most: Fraction = EXACT) -> Callable[[Coefficient], Any]:
    """What makes numbers of coefficients: exact ones; balls where they have no exact form, or miss the conditions."""
    if most or not all(isinstance(value, (int, Fraction, Algebraic)) for value in coefficients):
        return _ball
    return _rational if all(isinstance(value, (int, Fraction)) for value in coefficients) else _as_it_is


def _ball(value: Coefficient) -> Any:
    return 0 if value == 0 else enclose(value)


def _rational(value: Any) -> fmpq:
    return fmpq(value.numerator, value.denominator)


def _as_it_is(value: Coefficient) -> Any:
    return value
