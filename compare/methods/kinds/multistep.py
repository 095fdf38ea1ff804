"""Linear multistep methods: frozen tables of exact coefficients, and the step that follows in any arithmetic.

What a multistep method remembers: past increments and past slopes, carried behind the state from step to step.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from operator import add, sub
from typing import TYPE_CHECKING, Any, ClassVar

from compare.methods.kinds import newton
from compare.methods.kinds.increment import increment, part
from compare.methods.order.algebraic import Q
from compare.methods.order.multistep import is_zero_stable, multistep_order
from reference.once import cached_property

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from fractions import Fraction

    from compare.methods.kinds.protocol import Method, State, System

__all__ = ["Linear", "LinearMultistep", "Past", "PredictorCorrector", "moved", "total", "without_zeros"]

SUBSTEPS = 4
"""Steps of the starter in each step of a starting procedure."""


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
    def starting_steps(self) -> int:
        """Steps to be taken by another method before there is such a past."""
        return max(self.moves, self.slopes - 1, 0)

    @property
    def evaluations(self) -> int:
        """Evaluations of the right-hand side in the start."""
        return self.starting_steps * SUBSTEPS * self.starter.stages + self.slopes

    def start(
        self, system: System, y: State, h: Any, slope: Callable[[State], State]
    ) -> tuple[tuple[State, ...], State]:
        """The states after each step of the starting procedure, and the last with the past behind it."""
        states = [y]
        for _ in range(self.starting_steps):
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


class Multistep:
    """What multistep methods have in common: the past behind the state, where nothing has to be solved."""

    family: ClassVar[str] = "multistep"
    symplectic: ClassVar[bool] = False
    separable_only: ClassVar[bool] = False
    second_order_only: ClassVar[bool] = False
    linear_velocities_only: ClassVar[bool] = False
    opaque: ClassVar[bool] = False

    @cached_property
    def past(self) -> Past:
        """What is remembered from step to step."""
        raise NotImplementedError

    @property
    def starting_steps(self) -> int:
        return self.past.starting_steps

    def memory(self, dimension: int, positions: int) -> int:
        """Increments and slopes are of the state; where the method is of second order in time, of the positions."""
        return (positions if self.separable_only else dimension) * (self.past.moves + self.past.slopes)

    def iterations(self, size: float, bits: int) -> int:  # noqa: ARG002
        return 0

    def jacobians(self, iterations: int) -> int:  # noqa: ARG002
        return 0

    def start(self, system: System, y: State, h: Any) -> tuple[tuple[State, ...], State]:
        return self.past.start(system, y, h, system.derivative)


class Linear(Multistep):
    """A linear multistep method, of one new slope: explicit where its weight beta_k = 0, else solved for.

    Attributes:
        powers: the power of h before the slopes.
    """

    stages: ClassVar[int] = 1
    powers: ClassVar[int] = 1
    beta: tuple[Fraction, ...]

    @property
    def explicit(self) -> bool:
        return self.beta[-1] == 0

    @property
    def matrix(self) -> newton.Matrix:
        """The weight of the new slope, as of a method of one stage."""
        return ((self.beta[-1],),)

    def iterations(self, size: float, bits: int) -> int:
        weight = float(abs(self.beta[-1])) ** (1 / self.powers)
        return 0 if self.explicit else newton.iterations(size * weight, bits)

    def evaluations(self, iterations: int) -> tuple[int, int]:
        return (1 if self.explicit else newton.evaluations(self.matrix, iterations)), self.past.evaluations

    def jacobians(self, iterations: int) -> int:
        return 0 if self.explicit else newton.jacobians(self.matrix, iterations)


@dataclass(frozen=True)
class LinearMultistep(Linear):
    """sum_j alpha_j y_{n+j} = h sum_j beta_j f_{n+j},  j = 0 ... k,  alpha_k = 1; explicit where beta_k = 0.

    A step adds an increment to y_{n+k-1}: since the alpha sum to 0, the states enter by their differences alone.

    Raises:
        ValueError: alpha and beta are not of one length, alpha_k is not 1, or the alpha do not sum to 0.
    """

    name: str
    order: int
    source: str
    alpha: tuple[Fraction, ...]
    beta: tuple[Fraction, ...]
    starter: Method
    aliases: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if len(self.alpha) != len(self.beta):
            raise ValueError(
                f"{self.name}: there are {len(self.alpha)} alpha and {len(self.beta)} beta; equally many are accepted."
            )
        if self.alpha[-1] != 1 or sum(self.alpha) != 0:
            raise ValueError(
                f"{self.name}: alpha ends in {self.alpha[-1]} and sums to {sum(self.alpha)}; 1 and 0 are accepted."
            )

    @property
    def zero_stable(self) -> bool:
        """Whether past errors stay bounded: the root condition."""
        return is_zero_stable(self.alpha)

    def proven_order(self) -> int:
        return multistep_order(self.alpha, self.beta)

    @cached_property
    def of_moves(self) -> tuple[Fraction, ...]:
        """The weights of the past increments, latest first: -(alpha_j + ... + alpha_k) for y_{n+j} - y_{n+j-1}."""
        return without_zeros(tuple(-sum(self.alpha[j:], Q(0)) for j in range(len(self.alpha) - 2, 0, -1)))

    @cached_property
    def of_slopes(self) -> tuple[Fraction, ...]:
        """The weights of the past slopes, latest first."""
        return without_zeros(self.beta[-2::-1])

    @cached_property
    def past(self) -> Past:
        """What is remembered from step to step."""
        return Past(len(self.of_moves), len(self.of_slopes), self.starter)

    def step(self, system: System, y: State, h: Any, iterations: int = 0) -> tuple[State, State]:
        state, moves, slopes = self.past.split(y, system.dimension)
        move, changes = self.known(system, h, moves, slopes), ()
        if self.explicit:
            slope = system.derivative(moved(state, move))
        else:
            base, matrices = moved(state, move), (self.matrix,) * system.dimension
            (slope,), last_changes = newton.slopes(system, base, h, matrices, iterations)
            move = total(move, increment(system, h, self.beta[-1:], [slope]))
            changes = increment(system, h, self.beta[-1:], last_changes)
        return self.past.join(moved(state, move), [move, *moves], [slope, *slopes]), changes

    def known(self, system: System, h: Any, moves: Sequence[State], slopes: Sequence[State]) -> State:
        """The part of the increment that follows from the past."""
        return total(
            increment(system, system.number(Q(1)), self.of_moves, moves), increment(system, h, self.of_slopes, slopes)
        )


@dataclass(frozen=True)
class PredictorCorrector(Multistep):
    """An explicit method predicts, an implicit one corrects once: predict, evaluate, correct, evaluate (PECE)."""

    name: str
    order: int
    source: str
    predictor: LinearMultistep
    corrector: LinearMultistep
    aliases: tuple[str, ...] = ()
    stages: ClassVar[int] = 2

    def __post_init__(self) -> None:
        if not self.predictor.explicit or self.corrector.explicit:
            raise ValueError(f"{self.name}: an explicit predictor and an implicit corrector are accepted.")

    def proven_order(self) -> int:
        """The corrector's, but at most one above that of the predictor, whose error enters times h."""
        return min(self.corrector.proven_order(), self.predictor.proven_order() + 1)

    @cached_property
    def past(self) -> Past:
        """What is remembered from step to step."""
        both = self.predictor.past, self.corrector.past
        return Past(max(past.moves for past in both), max(past.slopes for past in both), self.predictor.starter)

    def evaluations(self, iterations: int) -> tuple[int, int]:  # noqa: ARG002
        return 2, self.past.evaluations

    def step(self, system: System, y: State, h: Any, iterations: int = 0) -> tuple[State, State]:  # noqa: ARG002
        state, moves, slopes = self.past.split(y, system.dimension)
        predicted = system.derivative(moved(state, self.predictor.known(system, h, moves, slopes)))
        known = self.corrector.known(system, h, moves, slopes)
        move = total(known, increment(system, h, self.corrector.beta[-1:], [predicted]))
        new = moved(state, move)
        return self.past.join(new, [move, *moves], [system.derivative(new), *slopes]), ()
