"""What few neighbours tell of rounding is what the neighbours of all courses tell, and what another machine shows."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from compare.course import Course
from compare.march import march
from compare.methods import find
from compare.precision import precision
from compare.records import FLOOR_FACTOR
from compare.rounding import Rounding, roundings_of
from reference import Pendulum

FLOAT64, FLOAT32, FLOAT128 = precision("float64"), precision("float32"), precision("float128")
PROBLEMS = tuple(Pendulum(amplitude) for amplitude in (0.1, 1.0, 2.0, 3.0))


def by_all_neighbours(name: str, courses: list[Course], errors: list[np.ndarray]) -> list[bool]:
    """From the coarsest course on: within FLOOR_FACTOR of what tells it from its neighbour, or a coarser one was."""
    fmt = courses[0].fmt
    marches = march(find(name), [course.neighbour.lane for course in courses], fmt)
    floors: list[bool] = []
    for i, (course, error, result) in enumerate(zip(courses, errors, marches, strict=True)):
        noise = float(np.max(np.abs(error - course.neighbour.errors(result.states))[:, 0]))
        own = np.max(np.abs(error[:, 0])) <= FLOOR_FACTOR * noise and noise <= 8 * course.n * course.place_led
        floors.append(bool(own) or (i > 0 and courses[i - 1].problem == course.problem and floors[-1]))
    return floors


def marched(name: str, courses: list[Course]) -> tuple[list[Any], list[np.ndarray]]:
    marches = march(find(name), [course.lane for course in courses], courses[0].fmt)
    return marches, [course.errors(result.states) for course, result in zip(courses, marches, strict=True)]


def told(name: str, courses: list[Course]) -> list[Rounding]:
    return roundings_of(find(name), courses, *marched(name, courses), courses[0].fmt)


@pytest.mark.parametrize("name", ["euler", "verlet", "rk4", "yoshida4", "yoshida6", "gauss4", "ab5"])
@pytest.mark.parametrize("fmt", [FLOAT64, FLOAT32], ids=lambda fmt: fmt.name)
def test_few_neighbours_tell_what_all_do(name: str, fmt: Any) -> None:
    courses = [Course(problem, 2**k, Fraction(10), fmt) for problem in PROBLEMS for k in range(7, 18)]
    errors = marched(name, courses)[1]
    floors = [found.floor for found in told(name, courses)]
    assert floors == by_all_neighbours(name, courses, errors)
    assert any(floors) or name == "euler" or (name == "verlet" and fmt is FLOAT64)


@pytest.mark.parametrize("name", ["euler", "heun", "verlet", "rk4", "yoshida6", "gauss4", "bdf2", "projected_rk4"])
def test_rounding_is_not_beyond_its_bound(name: str) -> None:
    """A bound on random steps, not the worst: the same steps in binary128 stand where truncation alone leads."""
    courses = [Course(problem, 2**k, Fraction(10), FLOAT64) for problem in PROBLEMS for k in range(7, 14, 2)]
    wide = [Course(course.problem, course.n, course.n * course.h, FLOAT128) for course in courses]
    for one, own, its in zip(told(name, courses), marched(name, courses)[1], marched(name, wide)[1], strict=True):
        off = np.max(np.abs(own - its), axis=0)
        if np.max(np.abs(own[:, 0])) < 1:  # one that is lost is on another motion, which carries roundings otherwise
            assert off[0] <= 2 * one.place
            assert np.all(off <= 2 * one.state)


def test_a_method_far_from_rounding_marches_no_neighbour(monkeypatch: pytest.MonkeyPatch) -> None:
    courses = [Course(PROBLEMS[1], 2**k, Fraction(10), FLOAT64) for k in range(7, 15)]
    counts = counted(monkeypatch)
    assert not any(found.floor for found in told("euler", courses))
    assert not counts


def test_few_steps_tell_of_the_rounding_of_many(monkeypatch: pytest.MonkeyPatch) -> None:
    courses = [Course(PROBLEMS[1], 2**k, Fraction(10), FLOAT64) for k in range(7, 21)]
    counts = counted(monkeypatch)
    assert not any(found.floor for found in told("verlet", courses))
    assert counts == [2**13, 2**14]


def test_a_method_on_the_floor_marches_few_neighbours(monkeypatch: pytest.MonkeyPatch) -> None:
    courses = [Course(PROBLEMS[1], 2**k, Fraction(10), FLOAT64) for k in range(7, 21)]
    counts = counted(monkeypatch)
    assert told("yoshida6", courses)[-1].floor
    assert max(counts) <= 2**15


def counted(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """The numbers of steps of the neighbours that are marched."""
    counts: list[int] = []

    def march_and_count(method: Any, lanes: Any, fmt: Any, among: Any) -> Any:
        counts.extend(lane.n for lane in lanes)
        return march(method, lanes, fmt, among)

    monkeypatch.setattr("compare.rounding.march", march_and_count)
    return counts
