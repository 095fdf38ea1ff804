"""The time and the arc as functions of the place: in balls, which hold the truth, and by Chebyshev series."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest
from flint import acb, arb, arb_series
from independent import fraction
from independent_descent import arc_length, passage

from reference.arithmetic.balls import BALL, SERIES, ComplexBall
from reference.arithmetic.precision import ctx, mp
from reference.problems.descent.chebyshev import ChebyshevClock
from reference.problems.descent.clock import REACH, NoChartError, Primitive, arc, clock, pieces
from reference.problems.descent.curves import RACE, spelled_curve
from reference.problems.descent.problem import Descent
from reference.problems.descent.slide import Slide

SLIDES = {curve.name: Slide(curve, Fraction(0), 1) for curve in RACE}
SLIDES["by angle"] = Slide(spelled_curve("x = pi - p + sin(p); y = 1 + cos(p)", 0, "pi"), Fraction(0), 2)
SLIDES["late"] = Slide(spelled_curve("exp(-x)", 0, 3), Fraction(1, 3), 1)
every_slide = pytest.mark.parametrize("name", SLIDES)
INTEGRANDS = ("slowness", "arc_rate")


@every_slide
def test_a_ball_of_little_precision_holds_one_of_much(name):
    slide, rng = SLIDES[name], random.Random(1696)
    coarse, fine = clock(slide, 90), clock(slide, 400)
    for u in [Fraction(rng.random()) for _ in range(25)] + [Fraction(0), Fraction(1, 10**9), Fraction(1)]:
        with ctx.workprec(400):
            exact = [ball.mid() for ball in fine.at(BALL.number(u))]
            time = BALL.number(fraction(exact[0]))
        with ctx.workprec(90):
            for wide, truth in zip(coarse.at(BALL.number(u)), exact, strict=True):
                assert wide.contains(truth)
                assert wide.rel_accuracy_bits() > 70 or u == 0
            place, _ = coarse.place(time)
            assert place.contains(BALL.number(u)) if u == 0 else abs(place - BALL.number(u)) < BALL.number(u) / 2**70


@pytest.mark.parametrize("of", INTEGRANDS)
@every_slide
def test_a_primitive_is_the_integral_that_arb_finds(name, of):
    slide = SLIDES[name]
    with ctx.workprec(80):

        def integrand(u: acb, analytic: bool) -> acb:
            return getattr(slide, of)(ComplexBall(analytic), u)

        expected = acb.integral(integrand, acb(0), acb(1)).real
        found = Primitive(slide, of).total
        assert found.overlaps(expected)
        assert min(found.rel_accuracy_bits(), expected.rel_accuracy_bits()) > 30


@pytest.mark.parametrize("curve", RACE, ids=lambda curve: curve.name)
def test_the_total_time_and_arc_are_those_computed_independently(curve):
    slide = SLIDES[curve.name]
    with mp.workprec(300), ctx.workprec(300):
        time, length = clock(slide, 300).total, arc(slide)
        for found, expected in (
            (time, passage(curve.name, mp.mpf(1), mp.mpf(1) / 2)),
            (length, arc_length(curve.name)),
        ):
            assert abs(found - BALL.number(fraction(expected))) < arb(2) ** -280


@pytest.mark.parametrize("of", INTEGRANDS)
@every_slide
def test_the_bound_of_a_piece_holds_on_its_disc(name, of):
    slide, rng = SLIDES[name], random.Random(1697)
    found = pieces(slide, of)
    assert found[0].first
    assert [piece.centre - piece.radius for piece in found[1:]] == [piece.end for piece in found[:-1]]
    assert found[-1].end == 1
    with ctx.workprec(100):
        for piece in found:
            for _ in range(5):
                turn, share = arb(rng.random()), arb(rng.random() ** 0.2)
                away = acb(turn.cos_pi() * share, turn.sin_pi() * share) * REACH * BALL.number(piece.radius)
                value = getattr(slide, of)(ComplexBall(analytic=True), BALL.number(piece.centre) + away)
                assert value.is_finite()
                assert value.abs_lower() <= piece.bound


@every_slide
def test_near_the_start_a_wide_ball_holds_the_values_of_the_narrow_ones(name):
    slide = SLIDES[name]
    with ctx.workprec(200):
        wide = slide.slowness(ComplexBall(analytic=True), acb(arb(0, 0.01), arb(0, 0.01)))
        assert wide.is_finite()
        for u in (acb(0.01), acb(1e-6), acb(0, 0.005), acb(-0.003, 0.002), acb(1e-30)):
            value = slide.slowness(ComplexBall(analytic=True), u)
            assert wide.contains(value) or wide.overlaps(value)
            assert value.overlaps(slide.slowness(ComplexBall(analytic=True), u + acb(arb(0, 1e-40), arb(0, 1e-40))))
        assert wide.real.contains(slide.slowness(ComplexBall(analytic=True), acb(arb(0))).real.mid())


@every_slide
def test_the_series_at_the_start_claims_no_more_terms_than_it_has(name):
    slide = SLIDES[name]
    found = []
    with ctx.workprec(200):
        for terms in (12, 40):
            with SERIES.of_length(terms):
                found.append(slide.slowness(SERIES, arb_series([arb(0), arb(1) / 64])))
        short, long = found
        assert short.prec <= 10
        for few, many in zip(short.coeffs(), long.coeffs(), strict=False):
            assert few.overlaps(many)
        assert len(short.coeffs()) >= 1
        assert all(coefficient.contains(0) for coefficient in long.coeffs()[len(short.coeffs()) : short.prec])


def test_a_primitive_is_no_number_beyond_what_its_series_serve():
    with ctx.workprec(100):
        primitive = clock(SLIDES["quartic"], 100)
        assert all(ball.is_finite() for ball in primitive.at(arb(1) + arb(1) / 10**6))
        assert not any(ball.is_finite() for ball in primitive.at(arb(3)))


def test_precision_and_length_of_series_are_left_as_they_were():
    before = ctx.prec, ctx.cap, mp.prec
    problem = Descent("circular_arc", "0.5")
    problem.descent_time().digits(100)
    problem.along("motion", [0.1, 0.2])
    problem.certified("motion", Fraction(1, 3)).routes  # noqa: B018 - run for what it may leave behind
    assert (ctx.prec, ctx.cap, mp.prec) == before
    with SERIES.of_length(3):
        assert ctx.cap == 3
    with pytest.raises(ZeroDivisionError), SERIES.of_length(3):
        _ = 1 / 0
    assert ctx.cap == before[1]


def test_a_way_without_a_chart_says_where():
    pole = Slide(spelled_curve("-1e-9/(x - 1/3) - x", 0, 1), Fraction(0), 1)
    with pytest.raises(NoChartError) as failure:
        pieces(pole, "slowness")
    assert float(failure.value.args[0]) == pytest.approx((1 / 3) ** 0.5, abs=1e-3)


@every_slide
def test_the_chebyshev_clock_is_the_clock(name):
    slide = SLIDES[name]
    with mp.workprec(150), ctx.workprec(150):
        series, balls = ChebyshevClock(slide), clock(slide, 150)
        total = mp.mpf(balls.total.mid().str(50, radius=False))
        for part in (0, mp.mpf(2) ** -40, mp.mpf(1) / 3, mp.mpf("0.99")):
            time = total * part
            w, rate = series.place(time)
            u, slowness = balls.place(BALL.number(fraction(time)))
            proven, by_u = slide.way(BALL, u)
            assert abs(BALL.number(fraction(w)) - proven) < arb(2) ** -125
            assert abs(BALL.number(fraction(rate)) - by_u / slowness) < arb(2) ** -110
            again, _ = series.time(w)
            assert abs(again - time) * rate < mp.mpf(2) ** -120
        assert abs(series.time(mp.mpf(1))[0] - total) < total * mp.mpf(2) ** -130


def test_a_chebyshev_series_that_does_not_end_is_an_error(monkeypatch):
    monkeypatch.setattr("reference.problems.descent.chebyshev.MAX_DEPTH", 2)
    kink = Slide(spelled_curve("-x - sqrt((x - 1/3)**2 + 1e-12)/2", 0, 1), Fraction(0), 1)
    with mp.workprec(100), pytest.raises(ArithmeticError, match="do not come to an end"):
        ChebyshevClock(kink)
