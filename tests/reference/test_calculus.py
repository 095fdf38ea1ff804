"""Integrals and zeros in balls and in mpmath."""

from fractions import Fraction

import pytest
from flint import arb

from reference.arithmetic.namespaces import BALL, MPMATH, ComplexBall
from reference.arithmetic.precision import ctx, mp

BITS = 400


def cycloid(m, x):
    """Zero at the angle of the end point x_B = y_B/3."""
    return x - m.sin(x) - (1 - m.cos(x)) * m.number(Fraction(1, 3))


def test_an_integral_of_balls_holds_the_exact_value():
    with ctx.workprec(BITS):
        found = BALL.integral(lambda m, x: m.sqrt(1 + m.sin(x)), arb(0), arb.pi() / 2)
        assert found.contains(2)
        assert found.rel_accuracy_bits() > BITS - 20


def test_the_ends_of_an_integral_may_be_balls():
    with ctx.workprec(BITS):
        found = BALL.integral(lambda _, x: 1 / x, arb(1), arb(2, arb(2) ** -200))
        assert found.contains(arb(2).log())
        assert 190 < found.rel_accuracy_bits() < 210


def test_an_integrand_that_leaves_the_real_axis_at_a_branch_cut_gives_no_number():
    with ctx.workprec(64):
        assert not BALL.integral(lambda m, x: m.sqrt(x), arb(-1), arb(1)).real.overlaps(arb(2) / 3 + 1)


def test_the_complex_balls_refuse_a_cut_only_where_analyticity_is_asked_for():
    assert ComplexBall(analytic=False).sqrt(-1).is_finite()
    assert not ComplexBall(analytic=True).sqrt(-1).is_finite()


def test_a_zero_in_balls_and_in_mpmath_is_the_same():
    with ctx.workprec(BITS), mp.workprec(BITS):
        proven = BALL.root(cycloid, arb(1) / 2**30, 2 * arb.pi())
        assert proven.rel_accuracy_bits() > BITS - 30
        near = MPMATH.root(cycloid, mp.mpf(2) ** -30, 2 * mp.pi)
        assert abs(mp.mpf(proven.mid().str(130, radius=False)) - near) < mp.mpf(2) ** (30 - BITS)


def test_a_zero_holds_all_zeros_that_the_parameters_allow():
    with ctx.workprec(BITS):
        wide = arb(2, arb(2) ** -100)
        found = BALL.root(lambda _, x: x * x - wide, arb(1), arb(2))
        for end in (wide.lower(), wide.upper()):
            assert found.contains(end.sqrt())


def test_a_zero_is_proven_where_most_bits_of_its_function_cancel():
    """(1 + x^2) acot x - x is about 2/(3 x): near 10^9 it keeps 90 bits fewer than its terms have."""
    ratio = Fraction(2, 3 * 10**9)

    def difference(m, x):
        return (1 + x * x) * (m.pi() / 2 - m.atan(x)) - x - m.number(ratio)

    with ctx.workprec(BITS):
        found = BALL.root(difference, arb(0), arb(10) ** 10)
        assert BITS - 110 < found.rel_accuracy_bits() < BITS - 60
    with ctx.workprec(2 * BITS):
        assert found.contains(BALL.root(difference, arb(0), arb(10) ** 10))
    with ctx.workprec(64):
        assert not BALL.root(difference, arb(0), arb(10) ** 10).is_finite()


def test_where_no_zero_is_there_none_is_given():
    with ctx.workprec(BITS):
        assert not BALL.root(lambda _, x: x * x * x + 1, arb(1), arb(2)).is_finite()
    with mp.workprec(BITS), pytest.raises(ArithmeticError, match=r"^no zero was found between 1\.0 and 2\.0"):
        MPMATH.root(lambda _, x: x * x * x + 1, mp.mpf(1), mp.mpf(2))
