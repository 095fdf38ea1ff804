"""Slopes, second slopes and condition numbers of the pendulum, against differences of other formulas."""

from __future__ import annotations

import math
import random
from fractions import Fraction

import numpy as np
import pytest
from independent import agm_period, condition_number, correct_limbs, fraction, released_state

from reference import Pendulum
from reference.arithmetic.precision import mp
from reference.routes.agreement import agreement

BITS = 3 * 159 + 100
TIMES = [0.7, 3.1, 9.5]


def limbs_of(value: object) -> list[float]:
    return correct_limbs(fraction(value), 3)


@pytest.mark.parametrize("theta0", [0.001, 0.3, 1.0, 2.5, math.pi - 1e-6])
def test_second_slopes_are_differences_of_another_formula_bit_by_bit(theta0):
    problem = Pendulum(theta0)
    found = problem.values("curvature", [Fraction(t) for t in TIMES], 3)
    with mp.workprec(BITS):
        for t, row in zip(TIMES, found.tolist(), strict=True):
            for i, limbs in enumerate(row):
                exact = mp.diff(
                    lambda a, i=i, t=t: released_state(a, mp.mpf(9.81), mp.mpf(1), mp.mpf(t))[i], mp.mpf(theta0), 2
                )
                assert limbs == limbs_of(exact)


@pytest.mark.parametrize("theta0", [0.001, 1.0, 3.0, math.pi - 1e-9])
def test_slopes_of_the_period_are_differences_of_the_arithmetic_geometric_mean(theta0):
    problem = Pendulum(theta0)
    with mp.workprec(BITS):
        for order, row in ((1, "dperiod_damplitude"), (2, "d2period_damplitude2")):
            exact = mp.diff(lambda a: agm_period(a, mp.mpf(9.81), mp.mpf(1)), mp.mpf(theta0), order)
            assert list(problem.certified(row).limbs(3)) == limbs_of(exact)


def test_the_period_bends_upwards_as_its_series_says():
    problem = Pendulum("1e-20", g=1)
    with mp.workprec(200):
        assert abs(mp.mpf(problem.certified("d2period_damplitude2").digits(40)) - mp.pi / 4) < mp.mpf(10) ** -38


@pytest.mark.parametrize(
    ("theta0", "omega0"),
    [(1.0, 0), (3.0, 0), (0.5, 2), (-1, -2.5), (0.3, 7), (2, -5), (0, 2 * math.sqrt(9.81) * (1 + 1e-9))],
)
def test_condition_numbers_are_singular_values_of_differences_bit_by_bit(theta0, omega0):
    problem = Pendulum(theta0, omega0=omega0)
    found = problem.values("condition", [Fraction(t) for t in TIMES], 3)
    with mp.workprec(BITS + 80):
        for t, (limbs,) in zip(TIMES, found.tolist(), strict=True):
            exact = condition_number(mp.mpf(theta0), mp.mpf(omega0), mp.mpf(9.81), mp.mpf(1), mp.mpf(t))
            assert limbs == limbs_of(exact)


def test_an_error_of_the_start_grows_no_more_than_the_condition_says():
    rng = random.Random(1667)
    for theta0, omega0 in ((1.0, 0), (2.9, 0.4), (0.3, 7), (0, 6.2)):
        problem, w = Pendulum(theta0, omega0=omega0), math.sqrt(9.81)
        for t in (0.5, 2.0, 20.0):
            condition = float(problem.certified("condition", Fraction(t)))
            slopes = problem.along("gradient", [t])[0]
            jacobian = np.array([[slopes[0], slopes[1] * w], [slopes[4] / w, slopes[5]]])
            growth = [
                np.linalg.norm(jacobian @ (math.cos(angle), math.sin(angle)))
                for angle in (rng.uniform(0, 2 * math.pi) for _ in range(200))
            ]
            assert max(growth) <= condition * (1 + 1e-12)
            assert max(growth) > 0.9 * condition
            assert np.linalg.det(jacobian) == pytest.approx(1, rel=1e-9 * condition**2)


def test_the_condition_is_one_where_nothing_has_happened_or_can():
    assert Pendulum(1.0).along("condition", [0], limbs=3).tolist() == [[[1.0, 0.0, 0.0]]]
    assert Pendulum(0, omega0=0).along("condition", [0, "1/3", 1e9]).tolist() == [[1.0]] * 3
    assert (Pendulum(1e-6).along("condition", np.linspace(0.1, 50, 20)) > 1).all()


def test_near_the_separatrix_digits_are_lost_where_the_pendulum_hesitates():
    """On the separatrix a start's error grows as exp(w t)."""
    grows = Pendulum(0, 1, 1, 2).along("condition", [10.0, 20.0, 30.0])[:, 0]
    assert np.diff(np.log(grows)) == pytest.approx([10, 10], abs=1e-3)
    for problem in (Pendulum(math.pi - 1e-9), Pendulum(0, omega0=2 * math.sqrt(9.81) * (1 + 1e-9))):
        lost = np.log10(problem.along("condition", np.linspace(0, 20, 50))[:, 0])
        assert lost.max() > 8


@pytest.mark.parametrize("route", ["taylor", "quadrature"])
def test_second_slopes_and_conditions_near_the_top_agree_with_both_routes(route):
    times = [Fraction(1, 2), Fraction(13, 2)]
    for theta0 in (0.001, 3.1, math.pi - 1e-9):
        for row in ("curvature", "condition"):
            assert min(each.digits for each in agreement(Pendulum(theta0), row, times, route)) >= 55
