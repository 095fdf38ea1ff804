"""The condition of the pendulum's states by their inputs, against derivatives and against other inputs."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from reference import LinearPendulum, Pendulum

RANDOM = np.random.default_rng(5)
MOTIONS = {
    "a release": Pendulum(1.0),
    "a swing": Pendulum(0.5, g=2, length=3, omega0=-1),
    "a start at the bottom": Pendulum(0, omega0=2),
    "a rotation": Pendulum(-7, omega0=-9.5),
    "a release near the top": Pendulum(3.1415),
    "rest": Pendulum(0, omega0=0),
    "the separatrix": Pendulum(0, g=1, length=1, omega0=2),
}


@pytest.mark.parametrize("kind", MOTIONS)
def test_the_sum_is_that_of_the_proven_derivatives(kind):
    problem = MOTIONS[kind]
    t = np.concatenate(
        [[0.0, 1e-9], RANDOM.uniform(-9, 9, 20), RANDOM.uniform(0, 1e4 if "separ" not in kind else 9, 9)]
    )
    theta, omega = problem.state(t).T
    rates = np.stack([omega, -float(problem.g / problem.length) * np.sin(theta)], axis=1)
    slopes = problem.along("gradient", t).reshape(-1, 2, 4)
    inputs = np.array([float(x) for x in (problem.theta0, problem.omega0, problem.g, problem.length)])
    wanted = np.abs(t[:, None] * rates) + np.abs(slopes * inputs).sum(axis=2)
    np.testing.assert_allclose(problem.input_condition().led(t), wanted, rtol=1e-6, atol=1e-30)


def test_of_the_linear_pendulum_it_is_what_other_inputs_change():
    given = {"theta0": Fraction(1, 2), "g": Fraction(5), "length": Fraction(3), "omega0": Fraction(-1, 3)}
    t, near = np.array([0.5, 7.25, 40.0]), Fraction(1, 1 << 40)

    def changed(later: Fraction = Fraction(0), **other: Fraction) -> np.ndarray:
        problem = LinearPendulum(**{**given, **other})
        return problem.state([Fraction(time) * (1 + later) for time in t], limbs=3)

    def size(up: np.ndarray, down: np.ndarray) -> np.ndarray:
        return np.abs((up - down).sum(axis=2)) / float(2 * near)

    wanted = size(changed(near), changed(-near)) + sum(
        size(changed(**{name: value * (1 + near)}), changed(**{name: value * (1 - near)}))
        for name, value in given.items()
    )
    np.testing.assert_allclose(LinearPendulum(**given).input_condition().led(t), wanted, rtol=1e-9)


def test_beyond_all_periods_that_are_reduced_nothing_is_known():
    assert np.isnan(Pendulum(1.0).input_condition().led(np.array([1e15, np.inf]))).all()
