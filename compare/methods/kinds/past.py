"""What a multistep method remembers: past increments and past slopes, carried behind the state from step to step."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from operator import add, sub
from typing import TYPE_CHECKING, Any

from compare.methods.kinds.increment import part
from compare.methods.order.algebraic import Q

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from fractions import Fraction

    from compare.methods.kinds.protocol import Method, State, System

__all__ = ["Past", "moved", "total", "without_zeros"]

SUBSTEPS = 4
"""Steps of the starter in each step of an opening."""


@dataclass(frozen=True)
class Past:
    """So many increments y_n - y_{n-1}, ... and so many slopes f_n, f_{n-1}, ..., the latest first.

    The first of them are made by the ``starter``, an explicit one-step method: the few steps that it takes leave an
    error of its local order, so that one of order p - 1 does not limit a method of order p.
    """

    moves: int
    slopes: int
    starter: Method

    @property
    def opening(self) -> int:
        """Steps to be taken by another method before there is such a past."""
        return max(self.moves, self.slopes - 1, 0)

    @property
    def evaluations(self) -> int:
        """Evaluations of the right-hand side in the start."""
        return self.opening * SUBSTEPS * self.starter.stages + self.slopes

    def start(
        self, system: System, y: State, h: Any, slope: Callable[[State], State]
    ) -> tuple[tuple[State, ...], State]:
        """The states after each step of the opening, and the last with the past behind it."""
        states = [y]
        for _ in range(self.opening):
            for _ in range(SUBSTEPS):
                y, _changes = self.starter.step(system, y, part(system, Q(1, SUBSTEPS), h))
            states.append(y)
        latest = states[::-1]
        moves = [tuple(map(sub, new, old)) for new, old in pairwise(latest)]
        return tuple(states[1:]), self.join(y, moves, [slope(state) for state in latest[: self.slopes]])

    def join(self, state: State, moves: Sequence[State], slopes: Sequence[State]) -> State:
        """The state with the past behind it; what is older than is remembered is dropped."""
        return tuple(number for part in (state, *moves[: self.moves], *slopes[: self.slopes]) for number in part)

    def split(self, y: State, dimension: int) -> tuple[State, list[State], list[State]]:
        """State, increments and slopes."""
        state, behind = y[:dimension], y[dimension:]
        moves, slopes = behind[: self.moves * dimension], behind[self.moves * dimension :]
        return state, _pieces(moves, self.moves), _pieces(slopes, self.slopes)


def _pieces(numbers: State, count: int) -> list[State]:
    size = len(numbers) // count if count else 0
    return [numbers[i * size : (i + 1) * size] for i in range(count)]


def total(*parts: State) -> State:
    """The sum of increments, of which some may be empty: nothing to add."""
    found: State = ()
    for one in parts:
        found = tuple(map(add, found, one)) if found and one else found or one
    return found


def moved(y: State, change: State) -> State:
    """y with an increment added."""
    return tuple(map(add, y, change)) if change else y


def without_zeros(weights: tuple[Fraction, ...]) -> tuple[Fraction, ...]:
    """Weights of the past without the zeros that they end in: what has no weight need not be remembered."""
    while weights and weights[-1] == 0:
        weights = weights[:-1]
    return weights
