"""What is said of rounding bounds it: near the separatrix, in every family, in narrow formats; not much too widely."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from statistics import median
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from compare.march.march import march
from compare.march.precision import precision
from compare.measure.rounding import Rounding, roundings_of
from compare.measure.truth import Course
from compare.methods import find
from compare.methods.kinds.compensated import compensate
from reference import Cycloid, Pendulum, PolarBrachistochrone, Tautochrone, Tunnel

if TYPE_CHECKING:
    from reference.problem import Problem

FLOAT64, FLOAT32, FLOAT128 = precision("float64"), precision("float32"), precision("float128")
PROBLEMS = (
    *(Pendulum(amplitude) for amplitude in (0.01, 1.0, 3.0, 3.13, 3.141, 3.1415)),
    Pendulum(1.0, omega0=7.0),
    Tautochrone(2.0, 1),
    Cycloid(2, 1),
    PolarBrachistochrone(z0=0.5),
    Tunnel(0.5),
)
METHODS = ("heun", "verlet", "rk4", "yoshida6", "kahan_li8", "gauss4", "bdf2", "taylor8")
COUNTS = (128, 1000, 4096)


def courses_of(problem: Problem, counts: Any = COUNTS, fmt: Any = FLOAT64) -> list[Course]:
    return [Course(problem, n, Fraction(10), fmt) for n in counts]


def marched(method: Any, courses: list[Course]) -> tuple[list[Any], list[np.ndarray]]:
    with np.errstate(over="ignore", invalid="ignore"):
        marches = march(method, [course.lane for course in courses], courses[0].fmt)
        return marches, [course.errors(result.states) for course, result in zip(courses, marches, strict=True)]


def told(method: Any, courses: list[Course]) -> list[Rounding]:
    found = marched(method, courses)
    with np.errstate(over="ignore", invalid="ignore"):
        return roundings_of(method, courses, *found, courses[0].fmt)


@cache
def shares(name: str, problem: Problem) -> list[float]:
    """What rounding is of its bound: the same steps in binary128 stand where truncation alone leads."""
    method, courses = find(name), courses_of(problem)
    if method.separable_only and not problem.positions:
        return []
    wide = [Course(course.problem, course.n, course.n * course.h, FLOAT128) for course in courses]
    (narrow, own), (exact, its) = marched(method, courses), marched(method, wide)
    found = []
    for one, course, error, other, result, true in zip(
        told(method, courses), courses, own, its, narrow, exact, strict=True
    ):
        if (
            np.max(course.position_error(error)) < 0.1
        ):  # one that is lost is on another motion, which carries roundings otherwise
            off = np.max(np.abs(error - other), axis=0)
            drift = max(
                (
                    abs(a - b) / scale / bound
                    for a, b, scale, bound in zip(
                        result.max_drifts, true.max_drifts, course.scales, one.drifts, strict=True
                    )
                    if scale
                ),
                default=0.0,
            )
            found.append(
                float(
                    max(
                        np.max(off / one.state),
                        np.max(course.position_error(error - other)) / one.position,
                        drift,
                    )
                )
            )
    return found


@pytest.mark.parametrize("name", METHODS)
def test_rounding_is_within_its_bound(name: str) -> None:
    found = {repr(problem): shares(name, problem) for problem in PROBLEMS}
    assert {problem: share for problem, of in found.items() for share in of if share > 1} == {}
    assert sum(map(len, found.values())) > len(PROBLEMS)


def test_the_bound_is_not_much_too_wide() -> None:
    typical = [median(found) for name in METHODS for problem in PROBLEMS if (found := shares(name, problem))]
    assert median(typical) > 0.03


@pytest.mark.parametrize("amplitude", [3.141, 3.1415, 3.1415926])
def test_near_the_separatrix_what_is_rounding_is_said_to_be(amplitude: float) -> None:
    courses = courses_of(Pendulum(amplitude), (1024, 2048, 4096, 8192))
    wide = [Course(course.problem, course.n, course.n * course.h, FLOAT128) for course in courses]
    method = find("kahan_li8")
    truncation = [np.max(np.abs(error[:, 0])) for error in marched(method, wide)[1]]
    errors = [np.max(np.abs(error[:, 0])) for error in marched(method, courses)[1]]
    assert all(own > 100 * exact for own, exact in zip(errors, truncation, strict=True))
    assert all(found.floor for found in told(method, courses))


@pytest.mark.parametrize("fmt", [FLOAT64, FLOAT32], ids=lambda fmt: fmt.name)
@pytest.mark.parametrize("name", ["verlet", "rk4", "yoshida6", "gauss4", "ab5"])
def test_an_error_that_falls_no_more_is_rounding(name: str, fmt: Any) -> None:
    courses = courses_of(Pendulum(1.0), [2**k for k in range(7, 19)], fmt)
    found, sizes = told(find(name), courses), [np.max(np.abs(error[:, 0])) for error in marched(find(name), courses)[1]]
    order = find(name).order
    for i in range(1, len(courses)):
        if sizes[i - 1] / sizes[i] < 2 ** (order - 1) / 2 and sizes[i] < 1e-3:
            assert found[i].floor, courses[i].n
    assert [one.floor for one in found] == sorted(one.floor for one in found)


def test_compensated_sums_lose_less_and_their_floor_is_found() -> None:
    courses = courses_of(Pendulum(1.0), (4096, 16384, 65536, 262144), FLOAT32)
    plain, better = told(find("rk4"), courses), told(compensate(find("rk4")), courses)
    assert all(found.floor for found in better)
    assert all(a.position < b.position for a, b in zip(better, plain, strict=True))


def test_a_method_far_from_rounding_marches_no_neighbour(monkeypatch: pytest.MonkeyPatch) -> None:
    courses = courses_of(Pendulum(1.0), [2**k for k in range(11, 15)])
    counts = counted(monkeypatch)
    assert not any(found.floor for found in told(find("euler"), courses))
    assert not counts


@pytest.mark.parametrize("name", ["verlet", "yoshida6"])
def test_neighbours_of_few_steps_tell_of_the_rounding_of_many(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    courses = courses_of(Pendulum(1.0), [2**k for k in range(7, 21)])
    counts = counted(monkeypatch)
    assert told(find(name), courses)[-1].floor == (name == "yoshida6")
    assert counts == [2**13, 2**14]


def test_the_bound_grows_where_a_neighbour_tells_of_more(monkeypatch: pytest.MonkeyPatch) -> None:
    courses, method = courses_of(Pendulum(1.0), (1024, 2048)), find("yoshida6")
    before = told(method, courses)

    def noisy(*arguments: Any, **options: Any) -> Any:
        found = march(*arguments, **options)
        if options:
            for one in found:
                one.states[:, 0] += 100 * before[0].position
        return found

    monkeypatch.setattr("compare.measure.rounding.march", noisy)
    wider = told(method, courses)
    assert {after.position / one.position for one, after in zip(before, wider, strict=True)} <= {16.0, 64.0, 256.0}


def counted(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """The numbers of steps of the neighbours that are marched."""
    counts: list[int] = []

    def march_and_count(method: Any, lanes: Any, fmt: Any, among: Any) -> Any:
        counts.extend(lane.n for lane in lanes)
        return march(method, lanes, fmt, among)

    monkeypatch.setattr("compare.measure.rounding.march", march_and_count)
    return counts
