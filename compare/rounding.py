"""What rounding makes of the errors of a march: a bound for each, and the cells where it is all there is.

Roundings add up as random steps do: with the root of their number, each carried along as the exact motion carries it.
That is a bound where the method, or a motion in more directions, does not carry them further.  Whether it does is told
by a neighbour, a course from a start close by: the two err differently by rounding alone.  The bound is a matter of
the problem, the method and N, so that it is the same on every machine.

A cell is on the floor within FLOOR_FACTOR of what a neighbour tells, and so is every finer one; but a difference that N
roundings cannot account for is of a step too large, not of rounding.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from compare.aspects import conserves
from compare.march import march
from compare.records import FLOOR_FACTOR

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.contract import Method
    from compare.course import Course
    from compare.march import March
    from compare.precision import Precision
    from reference.problem import Problem

__all__ = ["Rounding", "roundings_of"]

STRIDE = 4
"""Where roundings are carried further, the bound grows by so much, as often as it takes."""
PROBE = 64
"""The first neighbours to be marched have at most one such part of the steps of the longest march."""
UNDECIDED = 2000
"""Within this factor of rounding not all of three digits are decided."""
ENERGY_ROUNDINGS = 4
"""In computing an energy, of its own size."""
COUNTED = 8
"""Roundings of a step, at worst and all in one direction, by which a difference is accounted for."""


@dataclass(frozen=True)
class Rounding:
    """Bounds on what rounding made of one march.

    Attributes:
        place: of the error of the place, in the unit of ``Course.place``.
        state: of the error of each component, as it is.
        drift: of the change of the conserved quantity, relative to its start; NaN where nothing is conserved.
        floor: whether the error of the place is rounding: within FLOOR_FACTOR of what a neighbour tells.
    """

    place: float
    state: np.ndarray
    drift: float
    floor: bool


def roundings_of(
    method: Method, courses: Sequence[Course], marches: Sequence[March], errors: Sequence[np.ndarray], fmt: Precision
) -> list[Rounding]:
    """What rounding made of each march, given its errors [samples, state]; each problem's courses by N.

    A neighbour is marched where rounding may change the digits of a problem's numbers: one of few steps, which tells of
    the others; then where the error is so small that it may be rounding, and no coarser one is.
    """
    told = _Told(method, courses, marches, errors)
    lanes = [course.lane for course in courses]
    waiting = told.probes()
    while waiting:
        neighbours = [courses[i].neighbour for i in waiting]
        found = march(method, [neighbour.lane for neighbour in neighbours], fmt, among=lanes)
        for i, neighbour, result in zip(waiting, neighbours, found, strict=True):
            told.learn(i, neighbour, result)
        waiting = told.doubtful()
    return told.roundings()


class _Told:
    """What is known of rounding in each course: rows of bounds on the place, the drift and the state's components."""

    def __init__(
        self, method: Method, courses: Sequence[Course], marches: Sequence[March], errors: Sequence[np.ndarray]
    ) -> None:
        self.courses, self.marches, self.errors = courses, marches, errors
        self.sizes = [float(np.max(course.place(error))) for course, error in zip(courses, errors, strict=True)]
        operations = max(method.evaluations(0)[0], 1) + 1
        self.bounds = [_random_steps(course, operations) for course in courses]
        self.measured: set[int] = set()
        self.floors = [False] * len(courses)
        self.places: dict[Problem, list[int]] = {}
        for i, course in enumerate(courses):
            self.places.setdefault(course.problem, []).append(i)

    def probes(self) -> list[int]:
        """Of each problem that has an undecided course, two courses of few steps: one may agree by chance."""
        found = []
        for members in self.places.values():
            if any(self._may_be_rounding(i, UNDECIDED) for i in members):
                few = [i for i in members if self.courses[i].n * PROBE <= self.courses[members[-1]].n]
                found += few[-2:] if len(few) > 1 else members[:2]
        return found

    def doubtful(self) -> list[int]:
        """The coarsest courses that may be rounding: two of a problem, since lanes take little longer together."""
        return [i for members in self.places.values() for i in [j for j in members if self._is_doubtful(j)][:2]]

    def _is_doubtful(self, i: int) -> bool:
        return i not in self.measured and not self.floors[i] and self._may_be_rounding(i, FLOOR_FACTOR)

    def _may_be_rounding(self, i: int, factor: float) -> bool:
        return self.sizes[i] <= factor * float(self.bounds[i][0])

    def learn(self, i: int, neighbour: Course, result: March) -> None:
        """Hold a neighbour against its course, and widen the bounds of the problem where it tells of more."""
        course, others = self.courses[i], neighbour.errors(result.states)
        noise = _noise(course, self.errors[i], others)
        drifts = course.drift(self.marches[i].states) - neighbour.drift(result.states)
        row = np.array([noise, np.max(np.abs(drifts)), *np.max(np.abs(self.errors[i] - others), axis=0)])
        self.measured.add(i)
        members = self.places[course.problem]
        if noise <= COUNTED * course.n * course.place_led:
            excess = float(np.nanmax(row / self.bounds[i]))
            while 1 < excess < math.inf:
                excess /= STRIDE
                for j in members:
                    self.bounds[j] = STRIDE * self.bounds[j]
            if self.sizes[i] <= FLOOR_FACTOR * noise:
                for j in members[members.index(i) :]:
                    self.floors[j] = True

    def roundings(self) -> list[Rounding]:
        """What has been found."""
        return [
            Rounding(float(row[0]), row[2:], float(row[1]) if conserves(course.problem) else math.nan, floor)
            for course, row, floor in zip(self.courses, self.bounds, self.floors, strict=True)
        ]


def _random_steps(course: Course, operations: int) -> np.ndarray:
    """A row of bounds for roundings of so many operations a step that add up as random steps do."""
    steps = math.sqrt(course.n * operations)
    drift = steps * course.drift_led + ENERGY_ROUNDINGS * course.fmt.epsilon
    return np.array([steps * course.place_led, drift, *(steps * course.led)])


def _noise(course: Course, errors: np.ndarray, others: np.ndarray) -> float:
    """How far rounding can have led: what tells the errors from a neighbour's, and what the coordinate's error makes.

    Where they are alike to less than a rounding the neighbour has had the same roundings, as on a straight line, and
    tells nothing: then N random ones are counted.
    """
    apart = float(np.max(course.place(errors - others)))
    if apart < _rounding(course) / 4:
        apart = _rounding(course) * math.sqrt(course.n)
    return apart + course.carried(errors)


def _rounding(course: Course) -> float:
    """One rounding of the place at its largest."""
    return course.fmt.epsilon * float(np.max(course.place(course.truth[:, :, 0])))
