"""What rounding makes of the errors of a march: a bound for each, and the cells where it is all there is.

Roundings add up as random steps do: with the root of their number, each carried along as the exact motion carries it
(``compare.measure.conditioning``).  The bound is a matter of the problem, the method and N, and so the same on every
machine.  A neighbour, a course from a start close by, errs differently by rounding alone: where a few steps of it tell
of more than STRIDE times the bound, as where a method carries roundings further, the problem's bounds are widened.

A march with a large error is on another motion than the exact one: there the bound is that of its own neighbour.

A cell is rounding where its error is at most FLOOR_FACTOR times the bound, and so is every finer one.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.march.march import march
from compare.measure.records import FLOOR_FACTOR
from compare.methods.kinds.compensated import Compensated

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from compare.march.lanes import March
    from compare.march.precision import Precision
    from compare.measure.truth import Course
    from compare.methods.kinds.protocol import Method
    from reference.problem import Problem

__all__ = ["LOST", "Rounding", "rounding_of_steps", "roundings_of"]

STRIDE = 4
"""Where roundings are carried further, the bound grows by so much, as often as it takes."""
PROBE = 64
"""The neighbours that are marched have at most one such part of the steps of the longest march."""
UNDECIDED = 2000
"""Within this factor of rounding not all of three digits are decided."""
ENERGY_ROUNDINGS = 4
"""In computing an energy, of its own size."""
LOST = 1.0
"""From a position error of so much on, in rad or in sizes, a march is on another motion, and its own neighbour
tells how far that carries roundings."""
SENSITIVE = 256
"""A start that is moved by some part of itself changes the truncation error by at most so many such parts."""


@dataclass(frozen=True)
class Rounding:
    """Bounds on what rounding made of one march.

    Attributes:
        position: of the position error, in the unit of ``Course.position_error``.
        state: of the error of each component, as it is.
        drifts: of the change of each invariant, over its scale.
        floor: whether the position error is rounding.
        steps: to how many roundings, each of one part in a unit and led as far as any is, all of them add up.
    """

    position: float
    state: np.ndarray
    drifts: np.ndarray
    floor: bool
    steps: float


def roundings_of(
    method: Method, courses: Sequence[Course], marches: Sequence[March], errors: Sequence[np.ndarray], fmt: Precision
) -> list[Rounding]:
    """What rounding made of each march, given its errors [samples, state]; each problem's courses by N."""
    steps = [_steps(method, course) for course in courses]
    bounds = [_bounds(*of) for of in zip(courses, steps, errors, strict=True)]
    sizes = [float(np.max(course.position_error(error))) for course, error in zip(courses, errors, strict=True)]
    lost = [not size < LOST for size in sizes]
    members: dict[Problem, list[int]] = {}
    for i, course in enumerate(courses):
        members.setdefault(course.problem, []).append(i)
    probes = [i for own in members.values() for i in _probes([i for i in own if not lost[i]], courses, sizes, bounds)]
    probes += [i for i, one in enumerate(lost) if one]
    neighbours = [courses[i].neighbour for i in probes]
    found = march(method, [one.lane for one in neighbours], fmt, among=[course.lane for course in courses])
    factors = [1.0] * len(courses)
    for i, neighbour, result in zip(probes, neighbours, found, strict=True):
        excess = _excess(_told(courses[i], marches[i], errors[i], neighbour, result), factors[i] * bounds[i])
        if lost[i]:
            factors[i] = max(STRIDE * excess, 1.0)
            continue
        for j in [j for j in members[courses[i].problem] if not lost[j]]:
            factors[j] *= _widening(excess)
    bounds = [factor * row for factor, row in zip(factors, bounds, strict=True)]
    floors = {i: floor for own in members.values() for i, floor in _floors(own, sizes, bounds, lost)}
    return [
        Rounding(
            position=float(row[0]),
            state=row[1 + len(course.scales) :],
            drifts=row[1 : 1 + len(course.scales)],
            floor=floors[i],
            steps=factors[i] * steps[i],
        )
        for i, (course, row) in enumerate(zip(courses, bounds, strict=True))
    ]


def _steps(method: Method, course: Course) -> float:
    """To how many roundings those of a march add up, as random steps do.

    To a random walk of N s roundings, each of a third of the last unit, a constant's are added, which are the same in
    every step.  Compensated sums lose nothing from step to step.
    """
    operations = max(method.evaluations(0)[0], 1) + 1
    return _added(0 if isinstance(method, Compensated) else course.n, operations)


def _added(steps: int, operations: int) -> float:
    """What the roundings of so many steps, and the constant ones of a step, add up to."""
    return math.sqrt(steps * operations) / 3 + 2 * operations


def rounding_of_steps(course: Course, steps: int, operations: int, errors: np.ndarray) -> Rounding:
    """What rounding made of a march in steps of no one size, of so many operations each; no neighbour is marched."""
    added = _added(steps, operations)
    row = _bounds(course, added, errors)
    size = float(np.max(course.position_error(errors)))
    return Rounding(
        position=float(row[0]),
        state=row[1 + len(course.scales) :],
        drifts=row[1 : 1 + len(course.scales)],
        floor=bool(size < LOST and size <= FLOOR_FACTOR * row[0]),
        steps=added,
    )


def _bounds(course: Course, steps: float, errors: np.ndarray) -> np.ndarray:
    """A row of bounds, on the position, the drifts and the components.

    Along a curve the same step is added again and again: the coordinate's error is known, and so is what it makes.
    """
    along, known = course.carried(errors), course.conditioning
    drifts = steps * known.drift_led + ENERGY_ROUNDINGS * course.fmt.epsilon
    return np.array([steps * known.position_led + along, *drifts, *(steps * known.led + along * known.units)])


def _probes(own: Sequence[int], courses: Sequence[Course], sizes: Sequence[float], bounds: Sequence[Any]) -> list[int]:
    """Of one problem's courses two of few steps, where any has undecided digits: one alone may agree by chance."""
    if not any(sizes[i] <= UNDECIDED * bounds[i][0] for i in own):
        return []
    few = [i for i in own if courses[i].n * PROBE <= courses[own[-1]].n]
    return list(few[-2:] if len(few) > 1 else own[:2])


def _told(course: Course, result: March, errors: np.ndarray, neighbour: Course, other: March) -> np.ndarray:
    """What tells a march from its neighbour's, less what the distance of their starts makes of the truncation error."""
    drifts, others = course.drifts(result.states), neighbour.drifts(other.states)
    row, largest = (
        np.array([np.max(course.position_error(gap)), *np.max(drift, axis=1, initial=0.0), *np.max(gap, axis=0)])
        for gap, drift in (
            (_known(errors - neighbour.errors(other.states)), _known(drifts - others)),
            (_known(errors), _known(drifts)),
        )
    )
    told: np.ndarray = row - SENSITIVE * course.conditioning.apart * largest
    return told


def _known(values: np.ndarray) -> np.ndarray:
    """The sizes of those that are numbers, else zero."""
    return np.where(np.isfinite(values), np.abs(values), 0.0)


def _excess(told: np.ndarray, bound: np.ndarray) -> float:
    """How many times its bound was told; 0 where nothing was."""
    return float(np.nanmax(np.append(told / bound, 0.0)))


def _widening(excess: float) -> float:
    """The power of STRIDE that brings a bound within STRIDE of what was told."""
    factor = 1.0
    while STRIDE * factor < excess:
        factor *= STRIDE
    return factor


def _floors(
    own: Sequence[int], sizes: Sequence[float], bounds: Sequence[np.ndarray], lost: Sequence[bool]
) -> Iterator[tuple[int, bool]]:
    """Whether each of one problem's courses, by N, is rounding; a step that is too large is not."""
    floor = False
    for i in own:
        floor = floor or (not lost[i] and sizes[i] <= FLOOR_FACTOR * bounds[i][0])
        yield i, bool(floor)
