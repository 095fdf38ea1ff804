"""The compiled sine of doubles, against balls."""

from __future__ import annotations

import heyoka as hy
import numpy as np
import pytest
from flint import arb

from compare.march.sine import sine
from reference.arithmetic.precision import ctx

X = hy.expression("x")
COMPILED = hy.cfunc([sine(X)], vars=[X], batch_size=8)


def of(points: np.ndarray) -> np.ndarray:
    return COMPILED(np.ascontiguousarray(points[None]))[0]


@pytest.mark.parametrize("reach", [1e-3, 0.8, np.pi / 2, np.pi, 10.0, 1e3, 1e6, 2.0**26])
def test_the_sine_is_within_two_units_and_what_the_argument_allows(reach: float) -> None:
    points = np.random.default_rng(7).uniform(-reach, reach, 4000)
    with ctx.workprec(200):
        for x, found in zip(points.tolist(), of(points).tolist(), strict=True):
            exact = arb(x).sin()
            unit = np.spacing(abs(float(exact)))
            assert abs(float(exact - arb(found))) <= 2 * unit + 1e-25 * abs(x)


@pytest.mark.parametrize("n", [0, 1, -1, 2, 3, 1000, -12345])
@pytest.mark.parametrize("away", [0.0, 1e-12, 1e-9, 1e-6, 1e-3])
def test_it_keeps_its_digits_beside_the_multiples_of_pi(n: int, away: float) -> None:
    """Beside the upper rest position the force is small, and its digits decide how fast the pendulum leaves it."""
    x = n * np.pi + away
    with ctx.workprec(200):
        exact = float(arb(x).sin())
    assert abs(of(np.full(8, x))[0] - exact) <= 2 * np.spacing(abs(exact)) + 1e-25 * abs(x)


def test_it_is_odd_and_small_arguments_are_themselves() -> None:
    points = np.array([1e-9, 1e-150, 5e-324, 0.0, 0.5, 3.0, 100.0, 1e7])
    np.testing.assert_array_equal(of(-points), -of(points))
    np.testing.assert_array_equal(of(points)[:4], points[:4])


def test_what_is_not_a_number_stays_so() -> None:
    assert np.all(np.isnan(of(np.array([np.nan, np.inf, -np.inf, np.nan] * 2))))
