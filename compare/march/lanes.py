"""One march as it is asked for and as it is given back; where its samples fall."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from compare.march.aspects import conserves
from reference.arithmetic.namespaces import BALL

if TYPE_CHECKING:
    import numpy as np
    from flint import arb

    from compare.march.precision import Precision
    from reference.problem import Problem

__all__ = ["Lane", "March", "StartInvariant", "grain_of", "sample_steps", "start_level"]

LONG_BLOCKS = (64, 32, 16)
LONG_MARCH = 8192


@dataclass(frozen=True)
class Lane:
    """One march: a problem from its start in n steps of size h.

    Attributes:
        h: the exact step size, a number of the format.
        samples: the step numbers, increasing and at most n, at which the state is kept.
        start: where it starts, numbers of the format; at the problem's start if None.  The level stays the problem's.
    """

    problem: Problem
    n: int
    h: Fraction
    samples: tuple[int, ...]
    start: tuple[Fraction, ...] | None = None


@dataclass(frozen=True)
class March:
    """What a lane gave.

    Attributes:
        states: [samples, state] in the format; NaN where the stage equations of an implicit method did not converge.
        max_drift: the largest |invariant - its start| after any step.
        evaluations: of the right-hand side, over the march.
        jacobians: evaluations of its Jacobian, or of the invariant's gradient.
    """

    states: np.ndarray
    max_drift: float
    evaluations: int
    jacobians: int


@dataclass(frozen=True)
class StartInvariant:
    """The invariant of a problem at its exact start, to be rounded to any format."""

    problem: Problem

    def ball(self) -> arb:
        """The enclosure at the precision in force; 0 where the problem conserves nothing."""
        if not conserves(self.problem):
            return BALL.number(Fraction(0))
        start = [BALL.number(value) for value in self.problem.start]
        parameters = {name: BALL.number(value) for name, value in self.problem.parameters.items()}
        ball: arb = self.problem.invariant(BALL, start, parameters)
        return ball


@lru_cache(maxsize=256)
def start_level(problem: Problem, fmt: Precision) -> Any:
    """The invariant of a problem at its start as a number of a format, kept."""
    return fmt.number(StartInvariant(problem))


def sample_steps(n: int, count: int) -> tuple[int, ...]:
    """At most ``count`` steps spread evenly over 1 ... n, the last n, each at the end of a block of the march."""
    grain = grain_of(n)
    spread = min(count, n // grain)
    return tuple(grain * -(-(n // grain) * (j + 1) // spread) for j in range(spread))


def grain_of(n: int) -> int:
    """Steps per block where only the last state of each is wanted; 1 where every state is."""
    return next((block for block in LONG_BLOCKS if n % block == 0 and n >= LONG_MARCH), 1)
