"""Which cells of a study are on the rounding floor: their error is rounding's, not the method's.

A course and its neighbour, from a start close by, err differently by rounding alone, as the method and the problem
carry it along.  A cell within FLOOR_FACTOR of that difference is on the floor, and so is every finer one; but a
difference that N roundings cannot account for is of a step too large, not of rounding.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from compare.march import march

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.contract import Method
    from compare.course import Course
    from compare.precision import Precision
    from reference.problem import Problem

__all__ = ["FLOOR_FACTOR", "floors_of"]

FLOOR_FACTOR = 10
GROWTH = 4
"""Rounding is taken to grow with no higher power of N: at a fixed end it goes with the root of N, at worst with N."""


def floors_of(method: Method, courses: Sequence[Course], errors: Sequence[np.ndarray], fmt: Precision) -> list[bool]:
    """Which courses are on the floor, given the errors [samples, state] of their marches, each problem's by N.

    A neighbour is marched only where the error is so small that it may be rounding, no coarser course is on the floor,
    and no coarser neighbour told that rounding is still far away: most are not, and those have few steps.
    """
    largest = [float(np.max(course.place(error))) for course, error in zip(courses, errors, strict=True)]
    doubtful = [size <= FLOOR_FACTOR * course.roundings for size, course in zip(largest, courses, strict=True)]
    places: dict[Problem, list[int]] = {}
    for i, course in enumerate(courses):
        places.setdefault(course.problem, []).append(i)
    floors = [False] * len(courses)
    lanes = [course.lane for course in courses]
    while waiting := [i for members in places.values() for i in _coarsest(members, doubtful)]:
        neighbours = [courses[i].neighbour for i in waiting]
        marches = march(method, [neighbour.lane for neighbour in neighbours], fmt, among=lanes)
        for i, neighbour, result in zip(waiting, neighbours, marches, strict=True):
            noise = _noise(courses[i], errors[i], neighbour.errors(result.states))
            members = places[courses[i].problem]
            finer = members[members.index(i) :]
            if largest[i] <= FLOOR_FACTOR * noise and noise <= courses[i].roundings:
                for j in finer:
                    floors[j], doubtful[j] = True, False
            least = max(noise, _rounding(courses[i]))
            for j in finer:
                doubtful[j] &= j != i and largest[j] <= FLOOR_FACTOR * least * (courses[j].n / courses[i].n) ** GROWTH
    return floors


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


def _coarsest(members: Sequence[int], doubtful: Sequence[bool]) -> list[int]:
    """The first doubtful courses of a problem: two at once, since lanes of one march take little longer together."""
    return [i for i in members if doubtful[i]][:2]
