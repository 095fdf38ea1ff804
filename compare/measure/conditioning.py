"""How far the exact motion carries a rounding that is made at any time: what bounds rounding in every score.

In the plane of place q and velocity q' a rounding changes the energy E by dE and the time on the orbit by dtau, which
are conjugate: with E = M q'^2/2 + V(q) the area M dq dq' is dtau dE, so that dtau = M (q'_E dq - q_E dq').  A later
state z then differs by z_E dE + z' dtau.  A neighbour, another motion of the same equation, tells z_E.

Elsewhere the neighbour tells the growth of one distance; what is made at another time, or in another direction, may be
carried FURTHER.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from compare.march.equation import BoundSystem, FormatArithmetic
from compare.march.lanes import StartInvariant, drift_scales, initial_invariants
from compare.march.precision import precision
from reference.arithmetic.namespaces import NUMPY
from reference.arithmetic.precision import ctx
from reference.problem import NO_TIME

if TYPE_CHECKING:
    from compare.march.precision import Precision
    from reference.problem import Problem

__all__ = ["Conditioning", "conditioning"]

FURTHER = 16
BEFORE = 2.0**-20
"""Of a coordinate, between slopes whose difference is taken."""
BITS = 256
"""Working bits of a difference of energies, beside those of the format."""


@dataclass(frozen=True)
class Conditioning:
    """The size of a motion at some times, and how far it carries roundings to them.

    Attributes:
        sizes: the largest absolute value of each component of the state; 1 for one that is always zero.
        units: what the error of each component is measured in: its size, or 1 where errors are left as they are.
        led: how far one rounding leads each component.
        position_led: the same of the position error, in its unit; along a curve also what a rounding of the coordinate
            makes of it.
        drift_led: the same of the change of each invariant, over its scale; NaN where that is zero.
        slopes: how fast the place changes with the component that it is a function of, at each time; else zeros.
        bends: how fast those slopes do: steps that begin or end there take slopes that are off.
        apart: how far the neighbour begins, in start or parameters, in units of their sizes.
    """

    sizes: np.ndarray
    units: np.ndarray
    led: np.ndarray
    position_led: float
    drift_led: np.ndarray
    slopes: np.ndarray
    bends: np.ndarray
    apart: float


def conditioning(problem: Problem, truth: np.ndarray, near: Problem, other: np.ndarray, fmt: Precision) -> Conditioning:
    """The conditioning of a problem, given limbs [samples, state, limbs] of its states and of a neighbour's."""
    motion, space = _Motion(problem, truth[:, :, 0].T), problem.space
    sizes = np.max(np.abs(motion.state), axis=1)
    sizes = np.where(sizes > 0, sizes, 1.0)
    units = np.ones_like(sizes) if space.scale == "units" else sizes
    apart, gap = _apart(problem, near, sizes), np.sum(other - truth, axis=2).T
    raised = _raised(problem, near, fmt) if _in_one_plane(problem, near) else 0.0
    if raised:
        led = motion.led(gap / raised) + sizes
    else:
        led = FURTHER * (1 + np.max(np.abs(gap), axis=1) / sizes / (apart or 1.0)) * sizes
    places = space.places(space.positions)
    position_led, slopes = float(np.max((led / units)[places])), np.zeros(len(truth))
    bends = np.zeros(len(truth))
    if space.along is not None:
        (along,) = space.places([space.along])
        rates, before, shift = motion.rates(), *motion.rates_before(along)
        slopes = np.max([np.abs(rates[i]) / units[i] for i in places], axis=0)
        bends = np.max([np.abs(rates[i] - before[i]) / units[i] for i in places], axis=0) / shift
        position_led += float(np.max(slopes) * sizes[along] * np.max((sizes / units)[places]))
    epsilon = fmt.epsilon
    return Conditioning(
        sizes, units, epsilon * led, epsilon * position_led, epsilon * motion.drift_led(), slopes, bends, apart
    )


def _apart(problem: Problem, near: Problem, sizes: np.ndarray) -> float:
    """How far two problems are from each other."""
    starts = [abs(float(a - b)) for a, b in zip(problem.start, near.start, strict=True)]
    named = near.parameters
    parameters = [abs(float((value - named[name]) / (value or 1))) for name, value in problem.parameters.items()]
    return float(max([*np.divide(starts, sizes), *parameters]))


def _in_one_plane(problem: Problem, near: Problem) -> bool:
    """Whether the state is a place and its velocity, and the neighbour another motion of the same equation."""
    space = problem.space
    planar = space.components == (*space.positions, *space.rates) and len(space.pairs) == len(space.positions) == 1
    return planar and bool(problem.invariants) and problem.parameters == near.parameters


def _raised(problem: Problem, near: Problem, fmt: Precision) -> float:
    """The neighbour's energy less the problem's, which differ by little."""
    with ctx.workprec(BITS + fmt.bits):
        return float(StartInvariant(near).ball() - StartInvariant(problem).ball())


class _Motion:
    """The exact states of a problem as doubles [state, samples], and what its equation makes of them."""

    def __init__(self, problem: Problem, state: np.ndarray) -> None:
        fmt = precision("float64")
        self.problem, self.state = problem, state
        self.parameters = problem.parameters_in(NUMPY)
        self._scales = drift_scales(problem, fmt)
        self._system = BoundSystem(
            problem, FormatArithmetic(fmt), self.parameters, fmt, initial_invariants(problem, fmt)
        )

    def rates(self) -> tuple[np.ndarray, ...]:
        """The slopes of the components by what they are functions of."""
        return tuple(
            np.asarray(rate) for rate in self.problem.derivative(NUMPY, NO_TIME, tuple(self.state), self.parameters)
        )

    def rates_before(self, along: int) -> tuple[tuple[np.ndarray, ...], np.ndarray]:
        """The slopes a little before, in the component that the others are functions of, and how little."""
        shift, state = BEFORE * self.state[along], self.state.copy()
        state[along] -= shift
        return tuple(
            np.asarray(r) for r in self.problem.derivative(NUMPY, NO_TIME, tuple(state), self.parameters)
        ), shift

    def _slopes_of_energy(self, state: np.ndarray) -> tuple[np.ndarray, ...]:
        return tuple(self._system.gradient(tuple(state)))

    def drift_led(self) -> np.ndarray:
        """How far one rounding leads each invariant over its scale: one of a component y changes it by |y dE/dy|."""
        found = np.full(len(self.problem.invariants), math.nan)
        gradients = self._system.gradients(tuple(self.state))
        for i, (slopes, scale) in enumerate(zip(gradients, self._scales, strict=True)):
            if scale:
                changes = sum(np.abs(y * slope) for y, slope in zip(self.state, slopes, strict=True))
                found[i] = float(np.max(changes)) / scale
        return found

    def led(self, of_energy: np.ndarray) -> np.ndarray:
        """|z_E| dE + |z'| dtau at its largest, for roundings of one part in a unit, given z_E [state, samples]."""
        (q, v), (by_q, by_v), mass = np.abs(self.state), self._slopes_of_energy(self.state), self._mass()
        largest = np.abs(of_energy)
        energy = np.max(q * np.abs(by_q) + v * np.abs(by_v))
        time = np.max(np.abs(mass) * (q * largest[1] + v * largest[0]))
        led: np.ndarray = np.max(largest, axis=1) * energy + np.array([np.max(np.abs(r)) for r in self.rates()]) * time
        return led

    def _mass(self) -> np.ndarray:
        """M, the second slope of the energy by the velocity; 1 of a momentum, which has it in it."""
        if self.problem.space.momenta:
            return np.ones_like(self.state[1])
        still, moving = self.state.copy(), self.state.copy()
        still[1], moving[1] = 0.0, 1.0
        return np.asarray(self._slopes_of_energy(moving)[1] - self._slopes_of_energy(still)[1])
