"""Dual numbers: slopes of elliptic functions, and slopes of slopes, against differences."""

from __future__ import annotations

import pytest
from flint import arb
from independent import ball

from reference.arithmetic.dual import DualArithmetic
from reference.arithmetic.elliptic import BallElliptic, MpmathElliptic
from reference.arithmetic.namespaces import BALL, MPMATH
from reference.arithmetic.precision import ctx, mp

MODULI = (0.05, 0.6, 0.999)
NAMES = ("sn", "cn", "dn", "epsilon", "first", "second")


def everything(elliptic, u):
    return (*elliptic.functions(u), elliptic.epsilon(u), elliptic.first, elliptic.second())


def numbers(k, u):
    return everything(MpmathElliptic(k, mp.sqrt(1 - k * k)), u)


@pytest.mark.parametrize("k", MODULI)
@pytest.mark.parametrize("u", [0.4, -7.3])
def test_slopes_of_elliptic_functions_are_differences(k, u):
    with mp.workprec(240):
        point, moved = (mp.mpf(k), mp.mpf(u)), []
        m = DualArithmetic(MPMATH, 2)
        modulus, argument = (m.variable(value, i) for i, value in enumerate(point))
        moved = everything(m.elliptic(modulus, m.sqrt(1 - modulus * modulus)), argument)
        for i, name in enumerate(NAMES):
            for order in ((1, 0), (0, 1)):
                expected = mp.diff(lambda x, y, i=i: numbers(x, y)[i], point, order)
                slope = moved[i].slopes[order.index(1)]
                assert abs(slope - expected) < mp.mpf(10) ** -40 * (1 + abs(expected)), (name, order)


@pytest.mark.parametrize("k", MODULI)
@pytest.mark.parametrize("u", [0.4, -7.3])
def test_slopes_of_slopes_are_second_differences(k, u):
    with mp.workprec(240):
        inner = DualArithmetic(MPMATH, 1)
        outer = DualArithmetic(inner, 1)
        modulus = outer.variable(inner.variable(mp.mpf(k), 0), 0)
        argument = outer.constant(inner.constant(mp.mpf(u)))
        found = everything(outer.elliptic(modulus, outer.sqrt(1 - modulus * modulus)), argument)
        for i, name in enumerate(NAMES):
            expected = mp.diff(lambda x, i=i: numbers(x, mp.mpf(u))[i], mp.mpf(k), 2)
            assert abs(found[i].slopes[0].slopes[0] - expected) < mp.mpf(10) ** -35 * (1 + abs(expected)), name


def test_slopes_in_balls_hold_those_in_numbers():
    with ctx.workprec(300), mp.workprec(600):
        inner = DualArithmetic(BALL, 1)
        outer = DualArithmetic(inner, 1)
        modulus = outer.variable(inner.variable(ball(0.6), 0), 0)
        argument = outer.constant(inner.constant(ball(1.3)))
        found = everything(outer.elliptic(modulus, outer.sqrt(1 - modulus * modulus)), argument)
        for i in range(len(NAMES)):
            expected = mp.diff(lambda x, i=i: numbers(x, mp.mpf(1.3))[i], mp.mpf(0.6), 2)
            second = found[i].slopes[0].slopes[0]
            assert second.overlaps(arb(mp.nstr(expected, 120)))
            assert second.rad() < 1e-70


def test_a_slope_has_the_sign_of_the_change():
    """The period grows with the modulus, the sine of a fixed argument falls with it."""
    with ctx.workprec(100):
        m = DualArithmetic(BALL, 1)
        k = m.variable(arb(0.5), 0)
        elliptic = m.elliptic(k, m.sqrt(1 - k * k))
        assert elliptic.first.slopes[0] > 0
        assert elliptic.second().slopes[0] < 0
        sine = elliptic.functions(m.constant(arb(1)))[0]
        assert sine.slopes[0] < 0
        assert sine.value > BallElliptic(arb(0.51), (1 - arb(0.51) ** 2).sqrt()).functions(arb(1))[0]
