"""The linearised pendulum: a problem of its own, exact wherever it is rational."""

from __future__ import annotations

import math
import random
from fractions import Fraction

import numpy as np
import pytest
from independent import correct_limbs, fraction

from reference import Pendulum
from reference.arithmetic.namespaces import MPMATH
from reference.arithmetic.precision import mp
from reference.problems.pendulum.linear import LinearPendulum
from reference.routes.agreement import agreement

PENDULUMS = (
    LinearPendulum(1.0),
    LinearPendulum(0, omega0=2),
    LinearPendulum(-7, "1.62", 3, "1/3"),
    LinearPendulum(1e-150, 1e9, 1e-9, -1),
)
every_pendulum = pytest.mark.parametrize("problem", PENDULUMS, ids=repr)


@every_pendulum
def test_every_limb_is_the_correct_rounding_of_cosine_and_sine(problem):
    rng = random.Random(1673)
    times = [rng.uniform(-1, 1) * 10 ** rng.uniform(-3, 9) for _ in range(200)]
    found = problem.state(times, limbs=3).tolist()
    with mp.workprec(800):
        theta0, omega0, g, length = (
            MPMATH.number(value) for value in (problem.theta0, problem.omega0, problem.g, problem.length)
        )
        w = mp.sqrt(g / length)
        for t, (theta, omega) in zip(times, found, strict=True):
            u = w * mp.mpf(t)
            assert theta == correct_limbs(fraction(theta0 * mp.cos(u) + omega0 / w * mp.sin(u)), 3)
            assert omega == correct_limbs(fraction(omega0 * mp.cos(u) - theta0 * w * mp.sin(u)), 3)
        assert list(problem.period().limbs(3)) == correct_limbs(fraction(2 * mp.pi / w), 3)


@every_pendulum
@pytest.mark.parametrize("route", ["taylor", "quadrature"])
def test_every_row_agrees_with_both_routes(problem, route):
    scale = Fraction(1 / problem.rate())
    for row in problem.rows:
        arguments = [Fraction(0), scale / 3, 50 * scale] if row.over == "time" else [None]
        assert min(each.digits for each in agreement(problem, row.name, arguments, route)) >= 55


def test_what_is_rational_is_exact():
    problem = LinearPendulum("1/3", "9.81", 2, "1/7")
    energy = (Fraction(1, 49) + Fraction("9.81") / 2 / 9) / 2
    assert list(problem.energy().limbs(3)) == correct_limbs(energy, 3)
    assert problem.state(0, limbs=3).tolist() == [correct_limbs(Fraction(1, n), 3) for n in (3, 7)]
    assert LinearPendulum(0).state([0, 1, 1e9]).tolist() == [[0.0, 0.0]] * 3


def test_the_period_at_rest_has_no_motion_to_show_it():
    assert agreement(LinearPendulum(0), "period", [None], "taylor") is None
    assert agreement(LinearPendulum(0), "period", [None], "quadrature")[0].digits >= 55


def test_the_pendulum_becomes_linear_at_small_amplitudes():
    times = np.linspace(0, 3, 7)
    for amplitude in (1e-3, 1e-5):
        gap = Pendulum(amplitude).state(times) - LinearPendulum(amplitude).state(times)
        assert np.abs(gap).max() < 3 * amplitude**3
        assert np.abs(gap).max() > amplitude**3 / 100
    assert float(LinearPendulum(1.0).period()) < float(Pendulum(0.01).period())


def test_the_force_pulls_back_and_the_energy_is_its_integral():
    problem = LinearPendulum(1, 2, 4)
    numbers = {name: float(value) for name, value in problem.parameters.items()}
    assert LinearPendulum(1).derivative(None, 0, (3.0, 5.0), numbers) == (5.0, -1.5)
    assert LinearPendulum.invariant(None, (3.0, 5.0), numbers) == (25 + 0.5 * 9) / 2


@every_pendulum
def test_a_linear_pendulum_reads_back_from_its_repr(problem):
    assert eval(repr(problem), {"LinearPendulum": LinearPendulum}) == problem  # noqa: S307 - our own text
    nearby = problem.neighbour(lambda x: x, Fraction(1, 2**53))
    assert nearby != problem
    assert nearby.state(1)[0] == pytest.approx(problem.state(1)[0], rel=1e-5)


@pytest.mark.parametrize(("name", "value"), [("g", 0), ("length", "-1")])
def test_gravity_and_length_must_be_positive(name, value):
    with pytest.raises(ValueError, match=rf"^{name} is .*; a positive number is accepted\.$"):
        LinearPendulum(1.0, **{name: value})
    with pytest.raises(ValueError, match="theta0 is nan"):
        LinearPendulum(math.nan)
