"""The expansions in the amplitude, exact, against published coefficients and against the truth."""

from __future__ import annotations

from fractions import Fraction as Q

import pytest

from reference import Pendulum
from reference.arithmetic.namespaces import MPMATH
from reference.arithmetic.precision import mp
from reference.problems.pendulum.series import lindstedt, period_series


def test_the_period_series_has_its_published_coefficients() -> None:
    assert period_series(4) == (1, Q(1, 16), Q(11, 3072), Q(173, 737280), Q(22931, 1321205760))


def test_the_frequency_has_its_published_coefficients() -> None:
    assert lindstedt(3).frequency_squared == (1, Q(-1, 8), Q(7, 1536), Q(-19, 184320))


def test_the_harmonics_have_their_published_coefficients() -> None:
    """u_1 = (cos x - cos 3x)/192, and 9, -60, 51 over 184320 for the fifth, third and first of u_2."""
    assert lindstedt(2).harmonics[1] == {1: Q(1, 192), 3: Q(-1, 192)}
    assert lindstedt(2).harmonics[2] == {1: Q(51, 184320), 3: Q(-60, 184320), 5: Q(9, 184320)}


def test_frequency_and_period_are_of_one_motion() -> None:
    """w^2 T^2 = w0^2 T0^2, order by order, though the two are found in different ways."""
    order = 10

    def product(a: tuple[Q, ...], b: tuple[Q, ...]) -> tuple[Q, ...]:
        return tuple(sum((a[i] * b[n - i] for i in range(n + 1)), Q(0)) for n in range(order + 1))

    squared = product(period_series(order), period_series(order))
    assert product(squared, lindstedt(order).frequency_squared) == (1, *[0] * order)


@pytest.mark.parametrize("order", [1, 2, 3, 5])
def test_the_error_falls_with_the_amplitude_as_the_order_says(order: int) -> None:
    def worst(amplitude: Q) -> float:
        pendulum = Pendulum(amplitude, 1, 1)
        with mp.workdps(60):
            solution, largest = lindstedt(order), 0
            for t in (1, 3, 7):
                exact = sum(mp.mpf(limb) for limb in pendulum.state(t, limbs=3)[0].tolist())
                found = solution.angle(MPMATH, MPMATH.number(amplitude), mp.mpf(1), mp.mpf(1), mp.mpf(t))
                largest = max(largest, abs(found - exact))
            return float(mp.log(largest, 2))

    assert worst(Q(1, 4)) - worst(Q(1, 8)) == pytest.approx(2 * order + 3, abs=0.1)


@pytest.mark.parametrize("order", [1, 2, 4, 8])
def test_the_period_series_converges_to_the_period(order: int) -> None:
    for amplitude in (Q(1, 10), Q(1, 2)):
        exact = Q(Pendulum(amplitude, 1, 1).period().digits(45))
        with mp.workdps(60):
            series = sum(c * amplitude ** (2 * j) for j, c in enumerate(period_series(order)))
            error = 2 * mp.pi * MPMATH.number(series) - MPMATH.number(exact)
            following = 2 * mp.pi * MPMATH.number(period_series(order + 1)[-1] * amplitude ** (2 * order + 2))
            assert float(-error / following) == pytest.approx(1, abs=0.15)


@pytest.mark.parametrize("order", [-1, 1.5, True, 101, "3"])
def test_an_order_that_is_not_served_is_refused(order: object) -> None:
    for expansion in (period_series, lindstedt):
        with pytest.raises(ValueError, match="an integer from 0 to 100 is accepted"):
            expansion(order)
