"""The race and any other curve: every row against both routes and against an independent computation."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from independent import correct_limbs, fraction
from independent_descent import arc_length, passage, place

from reference.arithmetic.limbs import WorkBoundError
from reference.arithmetic.namespaces import NUMPY
from reference.arithmetic.precision import mp
from reference.problems.descent.curves import RACE
from reference.problems.descent.problem import Descent
from reference.routes.agreement import agreement

NAMES = [curve.name for curve in RACE]
ANGLE = ("x = pi - p + sin(p); y = 1 + cos(p)", 0, "pi")
"""The cycloid by its angle, which starts at a cusp."""
OTHERS = {
    "by angle": Descent(ANGLE[0], start=ANGLE[1], end=ANGLE[2]),
    "a dip": Descent("-sin(x) - x/10", "1.62", 0, 3),
    "a spiral": Descent("x = p*cos(p); y = p*sin(p)", 9.81, "2.5", 4),
    "late": Descent("quartic", "0.25", released="2/3"),
    "late cycloid": Descent("cycloid", released=0.3),
    "vertical": Descent("x = 2; y = exp(-p)", 1, 0, 3),
}
PROBLEMS = {**{curve.name: Descent(curve) for curve in RACE}, **OTHERS}
every_problem = pytest.mark.parametrize("name", PROBLEMS)
every_curve = pytest.mark.parametrize("curve", RACE, ids=lambda curve: curve.name)


def times(problem: Descent) -> list[Fraction]:
    end = Fraction(float(problem.descent_time()))
    return [Fraction(0), end / 1000, end / 3, end * Fraction(99, 100)]


def fractions(problem: Descent) -> list[Fraction]:
    return [
        1 - (1 - problem.released) * left for left in (Fraction(1), Fraction(999, 1000), Fraction(1, 3), Fraction(0))
    ]


@every_problem
def test_the_time_and_the_motion_agree_with_both_routes(name):
    problem = PROBLEMS[name]
    for row, arguments in (("descent_time", [None]), ("motion", times(problem))):
        for route in ("taylor", "quadrature"):
            found = agreement(problem, row, arguments, route)
            if (name, route) == ("by angle", "taylor"):
                assert found is None
            else:
                assert min(each.digits for each in found) >= 55


@pytest.mark.parametrize("name", ["line", "circular_arc", "cycloid", "late"])
def test_every_row_agrees_with_both_routes(name):
    problem = PROBLEMS[name]
    for row in problem.rows:
        arguments = {"time": times, "fraction": fractions}.get(row.over, lambda _: [None])(problem)
        for route in ("taylor", "quadrature"):
            assert min(each.digits for each in agreement(problem, row.name, arguments, route)) >= 55


@every_curve
@pytest.mark.parametrize("g", [9.81, 0.3])
def test_every_limb_of_a_passage_is_correctly_rounded(curve, g):
    places = [Fraction(1, 1000), Fraction(3, 7), Fraction(1)]
    found = Descent(curve, g).values("passage", places, 3)
    with mp.workprec(540):
        for w, values in zip(places, found.tolist(), strict=True):
            share = mp.mpf(w.numerator) / w.denominator
            x, y = place(curve.name, share)
            dx, dy = (mp.diff(lambda s, i=i: place(curve.name, s)[i], share) for i in (0, 1))
            speed = mp.sqrt(2 * mp.mpf(g) * (2 - y))
            expected = [passage(curve.name, share, mp.mpf(g)), x, y, speed, speed * dx / mp.hypot(dx, dy)]
            if w == 1:
                expected[1:3] = [mp.mpf(0)] * 2
                expected[4] = -speed * (mp.pi / mp.hypot(mp.pi, 2) if curve.name == "line" else 1)
            assert values == [correct_limbs(fraction(exact), 3) for exact in expected]


@every_curve
def test_every_limb_of_a_motion_is_correctly_rounded(curve):
    """At the time, to 500 bits, at which the body passes a place that is known."""
    problem = Descent(curve)
    with mp.workprec(560):
        for share in (mp.mpf(1) / 1000, mp.mpf(4) / 7, mp.mpf(15) / 16 + mp.mpf(1) / 3000):
            t = fraction(passage(curve.name, share, mp.mpf(9.81)))
            x, y = place(curve.name, share)
            dx, dy = (mp.diff(lambda s, i=i: place(curve.name, s)[i], share) for i in (0, 1))
            speed = mp.sqrt(2 * mp.mpf(9.81) * (2 - y))
            velocity = [speed * slope / mp.hypot(dx, dy) for slope in (dx, dy)]
            (found,) = problem.values("motion", [t], 3).tolist()
            assert found == [correct_limbs(fraction(value), 3) for value in (x, y, speed, *velocity)]
            rate = speed / mp.hypot(dx, dy)
            (found,) = problem.values("state", [t], 3).tolist()
            assert found == [correct_limbs(fraction(value), 3) for value in (share, rate)]


@every_curve
def test_the_length_of_a_curve_is_correctly_rounded(curve):
    with mp.workprec(540):
        assert Descent(curve).arc_length().limbs(3) == tuple(correct_limbs(fraction(arc_length(curve.name)), 3))


def test_five_hundred_digits_are_served_and_seven_hundred_are_not():
    problem = Descent("line")
    with mp.workprec(2100):
        expected = passage("line", mp.mpf(1), mp.mpf(9.81))
        assert problem.descent_time().digits(500)[:490] == mp.nstr(expected, 500)[:490]
    with pytest.raises(
        WorkBoundError, match=r"^descent_time of Descent\('line', g=9\.81\) could not be decided with 2048"
    ):
        problem.descent_time().digits(700)


def test_the_descent_times_of_the_race_in_order():
    """Of the polynomials the quartic is the fastest, but the arc and the ellipse come before it."""
    order = sorted(NAMES, key=lambda name: float(PROBLEMS[name].descent_time()))
    assert order == ["cycloid", "quarter_ellipse", "circular_arc", "quartic", "cubic", "parabola", "line"]


def test_the_line_is_the_shortest_and_the_slowest_way():
    lengths = {name: float(PROBLEMS[name].arc_length()) for name in NAMES}
    assert min(lengths, key=lengths.get) == "line"
    assert lengths["line"] == math.hypot(math.pi, 2)


def test_all_bodies_of_the_race_arrive_at_the_same_speed():
    speeds = {PROBLEMS[name].certified("passage", Fraction(1), 3).digits(40) for name in NAMES}
    assert len(speeds) == 1
    assert float(speeds.pop()) == pytest.approx(math.sqrt(4 * 9.81), rel=1e-15)


def test_all_bodies_are_on_their_way_for_a_second():
    for name in NAMES:
        assert (PROBLEMS[name].along("motion", [k / 100 for k in range(0, 101, 20)])[:, 1] > 0).all()


def test_the_cycloid_takes_pi_sqrt_r_over_g_from_every_start():
    with mp.workprec(300):
        expected = correct_limbs(fraction(mp.pi / mp.sqrt(mp.mpf(9.81))), 3)
    for released in (0, 0.25, "0.999"):
        assert Descent("cycloid", released=released).descent_time().limbs(3) == tuple(expected)


def test_the_cycloid_is_the_same_by_its_arc_and_by_its_angle():
    by_arc, by_angle = PROBLEMS["cycloid"], OTHERS["by angle"]
    assert by_arc.descent_time().limbs(3) == by_angle.descent_time().limbs(3)
    at = [0.1, 0.7, 1.0]
    np.testing.assert_array_equal(by_arc.along("motion", at, 3), by_angle.along("motion", at, 3))


def test_on_the_cycloid_the_horizontal_velocity_is_linear_in_the_height():
    """As the thesis finds in its figure 10: dx/dt = -sqrt(g) (2 - y)."""
    values = PROBLEMS["cycloid"].along("passage", np.linspace(0, 1, 9))
    np.testing.assert_allclose(values[:, 4], -math.sqrt(9.81) * (2 - values[:, 2]), rtol=1e-14, atol=0)


def test_a_curve_of_the_race_can_be_written_as_a_formula():
    for curve in (Descent("2*(x/pi)**4", start="pi", end=0), Descent("y = 2*(x/pi)**4", 9.81, "pi", "0")):
        assert curve == PROBLEMS["quartic"]
        assert hash(curve) == hash(PROBLEMS["quartic"])
    other = Descent("x = pi*p**2; y = 2*p**8", start=1, end="1/10**9")
    assert float(other.descent_time()) == pytest.approx(float(PROBLEMS["quartic"].descent_time()), rel=1e-8)


def test_a_body_slides_down_and_towards_the_end():
    for problem in PROBLEMS.values():
        moments = [Fraction(k, 10) * Fraction(float(problem.descent_time())) for k in range(10)]
        x, y, speed, velocity_x, velocity_y = problem.along("motion", moments).T
        assert (y < y[0])[1:].all()
        assert (speed > 0)[1:].all()
        assert velocity_y[1] < 0
        np.testing.assert_allclose(np.hypot(velocity_x, velocity_y), speed, rtol=1e-14)
        np.testing.assert_array_equal(np.sign(velocity_x[1:2]), np.sign(np.diff(x)[:1]))


def test_the_energy_is_kept():
    for name, problem in PROBLEMS.items():
        states = problem.state(times(problem))
        energies = [problem.invariant(NUMPY, state, {"g": float(problem.g)}) for state in states]
        np.testing.assert_allclose(energies, energies[-1], rtol=1e-13, err_msg=name)
        assert energies[0] > 0


def test_the_equation_of_motion_is_that_of_the_states():
    for name, problem in PROBLEMS.items():
        t, h = times(problem)[2], Fraction(1, 10**4)
        early, now, late = problem.state([t - h, t, t + h])
        going, bend = problem.derivative(NUMPY, 0, now, {"g": float(problem.g)})
        assert going == now[1]
        assert (late[0] - early[0]) / (2 * float(h)) == pytest.approx(going, rel=1e-5), name
        assert (late[1] - early[1]) / (2 * float(h)) == pytest.approx(bend, rel=1e-4, abs=1e-6), name


def test_at_the_start_the_acceleration_is_that_of_the_slope():
    for name in ("line", "parabola", "quartic"):
        problem = PROBLEMS[name]
        _, bend = problem.derivative(NUMPY, 0, (0.0, 0.0), {"g": 9.81})
        slope = 2 * {"line": 1, "parabola": 2, "quartic": 4}[name] / math.pi
        assert bend * math.pi == pytest.approx(9.81 * slope / (1 + slope**2), rel=1e-14)


def test_a_descent_starts_at_rest_but_at_a_cusp_it_has_no_start():
    assert PROBLEMS["late"].start == (Fraction(2, 3), 0)
    assert PROBLEMS["quartic"].start == (0, 0)
    with pytest.raises(ValueError, match="starts at a cusp, where its equation of motion has no start"):
        _ = OTHERS["by angle"].start


def test_a_neighbour_is_released_further_on():
    for name in ("quartic", "late", "cycloid"):
        problem = PROBLEMS[name]
        other = problem.neighbour(lambda x: Fraction(float(x)), Fraction(1, 2**52))
        assert other.curve == problem.curve
        assert 0 < other.start[0] - problem.start[0] < Fraction(1, 2**19)
        assert 0 < problem.rate() < 100
        assert other.state(0.5)[0] != problem.state(0.5)[0]


@every_problem
def test_a_descent_reads_back_from_its_repr(name):
    problem = PROBLEMS[name]
    assert eval(repr(problem), {"Descent": Descent}) == problem  # noqa: S307 - our own text


def test_small_and_large_things_are_served():
    """A fall of 1e-300 m or 1e300 m, and the first 1e-40 s of a descent."""
    small, large = (Descent("x", start=size, end=0) for size in ("1e-300", "1e300"))
    assert float(small.descent_time()) == pytest.approx(1e-150 * float(Descent("x", start=1, end=0).descent_time()))
    assert float(large.descent_time()) == pytest.approx(1e150 * float(Descent("x", start=1, end=0).descent_time()))
    slope = 8 / math.pi
    place_, rate = PROBLEMS["quartic"].state("1e-40")
    bend = 9.81 * slope / (1 + slope**2) / math.pi
    assert place_ == pytest.approx(bend * 1e-80 / 2, rel=1e-14)
    assert rate == pytest.approx(bend * 1e-40, rel=1e-14)
    assert PROBLEMS["line"].certified("state", Fraction(1, 10**40)).routes["quadrature"] >= 45
