"""The elementary functions of every arithmetic, and their slopes: one function, whatever the numbers."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from flint import acb, arb, arb_series

from reference.arithmetic.balls import SERIES
from reference.arithmetic.compiler import hy
from reference.arithmetic.dual import DualArithmetic, with_slope
from reference.arithmetic.namespaces import BALL, MPMATH, NUMPY, ComplexBall, Heyoka
from reference.arithmetic.precision import ctx, mp

FUNCTIONS = ("sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "exp", "log", "sqrt")
POINT = Fraction(3, 8)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_function_is_the_same_in_every_arithmetic(name):
    with ctx.workprec(200), mp.workprec(200):
        expected = getattr(mp, name)(mp.mpf(3) / 8)
        ball = getattr(BALL, name)(BALL.number(POINT))
        assert ball.rel_accuracy_bits() > 190
        assert abs(mp.mpf(ball.mid().str(70, radius=False)) - expected) < mp.mpf(2) ** -190
        assert getattr(ComplexBall(analytic=True), name)(arb(3) / 8).real.overlaps(ball)
        assert getattr(MPMATH, name)(MPMATH.number(POINT)) == expected
    assert float(getattr(NUMPY, name)(NUMPY.number(POINT))) == pytest.approx(float(expected), rel=1e-15)
    x = hy.expression("x")
    compiled = hy.cfunc([getattr(Heyoka(), name)(x)], [x])
    assert compiled(np.array([0.375]))[0] == pytest.approx(float(expected), rel=1e-15)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_the_slope_of_a_function_is_its_derivative(name):
    with mp.workprec(200):
        m = DualArithmetic(MPMATH, 1)
        found = getattr(m, name)(m.variable(MPMATH.number(POINT), 0))
        assert found.value == getattr(mp, name)(mp.mpf(3) / 8)
        with mp.workprec(500):
            expected = mp.diff(getattr(mp, name), mp.mpf(3) / 8)
        assert abs(found.slopes[0] - expected) < mp.mpf(2) ** -190


@pytest.mark.parametrize("exponent", [Fraction(1, 3), Fraction(-5, 2), Fraction(7, 4)])
def test_a_rational_power_is_the_same_in_every_arithmetic(exponent):
    with ctx.workprec(200), mp.workprec(200):
        m = DualArithmetic(MPMATH, 1)
        expected = mp.power(mp.mpf(3) / 8, mp.mpf(exponent.numerator) / exponent.denominator)
        found = m.power(m.variable(MPMATH.number(POINT), 0), exponent)
        assert found.value == expected
        assert mp.almosteq(found.slopes[0], exponent.numerator * expected * 8 / 3 / exponent.denominator)
        ball = BALL.power(BALL.number(POINT), exponent)
        assert abs(mp.mpf(ball.mid().str(70, radius=False)) - expected) < mp.mpf(2) ** -190
        assert ComplexBall(analytic=True).power(arb(3) / 8, exponent).real.overlaps(ball)
    assert NUMPY.power(0.375, exponent) == pytest.approx(float(expected), rel=1e-15)
    x = hy.expression("x")
    assert hy.cfunc([Heyoka().power(x, exponent)], [x])(np.array([0.375]))[0] == pytest.approx(float(expected))


def test_a_power_of_zero_is_zero_and_of_a_negative_number_none():
    assert BALL.power(arb(0), Fraction(1, 3)) == 0
    assert not BALL.power(arb(0), Fraction(-1, 3)).is_finite()
    assert not BALL.power(arb(-1), Fraction(1, 3)).is_finite()


def test_pi_is_pi():
    assert NUMPY.pi() == np.pi
    assert hy.cfunc([Heyoka().pi() * hy.expression("x")], [hy.expression("x")])(np.array([1.0]))[0] == np.pi


def test_a_function_of_a_constant_is_a_constant_to_heyoka_too():
    x = hy.expression("x")
    compiled = hy.cfunc([x * Heyoka().sqrt(2.0) * Heyoka().power(4.0, Fraction(1, 2))], [x])
    assert compiled(np.array([0.5]))[0] == pytest.approx(2**0.5)


def test_a_function_of_a_constant_is_a_constant_among_duals():
    m = DualArithmetic(NUMPY, 1)
    assert m.sin(0.5) == np.sin(0.5)
    assert m.power(2.0, Fraction(1, 2)) == np.sqrt(2.0)


def test_duals_of_arrays_stay_duals_of_arrays():
    m = DualArithmetic(NUMPY, 1)
    grid = np.linspace(0, 1, 5)
    found = grid * m.sin(m.variable(grid, 0))
    np.testing.assert_allclose(found.value, grid * np.sin(grid))
    np.testing.assert_allclose(found.slopes[0], grid * np.cos(grid))


@pytest.mark.parametrize(
    ("name", "on_the_cut", "beside_it"),
    [
        ("sqrt", acb(-2), acb(-2, 1)),
        ("log", acb(-2), acb(-2, 1)),
        ("asin", acb(2), acb(2, 1)),
        ("acos", acb(-2), acb(0.5)),
        ("atan", acb(0, 2), acb(1, 2)),
    ],
)
def test_on_a_branch_cut_there_is_no_analytic_function(name, on_the_cut, beside_it):
    assert getattr(ComplexBall(analytic=False), name)(on_the_cut).is_finite()
    assert not getattr(ComplexBall(analytic=True), name)(on_the_cut).is_finite()
    assert getattr(ComplexBall(analytic=True), name)(beside_it).is_finite()
    wide = on_the_cut + acb(arb(0, 0.25), arb(0, 0.25))
    assert not getattr(ComplexBall(analytic=True), name)(wide).is_finite()


def test_a_cut_is_avoided_by_powers_too():
    assert not ComplexBall(analytic=True).power(acb(-2), Fraction(1, 3)).is_finite()
    assert ComplexBall(analytic=True).power(acb(-2, 1), Fraction(1, 3)).is_finite()


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_series_has_the_derivatives_for_coefficients(name):
    before = ctx.cap
    with ctx.workprec(200), mp.workprec(200):
        with SERIES.of_length(6):
            found = getattr(SERIES, name)(arb_series([arb(3) / 8, arb(1)])).coeffs()
        with mp.workprec(400):
            expected = mp.taylor(getattr(mp, name), mp.mpf(3) / 8, 5)
        assert len(found) == 6
        for ball, value in zip(found, expected, strict=True):
            assert abs(mp.mpf(ball.mid().str(70, radius=False)) - value) < mp.mpf(2) ** -170
        constant = getattr(SERIES, name)(SERIES.number(POINT))
        assert constant.overlaps(found[0])
    assert ctx.cap == before


def test_a_rational_power_of_a_series():
    with ctx.workprec(200), SERIES.of_length(4):
        third = SERIES.power(arb_series([arb(8), arb(1)]), Fraction(1, 3))
        for found, value in zip((third * third * third).coeffs(), (8, 1, 0, 0), strict=True):
            assert found.contains(value)
        assert SERIES.power(arb(8), Fraction(1, 3)).overlaps(arb(2))


def test_a_slope_of_a_constant_is_zero():
    assert with_slope(NUMPY, lambda _m, _x: 3.0, 0.5) == (3.0, 0.0)
    assert with_slope(NUMPY, lambda m, x: m.exp(x) * x, 0.0) == (0.0, 1.0)
