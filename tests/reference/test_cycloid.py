"""The brachistochrone to any end point: every limb, the limits, and that nothing near it is quicker."""

from __future__ import annotations

import math
import pickle
import random
from fractions import Fraction

import heyoka as hy
import numpy as np
import pytest
from independent import correct_limbs, fraction
from independent_cycloid import Descent, number

from reference.arithmetic.limbs import WorkBoundError
from reference.arithmetic.namespaces import BALL, MPMATH, NUMPY, Heyoka
from reference.arithmetic.precision import ctx, mp
from reference.problems.cycloid.arc import CycloidArc
from reference.problems.cycloid.equations import (
    arc_acceleration,
    arc_energy,
    depth,
    excess,
    point_below_cusp,
    run,
    slowness,
)
from reference.problems.cycloid.problem import Cycloid
from reference.routes.agreement import ROUTES, agreement

BITS = 3 * 159
EXACT_PI = "3.14159265358979323846264338327950288419716939937510582097494459230781640628620899862803"
ENDS = [(1, 1), (2, 1), ("3.14159", 2), (0.5, 3), (3, 4, 2), (1e-9, 1), (1e9, 1), ("1e-6", "1e6")]
ARGUMENTS = {
    "once": [None],
    "time": [Fraction(0), Fraction(1, 1000), Fraction(1, 3), Fraction(17)],
    "fraction": [Fraction(0), Fraction(1, 1000), Fraction(1, 3), Fraction(15, 16), Fraction(1)],
    "arc_fraction": [Fraction(0), Fraction(1, 1000), Fraction(1, 3), Fraction(15, 16), Fraction(1)],
    "epsilon": [Fraction(0), Fraction(1, 2), Fraction(-1, 1000)],
}


def random_ends(count: int) -> list[tuple[float, float]]:
    rng = random.Random(1696)
    return [(10 ** rng.uniform(-9, 9), 1.0) for _ in range(count)] + [
        (rng.uniform(0.1, 10), rng.uniform(0.1, 10)) for _ in range(count)
    ]


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("end", ENDS)
def test_every_row_agrees_with_both_routes(end, route):
    problem = Cycloid(*end)
    for row in problem.rows:
        for each in agreement(problem, row.name, ARGUMENTS[row.over], route):
            assert each.digits >= 58
            assert each.checked == len(ARGUMENTS[row.over])


def test_beyond_the_reach_of_the_flow_there_is_no_taylor_route():
    assert set(Cycloid("1e-30", 1).descent_time().routes) == {"enclosure", "quadrature"}
    assert agreement(Cycloid(1, 1), "state", [Fraction(10**6)], "taylor") is None
    assert agreement(Cycloid(1, 1), "position", [Fraction(-1)], "taylor") is None


@pytest.mark.parametrize("end", [(1e-9, 1.0), (1e9, 1.0), (1e-9, 1e9), *random_ends(12)])
def test_every_limb_is_the_correct_rounding_of_a_value_at_three_times_the_precision(end):
    problem = Cycloid(*end)
    rng = random.Random(str(end))
    fractions = [Fraction(rng.random()) for _ in range(4)]
    times = [Fraction(rng.uniform(0, 3) * float(problem.descent_time())) for _ in range(4)]
    with mp.workprec(2 * BITS + 700):
        again = Descent(*(number(x) for x in (*end, 9.81)))
        once = {
            "radius": again.radius,
            "end_angle": again.angle,
            "descent_time": again.time,
            "arc_length": again.length,
            "chord_time": again.chord,
            "chord_gap": again.chord - again.time,
        }
        rows = {
            "curve": (fractions, [again.point(number(f)) for f in fractions]),
            "arc": (fractions, [again.by_arc(number(f) * again.length) for f in fractions]),
            "state": (times, [again.state(number(t)) for t in times]),
            "position": (times, [again.position(number(t)) for t in times]),
        }
        for name, value in once.items():
            assert list(problem.certified(name).limbs(3)) == correct_limbs(fraction(value), 3), name
        for name, (arguments, expected) in rows.items():
            limbs = [[correct_limbs(fraction(x), 3) for x in point] for point in expected]
            assert problem.along(name, arguments, limbs=3).tolist() == limbs, name


@pytest.mark.parametrize(("end", "epsilon"), [((2, 1), 0.5), ((0.01, 1), -0.5), ((40, 1), 2.0**-20)])
def test_every_limb_of_a_gap_is_correct(end, epsilon):
    with mp.workprec(BITS + 150):
        again = Descent(*(number(x) for x in (*end, 9.81)))
        expected = fraction(again.neighbour_time(number(epsilon)) - again.time)
    assert list(Cycloid(*end).neighbour_gap(epsilon).limbs(3)) == correct_limbs(expected, 3)


def test_the_ends_of_the_curve_are_exact():
    problem = Cycloid("1/3", "2/7")
    for row in ("curve", "arc"):
        ends = problem.along(row, [0, 1], limbs=3)
        assert not ends[0].any()
        assert ends[1].tolist() == [correct_limbs(Fraction(1, 3), 3), correct_limbs(Fraction(2, 7), 3)]
    for row in ("state", "position"):
        assert not problem.along(row, 0, limbs=3).any()


def test_the_time_on_the_chord_is_exact_where_it_is_a_root_of_a_square():
    assert Cycloid(3, 4, 2).certified("chord_time").limbs(3) == (2.5, 0, 0)
    assert Cycloid("3/7", "4/7", "2/7").certified("chord_time").digits(5) == "2.5000"
    assert Cycloid(3, 4, 3).certified("chord_time").limbs(3)[1] != 0


def test_a_gap_of_nothing_is_nothing():
    assert Cycloid(2, 1).neighbour_gap(0).limbs(3) == (0, 0, 0)


def test_to_the_bottom_it_takes_half_of_the_circles_turn():
    """From (0, 0) to (pi R, 2 R) in pi sqrt(R/g), on an arc of 4 R."""
    problem = Cycloid(EXACT_PI, 2, 1)
    for name, value in (("radius", "1"), ("end_angle", EXACT_PI), ("descent_time", EXACT_PI), ("arc_length", "4")):
        assert abs(Fraction(problem.certified(name).digits(90)) - Fraction(value)) < Fraction(1, 10**80)


def test_an_end_point_almost_below_is_reached_in_free_fall():
    """T = sqrt(2 y/g) (1 + 3 q^2/8 + ...), R = (2/9) y/q^2 (1 + 27 q^2/20 + ...), theta = 3 q (1 - 3 q^2/10 + ...).

    q = x/y: from q = 2 b/3 + 4 b^3/45 + ..., b = theta/2, R = y/(2 sin^2 b) and T = sqrt(2 y/g) b/sin b.
    """
    for q in (Fraction(1, 10**3), Fraction(1, 10**6), Fraction(1, 10**9)):
        problem = Cycloid(q, 1, 2)
        gap = Fraction(problem.descent_time().digits(60)) - 1
        assert abs(gap / (3 * q * q / 8) - 1) < q * q
        radius = Fraction(problem.radius().digits(60)) / (Fraction(2, 9) / q**2)
        assert abs(radius - 1 - 27 * q * q / 20) < 2 * q**4
        angle = Fraction(problem.end_angle().digits(60)) / (3 * q)
        assert abs(angle - 1 + 3 * q * q / 10) < 2 * q**4
        chord = Fraction(problem.chord_gap().digits(60))
        assert abs(chord / (q * q / 8) - 1) < q * q


def test_an_end_point_almost_level_takes_the_whole_arch():
    """2 pi - theta = d with d^2 q = 4 pi (1 + O(d^2)), R = x/(2 pi) (1 + O(d^3)), T = sqrt(2 pi x/g) (1 + O(d))."""
    with mp.workprec(300):
        for exponent in (3, 6, 9):
            problem = Cycloid(10**exponent, 1, 1)
            d = 2 * mp.pi - mp.mpf(problem.end_angle().digits(60))
            assert abs(d * d * 10**exponent / (4 * mp.pi) - 1) < d * d
            assert abs(mp.mpf(problem.radius().digits(60)) * 2 * mp.pi / 10**exponent - 1) < d**3
            assert abs(mp.mpf(problem.descent_time().digits(60)) / mp.sqrt(2 * mp.pi * 10**exponent) - 1) < d


@pytest.mark.parametrize("end", [(1, 1), (1e-9, 1), (1e9, 1), (EXACT_PI, 2)])
def test_every_neighbour_and_the_chord_take_longer(end):
    problem = Cycloid(*end)
    assert problem.chord_gap().limbs(1) > (0,)
    sizes = ["1/2", "1/10", "1e-3", "1e-9", "1e-100"]
    gaps = problem.along("neighbour_gap", [Fraction(sign) * Fraction(size) for size in sizes for sign in (1, -1)])
    assert (gaps > 0).all()


@pytest.mark.parametrize("end", [(1, 1), (1e-9, 1), (1e9, 1)])
def test_what_is_lost_is_of_second_order(end):
    """gap(e)/e^2 tends to a positive number, the second variation, from both sides with the first power of e."""
    problem = Cycloid(*end)
    second = Fraction(problem.neighbour_gap("1e-60").digits(40)) * 10**120
    for epsilon in (Fraction(1, 10**4), Fraction(-1, 10**4), Fraction(1, 10**12)):
        ratio = Fraction(problem.neighbour_gap(epsilon).digits(40)) / epsilon**2
        assert abs(ratio / second - 1) < 4 * abs(epsilon)


def test_the_second_variation_is_the_integral_of_legendre():
    """Without epsilon: s^2 (w^2 + w'^2) - (d(w sin theta)/dtheta)^2/4, by mpmath's differentiation."""
    with mp.workprec(200):
        half, zero = mp.mpf(7) / 4, mp.mpf(0)
        for f in (mp.mpf(1) / 7, mp.mpf(2) / 3):
            theta = 2 * half * f

            def w(theta):
                return mp.sin(mp.pi * theta / (2 * half))

            slope = mp.diff(lambda theta: w(theta) * mp.sin(theta), theta)
            expected = mp.sin(theta / 2) ** 2 * (w(theta) ** 2 + mp.diff(w, theta) ** 2) - slope**2 / 4
            assert abs(excess(MPMATH, f, half, mp.pi, zero) - expected) < mp.mpf(10) ** -25
            assert slowness(MPMATH, f, half, mp.pi, zero) == 1


def test_the_two_forms_of_a_neighbours_time_differ_by_what_integrates_to_nothing():
    """F - 1 - (epsilon^2/2) excess = (epsilon/2) d(w sin theta)/dtheta at every place and size."""
    with mp.workprec(200):
        half = mp.mpf(5) / 2
        for f in (mp.mpf(1) / 9, mp.mpf(1) / 2, mp.mpf(7) / 8):
            for epsilon in (mp.mpf(1) / 2, mp.mpf(-1) / 3):
                left = slowness(MPMATH, f, half, mp.pi, epsilon) - 1
                left -= epsilon**2 / 2 * excess(MPMATH, f, half, mp.pi, epsilon)
                slope = mp.diff(lambda v: mp.sin(mp.pi * v / (2 * half)) * mp.sin(v), 2 * half * f)
                assert abs(left - epsilon / 2 * slope) < mp.mpf(10) ** -25


def test_the_bead_falls_and_keeps_its_energy():
    problem = Cycloid(2, 1)
    times = np.linspace(0.01, 0.8, 9)
    (arc, rate), (x, y) = problem.state(times).T, problem.along("position", times).T
    assert (np.diff(x) > 0).all()
    assert (y > 0).all()
    assert (rate > 0).all()
    np.testing.assert_allclose(rate**2, 2 * 9.81 * y, rtol=1e-14)
    np.testing.assert_allclose(depth(arc, float(problem.radius())), y, rtol=1e-13)
    assert arc_acceleration(arc[0] - 4, 1.0, 9.81) > 0


def test_the_bead_is_at_the_end_point_after_the_descent_time():
    problem = Cycloid(2, 1)
    time = Fraction(problem.descent_time().digits(60))
    assert problem.along("position", time) == pytest.approx([2, 1], rel=1e-15)
    assert problem.state(time)[0] == pytest.approx(float(problem.certified("arc_length")), rel=1e-15)


def test_beyond_the_end_the_bead_swings_from_cusp_to_cusp():
    problem = Cycloid(2, 1)
    arch = 2 * math.pi * float(problem.radius())
    swing = Fraction(problem.descent_time().digits(60)) / Fraction(problem.end_angle().digits(60))
    with mp.workprec(300):
        swing *= fraction(2 * mp.pi)
    assert problem.along("position", swing) == pytest.approx([arch, 0], abs=1e-14)
    before, after = problem.along("position", [swing - Fraction(1, 5), swing + Fraction(1, 5)])
    assert before == pytest.approx(after, rel=1e-14)
    assert problem.along("position", 2 * swing + Fraction(1, 5)) == pytest.approx(problem.along("position", "1/5"))
    assert (problem.along("position", -1) == problem.along("position", 1)).all()
    assert (problem.state(-1) == problem.state(1) * [1, -1]).all()


def test_a_time_of_2_to_the_30_seconds_is_served_bit_for_bit():
    with mp.workprec(900):
        expected = Descent(mp.mpf(2), mp.mpf(1), number(9.81)).state(mp.mpf(2) ** 30)
        limbs = [correct_limbs(fraction(x), 3) for x in expected]
    assert Cycloid(2, 1).state(2**30, limbs=3).tolist() == limbs


def test_force_and_velocity_are_hamiltons_equations_of_the_energy():
    arc, rate, radius, g = hy.make_vars("arc", "rate", "radius", "g")
    parameters = {"radius": radius, "g": g}
    total = Cycloid.invariant(Heyoka(), (arc, rate), parameters)
    rates = Cycloid(2, 1).derivative(Heyoka(), 0, (arc, rate), parameters)
    differences = [rates[0] - hy.diff(total, rate), rates[1] + hy.diff(total, arc)]
    points = np.random.default_rng(7).uniform(0.1, 3, (4, 100))
    assert np.abs(hy.cfunc(differences, [arc, rate, radius, g])(points)).max() < 1e-12
    assert arc_energy(0.0, 0.0, 1.0, 9.81) == 0


def test_the_cycloid_satisfies_eulers_equation_and_the_closed_form_the_motion():
    with mp.workprec(300):
        problem = Cycloid(2, 1)
        form = problem.closed_form(MPMATH)
        for t in (mp.mpf(1) / 3, mp.mpf(5)):
            state = form.state(t)
            rates = [mp.diff(lambda s, i=i: form.state(s)[i], t) for i in range(2)]
            parameters = {"radius": form.radius, "g": form.g}
            for rate, expected in zip(rates, Cycloid(2, 1).derivative(MPMATH, 0, state, parameters), strict=True):
                assert abs(rate - expected) < mp.mpf(10) ** -35
        theta = mp.mpf(2) / 3
        dx, dy = (mp.diff(lambda a, i=i: point_below_cusp(MPMATH, a, 3)[i], theta) for i in range(2))
        y = point_below_cusp(MPMATH, theta, 3)[1]
        assert abs(dx / dy - run(MPMATH, y, 3)) < mp.mpf(10) ** -35
        assert abs(y * (1 + (dy / dx) ** 2) - 6) < mp.mpf(10) ** -35


def test_the_parameters_of_the_motion_are_those_of_the_curve():
    problem = Cycloid(2, 1)
    assert problem.parameters["g"] == Fraction(9.81)
    with ctx.workprec(1100):
        gap = problem.closed_form(BALL).radius - BALL.number(problem.parameters["radius"])
        assert abs(gap) < 2.0**-1000
    assert problem.start == (0, 0)
    assert problem.rate() == pytest.approx(math.sqrt(9.81 / (4 * float(problem.radius()))))
    assert problem.neighbour(lambda x: x, Fraction(1, 2**53)).end_x == 2 - Fraction(1, 2**35)


@pytest.mark.parametrize("arguments", [(1, 2), ("1/3", "2e-5", "9.81"), (1e-9, 3.0, 1)])
def test_a_cycloid_is_printed_as_what_makes_it(arguments):
    problem = Cycloid(*arguments)
    assert eval(repr(problem), {"Cycloid": Cycloid}) == problem  # noqa: S307 (the string is our own)
    assert pickle.loads(pickle.dumps(problem)) == problem  # noqa: S301 (so are the bytes)


@pytest.mark.parametrize("name", ["end_x", "end_y", "g"])
@pytest.mark.parametrize("value", [0, -1.0, "-1/3"])
def test_an_end_point_to_the_right_and_below_is_asked_for(name, value):
    with pytest.raises(ValueError, match=rf"^{name} is .*; a positive number is accepted\.$"):
        Cycloid(**{"end_x": 1, "end_y": 1, name: value})


@pytest.mark.parametrize(
    ("row", "name", "value", "bounds"),
    [
        ("curve", "fraction", "3/2", "0 <= fraction <= 1"),
        ("curve", "fraction", -1e-9, "0 <= fraction <= 1"),
        ("arc", "arc_fraction", 2, "0 <= arc_fraction <= 1"),
        ("neighbour_gap", "epsilon", 0.51, "-0.5 <= epsilon <= 0.5"),
    ],
)
def test_arguments_outside_their_range_are_refused(row, name, value, bounds):
    with pytest.raises(ValueError, match=rf"^{name} is .*; a number with {bounds} is accepted\.$"):
        Cycloid(1, 1).along(row, value)


def test_a_neighbour_too_far_is_refused_before_it_is_computed():
    with pytest.raises(ValueError, match=r"^epsilon is -0\.75; a number with -0\.5 <= epsilon <= 0\.5 is accepted\.$"):
        Cycloid(1, 1).neighbour_gap("-3/4")


def test_an_integral_to_thousands_of_digits_is_refused_at_once():
    with pytest.raises(WorkBoundError, match=r"^neighbour_gap of Cycloid.* with 4096 bits of working precision"):
        Cycloid(1, 1).neighbour_gap("1/3").digits(2000)
    assert len(Cycloid(1, 1).descent_time().digits(2000)) == 2002


def test_points_take_the_shape_of_their_fractions():
    problem = Cycloid(2, 1)
    assert problem.curve("1/3").shape == (2,)
    assert problem.curve(np.full((4, 5), 0.5), limbs=2).shape == (4, 5, 2, 2)
    assert (problem.curve([0.25, 1.0]) == problem.along("curve", [0.25, 1.0])).all()


@pytest.mark.parametrize("problem", [Cycloid(1, 1, "1e-30"), Cycloid("1e30", "1e30"), Cycloid("1e-30", "1e-30")])
@pytest.mark.parametrize("route", ROUTES)
def test_units_of_any_size_cost_no_digits(problem, route):
    early = Fraction(float(problem.descent_time())) / 1000
    for row, argument in (("state", early), ("position", early), ("curve", Fraction(1, 7))):
        assert min(each.digits for each in agreement(problem, row, [argument], route)) >= 58


@pytest.mark.parametrize("radius", [1, "1/7", 1e9])
@pytest.mark.parametrize("route", ROUTES)
def test_the_curve_by_its_radius_agrees_with_both_routes(radius, route):
    curve = CycloidArc(radius)
    heights = [curve.radius * Fraction(part) for part in ("0", "1e-9", "1/3", "1", "1.9999", "1.999999999999", "2")]
    angles = [Fraction(angle) for angle in ("0", "1e-6", "0.1", "3", "6.28")]
    for row, arguments in (("state", heights), ("curve", angles)):
        assert min(each.digits for each in agreement(curve, row, arguments, route)) >= 58


def test_the_abscissa_at_a_height_is_the_published_formula_to_every_limb():
    rng = random.Random(2022)
    heights = [Fraction(rng.uniform(0, 2)) for _ in range(20)] + [Fraction("1.9999"), Fraction(1, 10**9), Fraction(2)]
    with mp.workprec(BITS + 300):
        expected = [mp.acos(1 - number(y)) - mp.sqrt(number(y) * (2 - number(y))) for y in heights]
        limbs = [[correct_limbs(fraction(x), 3), correct_limbs(y, 3)] for x, y in zip(expected, heights, strict=True)]
    assert CycloidArc(1).state(heights, limbs=3).tolist() == limbs


def test_the_start_of_figure_7_is_served_by_angle_and_by_height():
    with mp.workprec(300):
        x, y = (fraction(value) for value in (mp.mpf("0.1") - mp.sin("0.1"), 1 - mp.cos("0.1")))
    found = CycloidArc(1).along("curve", "0.1", limbs=3)
    assert found.tolist() == [correct_limbs(x, 3), correct_limbs(y, 3)]
    by_height = Fraction(CycloidArc(1).certified("state", y).digits(60))
    assert abs(by_height - x) < Fraction(1, 10**60)


def test_the_curve_has_the_slope_of_its_equation_and_two_singular_ends():
    curve = CycloidArc(3)
    step = Fraction(1, 10**20)
    before, after = (Fraction(curve.certified("state", 2 + side * step).digits(60)) for side in (-1, 1))
    slopes = curve.derivative(NUMPY, 0, (0.0, 2.0), {"radius": 3.0})
    assert float((after - before) / (2 * step)) == pytest.approx(slopes[0], rel=1e-15)
    assert slopes[1] == 1
    assert run(NUMPY, 0.0, 3.0) == 0
    assert run(NUMPY, 6 - 1e-12, 3.0) > 1e6


@pytest.mark.parametrize("y", [-1e-9, "2.0000001"])
def test_a_height_off_the_curve_is_refused(y):
    with pytest.raises(ValueError, match=r"^height is .*; a number with 0 <= height <= 2 is accepted\.$"):
        CycloidArc(1).state(y)


def test_the_radius_of_a_curve_is_positive_and_printed():
    with pytest.raises(ValueError, match=r"^radius is -1\.0; a positive number is accepted\.$"):
        CycloidArc(-1)
    assert eval(repr(CycloidArc("1/3")), {"CycloidArc": CycloidArc}) == CycloidArc("1/3")  # noqa: S307
