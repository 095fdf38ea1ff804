"""Multistep methods: derived coefficients, order and zero-stability by algebra, order by slope, memory in a march."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np
import pytest

from compare.march.lanes import Lane, sample_steps
from compare.march.march import march
from compare.march.precision import precision
from compare.measure.errors import score_method
from compare.measure.order_fit import fit_order
from compare.measure.truth import Course
from compare.methods import find
from compare.methods.explicit import EULER, RK4
from compare.methods.kinds.multistep import LinearMultistep, PredictorCorrector
from compare.methods.kinds.stormer import StormerCowell
from compare.methods.multistep import BDF2, MULTISTEP
from compare.methods.order.algebraic import Q
from compare.methods.order.multistep import adams, backward_differences, is_zero_stable, stormer
from reference import Pendulum

if TYPE_CHECKING:
    from compare.methods.kinds.protocol import Method

FLOAT64, FLOAT128 = precision("float64"), precision("float128")
by_name = pytest.mark.parametrize("method", MULTISTEP, ids=lambda method: method.name)
COURSES = [Course(Pendulum(1.0), n, Fraction(2), FLOAT128) for n in (512, 1024, 2048, 4096, 8192)]


def of(divisor: int, *numerators: int) -> tuple[Fraction, ...]:
    return tuple(Q(numerator, divisor) for numerator in numerators)


@by_name
def test_order_by_algebra_is_the_declared_one(method: Method) -> None:
    assert method.proven_order() == method.order


@by_name
def test_order_by_slope_in_binary128_is_the_declared_one(method: Method) -> None:
    """The starting procedure is exact beside the rest, so that the error begins late: N is large beside its steps."""
    cells, _ = score_method(method, COURSES, FLOAT128)
    fitted = fit_order(method, cells)
    assert fitted.cells_used == len(COURSES)
    assert abs(fitted.fitted_order - method.order) < 0.02


@by_name
def test_every_method_is_zero_stable(method: Method) -> None:
    for formula in (method.predictor, method.corrector) if isinstance(method, PredictorCorrector) else (method,):
        assert formula.zero_stable


def test_bdf_is_zero_stable_up_to_six_steps_and_no_further() -> None:
    assert [is_zero_stable(backward_differences(k)[0]) for k in range(1, 9)] == [True] * 6 + [False] * 2


@pytest.mark.parametrize(
    ("polynomial", "simple", "double"),
    [
        ((-1, 0, 1), True, True),
        ((1, -2, 1), False, True),
        ((-1, 3, -3, 1), False, False),
        ((1, 0, 2, 0, 1), False, True),
        ((2, -3, 1), False, False),
        ((Q(1, 4), -1, 1), True, True),
        ((1, Q(-5, 2), 1), False, False),
        ((-4, 3, 1), False, False),
        ((1, Q(6, 5), 1), True, True),
    ],
)
def test_the_root_condition_sees_zeros_outside_and_repeated_zeros_on_the_circle(
    polynomial: tuple[Fraction | int, ...], simple: bool, double: bool
) -> None:
    alpha = [Fraction(coefficient) for coefficient in polynomial]
    assert is_zero_stable(alpha) == simple
    assert is_zero_stable(alpha, 2) == double


def test_adams_coefficients_are_those_in_print() -> None:
    """Hairer, Norsett and Wanner 1993, III.1, (1.5) and (1.9); the newest slope last."""
    assert adams(2, implicit=False)[1] == of(2, -1, 3, 0)
    assert adams(4, implicit=False)[1] == of(24, -9, 37, -59, 55, 0)
    assert adams(5, implicit=False)[1] == of(720, 251, -1274, 2616, -2774, 1901, 0)
    assert adams(3, implicit=True)[1] == of(24, 1, -5, 19, 9)
    assert adams(4, implicit=True)[1] == of(720, -19, 106, -264, 646, 251)


def test_backward_differences_and_stormers_coefficients_are_those_in_print() -> None:
    """Hairer, Norsett and Wanner 1993, III.1, (1.22') and III.10, (10.9) to (10.11)."""
    assert backward_differences(2) == (of(3, 1, -4, 3), of(3, 0, 0, 2))
    assert backward_differences(4)[0] == of(25, 3, -16, 36, -48, 25)
    assert stormer(3, implicit=False) == of(12, 1, -2, 13, 0)
    assert stormer(4, implicit=False) == of(12, -1, 4, -5, 14, 0)
    assert stormer(2, implicit=True) == of(12, 1, 10, 1)
    assert stormer(4, implicit=True) == of(240, -1, 4, 14, 204, 19)


def test_a_slip_in_one_coefficient_lowers_the_proven_order() -> None:
    slipped = (Q(-9, 24), Q(37, 24), Q(-58, 24), Q(54, 24), Q(0))
    assert replace(find("ab4"), beta=slipped).proven_order() == 1
    assert replace(find("cowell4"), beta=of(12, 2, 9, 1)).proven_order() == 1


def states_of(method: Method, n: int, t_end: Fraction | int = 2, problem: Pendulum = Pendulum(1.0)) -> np.ndarray:  # noqa: B008
    """Every state of a march, the start among them."""
    lane = Lane(problem, n, FLOAT64.round(Fraction(t_end, n)), sample_steps(n, n))
    (result,) = march(method, [lane], FLOAT64)
    return np.concatenate([[[float(value) for value in problem.start]], result.states])


@pytest.mark.parametrize("name", ["ab3", "am4", "bdf2", "two_step_leapfrog"])
def test_the_states_of_a_march_satisfy_the_formula(name: str) -> None:
    method = find(name)
    assert isinstance(method, LinearMultistep)
    y = states_of(method, 128)
    f = np.stack([y[:, 1], -9.81 * np.sin(y[:, 0])], axis=1)
    k = len(method.alpha) - 1
    left, right = (
        sum(float(weight) * values[j : len(y) - k + j] for j, weight in enumerate(weights))
        for weights, values in ((method.alpha, y), (method.beta, f))
    )
    np.testing.assert_allclose(left, float(FLOAT64.round(Fraction(2, 128))) * right, rtol=0, atol=5e-15)


@pytest.mark.parametrize("name", ["stormer3", "stormer4", "cowell4", "cowell5"])
def test_the_positions_of_a_march_satisfy_stormers_formula(name: str) -> None:
    method = find(name)
    assert isinstance(method, StormerCowell)
    """From the second step on: the first goes on from the velocity that the starting procedure ends with."""
    y = states_of(method, 128)
    q, force = y[:, 0], -9.81 * np.sin(y[:, 0])
    k = len(method.beta) - 1
    first = method.starting_steps - k + 2
    second = q[2:] - 2 * q[1:-1] + q[:-2]
    right = sum(float(weight) * force[j : len(q) - k + j] for j, weight in enumerate(method.beta)) / 64**2
    np.testing.assert_allclose(second[k - 2 :][first:], right[first:], rtol=0, atol=5e-15)


def test_stormers_method_with_one_force_is_verlets() -> None:
    beta = (Q(0), *stormer(1, implicit=False))
    method = StormerCowell("stormer2", 2, "none", beta, velocity=1, starter=RK4)
    assert method.proven_order() == 2
    assert method.starting_steps == 0
    np.testing.assert_allclose(states_of(method, 500), states_of(find("verlet"), 500), rtol=0, atol=1e-13)


def test_a_predictor_and_corrector_evaluates_twice_what_its_formulas_say() -> None:
    y = states_of(find("abm2"), 64)
    h, f = 1 / 32, np.stack([y[:, 1], -9.81 * np.sin(y[:, 0])], axis=1)
    predicted = y[1:-1] + h * (3 * f[1:-1] - f[:-2]) / 2
    slope = np.stack([predicted[:, 1], -9.81 * np.sin(predicted[:, 0])], axis=1)
    np.testing.assert_allclose(y[2:], y[1:-1] + h * (f[1:-1] + slope) / 2, rtol=0, atol=5e-15)


def test_a_poor_start_limits_the_order_and_ours_does_not() -> None:
    ours = find("ab4")
    poor = replace(ours, starter=EULER)
    orders = [fit_order(method, score_method(method, COURSES[:4], FLOAT128)[0]).fitted_order for method in (ours, poor)]
    assert orders[0] == pytest.approx(4, abs=0.02)
    assert orders[1] == pytest.approx(2, abs=0.1)


def test_a_march_shorter_than_the_opening_is_the_opening() -> None:
    """Four steps of RK4 in each."""
    (result,) = march(find("ab4"), [Lane(Pendulum(1.0), 2, Fraction(1, 4), (1, 2))], FLOAT64)
    np.testing.assert_allclose(result.states, states_of(RK4, 8, Fraction(1, 2))[[4, 8]], rtol=0, atol=1e-15)


def test_long_blocks_and_short_ones_go_on_from_the_same_opening() -> None:
    n = 8192
    short, long = (Lane(Pendulum(1.0), n, FLOAT64.round(Fraction(2, n)), samples) for samples in ((n - 1, n), (n,)))
    for name in ("ab5", "bdf2", "stormer4"):
        first, second = march(find(name), [short], FLOAT64), march(find(name), [long], FLOAT64)
        np.testing.assert_allclose(first[0].states[-1], second[0].states[-1], rtol=0, atol=1e-12)
        assert first[0].max_drifts[0] == pytest.approx(second[0].max_drifts[0], rel=1e-3)


def test_lanes_with_a_memory_do_not_mix() -> None:
    lanes = [
        Lane(Pendulum(theta0), n, FLOAT64.round(Fraction(10, n)), sample_steps(n, 64))
        for n in (128, 16384, 300, 8192)
        for theta0 in (0.1, 3.0)
    ]
    for name in ("abm4", "bdf2", "cowell4"):
        for one, result in zip(lanes, march(find(name), lanes, FLOAT64), strict=True):
            (alone,) = march(find(name), [one], FLOAT64)
            np.testing.assert_allclose(result.states, alone.states, rtol=0, atol=1e-9)
            assert result.max_drifts[0] == pytest.approx(alone.max_drifts[0], rel=1e-3)


def test_a_velocity_that_is_not_the_momentum_is_refused() -> None:
    class Heavy(Pendulum):
        @staticmethod
        def velocity(m: object, momenta: tuple, p: dict) -> tuple:  # noqa: ARG004
            return (momenta[0] / 2,)

    with pytest.raises(ValueError, match="stormer4 marches q'' = F"):
        states_of(find("stormer4"), 16, problem=Heavy(1.0))


def test_a_table_that_is_no_method_is_refused() -> None:
    with pytest.raises(ValueError, match="3 alpha and 2 beta"):
        replace(BDF2, beta=(Q(0), Q(1)))
    with pytest.raises(ValueError, match="alpha ends in 1 and sums to 1/3"):
        replace(BDF2, alpha=(Q(2, 3), Q(-4, 3), Q(1)))
    with pytest.raises(ValueError, match="an explicit predictor and an implicit corrector"):
        PredictorCorrector("bad", 2, "none", BDF2, BDF2)
    with pytest.raises(ValueError, match="beta sum to 1/2"):
        StormerCowell("bad", 2, "none", (Q(0), Q(1, 2), Q(0)), 1, RK4)
