"""One march as it is asked for and as it is given back; where its samples fall."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from flint import arb

from reference.arithmetic.namespaces import BALL

if TYPE_CHECKING:
    from fractions import Fraction

    import numpy as np

    from compare.march.precision import Precision
    from reference.problem import Problem

__all__ = [
    "CommonEquation",
    "Lane",
    "March",
    "StartInvariant",
    "drift_scales",
    "grain_of",
    "initial_invariants",
    "sample_steps",
]

LONG_BLOCKS = (64, 32, 16)
LONG_MARCH = 8192


@dataclass(frozen=True)
class CommonEquation:
    """What problems must share to share compiled code: an equation, whatever its parameters."""

    structure: Any
    problem: Problem = field(compare=False)

    @classmethod
    def of(cls, problem: Problem) -> CommonEquation:
        return cls(problem.structure, problem)


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
        max_drifts: for each invariant the largest |invariant - its start| after any step.
        evaluations: of the right-hand side, over the march.
        jacobians: evaluations of its Jacobian, or of the invariant's gradient.
    """

    states: np.ndarray
    max_drifts: tuple[float, ...]
    evaluations: int
    jacobians: int


@dataclass(frozen=True)
class StartInvariant:
    """A value of a problem's at its exact start, of the method of this name, to be rounded to any format."""

    problem: Problem
    value: str = "invariant"

    def ball(self) -> arb:
        """The enclosure at the precision in force."""
        ball: arb = arb(self._at(BALL))
        return ball

    def exact(self) -> Fraction | None:
        """The value itself where it is rational, which no ball might decide; None where it is not known to be."""
        return self.problem.exact_invariant(self.value)

    def _at(self, m: Any) -> Any:
        start = self.problem.start_in(m)
        parameters = self.problem.parameters_in(m)
        return getattr(self.problem, self.value)(m, start, parameters)


@lru_cache(maxsize=256)
def initial_invariants(problem: Problem, fmt: Precision) -> tuple[Any, ...]:
    """Each invariant of a problem at its start as a number of a format, kept."""
    return tuple(_rounded(StartInvariant(problem, one.value), fmt) for one in problem.invariants)


@lru_cache(maxsize=256)
def drift_scales(problem: Problem, fmt: Precision) -> tuple[Any, ...]:
    """What the drift of each invariant is divided by, as a positive number of a format; zero where there is none."""
    initial = initial_invariants(problem, fmt)
    return tuple(
        abs(level) if one.scale == "start" else abs(_rounded(StartInvariant(problem, one.scale), fmt))
        for one, level in zip(problem.invariants, initial, strict=True)
    )


def _rounded(value: StartInvariant, fmt: Precision) -> Any:
    exact = value.exact()
    return fmt.number(value if exact is None else exact)


def sample_steps(n: int, count: int) -> tuple[int, ...]:
    """At most ``count`` steps spread evenly over 1 ... n, the last n, each at the end of a block of the march."""
    grain = grain_of(n)
    spread = min(count, n // grain)
    return tuple(grain * -(-(n // grain) * (j + 1) // spread) for j in range(spread))


def grain_of(n: int) -> int:
    """Steps per block where only the last state of each is wanted; 1 where every state is."""
    return next((block for block in LONG_BLOCKS if n % block == 0 and n >= LONG_MARCH), 1)
