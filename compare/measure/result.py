"""One march that has been made: what the scores of its course are taken from, each computed once."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
from flint import arb

from compare.measure.orbital import orbital_conditioning
from compare.measure.rounding import LOST
from reference.arithmetic.namespaces import BALL
from reference.arithmetic.precision import ctx
from reference.once import cached_property
from reference.orbits import NOWHERE, apart

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.march.lanes import March
    from compare.measure.orbital import OrbitalConditioning
    from compare.measure.records import Cell
    from compare.measure.rounding import Rounding
    from compare.measure.truth import Course
    from compare.methods.kinds.one_step import Method
    from reference.orbits import Orbits, Place

__all__ = ["SPARE_BITS", "Run", "as_balls", "exactly"]

SPARE_BITS = 64
"""Bits beyond those of the format to which places on orbits are found."""
SMALL = 0.25
"""A state with a component below this part of its error is held by itself."""


@dataclass(frozen=True)
class Run:
    """What a method made of a course."""

    method: Method
    course: Course
    march: March
    cell: Cell
    rounding: Rounding

    @cached_property
    def position_error(self) -> np.ndarray:
        """The position error at each sample in the case's unit; of several components the largest."""
        with np.errstate(over="ignore", invalid="ignore"):
            return self.course.position_error(self.course.errors(self.march.states))

    @cached_property
    def drifts(self) -> np.ndarray:
        """The drift of each invariant over its scale at each sample: [invariants, samples]."""
        with np.errstate(over="ignore", invalid="ignore"):
            return self.course.drifts(self.march.states)

    @property
    def lost(self) -> bool:
        """Whether the march is on another motion than the exact one."""
        return not self.cell.max_error < LOST

    @property
    def state_rounding(self) -> float:
        """A bound on rounding's part of the state in units of its size."""
        return float(np.max(self.rounding.state / self.course.conditioning.sizes))

    @property
    def phase_rounding(self) -> float:
        """A bound on rounding's part of the phase in rad."""
        return self.rounding.steps * self.course.fmt.epsilon * self._conditioning.phase

    @property
    def amplitude_rounding(self) -> float:
        """A bound on rounding's part of the amplitude."""
        return self.rounding.steps * self.course.fmt.epsilon * self._conditioning.amplitude

    @cached_property
    def _conditioning(self) -> OrbitalConditioning:
        return orbital_conditioning(self.course)

    @cached_property
    def orbital_known(self) -> bool:
        """Whether the exact motion has a phase or an amplitude."""
        with ctx.workprec(SPARE_BITS):
            return self.course.problem.orbits() is not None

    @cached_property
    def orbital(self) -> np.ndarray:
        """The errors of phase, followed over whole turns, and of amplitude at each sample: [samples, 2]."""
        course = self.course
        with ctx.workprec(_bits(course)):
            known = course.problem.orbits()
            if known is None:
                return np.full((len(course.times), 2), math.nan)
            here = _places(course, known, self.march.states)
            found = np.array([apart(*pair) for pair in zip(here, map(known.truth, course.times), strict=True)])
        told = np.isfinite(found[:, 0])
        found[told, 0] = np.unwrap(found[told, 0])
        return found


def _bits(course: Course) -> int:
    return course.fmt.bits + SPARE_BITS + course.problem.working_bits(course.times)


def _places(course: Course, known: Orbits, states: np.ndarray) -> list[Place]:
    """The place of each state at the course's times; nowhere where it is no number."""
    with np.errstate(over="ignore", invalid="ignore"):
        errors = course.errors(states)
    return [
        known.place(_state(truth, error, state)) if np.isfinite(error).all() else NOWHERE
        for truth, error, state in zip(course.truth, errors, states, strict=True)
    ]


def _state(truth: np.ndarray, error: np.ndarray, state: np.ndarray) -> Sequence[arb]:
    """A state as the truth and its error, which no format but balls holds together.

    Where a component has become far smaller than the truth, its error has lost it: then it is the state by itself.
    """
    if np.any((np.abs(state) < np.abs(error) * SMALL) & (state != 0)):
        alone = as_balls(state)
        if alone is not None:
            return alone
    return [sum(map(arb, limbs), arb(off)) for limbs, off in zip(truth.tolist(), error.tolist(), strict=True)]


def as_balls(state: np.ndarray) -> list[arb] | None:
    """A state by itself; None where it is no number."""
    values = [value for value in map(exactly, state) if value is not None]
    return [BALL.number(value) for value in values] if len(values) == len(state) else None


def exactly(value: Any) -> Fraction | None:
    """A number of any format as a rational that reads back as the same number; None where it is not finite."""
    if not math.isfinite(float(value)):
        return None
    return Fraction(*value.as_integer_ratio()) if hasattr(value, "as_integer_ratio") else Fraction(str(value))
