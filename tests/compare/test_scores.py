"""Scores: errors at exactly n h, floors, fitted orders, drift."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np
import pytest
from made_study import made_case, made_cell

from compare.march.march import march
from compare.march.precision import precision
from compare.measure.errors import score_errors, score_method
from compare.measure.order_fit import fit_order, slope_with_interval, student_95
from compare.measure.truth import Course
from compare.methods import find
from reference import Pendulum
from reference.arithmetic.precision import mp
from reference.problems.cycloid.tautochrone import CycloidalPendulum

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.measure.records import Cell

FLOAT64 = precision("float64")
RK4 = find("rk4")


def cells(errors: list[float], floor: tuple[int, ...] = ()) -> list[Cell]:
    return [
        made_cell("rk4", 2 ** (7 + i), 10 / 2 ** (7 + i), made_case(1.0), error, None, i in floor, 0)
        for i, error in enumerate(errors)
    ]


def test_the_error_is_taken_at_exactly_n_h() -> None:
    """10/3 is no double: at 3 steps the march ends at 3 fl(10/3), not at 10."""
    course = Course(Pendulum(1.0), 3, Fraction(10), FLOAT64)
    assert course.times[-1] == 3 * Fraction(10 / 3)
    assert course.times[-1] != 10


@pytest.mark.parametrize("name", ["float32", "longdouble", "float128", "mp:200"])
def test_h_is_rounded_to_the_format(name: str) -> None:
    fmt = precision(name)
    course = Course(Pendulum(1.0), 3, Fraction(10), fmt)
    assert course.h == fmt.round(Fraction(10, 3)) != Fraction(10, 3)


def test_the_error_of_rk4_is_that_of_an_independent_march() -> None:
    """The same method in mpmath, against mpmath's elliptic function."""
    ((cell,), _) = score_method(RK4, [Course(Pendulum(1.0), 128, Fraction(10), FLOAT64)], FLOAT64)
    with mp.workdps(30):
        q, v, h, g = mp.mpf(1), mp.mpf(0), mp.mpf(10) / 128, mp.mpf(9.81)
        k, largest = mp.sin(mp.mpf(1) / 2), mp.mpf(0)
        for n in range(1, 129):
            a1, a2 = v, v - h / 2 * g * mp.sin(q)
            f2 = -g * mp.sin(q + h / 2 * a1)
            a3, f3 = v + h / 2 * f2, -g * mp.sin(q + h / 2 * a2)
            a4, f4 = v + h * f3, -g * mp.sin(q + h * a3)
            q, v = q + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4), v + h / 6 * (-g * mp.sin(q) + 2 * f2 + 2 * f3 + f4)
            exact = 2 * mp.asin(k * mp.ellipfun("cd", mp.sqrt(g) * n * h, m=k * k))
            largest = max(largest, abs(q - exact))
        assert cell.max_error == pytest.approx(float(largest), rel=1e-9)
        assert cell.end_error == pytest.approx(float(abs(q - exact)), rel=1e-9)


def test_the_floor_is_where_rounding_is() -> None:
    """RK4 in doubles leaves the slope of its binary128 self where its cells are marked, and not before."""
    n = [2**k for k in range(9, 19)]
    doubles, _ = score_method(RK4, [Course(Pendulum(1.0), k, Fraction(10), FLOAT64) for k in n], FLOAT64)
    fmt = precision("longdouble")
    wide, _ = score_method(RK4, [Course(Pendulum(1.0), k, Fraction(10), fmt) for k in n], fmt)
    for narrow, true in zip(doubles, wide, strict=True):
        if not narrow.floor:
            assert narrow.max_error == pytest.approx(true.max_error, rel=0.15)
    assert [cell.floor for cell in doubles] == sorted(cell.floor for cell in doubles)
    assert doubles[-1].floor
    assert not doubles[4].floor


def floors(method: str, theta0: float, n: Sequence[int], t_end: int = 10, name: str = "float64") -> list[bool]:
    fmt = precision(name)
    cells, _ = score_method(find(method), [Course(Pendulum(theta0), k, Fraction(t_end), fmt) for k in n], fmt)
    return [cell.floor for cell in cells]


@pytest.mark.parametrize("theta0", [1.0, 0.001])
def test_a_step_too_large_is_not_called_rounding(theta0: float) -> None:
    assert not any(floors("verlet", theta0, [10, 20, 40, 80, 160, 320, 640, 1280]))
    assert not any(floors("yoshida4", theta0, [8, 16, 32, 64, 128]))


def test_chaos_of_the_method_over_a_long_time_is_not_called_rounding() -> None:
    assert not any(floors("verlet", 3.1, [8192, 16384, 32768], t_end=1000))


@pytest.mark.parametrize(
    ("method", "theta0", "name"), [("yoshida4", 3.1, "float32"), ("midpoint", 3.141592653589, "float64")]
)
def test_rounding_is_seen_beside_the_top_and_in_narrow_formats(method: str, theta0: float, name: str) -> None:
    found = floors(method, theta0, [2**k for k in range(9, 17)], name=name)
    assert found[-1]
    assert found == sorted(found)


def test_a_neighbour_is_another_start_in_every_format() -> None:
    for name in ("float32", "float64", "longdouble", "float128"):
        fmt = precision(name)
        for theta0 in (1e-30, 0.001, 1.0, 3.1, 3.1415925, 3.141592653589793):
            course = Course(Pendulum(theta0), 128, Fraction(10), fmt)
            assert fmt.number(course.problem.theta0) != fmt.number(course.neighbour.problem.theta0)


def test_a_start_that_the_format_cannot_hold_is_refused() -> None:
    with pytest.raises(ValueError, match="theta starts at 1e-200, which float32 cannot hold"):
        Course(Pendulum(1e-200), 128, Fraction(10), precision("float32"))


def test_a_perfect_power_law_is_fitted_exactly() -> None:
    fitted = fit_order(RK4, cells([2.0 ** (-4 * i) * 1e-3 for i in range(8)]))
    assert fitted.fitted_order == pytest.approx(4, abs=1e-12)
    assert fitted.cells_used == 8
    assert fitted.n_range == (128, 16384)


def test_floor_cells_and_the_approach_are_left_out_of_the_fit() -> None:
    errors = [0.9, 0.5, *(2.0 ** (-4 * i) * 1e-3 for i in range(6)), 3e-14, 5e-14]
    fitted = fit_order(RK4, cells(errors, floor=(8, 9)))
    assert fitted.fitted_order == pytest.approx(4, abs=1e-12)
    assert fitted.n_range == (512, 16384)


def test_the_fit_does_not_know_what_the_method_declares() -> None:
    fitted = fit_order(RK4, cells([2.0 ** (-2 * i) * 1e-3 for i in range(8)]))
    assert fitted.declared_order == 4
    assert fitted.fitted_order == pytest.approx(2)


def test_two_cells_are_no_fit() -> None:
    fitted = fit_order(RK4, cells([1e-3, 1e-4]))
    assert (fitted.fitted_order, fitted.spread, fitted.cells_used, fitted.n_range) == (None, None, 0, None)


def test_cells_that_are_not_numbers_are_left_out() -> None:
    fitted = fit_order(RK4, cells([math.nan, math.inf, *(2.0 ** (-2 * i) * 1e-3 for i in range(5))]))
    assert fitted.fitted_order == pytest.approx(2)


@pytest.mark.parametrize("freedom", [1, 2, 3, 4, 7, 20, 126])
def test_students_quantile_is_that_of_its_distribution(freedom: int) -> None:
    x = student_95(freedom)
    with mp.workdps(15):
        tail = mp.betainc(freedom / 2, 0.5, 0, freedom / (freedom + x * x), regularized=True)
    assert float(tail) == pytest.approx(0.05, rel=0.01)


def test_a_line_with_noise_has_an_interval_that_covers_its_slope() -> None:
    random = np.random.default_rng(1)
    covered = 0
    x = np.arange(20.0)
    for _ in range(400):
        slope, half = slope_with_interval(x, 3 * x + random.normal(size=20))
        covered += abs(slope - 3) <= half
    assert 360 <= covered <= 396


def test_drift_has_both_normalisations_and_eulers_grows() -> None:
    course = Course(Pendulum(1.0), 1024, Fraction(10), FLOAT64)
    _, (euler,) = score_method(find("euler"), [course], FLOAT64)
    assert euler.max_drift_above_rest == pytest.approx(
        euler.max_drift_relative * math.cos(1) / (1 - math.cos(1)), rel=1e-12
    )
    assert euler.slope_per_period == pytest.approx(0.236, abs=0.001)
    assert 0 < euler.slope_interval < 0.02 * euler.slope_per_period


def test_verlets_energy_error_stays_bounded_and_rk4s_drifts() -> None:
    course = Course(Pendulum(1.0), 16384, Fraction(400), FLOAT64)
    _, (verlet,) = score_method(find("verlet"), [course], FLOAT64)
    _, (rk4,) = score_method(RK4, [course], FLOAT64)
    assert abs(verlet.slope_per_period) < 3 * verlet.slope_interval
    assert abs(rk4.slope_per_period) > 10 * rk4.slope_interval


def test_norms_and_digits_are_of_the_errors_at_the_samples() -> None:
    course = Course(Pendulum(1.0), 128, Fraction(10), FLOAT64)
    ((cell,), _) = score_method(RK4, [course], FLOAT64)
    (states,) = (result.states for result in march(RK4, [course.lane], FLOAT64))
    errors = np.abs(states - course.truth[..., 0])
    assert cell.rms_error == pytest.approx(math.sqrt(np.mean(errors[:, 0] ** 2)), rel=1e-9)
    assert cell.max_velocity_error == pytest.approx(np.max(errors[:, 1]), rel=1e-9)
    assert cell.end_velocity_error == pytest.approx(errors[-1, 1], rel=1e-9)
    assert cell.rms_velocity_error == pytest.approx(math.sqrt(np.mean(errors[:, 1] ** 2)), rel=1e-9)
    assert cell.digits == pytest.approx(-math.log10(cell.max_error / np.max(np.abs(course.truth[:, 0, 0]))), rel=1e-9)


def test_digits_are_no_more_than_the_format_holds_and_no_less_than_none() -> None:
    fmt = precision("float32")
    ((exact,), _) = score_method(find("verlet"), [Course(Pendulum(0, omega0=0), 16, Fraction(1), fmt)], fmt)
    ((lost,), _) = score_method(find("euler"), [Course(Pendulum(1.0), 16, Fraction(100), fmt)], fmt)
    assert exact.digits == pytest.approx(24 * math.log10(2))
    assert lost.digits == 0


@pytest.mark.parametrize("omega0", [2.0, -8.0])
def test_a_pendulum_set_going_is_scored_like_a_released_one(omega0: float) -> None:
    """Rotation and libration from a moving start: orders, floors, drift."""
    courses = [Course(Pendulum(0.5, omega0=omega0), 2**k, Fraction(4), FLOAT64) for k in range(8, 17)]
    cells, drifts = score_method(RK4, courses, FLOAT64)
    fitted = fit_order(RK4, cells)
    assert fitted.fitted_order == pytest.approx(4, abs=0.1)
    assert cells[-1].floor
    assert not cells[2].floor
    assert all(drift.max_drift_above_rest > 0 for drift in drifts)


def test_the_separatrix_has_a_trend_per_second() -> None:
    _, (drift,) = score_method(RK4, [Course(Pendulum(0, g=1, omega0=2), 256, Fraction(4), FLOAT64)], FLOAT64)
    assert drift.case.cycle == "s"
    assert math.isfinite(drift.slope_per_period)


def test_errors_in_the_units_of_the_state_are_not_divided_by_its_size() -> None:
    course = Course(CycloidalPendulum(2.0), 128, Fraction(10), FLOAT64)
    (plain,), ((relative,), _) = score_errors(RK4, [course], FLOAT64), score_method(RK4, [course], FLOAT64)
    assert plain.max_error == pytest.approx(relative.max_error * course.conditioning.sizes[0], rel=1e-12)
    assert plain.digits == relative.digits
