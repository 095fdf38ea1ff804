"""Methods that keep the energy to rounding: projection, the average vector field and a discrete gradient.

Each works for any problem by its ``derivative`` and its ``invariant``, with the gradient of the latter by dual numbers.
Iterations are decided before the march, as those of any implicit method are, and their last change is reported.

Gauss's quadrature on [0, 1]: nodes and weights known by their enclosures, to be rounded to any format.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import reduce
from operator import add, mul
from typing import TYPE_CHECKING, Any, ClassVar

from flint import arb

from compare.methods.kinds.newton import Elimination, newton_matrix
from compare.methods.kinds.protocol import OneStep
from compare.methods.order.algebraic import Q

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.methods.kinds.protocol import Method, State, System

__all__ = ["AverageVectorField", "DiscreteGradient", "Projected"]


@dataclass(frozen=True)
class _Node:
    """The i-th zero of Legendre's polynomial of a degree, moved to [0, 1]."""

    degree: int
    place: int

    def ball(self) -> arb:
        return (1 + arb.legendre_p_root(self.degree, self.place)) / 2


@dataclass(frozen=True)
class _Weight:
    """The weight that belongs to it."""

    degree: int
    place: int

    def ball(self) -> arb:
        return arb.legendre_p_root(self.degree, self.place, weight=True)[1] / 2


def gauss_rule(count: int) -> tuple[tuple[_Node, _Weight], ...]:
    """(node, weight) of the rule with ``count`` nodes: exact for polynomials of degree 2 count - 1."""
    return tuple((_Node(count, place), _Weight(count, place)) for place in range(count))


LARGEST_SIZE = 0.85
"""Above it the estimates of the convergence say nothing; as many iterations are taken as there."""


def _bits_of(size: float) -> float:
    """-log2 of h times the Lipschitz rate."""
    return -math.log2(min(size, LARGEST_SIZE))


def _dot(a: State, b: State) -> Any:
    return reduce(add, map(mul, a, b))


def _scaled(factor: Any, direction: State) -> State:
    return tuple(factor * component for component in direction)


def _plus(a: State, b: State) -> State:
    return tuple(map(add, a, b))


def _minus(a: State, b: State) -> State:
    return tuple(first - second for first, second in zip(a, b, strict=True))


def _linear(system: System, h: Any, jacobian: Sequence[State]) -> Elimination:
    """I - (h/2) J, eliminated."""
    return Elimination(newton_matrix(system, h, (((Q(1, 2),),),) * len(jacobian), [0], [jacobian]))


@dataclass(frozen=True)
class Projected(OneStep):
    """An explicit one-step method, and after every step the nearest state of the start's energy.

    y = z + lambda grad H(y),  H(y) = H(y_0),  z the state after the step of the ``base``: orthogonal in the coordinates
    of the state as they are, an angle beside an angular velocity.  Newton's method on lambda, the direction renewed
    with it: with d = y - z and g = grad H(y), lambda = (H(y_0) - H(y) + g.d)/|g|^2.
    """

    name: str
    order: int
    source: str
    base: Method
    aliases: tuple[str, ...] = ()
    family: str = "conservative"
    symplectic: bool = False
    separable_only: bool = False
    second_order_only: ClassVar[bool] = False

    @property
    def stages(self) -> int:
        return self.base.stages

    def proven_order(self) -> int:
        """That of the base: the projection moves by no more than the error of the step."""
        return self.base.order

    def iterations(self, size: float, bits: int) -> int:
        """The energy errs by about x^(p+1)/2^p of itself in a step, and so does each iteration by that of the last."""
        gained = (self.base.order + 1) * _bits_of(size) + self.base.order
        return 1 + math.ceil(bits / gained)

    def evaluations(self, iterations: int) -> tuple[int, int]:
        return self.base.evaluations(iterations)

    def jacobians(self, iterations: int) -> int:
        return iterations

    def step(self, system: System, y: State, h: Any, iterations: int = 0) -> tuple[State, State]:
        z, _ = self.base.step(system, y, h)
        away = change = (system.number(Q(0)),) * len(z)
        for _ in range(iterations):
            new = _plus(z, away)
            gradient = system.gradient(new)
            excess = system.invariant(new) - system.initial_invariant
            multiplier = (_dot(gradient, away) - excess) / (_dot(gradient, gradient) + system.tiny)
            change = _minus(_scaled(multiplier, gradient), away)
            away = _scaled(multiplier, gradient)
        return _plus(z, away), change


@dataclass(frozen=True)
class _Increment(OneStep):
    """A method whose increment d solves d = h mean(y, d): Newton's method with one Jacobian an iteration or a step."""

    name: str
    order: int
    source: str
    aliases: tuple[str, ...] = ()
    family: str = "conservative"
    symplectic: bool = False
    separable_only: bool = False
    second_order_only: ClassVar[bool] = False

    gain: ClassVar[tuple[int, int]]
    """Bits that an iteration gains: so many times those of x, and so many more."""

    @property
    def stages(self) -> int:
        return 1

    def iterations(self, size: float, bits: int) -> int:
        """The first increment is h f(y), which errs by x/2 of itself; the last change is a rounding."""
        known = _bits_of(size)
        return 2 + math.ceil(max(bits - known, 0) / (self.gain[0] * known + self.gain[1]))


def _nodes(iterations: int) -> int:
    return iterations + iterations // 2


@dataclass(frozen=True)
class AverageVectorField(_Increment):
    """y' = y + h integral_0^1 f(y + s (y' - y)) ds, which keeps the energy of any canonical Hamiltonian system.

    The integral is Gauss's, with half as many nodes again as there are iterations: then it is exact to rounding, for
    with x = h times the rate and |d| < 2 x the error of m nodes is below (x/2)^(2m).  With one angle the mean force is
    the difference of the potentials divided by that of the angles (LaBudde and Greenspan 1974), without dividing.
    """

    gain: ClassVar[tuple[int, int]] = (3, 4)

    def evaluations(self, iterations: int) -> tuple[int, int]:
        return 1 + _nodes(iterations) * iterations, 0

    def jacobians(self, iterations: int) -> int:
        return iterations

    def proven_order(self) -> int:
        """By Butcher's trees, as the Runge-Kutta method a_ij = c_i b_j; more nodes change nothing up to degree 3."""
        from compare.methods.kinds.one_step import Tableau
        from compare.methods.order.algebraic import root
        from compare.methods.order.conditions import order_of_tableau

        nodes = [Q(1, 2) - root(3, 2) / 6, Q(1, 2) + root(3, 2) / 6]
        return order_of_tableau(
            Tableau("avf", 2, self.source, tuple((c / 2, c / 2) for c in nodes), (Q(1, 2), Q(1, 2)))
        )

    def step(self, system: System, y: State, h: Any, iterations: int = 0) -> tuple[State, State]:
        rule = [(system.number(node), system.number(weight)) for node, weight in gauss_rule(_nodes(iterations))]
        third = system.number(Q(2, 3))
        d = _scaled(h, system.derivative(y))
        for _ in range(iterations):
            slopes = [_scaled(weight, system.derivative(_plus(y, _scaled(node, d)))) for node, weight in rule]
            residual = _minus(_scaled(h, reduce(_plus, slopes)), d)
            jacobian = system.jacobian(_plus(y, _scaled(third, d)))
            change = tuple(_linear(system, h, jacobian).solve(residual))
            d = _plus(d, change)
        return _plus(y, d), change


@dataclass(frozen=True)
class DiscreteGradient(_Increment):
    """y' = y + h S G, with Gonzalez's discrete gradient G at the midpoint m = (y + y')/2 and d = y' - y.

    G = g + a d,  g = grad H(m),  a = (H(y') - H(y) - g.d)/|d|^2,  so that G.d = H(y') - H(y); S is the antisymmetric
    matrix (f g^T - g f^T)/|g|^2 of McLachlan, Quispel and Robidoux, with S g = f(m).  H(y) is that of the start.
    The square |d|^2 is not zero while anything moves, and where nothing does a least number stands in its place.
    """

    gain: ClassVar[tuple[int, int]] = (2, 3)

    def evaluations(self, iterations: int) -> tuple[int, int]:
        return 1 + iterations, 0

    def jacobians(self, iterations: int) -> int:
        return 1 + iterations

    def step(self, system: System, y: State, h: Any, iterations: int = 0) -> tuple[State, State]:
        half = system.number(Q(1, 2))
        d = _scaled(h, system.derivative(y))
        elimination = _linear(system, h, system.jacobian(_plus(y, _scaled(half, d))))
        for _ in range(iterations):
            residual = _minus(_scaled(h, self._slope(system, y, d, _plus(y, _scaled(half, d)))), d)
            change = tuple(elimination.solve(residual))
            d = _plus(d, change)
        return _plus(y, d), change

    @staticmethod
    def _slope(system: System, y: State, d: State, middle: State) -> State:
        """S G."""
        f, g = system.derivative(middle), system.gradient(middle)
        along, size = _dot(g, d), _dot(g, g) + system.tiny
        a = (system.invariant(_plus(y, d)) - system.initial_invariant - along) / (_dot(d, d) + system.tiny)
        return _minus(_scaled(1 + a * along / size, f), _scaled(a * _dot(f, d) / size, g))
