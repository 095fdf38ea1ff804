"""That the brachistochrone is the fastest: against straight lines, and against a family of neighbours."""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import pairwise

import pytest
from flint import arb
from independent_polar import POINT_MASS, UNIFORM_BALL, chord_time, neighbour_time, number

from reference.arithmetic.namespaces import BALL
from reference.arithmetic.precision import ctx, mp
from reference.problems.polar.panels import Panels, Schedule, panels_of, periodic_ball, periodic_mpmath
from reference.problems.polar.problem import PolarBrachistochrone
from reference.problems.tunnel.problem import Tunnel

BOTH = pytest.mark.parametrize("family", [PolarBrachistochrone, Tunnel])
PATHS = ({"z0": 0.2}, {"z0": 0.9}, {"end": (0.5, 0.4)}, {"end": (0.6, 1.9)})
FIELDS = {PolarBrachistochrone: POINT_MASS, Tunnel: UNIFORM_BALL}
EPSILONS = [Fraction(k, 8) for k in (-8, -3, -1, 1, 4, 8)]


@BOTH
@pytest.mark.parametrize("path", PATHS, ids=str)
def test_every_other_curve_takes_longer(family, path):
    problem = family(**path)
    assert float(problem.certified("chord_gap")) > 0
    assert (problem.along("neighbour_gap", EPSILONS) > 0).all()


@BOTH
@pytest.mark.parametrize("path", [PATHS[0], PATHS[2], PATHS[3]], ids=str)
def test_gaps_are_differences_of_times_straight_from_ds_over_v(family, path):
    problem, epsilon, field = family(**path), Fraction(-3, 8), FIELDS[family]
    with mp.workprec(300):
        z0, psi_end, kappa = ends(problem)
        arrival, gap, chord = (
            mp.mpf(problem.certified(*asked).digits(60))
            for asked in (("arrival_time",), ("neighbour_gap", epsilon), ("chord_time",))
        )
        assert abs(neighbour_time(z0, kappa, field, psi_end, number(epsilon)) - arrival - gap) < mp.mpf(10) ** -25
        half = mp.mpf(problem.certified("half_angle").digits(60))
        end = (mp.mpf(1), 2 * half) if problem.end is None else [number(x) for x in problem.end]
        assert abs(chord_time(field, *end) - chord) < mp.mpf(10) ** -25


def ends(problem):
    """z0, psi at the end and kappa in mpmath's numbers."""
    with ctx.workprec(300):
        form = problem.closed_form(BALL)
        sine, cosine = form.last
        found = form.z0, 2 * arb.atan2(sine, cosine), form.kappa
        return [mp.mpf(x.str(80, radius=False)) for x in found]


@BOTH
def test_from_rest_to_rest_a_gap_is_even_and_begins_with_the_square(family):
    problem = family(z0=0.4)
    forward, back = problem.along("neighbour_gap", [Fraction(1, 4), Fraction(-1, 4)], limbs=3).tolist()
    assert forward == back
    small, smaller = (float(problem.certified("neighbour_gap", Fraction(1, 2**k))) for k in (20, 21))
    assert small / smaller == pytest.approx(4, rel=1e-9)


@BOTH
def test_a_gap_is_proven_on_deep_paths_too(family):
    """Where the trapezoidal rule would take too many points."""
    problem = family(z0=1e-7)
    gap = problem.certified("neighbour_gap", Fraction(1, 2))
    assert 0 < float(gap) < 0.2
    with ctx.workprec(100):
        assert periodic_ball(lambda m, x: 1 / (m.number(Fraction(1)) + m.cos(x) ** 2), [1e-4]) is None


@BOTH
def test_the_extremal_keeps_more_than_any_other_way_across_it(family):
    """z^2/v^2 - kappa is not negative: the identity that takes the cancellation out of the gaps."""
    field = family.field
    for z0 in (Fraction(1, 7), Fraction(4, 5)):
        for sine2 in (Fraction(1, 9), Fraction(1, 2), Fraction(1)):
            with mp.workprec(200):
                low, part = number(z0), number(sine2)
                z = field.height(mp, low, part, 1 - part)
                expected = (z**2 / field.speed_squared(z) - field.kappa(low)) * part
                found = field.excess(mp, low, part, 1 - part)
                assert abs(found - expected) < mp.mpf(10) ** -50
                assert found >= 0


def test_periodic_integrals_are_enclosed_and_agree_with_mpmath():
    """The integral of 1/(a + cos x) over a period is 2 pi/sqrt(a^2 - 1)."""

    def function(m, x):
        return 1 / (m.number(Fraction(3, 2)) + m.cos(x))

    with ctx.workprec(300), mp.workprec(300):
        found = periodic_ball(function, [1.5, 0.9])
        exact = 2 * arb.pi() / (arb(5) / 4).sqrt()
        assert found.contains(exact)
        assert found.rel_accuracy_bits() > 250
        near = periodic_mpmath(lambda x: 1 / (mp.mpf(3) / 2 + mp.cos(x)))
        assert abs(near - 2 * mp.pi / mp.sqrt(mp.mpf(5) / 4)) < mp.mpf(2) ** -285
    with ctx.workprec(300):
        assert periodic_ball(function, [1.5]) is None


def test_the_trapezoidal_rule_does_not_claim_what_it_did_not_reach():
    with mp.workprec(200), pytest.raises(ArithmeticError, match="the trapezoidal rule did not settle"):
        periodic_mpmath(lambda x: 1 / (1 + mp.mpf(10) ** -12 + mp.cos(x)))


@BOTH
@pytest.mark.parametrize("z0", [1e-300, 1e-6, 0.5, 1 - 1e-15, 1.0])
def test_panels_cover_a_turn_and_keep_away_from_singularities(family, z0):
    panels = panels_of(family.field, z0)
    points = [0.0, *panels.between(0.0, math.pi)]
    assert points == sorted(points)
    assert points[-1] == math.pi
    for low, high in pairwise(points):
        away = 4 * (high - low) <= 2 * panels.distance((low + high) / 2)
        assert away or high - low < 1e-15
    assert panels.distance(1.0) == pytest.approx(panels.distance(1 + 2 * math.pi))


def test_panels_without_a_period_know_the_points_they_are_given():
    panels = Panels([1j])
    assert panels.distance(0) == 1
    assert panels.distance(7) == pytest.approx(math.sqrt(50))


@pytest.mark.parametrize("z0", [1e-9, 0.3, 1 - 1e-9])
def test_a_schedule_is_a_good_guess(z0):
    problem, schedule = PolarBrachistochrone(z0=z0), Schedule(PolarBrachistochrone.field, z0)
    for part in (0.1, 0.5, 0.99):
        psi = schedule.psi_at(part)
        tau = float(problem.certified("curve", Fraction(psi), 2)) / float(problem.certified("descent_time"))
        assert tau == pytest.approx(part, rel=1e-13)
        assert schedule.psi_at(-part) == -psi
