"""The boundary-value form: which extremal reaches a point, proven; and the points that none reaches."""

from __future__ import annotations

import math
import random
from fractions import Fraction
from itertools import pairwise

import pytest
from flint import arb
from independent import correct_limbs, fraction
from independent_polar import Amplitude, ball

from reference.arithmetic.limbs import WorkBoundError
from reference.arithmetic.namespaces import BALL
from reference.arithmetic.precision import ctx
from reference.problems.polar.boundary import _approach
from reference.problems.polar.problem import PolarBrachistochrone
from reference.problems.tunnel.problem import Tunnel

BOTH = pytest.mark.parametrize("family", [PolarBrachistochrone, Tunnel])


def angle_to(z0: Fraction, radius: Fraction, after: bool) -> arb:
    """The angle at which the extremal through z0 passes the radius, by integrals over Jacobi's amplitude."""
    path = Amplitude(ball(z0))
    down = path.passed((ball(1 - radius) / ball(radius - z0)).sqrt())[0]
    s = (3 - 2 * path.z0).sqrt()
    first = arb.pi() / (2 * arb(1).agm(((1 + (3 - path.z0**2) / (2 * s)) / 2).sqrt()))
    return 2 * (arb.pi() / 3 - 2 * path.z0 * first / (3 * s.sqrt())) - down if after else down


def test_the_lowest_point_is_where_the_angles_on_both_sides_of_its_limbs_say():
    """The angle at a fixed radius is monotone in z0: it is passed between the last limb's neighbours."""
    rng = random.Random(1744)
    for _ in range(30):
        radius, angle = rng.uniform(0.05, 0.999), rng.uniform(0.01, 2.09)
        problem = PolarBrachistochrone(end=(radius, angle))
        z0 = sum(Fraction(limb) for limb in problem.certified("z0").limbs(3))
        gap = Fraction(math.ulp(problem.certified("z0").limbs(3)[2]))
        with ctx.workprec(400):
            low, high = (angle_to(z0 + side * gap, Fraction(radius), problem.after_lowest) for side in (-1, 1))
            wanted = ball(Fraction(angle))
            assert (low > wanted > high) if problem.after_lowest else (low < wanted < high)


@BOTH
@pytest.mark.parametrize("z0", ["1e-6", "0.03", "0.4", "0.9", "0.999999"])
@pytest.mark.parametrize("psi", [Fraction(1, 8), Fraction(3), Fraction(10, 3), Fraction(6)])
def test_a_point_of_an_extremal_leads_back_to_it(family, z0, psi):
    there = family(z0=z0)
    radius, angle, tau = (Fraction(there.certified("curve", psi, i).digits(70)) for i in range(3))
    found = family(end=(radius, angle))
    assert found.after_lowest == (psi > Fraction(22, 7))
    assert abs(Fraction(found.certified("z0").digits(60)) / Fraction(z0) - 1) < Fraction(1, 10**45)
    assert abs(Fraction(found.certified("arrival_time").digits(60)) / tau - 1) < Fraction(1, 10**55)


@BOTH
def test_a_point_at_the_radius_of_the_release_is_reached_at_rest(family):
    there = family(z0="0.3")
    half = Fraction(there.certified("half_angle").digits(70))
    found = family(end=(1, 2 * half))
    assert abs(Fraction(found.certified("z0").digits(60)) - Fraction(3, 10)) < Fraction(1, 10**55)
    assert found.certified("half_angle").limbs(3) == tuple(correct_limbs(half, 3))
    arrival = Fraction(found.certified("arrival_time").digits(50))
    assert abs(arrival / (2 * Fraction(there.certified("descent_time").digits(60))) - 1) < Fraction(1, 10**49)


@BOTH
def test_the_angle_is_monotone_on_either_branch(family):
    """What makes the extremal to a point the only one: rising with z0 before the lowest point, falling after it."""
    with ctx.workprec(200):
        for radius in (Fraction(1, 10), Fraction(3, 5), Fraction(99, 100)):
            before, after = [], []
            for k in range(1, 40):
                z0 = radius * k / 40
                form = family(z0=z0).closed_form(BALL)
                phi = form.by_height(BALL.number((radius - z0) / (1 - z0)))[1]
                before.append(phi)
                after.append(2 * form.half_angle - phi)
            assert all(low < high for low, high in pairwise(before))
            assert all(low > high for low, high in pairwise(after))
            assert before[-1] < after[-1]
            assert after[0] < BALL.number(family.field.sweep) * arb.pi()


@pytest.mark.parametrize(
    "end",
    [
        (1, "1e-9"),
        (1, "2.09439510239"),
        (1, "2.0943951023931954923084289221863352561314462"),
        ("1e-12", "1e-12"),
        ("1e-12", 1),
        (1 - 1e-12, "1e-9"),
        (1 - 1e-12, 1),
        (0.5, "1e-12"),
        (0.5, "2.0943951023931954923084"),
    ],
)
def test_ends_near_to_the_limits_are_reached(end):
    problem = PolarBrachistochrone(end=end)
    with ctx.workprec(700):
        form = problem.closed_form(BALL)
        assert form.arrival_angle.overlaps(ball(problem.end[1]))
        assert form.arrival_angle.rel_accuracy_bits() > 200
        assert 0 < form.z0 < ball(problem.end[0])
    assert 0 < float(problem.certified("arrival_time")) <= math.pi


@BOTH
def test_the_time_to_arrive_rises_with_the_angle_to_that_of_the_way_through_the_centre(family):
    limit = float(family.field.sweep) * math.pi
    arrivals = [
        float(family(end=(1, limit * part)).certified("arrival_time")) for part in (0.01, 0.3, 0.6, 0.9, 0.999999)
    ]
    assert arrivals == sorted(arrivals)
    assert arrivals[-1] == pytest.approx(math.pi, rel=1e-6)


@BOTH
def test_beyond_the_sweep_no_extremal_is_found_and_why_is_said(family):
    beyond = {"polar": ("2.0943951023931954923084289221863352561314463", "2 pi/3"), "tunnel": ("3.1416", "pi")}
    angle, told = beyond[family.name]
    for radius in (1, 0.5):
        with pytest.raises(
            ValueError, match=f"which no smooth extremal reaches: released at rest, all sweep less than {told}"
        ):
            family(end=(radius, angle))


@BOTH
@pytest.mark.parametrize(
    ("end", "told"),
    [
        ((1.5, 1), r"end is \(1\.5, 1\.0\); a radius with 0 < R <= 1"),
        ((0, 1), "a radius with 0 < R <= 1"),
        ((0.5, 0), "a positive angle is accepted: the fall along the radius"),
        ((0.5, -1), "a positive angle"),
    ],
)
def test_ends_that_no_release_reaches_are_refused(family, end, told):
    with pytest.raises(ValueError, match=told):
        family(end=end)


def test_an_end_too_near_to_the_limits_is_refused_in_one_sentence():
    with pytest.raises(WorkBoundError, match=r"end is \(1\.0, 1/10+\), too near to where no smooth extremal reaches"):
        PolarBrachistochrone(end=(1, "1e-400")).certified("z0").limbs(1)


def test_an_approach_without_end_is_an_error():
    with pytest.raises(ArithmeticError, match="no extremal was found in 100 steps"):
        list(_approach(lambda x: 1 if x > 0.3 else -1, ((0.0, -1.0), (1.0, 1.0)), float))


def test_the_time_to_an_end_is_correctly_rounded():
    """tau at the end from the proven z0, by an integral; good to what z0 is good for."""
    for end in ((0.5, 0.3), (0.25, 0.8)):
        problem = PolarBrachistochrone(end=end)
        z0 = Fraction(problem.certified("z0").digits(180))
        with ctx.workprec(560):
            tangent = (ball(1 - Fraction(end[0])) / ball(Fraction(end[0]) - z0)).sqrt()
            tau = Amplitude(ball(z0)).passed(tangent)[1]
            assert list(problem.certified("arrival_time").limbs(3)) == correct_limbs(fraction(tau), 3)
