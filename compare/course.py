"""One cell of a study before any method runs it: a problem, a number of steps, and the truth at its sample times."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING

import numpy as np
from flint import ctx

from compare.aspects import Aspect, aspect_of, conserves
from compare.bound import BoundSystem, FormatArithmetic
from compare.cases import case_of
from compare.lane import Lane, StartInvariant, sample_steps, start_level
from compare.precision import precision
from reference.arithmetic import NUMPY

if TYPE_CHECKING:
    from fractions import Fraction

    from compare.precision import Precision
    from compare.records import Case
    from reference.problem import Problem

__all__ = ["SAMPLES", "Course"]

SAMPLES = 128
FURTHER = 16
"""How much further roundings may be carried than the one distance that a neighbour tells of."""
BITS = 256
"""Working bits of a difference of energies, beside those of the format."""


@dataclass(frozen=True)
class Course:
    """A problem in n steps up to t_end, whose state is compared after some of them."""

    problem: Problem
    n: int
    t_end: Fraction
    fmt: Precision
    samples: int = SAMPLES

    def __post_init__(self) -> None:
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
        return _proven_on(self.problem, *self.grid, max(2, self.fmt.bits // 53 + 2))

    @cached_property
    def neighbour(self) -> Course:
        """The same course from a start close by, whose truncation error is the same and whose rounding is not."""
        return replace(self, problem=self.problem.neighbour(self.fmt.round, self.fmt.exact_epsilon))

    @cached_property
    def case(self) -> Case:
        """The problem in a few words."""
        return case_of(self.problem)

    @property
    def aspect(self) -> Aspect:
        """How the state is read."""
        return aspect_of(self.problem)

    @cached_property
    def sizes(self) -> np.ndarray:
        """The largest absolute value of each component of the truth over the samples; 1 for one that is always zero."""
        sizes = np.max(np.abs(self.truth[:, :, 0]), axis=0)
        return np.where(sizes > 0, sizes, 1.0)

    @cached_property
    def units(self) -> np.ndarray:
        """What the error of each component is measured in: its size, or 1 where errors are left as they are."""
        return np.ones_like(self.sizes) if self.aspect.angle else self.sizes

    def place(self, errors: np.ndarray) -> np.ndarray:
        """The error of the place at each sample, of errors [samples, state]: of several components the largest."""
        largest: np.ndarray = np.max((np.abs(errors) / self.units)[:, list(self.aspect.places)], axis=1)
        return largest

    @cached_property
    def led(self) -> np.ndarray:
        """How far one rounding, made at any time, leads each component, carried along as the exact motion carries it.

        In the plane of place and velocity a rounding changes the energy and the time on the orbit; a neighbour of the
        same equation tells what either makes of a state.  Elsewhere it tells the growth of one distance, and what is
        made at another time, or in another direction, may be carried a few times as far.
        """
        gap = np.sum(self.neighbour.truth - self.truth, axis=2)
        if self._is_planar:
            led = self._led_in_the_plane(gap) + self.fmt.epsilon * self.sizes
        else:
            growth = 1 + np.max(np.abs(gap), axis=0) / self.sizes / (self.apart or 1.0)
            led = FURTHER * self.fmt.epsilon * growth * self.sizes
        return led

    @property
    def _is_planar(self) -> bool:
        """Whether the state is a place and its velocity, and the neighbour another motion of the same equation."""
        here, there = self.problem, self.neighbour.problem
        planar = len(self.sizes) == 2 and conserves(here) and self.aspect.along is None
        return planar and here.parameters == there.parameters and self._raised != 0

    @cached_property
    def _raised(self) -> float:
        """The neighbour's energy less this one's, which differ by little."""
        with ctx.workprec(BITS + self.fmt.bits):
            return float(StartInvariant(self.neighbour.problem).ball() - StartInvariant(self.problem).ball())

    def _led_in_the_plane(self, gap: np.ndarray) -> np.ndarray:
        """z_E dE + z' dtau at its largest: the state z by energy E and time tau on the orbit, which are conjugate.

        With E = M q'^2/2 + V(q) the area M dq dq' is dtau dE, so that dtau = M (q'_E dq - q_E dq'); the gap is
        z_E times the difference of the energies.
        """
        state, (by_q, by_v), mass = self._plane
        of_energy = np.abs(gap.T / self._raised)
        energy = np.max(np.abs(state[0] * by_q) + np.abs(state[1] * by_v))
        time = np.max(np.abs(mass) * (np.abs(state[0]) * of_energy[1] + np.abs(state[1]) * of_energy[0]))
        rates = np.abs(self.problem.derivative(NUMPY, tuple(state), self._doubles))
        led: np.ndarray = self.fmt.epsilon * np.array(
            [np.max(of) * energy + np.max(rate) * time for of, rate in zip(of_energy, rates, strict=True)]
        )
        return led

    @cached_property
    def _plane(self) -> tuple[np.ndarray, tuple[np.ndarray, ...], np.ndarray]:
        """The exact states as doubles [state, samples], the slopes of the energy there, and M, its second by q'."""
        state = self.truth[:, :, 0].T
        slopes = self._slopes_of_energy(state)
        still, moving = state.copy(), state.copy()
        still[1], moving[1] = 0.0, 1.0
        mass = self._slopes_of_energy(moving)[1] - self._slopes_of_energy(still)[1]
        return state, slopes, mass

    def _slopes_of_energy(self, state: np.ndarray) -> tuple[np.ndarray, ...]:
        fmt = precision("float64")
        system = BoundSystem(self.problem, FormatArithmetic(fmt), self._doubles, fmt, self.level)
        return tuple(system.gradient(tuple(state)))

    @cached_property
    def _doubles(self) -> dict[str, float]:
        """The parameters as doubles."""
        return {name: float(value) for name, value in self.problem.parameters.items()}

    @cached_property
    def place_led(self) -> float:
        """The same of the place; along a curve also what a rounding of the coordinate makes of it."""
        places, along = list(self.aspect.places), self.aspect.along
        led = float(np.max((self.led / self.units)[places]))
        if along is not None:
            size = self.sizes[along] * float(np.max((self.sizes / self.units)[places]))
            led += self.fmt.epsilon * float(np.max(self._slopes)) * size
        return led

    @cached_property
    def drift_led(self) -> float:
        """The same of the change of the conserved quantity, relative to its start; NaN where there is none.

        A rounding of a component y changes E by |y dE/dy| of it, which the exact motion neither lessens nor lets grow.
        """
        if not conserves(self.problem) or not self.level:
            return math.nan
        state = self.truth[:, :, 0].T
        changes = sum(np.abs(y * slope) for y, slope in zip(state, self._slopes_of_energy(state), strict=True))
        return self.fmt.epsilon * float(np.max(changes)) / abs(self.level)

    @cached_property
    def _slopes(self) -> np.ndarray:
        """How fast the place changes with the component that it is a function of, in its unit; zeros without one."""
        aspect, problem = self.aspect, self.problem
        if aspect.along is None:
            return np.zeros(len(self.times))
        slopes = problem.derivative(NUMPY, tuple(self.truth[:, :, 0].T), self._doubles)
        largest: np.ndarray = np.max([np.abs(slopes[i]) / self.units[i] for i in aspect.places], axis=0)
        return largest

    def carried(self, errors: np.ndarray) -> float:
        """What errors [samples, state] of the component that the place is a function of make of the place.

        They are of rounding alone, and the same in a neighbour.
        """
        along = self.aspect.along
        return 0.0 if along is None else float(np.max(self._slopes * np.abs(errors[:, along])))

    @cached_property
    def apart(self) -> float:
        """How far the neighbour begins, in start or parameters, in units of their sizes."""
        here, there = self.problem, self.neighbour.problem
        starts = [abs(float(a - b)) for a, b in zip(here.start, there.start, strict=True)]
        named = there.parameters
        parameters = [abs(float((value - named[name]) / (value or 1))) for name, value in here.parameters.items()]
        return float(max(*np.divide(starts, self.sizes), *parameters))

    @property
    def lane(self) -> Lane:
        """The march that this course asks for."""
        return Lane(self.problem, self.n, self.h, self.steps)

    def errors(self, states: np.ndarray) -> np.ndarray:
        """States - truth, float64 [samples, state]."""
        return self.fmt.difference(states, self.truth)

    @cached_property
    def level(self) -> float:
        """The invariant at the start."""
        return float(start_level(self.problem, self.fmt))

    def drift(self, states: np.ndarray) -> np.ndarray:
        """(E - E0)/(E0 - Emin) of states [samples, state], computed in the format, as float64.

        Not a number where nothing is conserved, or where E0 - Emin is below the range of the format.
        """
        problem, start = self.problem, start_level(self.problem, self.fmt)
        if not conserves(problem) or not start:
            return np.full(len(states), np.nan)
        parameters = {name: self.fmt.number(value) for name, value in problem.parameters.items()}
        energies = problem.invariant(FormatArithmetic(self.fmt), tuple(np.moveaxis(states, 1, 0)), parameters)
        drift: np.ndarray = ((energies - start) / start).astype(np.float64)
        return drift


@lru_cache(maxsize=64)
def multiples(unit: Fraction, counts: tuple[int, ...]) -> tuple[Fraction, ...]:
    """Each count times the unit, kept."""
    return tuple(count * unit for count in counts)


@lru_cache(maxsize=64)
def _proven_on(problem: Problem, unit: Fraction, counts: tuple[int, ...], limbs: int) -> np.ndarray:
    """``problem.state`` at multiples of a time, kept: the numbers of steps of a study come back to the same."""
    return problem.state(multiples(unit, counts), limbs=limbs)
