"""One cell of a study before any method runs it: a problem, a number of steps, and the truth at its sample times."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from compare.march.autonomous import autonomous
from compare.march.equation import FormatArithmetic
from compare.march.lanes import Lane, drift_scales, initial_invariants, sample_steps
from compare.march.precision import precision
from compare.measure.cases import case_of
from compare.measure.conditioning import Conditioning, conditioning
from reference.once import cached_property

if TYPE_CHECKING:
    from collections.abc import Iterable

    from compare.march.precision import Precision
    from compare.measure.records import Case
    from reference.problem import Problem

__all__ = ["SAMPLES", "Course", "errors_of_doubles", "proven"]

SAMPLES = 128
DOUBLE_LIMBS = 2
"""Of the truth, enough for the errors of doubles."""


@dataclass(frozen=True)
class Course:
    """A problem in n steps up to t_end, whose state is compared after some of them."""

    problem: Problem
    n: int
    t_end: Fraction
    fmt: Precision
    samples: int = SAMPLES

    def __post_init__(self) -> None:
        object.__setattr__(self, "problem", autonomous(self.problem))
        for name, value in zip(self.problem.state_names, self.problem.start, strict=True):
            if value and not self.fmt.number(value):
                raise ValueError(f"{name} starts at {float(value)}, which {self.fmt.name} cannot hold.")

    @cached_property
    def h(self) -> Fraction:
        """t_end/N rounded to the format, exactly.

        Raises:
            ValueError: it is smaller than any number of the format.
        """
        h = self.fmt.round(self.t_end / self.n)
        if not self.fmt.number(h):
            raise ValueError(
                f"t_end/n is {float(h):.1e}, which {self.fmt.name} cannot hold; a longer time is accepted."
            )
        return h

    @cached_property
    def steps(self) -> tuple[int, ...]:
        """The steps after which the state is compared."""
        return sample_steps(self.n, self.samples)

    @property
    def grid(self) -> tuple[Fraction, tuple[int, ...]]:
        """The times as multiples of an interval, which numbers of steps that are powers of two share."""
        common = math.gcd(*self.steps)
        return common * self.h, tuple(step // common for step in self.steps)

    @property
    def times(self) -> tuple[Fraction, ...]:
        """n h, exactly."""
        return multiples(*self.grid)

    @cached_property
    def truth(self) -> np.ndarray:
        """The proven state at the times: float64 limbs [samples, state, limbs], enough for the format."""
        return proven(self.problem, *self.grid, _limbs(self.fmt))

    @cached_property
    def neighbour(self) -> Course:
        """The same course from a start close by, whose truncation error is the same and whose rounding is not."""
        return replace(self, problem=self.problem.neighbour(self.fmt.round, self.fmt.exact_epsilon))

    @cached_property
    def case(self) -> Case:
        """The problem in a few words."""
        return case_of(self.problem.original)

    @cached_property
    def conditioning(self) -> Conditioning:
        """How large the motion is, and how far it carries roundings: the same object on the same grid of times."""
        return _conditioning_on(self.problem, *self.grid, self.fmt)

    def position_error(self, errors: np.ndarray) -> np.ndarray:
        """The position error at each sample, of errors [samples, state]: of several components the largest."""
        space = self.problem.space
        largest: np.ndarray = np.max(
            (np.abs(errors) / self.conditioning.units)[:, space.places(space.positions)], axis=1
        )
        return largest

    def carried(self, errors: np.ndarray) -> float:
        """What errors [samples, state] of the component that the place is a function of make of the place.

        They are of rounding alone, and the same in a neighbour.  A step that takes a slope there takes another one.
        """
        space = self.problem.space
        if space.along is None:
            return 0.0
        (along,) = space.places([space.along])
        return float(
            np.max((self.conditioning.slopes + float(self.h) * self.conditioning.bends) * np.abs(errors[:, along]))
        )

    @property
    def lane(self) -> Lane:
        """The march that this course asks for."""
        return Lane(self.problem, self.n, self.h, self.steps)

    def errors(self, states: np.ndarray) -> np.ndarray:
        """States - truth, float64 [samples, state]."""
        return self.fmt.difference(states, self.truth)

    @cached_property
    def scales(self) -> tuple[float, ...]:
        """What the drift of each invariant is divided by."""
        return tuple(map(float, drift_scales(self.problem, self.fmt)))

    def drifts(self, states: np.ndarray) -> np.ndarray:
        """The drift of each invariant over its scale, of states [samples, state]: float64 [invariants, samples].

        Computed in the format; not a number where the scale is below the format's range.
        """
        problem = self.problem
        parameters = problem.parameters_in(self.fmt)
        m, y = FormatArithmetic(self.fmt), tuple(np.moveaxis(states, 1, 0))
        found = np.full((len(problem.invariants), len(states)), np.nan)
        initial, scales = initial_invariants(problem, self.fmt), drift_scales(problem, self.fmt)
        for i, (one, level, scale) in enumerate(zip(problem.invariants, initial, scales, strict=True)):
            if scale:
                found[i] = ((getattr(problem, one.value)(m, y, parameters) - level) / scale).astype(np.float64)
        return found


@lru_cache(maxsize=64)
def multiples(unit: Fraction, counts: tuple[Fraction | int, ...]) -> tuple[Fraction, ...]:
    """Each count times the unit, kept."""
    return tuple(count * unit for count in counts)


@lru_cache(maxsize=64)
def proven(
    problem: Problem, unit: Fraction, counts: tuple[Fraction | int, ...], limbs: int = DOUBLE_LIMBS
) -> np.ndarray:
    """The proven state at multiples of a time: float64 limbs [samples, state, limbs].

    Kept: the numbers of steps of a study, and the solvers that are asked, come back to the same.
    """
    return problem.state(multiples(unit, counts), limbs=limbs)


def errors_of_doubles(problem: Problem, times: Iterable[Fraction], states: np.ndarray) -> np.ndarray:
    """States - truth at exact times, float64 [times, state]."""
    return precision("float64").difference(states, proven(problem, Fraction(1), tuple(times)))


def _limbs(fmt: Precision) -> int:
    """Of the truth, enough for the format."""
    return max(2, fmt.bits // 53 + 2)


@lru_cache(maxsize=64)
def _conditioning_on(problem: Problem, unit: Fraction, counts: tuple[int, ...], fmt: Precision) -> Conditioning:
    """The conditioning at multiples of a time, kept."""
    near = problem.neighbour(fmt.round, fmt.exact_epsilon)
    truth, other = (proven(one, unit, counts, _limbs(fmt)) for one in (problem, near))
    return conditioning(problem, truth, near, other, fmt)
