"""How a step moves a state: y + h sum_j w_j k_j, with the same few lines for every method."""

from __future__ import annotations

from functools import reduce
from operator import add
from typing import TYPE_CHECKING, Any

from compare.methods.order.algebraic import Q

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.methods.kinds.protocol import Equation, State, System
    from compare.methods.order.algebraic import Coefficient

__all__ = ["advance", "increment", "part", "stage", "turned"]


def part(system: Equation, weight: Coefficient, h: Any) -> Any:
    """weight h: the same in every step, so that the compiler takes it out of them all."""
    return h if weight == 1 else system.number(weight) * h


def increment(system: Equation, h: Any, weights: Sequence[Coefficient], slopes: Sequence[State]) -> State:
    """sum_j (h weights_j) slopes_j; nothing where every weight is zero."""
    sizes = [(part(system, weight, h), slope) for weight, slope in zip(weights, slopes, strict=False) if weight != 0]
    if not sizes:
        return ()
    components = range(len(sizes[0][1]))
    return tuple(reduce(add, (size * slope[i] for size, slope in sizes)) for i in components)


def advance(system: Equation, y: State, h: Any, weights: Sequence[Coefficient], slopes: Sequence[State]) -> State:
    """y + sum_j (h weights_j) slopes_j."""
    moved = increment(system, h, weights, slopes)
    return tuple(map(add, y, moved)) if moved else y


def turned(system: System, force: State) -> State:
    """The rates of the velocities that a force gives, v(F) - v(0): where v(p) = A p + b they are A F."""
    zero = system.number(Q(0))
    still = system.velocity((zero,) * len(force))
    return tuple(rate - rest for rate, rest in zip(system.velocity(force), still, strict=True))


def stage(system: Equation, y: State, h: Any, rows: Sequence[Sequence[Coefficient]], slopes: Sequence[State]) -> State:
    """y + sum_j (h weights_j) slopes_j, with weights for each component of their own."""
    moved = []
    for c, row in enumerate(rows):
        value = y[c]
        for weight, slope in zip(row, slopes, strict=True):
            if weight != 0:
                value = value + part(system, weight, h) * slope[c]
        moved.append(value)
    return tuple(moved)
