"""Symplecticity and reversibility defects: on a harmonic motion they are known in closed form."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING

import pytest

from compare.march.precision import precision
from compare.measure.scores import score
from compare.measure.truth import Course
from compare.methods import find
from reference import Descent, Pendulum, PolarBrachistochrone, Tautochrone
from reference.problems.cycloid.tautochrone import CycloidalPendulum
from reference.problems.families import find_family
from reference.problems.polar.paths import PolarByPsi

if TYPE_CHECKING:
    from reference.problem import Problem

ARC = CycloidalPendulum(1.0)


def defects(method: str, problem: Problem, n: int = 256, t_end: int = 10, name: str = "float64"):
    fmt = precision(name)
    (found,) = score(find(method), [Course(problem, n, Fraction(t_end), fmt)], fmt, ("defects",))["defects"]
    return found


def test_eulers_defects_are_those_of_its_multiplier() -> None:
    """|1 - i w h|^2 = 1 + (w h)^2 is the determinant, and forward and back the factor of n steps."""
    found, square = defects("euler", ARC), 9.81 / 4 * (10 / 256) ** 2
    assert found.symplecticity == pytest.approx(square, rel=1e-12)
    assert found.reversibility == pytest.approx((1 + square) ** 256 - 1, rel=1e-4)


@pytest.mark.parametrize("name", ["symplectic_euler", "verlet", "ruth3", "yoshida4", "yoshida8", "implicit_midpoint"])
def test_a_symplectic_method_has_no_defect_but_rounding(name: str) -> None:
    assert defects(name, Pendulum(1.0)).symplecticity < 4e-15


@pytest.mark.parametrize(
    ("name", "least"), [("verlet", False), ("yoshida4", False), ("gauss4", False), ("ruth3", True)]
)
def test_a_symmetric_method_runs_backwards(name: str, least: bool) -> None:
    found = defects(name, Pendulum(1.0)).reversibility
    assert found > 1e-8 if least else found < 1e-13


@pytest.mark.parametrize("problem", [Pendulum(1.0), PolarBrachistochrone(z0=0.5)])
def test_rounding_is_that_of_the_format(problem: Problem) -> None:
    found = defects("gauss4", problem, n=64, t_end=2, name="float128")
    assert found.symplecticity < 1e-32
    assert found.reversibility < 1e-30


@pytest.mark.parametrize("problem", [Tautochrone(1.0), Descent("quartic"), PolarBrachistochrone(z0=0.5)])
def test_area_counts_with_the_mass_where_momentum_is_not_velocity(problem: Problem) -> None:
    """The exact motion keeps M dq dq', and so does RK4 to its order: halving h divides the defect by 2^5 or more."""
    coarse, fine = (defects("rk4", problem, n=n, t_end=1).symplecticity for n in (64, 128))
    assert coarse < 1e-3
    assert coarse / fine > 2**4.7


def test_the_angle_of_a_polar_path_turns_back_with_time() -> None:
    assert defects("implicit_midpoint", PolarBrachistochrone(z0=0.5)).reversibility < 1e-12


def test_what_carries_more_than_the_state_has_no_determinant() -> None:
    found = defects("adams_bashforth2", Pendulum(1.0))
    assert math.isnan(found.symplecticity)
    assert found.reversibility > 0


def test_a_curve_has_no_defects() -> None:
    found = defects("rk4", PolarByPsi(0.5), t_end=6)
    assert math.isnan(found.symplecticity)
    assert math.isnan(found.reversibility)


def test_a_march_that_is_lost_does_not_come_back() -> None:
    assert math.isnan(defects("euler", ARC, n=2048, t_end=10**9).reversibility)


def test_entries_of_the_form_that_change_as_much_with_other_signs_are_no_rounding() -> None:
    """In Toda's ring the momentum is kept: the entries of the form's change come in such pairs."""
    found = defects("rk4", find_family("toda").problem(), n=16, t_end=1)
    assert found.symplecticity > 1e-6
    assert found.symplecticity_rounding < 1e-12
