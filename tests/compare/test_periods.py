"""The period of a method's own motion: on a harmonic motion it is known in closed form."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING

import pytest

from compare.march.precision import precision
from compare.measure.scores import score
from compare.measure.truth import Course
from compare.methods import find
from reference import Cycloid, Pendulum, PolarBrachistochrone, Tautochrone, Tunnel
from reference.problems.cycloid.tautochrone import CycloidalPendulum

if TYPE_CHECKING:
    from reference.problem import Problem

W = math.sqrt(9.81 / 4)


def own(method: str, problem: Problem, n: int, name: str = "float64"):
    fmt = precision(name)
    return score(find(method), [Course(problem, n, Fraction(10), fmt)], fmt, ("period",))["period"]


@pytest.mark.parametrize("problem", [CycloidalPendulum(1.0), Cycloid(3.0, 2.0)])
@pytest.mark.parametrize("n", [32, 512, 8192])
def test_the_period_is_that_of_the_methods_multiplier(problem: Problem, n: int) -> None:
    """Euler turns z = s + i s'/w by atan(w h) in a step, the implicit midpoint rule by 2 atan(w h/2)."""
    x = problem.rate() * 10 / n
    (euler,), (midpoint,) = own("euler", problem, n), own("implicit_midpoint", problem, n)
    assert euler.relative_error == pytest.approx(x / math.atan(x) - 1, rel=1e-6)
    assert midpoint.relative_error == pytest.approx(x / 2 / math.atan(x / 2) - 1, rel=1e-6)
    assert euler.period == pytest.approx(2 * math.pi / problem.rate() * (1 + euler.relative_error), rel=1e-12)


def test_conjugate_methods_have_one_period() -> None:
    """Symplectic Euler and position Verlet differ by a change of variables alone, which no period knows of."""
    (first,), (second,) = own("symplectic_euler", Pendulum(1.0), 8192), own("position_verlet", Pendulum(1.0), 8192)
    assert first.relative_error == pytest.approx(second.relative_error, rel=1e-3)


@pytest.mark.parametrize(("method", "order"), [("verlet", 2), ("suzuki4", 4), ("gauss6", 6)])
def test_the_error_of_the_period_has_the_order_of_the_method(method: str, order: int) -> None:
    (coarse,), (fine,) = (own(method, Pendulum(1.0), n, "float128") for n in (1024, 2048))
    assert math.log2(coarse.relative_error / fine.relative_error) == pytest.approx(order, abs=0.02)


@pytest.mark.parametrize(
    "problem", [Pendulum(1.0), Pendulum(-0.5, omega0=2.0), Pendulum(0.5, omega0=8.0), Tautochrone(3.0)]
)
def test_libration_rotation_and_swing_have_their_periods(problem: Problem) -> None:
    (found,) = own("rk4", problem, 4096)
    assert 0 < abs(found.relative_error) < 1e-6
    assert found.period == pytest.approx(float(problem.certified("period")), rel=1e-6)


@pytest.mark.parametrize("problem", [PolarBrachistochrone(z0=0.5), PolarBrachistochrone(z0=0.9), Tunnel(z0=0.5)])
def test_in_a_central_field_the_period_is_from_one_lowest_point_to_the_next(problem: Problem) -> None:
    (coarse,), (fine,) = (own("gauss4", problem, n, "float128") for n in (4096, 8192))
    assert math.log2(coarse.relative_error / fine.relative_error) == pytest.approx(4, abs=0.05)
    assert fine.period == pytest.approx(2 * float(problem.certified("descent_time")), rel=1e-8)


@pytest.mark.parametrize("method", ["euler", "implicit_euler"])
def test_a_period_is_found_where_the_passages_are_many_steps_from_the_exact_ones(method: str) -> None:
    """Of a method of order one they are as many steps away at every N."""
    (coarse,), (fine,) = (own(method, PolarBrachistochrone(z0=0.5), n) for n in (2**15, 2**16))
    assert abs(fine.relative_error) * fine.period * 3 / 2 > 32 * fine.h
    assert coarse.relative_error / fine.relative_error == pytest.approx(2, abs=0.02)


def test_no_passage_is_no_period() -> None:
    (found,) = own("euler", Pendulum(3.0), 64)
    assert math.isnan(found.period)
    assert math.isnan(found.relative_error)


def test_the_separatrix_has_no_record() -> None:
    assert own("rk4", Pendulum(0, g=1, omega0=2), 64) == []
