"""What rounding makes of the errors of a march: a bound for each, and the cells where it is all there is.

Roundings add up as random steps do: with the root of their number, each carried along as the exact motion carries it
(``compare.reach``).  The bound is a matter of the problem, the method and N, and so the same on every machine.  A
neighbour, a course from a start close by, errs differently by rounding alone: where a few steps of it tell of more than
STRIDE times the bound, as where a method carries roundings further, the problem's bounds are widened.

A cell is rounding where its error is at most FLOOR_FACTOR times the bound, and so is every finer one.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.aspects import conserves
from compare.compensated import Compensated
from compare.march import march
from compare.records import FLOOR_FACTOR

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from compare.contract import Method
    from compare.course import Course
    from compare.march import March
    from compare.precision import Precision
    from reference.problem import Problem

__all__ = ["Rounding", "roundings_of"]

STRIDE = 4
"""Where roundings are carried further, the bound grows by so much, as often as it takes."""
PROBE = 64
"""The neighbours that are marched have at most one such part of the steps of the longest march."""
UNDECIDED = 2000
"""Within this factor of rounding not all of three digits are decided."""
ENERGY_ROUNDINGS = 4
"""In computing an energy, of its own size."""
SENSITIVE = 256
"""A start that is moved by some part of itself changes the truncation error by at most so many such parts."""


@dataclass(frozen=True)
class Rounding:
    """Bounds on what rounding made of one march.

    Attributes:
        place: of the error of the place, in the unit of ``Course.place``.
        state: of the error of each component, as it is.
        drift: of the change of the conserved quantity, relative to its start; NaN where nothing is conserved.
        floor: whether the error of the place is rounding.
    """

    place: float
    state: np.ndarray
    drift: float
    floor: bool


def roundings_of(
    method: Method, courses: Sequence[Course], marches: Sequence[March], errors: Sequence[np.ndarray], fmt: Precision
) -> list[Rounding]:
    """What rounding made of each march, given its errors [samples, state]; each problem's courses by N."""
    bounds = [_random_steps(method, course, error) for course, error in zip(courses, errors, strict=True)]
    sizes = [float(np.max(course.place(error))) for course, error in zip(courses, errors, strict=True)]
    members: dict[Problem, list[int]] = {}
    for i, course in enumerate(courses):
        members.setdefault(course.problem, []).append(i)
    probes = [i for own in members.values() for i in _probes(own, courses, sizes, bounds)]
    neighbours = [courses[i].neighbour for i in probes]
    found = march(method, [one.lane for one in neighbours], fmt, among=[course.lane for course in courses])
    for i, neighbour, result in zip(probes, neighbours, found, strict=True):
        factor = _widening(_told(courses[i], marches[i], errors[i], neighbour, result), bounds[i])
        for j in members[courses[i].problem]:
            bounds[j] = factor * bounds[j]
    floors = {i: floor for own in members.values() for i, floor in _floors(own, sizes, bounds)}
    return [
        Rounding(float(row[0]), row[2:], float(row[1]) if conserves(course.problem) else math.nan, floors[i])
        for i, (course, row) in enumerate(zip(courses, bounds, strict=True))
    ]


def _random_steps(method: Method, course: Course, errors: np.ndarray) -> np.ndarray:
    """A row of bounds, on the place, the drift and the components, for roundings that add up as random steps do.

    To a random walk of N s roundings, each of a third of the last unit, a constant's are added, which are the same in
    every step.  Compensated sums lose nothing from step to step.  Along a curve the same step is added again and again:
    the coordinate's error is known, and so is what it makes.
    """
    operations = max(method.evaluations(0)[0], 1) + 1
    walk = 0.0 if isinstance(method, Compensated) else math.sqrt(course.n * operations) / 3
    steps = walk + 2 * operations
    along = course.carried(errors)
    drift = steps * course.reach.drift_led + ENERGY_ROUNDINGS * course.fmt.epsilon
    return np.array(
        [steps * course.reach.place_led + along, drift, *(steps * course.reach.led + along * course.reach.units)]
    )


def _probes(own: Sequence[int], courses: Sequence[Course], sizes: Sequence[float], bounds: Sequence[Any]) -> list[int]:
    """Of one problem's courses two of few steps, where any has undecided digits: one alone may agree by chance."""
    if not any(sizes[i] <= UNDECIDED * bounds[i][0] for i in own):
        return []
    few = [i for i in own if courses[i].n * PROBE <= courses[own[-1]].n]
    return list(few[-2:] if len(few) > 1 else own[:2])


def _told(course: Course, result: March, errors: np.ndarray, neighbour: Course, other: March) -> np.ndarray:
    """What tells a march from its neighbour's, less what the distance of their starts makes of the truncation error."""
    gap = np.abs(errors - neighbour.errors(other.states))
    drift = np.abs(course.drift(result.states))
    drifts = np.abs(course.drift(result.states) - neighbour.drift(other.states))
    row = np.array([np.max(course.place(gap)), np.max(drifts), *np.max(gap, axis=0)])
    largest = np.array([np.max(course.place(errors)), np.max(drift), *np.max(np.abs(errors), axis=0)])
    told: np.ndarray = row - SENSITIVE * course.reach.apart * largest
    return told


def _widening(told: np.ndarray, bound: np.ndarray) -> float:
    """The power of STRIDE that brings a bound within STRIDE of what was told; 1 where nothing finite was."""
    excess = float(np.nanmax(np.append(told / bound, 0.0)))
    factor = 1.0
    while STRIDE * factor < excess < math.inf:
        factor *= STRIDE
    return factor


def _floors(own: Sequence[int], sizes: Sequence[float], bounds: Sequence[np.ndarray]) -> Iterator[tuple[int, bool]]:
    """Whether each of one problem's courses, by N, is rounding."""
    floor = False
    for i in own:
        floor = floor or sizes[i] <= FLOOR_FACTOR * bounds[i][0]
        yield i, bool(floor)
