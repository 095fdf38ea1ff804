"""Phase and amplitude: on a harmonic motion they are known of each method in closed form."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np
import pytest

from compare.march.march import march
from compare.march.precision import precision
from compare.measure.scores import score
from compare.measure.truth import Course
from compare.methods import find
from reference import Descent, Pendulum, PolarBrachistochrone, Tautochrone, Tunnel
from reference.problems.cycloid.tautochrone import CycloidalPendulum

if TYPE_CHECKING:
    from reference.problem import Problem

FLOAT64 = precision("float64")
ARC = CycloidalPendulum(1.0)
W = math.sqrt(9.81 / 4)


def phase(method: str, problem: Problem, n: int = 512, t_end: int = 10, name: str = "float64"):
    fmt = precision(name)
    (found,) = score(find(method), [Course(problem, n, Fraction(t_end), fmt)], fmt, ("phase",))["phase"]
    return found


def test_eulers_phase_and_amplitude_are_those_of_its_multiplier() -> None:
    """With z = s + i s'/w a step multiplies by 1 - i w h: the amplitude grows, the phase advances by atan(w h)."""
    found, h = phase("euler", ARC), 10 / 512
    assert found.end_phase_error == pytest.approx(512 * (math.atan(W * h) - W * h), rel=1e-10)
    assert found.end_amplitude_error == pytest.approx((1 + (W * h) ** 2) ** 256 - 1, rel=1e-10)
    assert found.max_amplitude_error == found.end_amplitude_error
    assert found.max_phase_error == -found.end_phase_error


def test_phases_are_followed_over_whole_turns() -> None:
    found, h = phase("euler", ARC, n=256, t_end=100), 100 / 256
    assert found.end_phase_error == pytest.approx(256 * (math.atan(W * h) - W * h), rel=1e-10)
    assert abs(found.end_phase_error) > 2 * math.pi


def test_the_angle_has_the_phase_and_the_amplitude_of_its_arc() -> None:
    """One step of Euler leaves theta and turns omega: the orbit through that state, by hand."""
    h, start = 1 / 8, 1.0
    found = phase("euler", Tautochrone(start), n=1, t_end=h)
    omega = -h * math.tan(start / 2) * 9.81 / 2
    x, v = math.sin(start / 2), math.cos(start / 2) * omega / 2 / W
    assert found.end_amplitude_error == pytest.approx(2 * math.asin(math.hypot(x, v)) - start, rel=1e-12)
    assert found.end_phase_error == pytest.approx(math.atan2(x, v) - math.pi / 2 - W * h, rel=1e-12)


@pytest.mark.parametrize("name", ["float64", "longdouble", "float128", "mp:160"])
def test_phases_are_the_same_in_every_format_where_truncation_dominates(name: str) -> None:
    wide, double = phase("rk4", Pendulum(1.0), name=name), phase("rk4", Pendulum(1.0))
    assert wide.end_phase_error == pytest.approx(double.end_phase_error, rel=1e-6)
    assert wide.end_amplitude_error == pytest.approx(double.end_amplitude_error, rel=1e-6)


def test_a_phase_in_binary128_is_told_far_below_the_roundings_of_doubles() -> None:
    found = phase("gauss6", Pendulum(1.0), n=16384, t_end=2, name="float128")
    assert 1e-27 < found.max_phase_error < 1e-21
    assert 1e-30 < found.max_amplitude_error < 1e-21


def test_a_small_error_of_the_state_is_one_of_phase_along_the_orbit_and_of_amplitude_across() -> None:
    """d(theta)/d(phase) at the end is omega T/(2 pi); the rest is the amplitude's."""
    course = Course(ARC, 2048, Fraction(7), FLOAT64)
    found = phase("rk4", ARC, n=2048, t_end=7)
    (cell,) = score(find("rk4"), [course], FLOAT64, ())["error_vs_n"]
    arc, rate = course.truth[-1, :, 0]
    along = rate / W * found.end_phase_error + arc * found.end_amplitude_error
    assert abs(along) == pytest.approx(cell.end_error * course.reach.sizes[0], rel=1e-6)


def test_a_rotation_has_a_phase_and_no_amplitude() -> None:
    found = phase("rk4", Pendulum(0.5, omega0=8.0))
    assert 0 < found.max_phase_error < 1e-3
    assert math.isnan(found.max_amplitude_error)


def test_states_that_leave_the_kind_of_motion_are_counted_as_lost() -> None:
    found = phase("euler", Pendulum(3.0), n=128)
    assert 0 < found.lost <= 128
    assert phase("verlet", Pendulum(1.0)).lost == 0


def test_a_march_that_overflows_has_no_phase() -> None:
    found = phase("euler", ARC, n=2048, t_end=10**9)
    assert found.lost > 0
    assert np.isnan(found.end_phase_error)


@pytest.mark.parametrize("problem", [PolarBrachistochrone(z0=0.5), PolarBrachistochrone(z0=0.95), Tunnel(z0=0.3)])
def test_in_a_central_field_phase_and_amplitude_err_with_the_order_of_the_method(problem: Problem) -> None:
    coarse, fine = (phase("gauss4", problem, n, t_end=4, name="float128") for n in (1024, 2048))
    assert math.log2(coarse.end_phase_error / fine.end_phase_error) == pytest.approx(4, abs=0.05)
    assert math.log2(coarse.end_amplitude_error / fine.end_amplitude_error) == pytest.approx(4, abs=0.05)
    assert (coarse.lost, fine.lost) == (0, 0)


def test_a_small_error_in_a_central_field_is_one_of_phase_along_the_orbit_where_nothing_else_is_wrong() -> None:
    """d(z)/d(phase) is z' T/(2 pi): of a march that keeps the invariant to rounding, the phase is all of the error."""
    problem = PolarBrachistochrone(z0=0.5)
    course = Course(problem, 4096, Fraction(3), FLOAT64)
    found = phase("rk4_projected", problem, n=4096, t_end=3)
    (result,) = march(find("rk4_projected"), [course.lane], FLOAT64)
    error = course.errors(result.states)[-1, 0]
    period = 2 * float(problem.descent_time())
    assert found.max_amplitude_error < 1e-14
    assert error == pytest.approx(course.truth[-1, 1, 0] * period / (2 * math.pi) * found.end_phase_error, rel=1e-3)


def test_a_motion_without_known_orbits_has_no_record() -> None:
    course = Course(Descent("parabola"), 128, Fraction(1, 2), FLOAT64)
    assert score(find("rk4"), [course], FLOAT64, ("phase",))["phase"] == []
