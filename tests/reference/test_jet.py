"""Power series over any arithmetic give the Taylor coefficients of functions and of solutions."""

from __future__ import annotations

from fractions import Fraction as Q
from itertools import pairwise
from typing import Any

import pytest
from flint import arb, arb_series

from reference.arithmetic.balls import SERIES
from reference.arithmetic.dual import DualArithmetic, with_slope
from reference.arithmetic.formula import FUNCTIONS, Expression
from reference.arithmetic.namespaces import BALL, NUMPY
from reference.arithmetic.precision import ctx
from reference.arithmetic.series import Series, SeriesArithmetic, jet

ORDER = 12
COEFFICIENTS = (
    Q(2, 5),
    Q(-1, 3),
    Q(3, 7),
    Q(1, 9),
    Q(0),
    Q(-2, 3),
    Q(1, 4),
    Q(1),
    Q(-1, 8),
    Q(2),
    Q(1, 7),
    Q(-3),
    Q(5),
)


class Rationals:
    """Exact numbers, with the one value of a circular function that a test needs: sin = 3/5, cos = 4/5."""

    @staticmethod
    def number(value: Q) -> Q:
        return value

    @staticmethod
    def sin(_: Any) -> Q:
        return Q(3, 5)

    @staticmethod
    def cos(_: Any) -> Q:
        return Q(4, 5)


def series_of(arithmetic: SeriesArithmetic, coefficients: tuple[Any, ...]) -> Series:
    return Series(arithmetic.tape, lambda k: coefficients[k])


def agree(function: Any) -> None:
    """A function of a series of balls has the coefficients that Arb finds."""
    with ctx.workprec(200), SERIES.of_length(ORDER + 1):
        arithmetic = SeriesArithmetic(BALL)
        balls = tuple(map(BALL.number, COEFFICIENTS))
        found = function(arithmetic, series_of(arithmetic, balls))
        expected = function(SERIES, arb_series(list(balls)))
        for k in range(ORDER + 1):
            assert (found.term(k) - expected[k]).contains(0), k
            assert arb(found.term(k)).rad() < 1e-40


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_function_of_a_series_has_the_coefficients_that_arb_finds(name: str) -> None:
    agree(lambda m, x: getattr(m, name)(x))


@pytest.mark.parametrize("exponent", [Q(1, 3), Q(-5, 7), Q(3, 2), Q(3)])
def test_every_power_of_a_series_has_the_coefficients_that_arb_finds(exponent: Q) -> None:
    agree(lambda m, x: m.power(x, exponent))


@pytest.mark.parametrize("power", [-3, -1, 1, 2, 5])
def test_a_whole_power_is_a_product(power: int) -> None:
    agree(lambda _, x: x**power if power > 0 else 1 / x**-power)
    arithmetic = SeriesArithmetic(Rationals())
    x = series_of(arithmetic, COEFFICIENTS)
    expected = arithmetic.series(Q(1))
    for _ in range(abs(power)):
        expected = expected * x if power > 0 else expected / x
    assert [(x**power).term(k) for k in range(9)] == [expected.term(k) for k in range(9)]
    assert x**0 == 1


@pytest.mark.parametrize(
    "formula",
    ["1 - x", "x - 1", "3 + x*2", "-x/3", "2/x", "x/(1 + x*x)", "sin(x)*cos(x) - sin(2*x)/2", "1/(2 + x)**(3/2)"],
)
def test_numbers_and_series_mix_as_numbers_do(formula: str) -> None:
    agree(Expression.parse(formula, "x"))


def test_a_constant_stays_a_number() -> None:
    arithmetic = SeriesArithmetic(NUMPY)
    for name in FUNCTIONS:
        assert getattr(arithmetic, name)(0.25) == getattr(NUMPY, name)(0.25)
    assert arithmetic.power(0.25, Q(1, 3)) == 0.25 ** (1 / 3)
    assert (arithmetic.number(Q(1, 4)), arithmetic.pi()) == (0.25, NUMPY.pi())


def test_a_slope_by_duals_of_series_is_the_series_of_the_slope() -> None:
    formula, slope = Expression.parse("sin(x)/(2 + x)", "x"), Expression.parse("cos(x)/(2+x) - sin(x)/(2+x)**2", "x")
    with ctx.workprec(200):
        arithmetic = SeriesArithmetic(BALL)
        x = series_of(arithmetic, tuple(map(BALL.number, COEFFICIENTS)))
        found, expected = with_slope(arithmetic, formula, x)[1], slope(arithmetic, x)
        assert all((found.term(k) - expected.term(k)).contains(0) for k in range(ORDER + 1))


def differentiated(polynomial: dict[tuple[int, int, int], Q]) -> dict[tuple[int, int, int], Q]:
    """The rate of a polynomial in omega, sin theta and cos theta along omega' = -2 sin theta."""
    rate: dict[tuple[int, int, int], Q] = {}
    for (w, s, c), value in polynomial.items():
        for moved, factor in (
            ((w - 1, s + 1, c), -2 * w),
            ((w + 1, s - 1, c + 1), s),
            ((w + 1, s + 1, c - 1), -c),
        ):
            if factor:
                rate[moved] = rate.get(moved, Q(0)) + factor * value
    return rate


def test_the_jet_of_a_pendulum_is_exactly_that_of_its_derivatives() -> None:
    """Each derivative of theta'' = -2 sin theta is a polynomial in theta', sin and cos, differentiated by hand."""
    omega, order = Q(7, 4), 15
    found = jet(Rationals(), lambda m, y: (y[1], -2 * m.sin(y[0])), (None, omega), order)
    theta, factorial = {(1, 0, 0): Q(1)}, 1
    for k, (angle, rate) in enumerate(found, 1):
        factorial *= k
        value = sum(v * omega**w * Q(3, 5) ** s * Q(4, 5) ** c for (w, s, c), v in theta.items())
        assert angle == value / factorial
        theta = differentiated(theta)
        value = sum(v * omega**w * Q(3, 5) ** s * Q(4, 5) ** c for (w, s, c), v in theta.items())
        assert rate == value / factorial


def test_a_jet_solves_equations_whose_solutions_are_known() -> None:
    """y' = y^2 from 1 is 1/(1 - t), and y' = 1 is t: nothing after its first coefficient."""
    found = jet(Rationals(), lambda m, y: (y[0] * y[0], m.number(Q(1))), (Q(1), Q(5)), 9)
    assert found == [(Q(1), 1 if k == 1 else 0) for k in range(1, 10)]
    assert all(type(rest) is int for _, rest in found[1:])


def test_a_jet_of_balls_and_duals_is_differentiated_by_its_start() -> None:
    """y' = y^2 from a: y[k] = a^(k+1), whose slope is (k+1) a^k."""
    with ctx.workprec(100):
        duals = DualArithmetic(BALL, 1)
        found = jet(duals, lambda _, y: (y[0] * y[0],), (duals.variable(arb(3), 0),), 6)
        for k, (coefficient,) in enumerate(found, 1):
            assert (coefficient.value - 3 ** (k + 1)).contains(0)
            assert (coefficient.slopes[0] - (k + 1) * 3**k).contains(0)


class Counted:
    """A number that counts products."""

    products = 0

    def __mul__(self, other: Any) -> Counted:
        Counted.products += 1
        return self

    def __add__(self, other: Any) -> Counted:
        return self

    def __neg__(self) -> Counted:
        return self

    __rmul__ = __mul__
    __radd__ = __add__


def products(order: int) -> int:
    """Products of numbers in a jet of the pendulum."""

    class Numbers:
        number = sin = cos = staticmethod(lambda _: Counted())

    Counted.products = 0
    jet(Numbers(), lambda m, y: (y[1], -m.sin(y[0])), (Counted(), Counted()), order)
    return Counted.products


def test_the_work_of_a_jet_grows_as_the_square_of_its_order() -> None:
    counts = [products(order) for order in (40, 80, 160)]
    assert products(20) < 2 * 20**2
    assert all(3 < later / earlier < 4.1 for earlier, later in pairwise(counts))


def test_a_formula_may_be_as_deep_as_it_likes() -> None:
    def deep(_: Any, y: Any) -> tuple[Any]:
        x = y[0]
        for _again in range(5000):
            x = x * 1 + 0
        return (x,)

    assert jet(Rationals(), deep, (Q(1),), 4) == [(Q(1),), (Q(1, 2),), (Q(1, 6),), (Q(1, 24),)]
