"""Elliptic functions in balls and in mpmath, against definitions that neither uses."""

from __future__ import annotations

import math

import pytest
from flint import arb
from independent import ball, fraction

from reference.arithmetic.elliptic import BallElliptic, MpmathElliptic, sine_polynomial
from reference.arithmetic.precision import ctx, mp

ANGLES = (1e-3, 0.5, math.pi / 2, 3.0, math.pi - 1e-6)
"""theta0 of the modulus k = sin(theta0/2)."""
ARGUMENTS = (0.0, 0.3, -1.7, 12.5, 1e4)


@pytest.mark.parametrize("angle", ANGLES)
def test_squares_of_the_functions_keep_their_identities(angle):
    with ctx.workprec(300):
        k, kc = (ball(angle) / 2).sin(), (ball(angle) / 2).cos()
        elliptic = BallElliptic(k, kc)
        for u in ARGUMENTS:
            sn, cn, dn = elliptic.functions(ball(u))
            for zero in (sn**2 + cn**2 - 1, dn**2 + k**2 * sn**2 - 1, dn**2 - k**2 * cn**2 - kc**2):
                assert zero.contains(0)
                assert zero.rad() < 1e-60


@pytest.mark.parametrize("angle", ANGLES)
def test_the_functions_invert_the_integral_of_the_first_kind(angle):
    with mp.workprec(200):
        half = mp.mpf(angle) / 2
        elliptic = MpmathElliptic(mp.sin(half), mp.cos(half))
        phi = mp.mpf("0.7")
        sn, cn, dn = elliptic.functions(mp.ellipf(phi, mp.sin(half) ** 2))
        for found, expected in ((sn, mp.sin(phi)), (cn, mp.cos(phi)), (dn, mp.sqrt(1 - (mp.sin(half) * sn) ** 2))):
            assert abs(found - expected) < mp.mpf(10) ** -50


@pytest.mark.parametrize("angle", ANGLES)
@pytest.mark.parametrize("u", ARGUMENTS)
def test_balls_hold_what_mpmath_computes_at_twice_the_precision(angle, u):
    with ctx.workprec(256):
        balls = BallElliptic((ball(angle) / 2).sin(), (ball(angle) / 2).cos())
        enclosed = (balls.first, balls.second(), *balls.functions(ball(u)), balls.epsilon(ball(u)))
    with mp.workprec(512):
        half = mp.mpf(angle) / 2
        numbers = MpmathElliptic(mp.sin(half), mp.cos(half))
        found = (numbers.first, numbers.second(), *numbers.functions(mp.mpf(u)), numbers.epsilon(mp.mpf(u)))
        exact = [fraction(value) for value in found]
    with ctx.workprec(512):
        for truth, value in zip(enclosed, exact, strict=True):
            gap = abs(truth - arb(value.numerator) / value.denominator)
            assert gap.contains(0) or gap < 1e-140
            assert truth.rad() < 1e-55


@pytest.mark.parametrize("angle", ANGLES[:4])
@pytest.mark.parametrize("u", [0.3, -1.7, 5.0])
def test_epsilon_is_the_integral_of_dn_squared(angle, u):
    with mp.workprec(160):
        half = mp.mpf(angle) / 2
        elliptic = MpmathElliptic(mp.sin(half), mp.cos(half))
        pieces = mp.linspace(0, u, 2 + int(abs(u)) * 2)
        integral = mp.quad(lambda v: elliptic.functions(v)[2] ** 2, pieces)
        assert abs(elliptic.epsilon(mp.mpf(u)) - integral) < mp.mpf(10) ** -40


@pytest.mark.parametrize("angle", ANGLES)
def test_the_complete_integrals_are_those_of_the_defining_quadrature(angle):
    with mp.workprec(160):
        half = mp.mpf(angle) / 2
        k, kc = mp.sin(half), mp.cos(half)
        elliptic = MpmathElliptic(k, kc)
        pieces = [mp.pi / 2 * (1 - mp.mpf(4) ** -j) for j in range(16)] + [mp.pi / 2]
        first = mp.quad(lambda phi: 1 / mp.sqrt(mp.cos(phi) ** 2 + (kc * mp.sin(phi)) ** 2), pieces)
        second = mp.quad(lambda phi: mp.sqrt(mp.cos(phi) ** 2 + (kc * mp.sin(phi)) ** 2), pieces)
        assert abs(elliptic.first - first) < mp.mpf(10) ** -40
        assert abs(elliptic.second() - second) < mp.mpf(10) ** -40


@pytest.mark.parametrize("angle", ANGLES)
def test_legendres_relation_ties_the_four_complete_integrals(angle):
    with ctx.workprec(300):
        k, kc = (ball(angle) / 2).sin(), (ball(angle) / 2).cos()
        one, other = BallElliptic(k, kc), BallElliptic(kc, k)
        relation = one.second() * other.first + other.second() * one.first - one.first * other.first
        gap = relation - arb.pi() / 2
        assert gap.contains(0)
        assert gap.rad() < 1e-60


def test_the_quarter_period_is_where_the_sine_is_one():
    with ctx.workprec(256):
        elliptic = BallElliptic(arb("0.6"), arb("0.8"))
        sn, cn, dn = elliptic.functions(elliptic.first)
        assert sn.contains(1)
        assert cn.contains(0)
        assert dn.overlaps(arb("0.8"))
        assert max(x.rad() for x in (sn, cn, dn)) < 1e-60


@pytest.mark.parametrize("angle", ANGLES)
@pytest.mark.parametrize("width", ["0.001", "0.125", "0.9"])
@pytest.mark.parametrize("bits", [20, 80, 200])
def test_the_polynomial_of_the_sine_holds_it_within_its_width(angle, width, bits):
    with ctx.workprec(400):
        k, kc = (ball(angle) / 2).sin(), (ball(angle) / 2).cos()
        found = sine_polynomial(k, arb(width), bits)
        assert found[0].rad() < arb(width) * arb(2) ** -bits
        for x in (arb(1), arb(-1), arb("0.9"), arb("-0.3")):
            truth = BallElliptic(k, kc).functions(x * arb(width))[0]
            assert (x * found(x * x)).overlaps(truth)


def test_the_polynomial_of_the_sine_without_its_rest_misses_it():
    with ctx.workprec(400):
        found = sine_polynomial(arb(0.6), arb(0.5), 60)
        bare = sum(found[i].mid() for i in range(found.length()))
        assert not arb(bare).overlaps(BallElliptic(arb(0.6), arb(0.64).sqrt()).functions(arb(0.5))[0])
