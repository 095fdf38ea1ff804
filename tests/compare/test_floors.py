"""Floors found by few neighbours are those that the neighbours of all courses tell."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from compare.course import Course
from compare.floors import FLOOR_FACTOR, floors_of
from compare.march import march
from compare.methods import find
from compare.precision import precision
from reference import Pendulum

FLOAT64, FLOAT32 = precision("float64"), precision("float32")
PROBLEMS = tuple(Pendulum(amplitude) for amplitude in (0.1, 1.0, 2.0, 3.0))


def by_all_neighbours(name: str, courses: list[Course], errors: list[np.ndarray]) -> list[bool]:
    """From the coarsest course on: within FLOOR_FACTOR of what tells it from its neighbour, or a coarser one was."""
    fmt = courses[0].fmt
    marches = march(find(name), [course.neighbour.lane for course in courses], fmt)
    floors: list[bool] = []
    for i, (course, error, result) in enumerate(zip(courses, errors, marches, strict=True)):
        noise = float(np.max(np.abs(error - course.neighbour.errors(result.states))[:, 0]))
        own = np.max(np.abs(error[:, 0])) <= FLOOR_FACTOR * noise and noise <= course.roundings
        floors.append(bool(own) or (i > 0 and courses[i - 1].problem == course.problem and floors[-1]))
    return floors


@pytest.mark.parametrize("name", ["euler", "verlet", "rk4", "yoshida4", "yoshida6", "gauss4", "ab5"])
@pytest.mark.parametrize("fmt", [FLOAT64, FLOAT32], ids=lambda fmt: fmt.name)
def test_few_neighbours_tell_what_all_do(name: str, fmt: Any) -> None:
    courses = [Course(problem, 2**k, Fraction(10), fmt) for problem in PROBLEMS for k in range(7, 18)]
    marches = march(find(name), [course.lane for course in courses], fmt)
    errors = [course.errors(result.states) for course, result in zip(courses, marches, strict=True)]
    floors = floors_of(find(name), courses, errors, fmt)
    assert floors == by_all_neighbours(name, courses, errors)
    assert any(floors) or name == "euler" or (name == "verlet" and fmt is FLOAT64)


def test_a_method_far_from_rounding_marches_no_neighbour(monkeypatch: pytest.MonkeyPatch) -> None:
    courses = [Course(PROBLEMS[1], 2**k, Fraction(10), FLOAT64) for k in range(7, 21)]
    errors = [course.errors(result.states) for course, result in _marched("euler", courses)]
    marched: list[Any] = []
    monkeypatch.setattr("compare.floors.march", lambda *words, **_: marched.append(words))
    assert not any(floors_of(find("euler"), courses, errors, FLOAT64))
    assert not marched


def test_a_method_on_the_floor_marches_few_neighbours(monkeypatch: pytest.MonkeyPatch) -> None:
    courses = [Course(PROBLEMS[1], 2**k, Fraction(10), FLOAT64) for k in range(7, 21)]
    errors = [course.errors(result.states) for course, result in _marched("yoshida6", courses)]
    counts: list[int] = []

    def march_and_count(method: Any, lanes: Any, fmt: Any, among: Any) -> Any:
        counts.extend(lane.n for lane in lanes)
        return march(method, lanes, fmt, among)

    monkeypatch.setattr("compare.floors.march", march_and_count)
    assert floors_of(find("yoshida6"), courses, errors, FLOAT64)[-1]
    assert max(counts) <= 2**15


def _marched(name: str, courses: list[Course]) -> list[tuple[Course, Any]]:
    return list(zip(courses, march(find(name), [course.lane for course in courses], FLOAT64), strict=True))
