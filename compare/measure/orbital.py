"""How far roundings lead the phase and the amplitude: by the action-angle variables of the exact orbits.

A rounding of a state changes its phase Phi at once, and its energy E, with which the frequency f of its orbit changes:
after a time t the phase has changed by dPhi + 2 pi f_E dE t.  The slopes of Phi, E and the amplitude by the state are
differences in balls, and f of any orbit is the slope of Phi along its own motion.  A component counts with its own
size, which in a rotation is that of all turns so far.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from flint import arb

from compare.measure.truth import proven
from reference.arithmetic.namespaces import BALL
from reference.arithmetic.precision import ctx
from reference.problem import NO_TIME

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction

    from compare.measure.truth import Course
    from reference.orbits import Orbits, Place
    from reference.problem import Problem

__all__ = ["OrbitalConditioning", "early_conditioning", "orbital_conditioning"]

STATES = 64
"""States of the exact motion at which roundings are made, at most."""
EARLY_STATES = 16
APART = 96
"""Differences are over one part in two to this power, of a size or of a period."""
BITS = 4 * APART
"""Working bits of differences of differences, beside those of the problem."""


class OrbitalConditioning(NamedTuple):
    """How far one rounding, of one part in a unit of each component, leads the phase in rad, and the amplitude.

    Infinite where no state has a phase, or an amplitude, that can be told from its neighbours'.
    """

    phase: float
    amplitude: float


def orbital_conditioning(course: Course) -> OrbitalConditioning:
    """Of a course whose problem has orbits: to the last of its times."""
    unit, counts = course.grid
    chosen = np.unique(np.linspace(0, len(counts) - 1, STATES).round().astype(int))
    return _conditioning(course.problem, _hashable(course.truth[chosen]), unit * counts[-1])


@lru_cache(maxsize=64)
def early_conditioning(problem: Problem, end: Fraction) -> OrbitalConditioning:
    """Of a problem that has orbits, to a time that need not be one of a march's."""
    states = proven(problem, end / EARLY_STATES, tuple(range(1, EARLY_STATES + 1)))
    return _conditioning(problem, _hashable(states), end)


def _hashable(states: np.ndarray) -> tuple[tuple[tuple[float, ...], ...], ...]:
    """Limbs [states, components, limbs] as tuples."""
    return tuple(tuple(map(tuple, state)) for state in states.tolist())


@lru_cache(maxsize=64)
def _conditioning(problem: Problem, states: Sequence[Sequence[Sequence[float]]], end: Fraction) -> OrbitalConditioning:
    """Kept: the methods and the numbers of steps of a study come back to the same."""
    with ctx.workprec(BITS + problem.working_bits([end])):
        known = problem.orbits()
        if known is None:
            return OrbitalConditioning(math.nan, math.nan)
        motion = _Neighbours(problem, known)
        balls = [[sum(map(arb, limbs), arb(0)) for limbs in state] for state in states]
        led = np.array([motion.led(y) for y in balls])
        bend = motion.bend(balls[int(np.argmax(led[:, 0]))])
    with np.errstate(invalid="ignore"):
        energy, phase, amplitude = (float(np.max(of[np.isfinite(of)], initial=-math.inf)) for of in led.T)
    told = abs(phase) + bend * energy * float(end)
    return OrbitalConditioning(told if math.isfinite(told) else math.inf, abs(amplitude))


class _Neighbours:
    """What the orbits of a problem tell of states that are apart by one part in 2^APART."""

    def __init__(self, problem: Problem, known: Orbits) -> None:
        self._problem, self._orbits, self._apart = problem, known, arb(2) ** -APART
        self._parameters = problem.parameters_in(BALL)

    def led(self, y: Sequence[arb]) -> tuple[float, float, float]:
        """What a part of every component makes of E, the phase in rad and the amplitude, for one part in a unit."""
        here, energy = self._orbits.place(y), self._energy(y)
        found = np.zeros(3)
        for moved in self._moved(y):
            there = self._orbits.place(moved)
            changes = self._energy(moved) - energy, 2 * arb.pi() * _turned(here, there), _grown(here, there)
            found += [abs(float(change / self._apart)) for change in changes]
        return float(found[0]), float(found[1]), float(found[2])

    def bend(self, y: Sequence[arb]) -> float:
        """2 pi |df/dE| at a state, from the neighbour whose energy differs most."""
        energy, frequency = self._energy(y), self._frequency(y)
        moved = max(self._moved(y), key=lambda other: abs(float(self._energy(other) - energy)))
        bend = 2 * arb.pi() * (self._frequency(moved) - frequency) / (self._energy(moved) - energy)
        return abs(float(bend))

    def _moved(self, y: Sequence[arb]) -> list[list[arb]]:
        """A neighbour for each component that is not zero."""
        return [[*y[:i], value * (1 + self._apart), *y[i + 1 :]] for i, value in enumerate(y) if value != 0]

    def _frequency(self, y: Sequence[arb]) -> arb:
        """By how much the phase moves on in a unit of time, in turns, along the motion through a state."""
        rates = self._problem.derivative(BALL, NO_TIME, y, self._parameters)
        later = [value + self._apart * rate for value, rate in zip(y, rates, strict=True)]
        return _turned(self._orbits.place(y), self._orbits.place(later)) / self._apart

    def _energy(self, y: Sequence[arb]) -> arb:
        found: arb = getattr(self._problem, self._problem.invariants[0].value)(BALL, y, self._parameters)
        return found


def _turned(here: Place, there: Place) -> arb:
    """From one place to another by less than half a turn, in turns; not a number where one has no phase."""
    if here.phase is None or there.phase is None:
        return arb("nan")
    turned = there.phase - here.phase
    return turned - (turned + arb(0.5)).mid().floor()


def _grown(here: Place, there: Place) -> arb:
    """From one amplitude to another; not a number where one has none."""
    return arb("nan") if here.amplitude is None or there.amplitude is None else there.amplitude - here.amplitude
