"""What rounding makes of the errors of a march: a bound for each, and the cells where it is all there is.

A course and its neighbour, from a start close by, err differently by rounding alone, as the method and the problem
carry it along.  What is told so at one number of steps bounds rounding at others, which grows with N at worst; so does
the count of the roundings, carried along as the exact motion carries them.  Few neighbours are marched, and short ones.

A cell is on the floor within FLOOR_FACTOR of rounding, and so is every finer one; but a difference that N roundings
cannot account for is of a step too large, not of rounding.
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

SAFE = 4
"""What one march tells of rounding holds for another within this factor."""
PROBE = 64
"""The first neighbours to be marched have at most one such part of the steps of the longest march."""
UNDECIDED = 4000
"""Within this factor of rounding not all of three digits are decided."""
ENERGY_ROUNDINGS = 4
"""In computing an energy, of its own size."""


@dataclass(frozen=True)
class Rounding:
    """Bounds on what rounding made of one march.

    Attributes:
        place: of the error of the place, in the unit of ``Course.place``.
        state: of the error of each component, as it is.
        drift: of the change of the conserved quantity, relative to its start; NaN where nothing is conserved.
        floor: whether the error of the place is rounding: within FLOOR_FACTOR of it.
    """

    place: float
    state: np.ndarray
    drift: float
    floor: bool


def roundings_of(
    method: Method, courses: Sequence[Course], marches: Sequence[March], errors: Sequence[np.ndarray], fmt: Precision
) -> list[Rounding]:
    """What rounding made of each march, given its errors [samples, state]; each problem's courses by N.

    A neighbour is marched where a problem's numbers are not decided by the count of roundings: one of few steps, which
    tells of the others; then where the error is so small that it may be rounding, and no coarser one is.
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
        self.power = 2 if method.family == "multistep" else 1  # what is remembered may let roundings grow faster
        self.sizes = [float(np.max(course.place(error))) for course, error in zip(courses, errors, strict=True)]
        self.counted = [_counted(method, course) for course in courses]
        self.measured: dict[int, np.ndarray] = {}
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
        return self.sizes[i] <= factor * float(self.bound(i)[0])

    def learn(self, i: int, neighbour: Course, result: March) -> None:
        """Hold a neighbour against its course."""
        course, others = self.courses[i], neighbour.errors(result.states)
        noise = _noise(course, self.errors[i], others)
        drifts = course.drift(self.marches[i].states) - neighbour.drift(result.states)
        drift = float(np.max(np.abs(drifts))) + ENERGY_ROUNDINGS * course.fmt.epsilon
        self.measured[i] = np.array([noise, drift, *np.max(np.abs(self.errors[i] - others), axis=0)])
        members = self.places[course.problem]
        if self.sizes[i] <= FLOOR_FACTOR * noise and noise <= course.roundings:
            for j in members[members.index(i) :]:
                self.floors[j] = True

    def bound(self, i: int) -> np.ndarray:
        """The smaller of what is counted and of what the two nearest courses tell that have been measured."""
        known = [j for j in self.places[self.courses[i].problem] if j in self.measured]
        nearest = sorted(known, key=lambda j: abs(math.log(self.courses[j].n / self.courses[i].n)))[:2]
        rows = [self._reach(i, j) * self.measured[j] for j in nearest]
        bound: np.ndarray = np.fmin(self.counted[i], np.max(rows, axis=0)) if rows else self.counted[i]
        return bound

    def _reach(self, i: int, j: int) -> float:
        """By how much rounding in course i may be larger than what course j tells: it grows as N's root, at worst as N."""
        more = self.courses[i].n / self.courses[j].n
        return float(max(SAFE * max(more, 1.0) ** 0.5, more**self.power)) if i != j else 1.0

    def roundings(self) -> list[Rounding]:
        """What has been found."""
        rows = map(self.bound, range(len(self.courses)))
        return [
            Rounding(float(row[0]), row[2:], float(row[1]) if conserves(course.problem) else math.nan, floor)
            for course, row, floor in zip(self.courses, rows, self.floors, strict=True)
        ]


def _counted(method: Method, course: Course) -> np.ndarray:
    """Bounds by the number of the roundings: half a unit for each evaluation in a step and for their sum.

    Where equations are solved in a step, or earlier steps remembered, there are more, and ``Course`` has a bound for
    all.
    """
    evaluations = method.evaluations(0)[0] if method.family != "implicit" else 0
    plain = method.opening == 0 and method.jacobians(1) == 0 and evaluations > 0
    share = (evaluations + 1) / 2 / 8 if plain else 1.0
    place, drift, state = course.roundings, course.drift_roundings, course.state_roundings
    return np.array([share * place, share * drift + ENERGY_ROUNDINGS * course.fmt.epsilon, *(share * state)])


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
