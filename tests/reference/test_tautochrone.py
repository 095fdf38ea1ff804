"""Huygens' pendulum: the same time from every start, every limb of its motion, and its two equations."""

from __future__ import annotations

import math
import pickle
import random
from fractions import Fraction

import heyoka as hy
import numpy as np
import pytest
from independent import correct_limbs, fraction
from independent_cycloid import number, swing

from reference.arithmetic.namespaces import MPMATH, NUMPY, Heyoka
from reference.arithmetic.precision import mp
from reference.problems.cycloid.equations import angular_acceleration, arc_energy, swing_energy
from reference.problems.cycloid.problem import Cycloid
from reference.problems.cycloid.tautochrone import CycloidalPendulum, Tautochrone
from reference.routes.agreement import ROUTES, agreement

BITS = 3 * 159
STARTS = (1.0, 3.13, -2.5, 0.001)
TIMES = [Fraction(0), Fraction(1, 7), Fraction(1), Fraction(21, 10)]
ROWS_OF_TIME = ("state", "position", "arc")


def random_starts(count: int) -> list[float]:
    rng = random.Random(1673)
    return [rng.uniform(-3.14, 3.14) for _ in range(count)] + [math.pi - 10 ** rng.uniform(-12, -1) for _ in range(3)]


@pytest.mark.parametrize("angle", STARTS)
@pytest.mark.parametrize("route", ROUTES)
def test_every_row_agrees_with_both_routes(angle, route):
    problem = Tautochrone(angle, "0.7")
    for row in problem.rows:
        arguments = TIMES if row.over == "time" else [None]
        for each in agreement(problem, row.name, arguments, route):
            assert each.digits >= 58
            assert each.checked == len(arguments)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("arc", [1, -2.5, 4, 1e-9])
def test_every_row_of_the_arc_agrees_with_both_routes(arc, route):
    problem = CycloidalPendulum(arc)
    for row in problem.rows:
        (*found,) = agreement(problem, row.name, TIMES if row.over == "time" else [None], route)
        assert min(each.digits for each in found) >= 58


@pytest.mark.parametrize("angle", [*random_starts(20), 1e-150, math.pi])
def test_every_limb_is_the_correct_rounding_of_a_value_at_three_times_the_precision(angle):
    rng = random.Random(angle)
    radius, g = rng.uniform(0.1, 10), rng.uniform(1, 30)
    times = [0.0, *(rng.uniform(0, 10 ** rng.uniform(-6, 6)) for _ in range(5))]
    problem = Tautochrone(angle, radius, g)
    with mp.workprec(BITS + 1200):
        expected = [swing(*(number(x) for x in (angle, radius, g, t))) for t in times]
        for row in ROWS_OF_TIME:
            limbs = [[correct_limbs(fraction(x), 3) for x in rows[row]] for rows in expected]
            skip = 1 if row == "state" else 0  # at the start the sine of half the angle is undone by its inverse
            assert problem.along(row, times, limbs=3)[skip:].tolist() == limbs[skip:], row
    assert problem.state(0, limbs=3).tolist() == [correct_limbs(Fraction(angle), 3), [0, 0, 0]]


@pytest.mark.parametrize("problem", [Tautochrone(1), CycloidalPendulum(1, "0.7", "1.62"), Tautochrone(3, 2, 9.81)])
def test_scalars_are_correctly_rounded(problem):
    with mp.workprec(BITS + 100):
        radius, g = number(problem.radius), number(problem.g)
        times = {"descent_time": mp.pi * mp.sqrt(radius / g), "period": 4 * mp.pi * mp.sqrt(radius / g)}
        for name, value in times.items():
            assert list(problem.certified(name).limbs(3)) == correct_limbs(fraction(value), 3)
        if isinstance(problem, Tautochrone):
            energy = g * radius * (1 - mp.cos(number(problem.angle)))
            assert list(problem.energy().limbs(3)) == correct_limbs(fraction(energy), 3)
        else:
            assert list(problem.energy().limbs(3)) == correct_limbs(problem.g / (8 * problem.radius), 3)


@pytest.mark.parametrize("angle", [0.5, 1.5, 2.5, 3.13])
def test_the_time_is_the_same_from_every_start_by_the_integral_along_the_curve(angle):
    """That of sqrt((1 + cos b)/(cos b - cos a)) db/sqrt(g/R), b = a (1 - v^2), which depends on the start a."""
    with mp.workprec(200):
        a = mp.mpf(angle)

        def rate(v):
            gap = a * v * v / 2
            return 2 * a * mp.cos(a / 2 - gap) / mp.sqrt(mp.sin(a - gap) * mp.sinc(gap) * a / 2)

        time = mp.quad(rate, [0, 0.1, 1]) * mp.sqrt(1 / mp.mpf(9.81))
        assert abs(time - mp.mpf(Tautochrone(angle).descent_time().digits(50))) < mp.mpf(10) ** -45


def test_descents_from_every_height_end_together():
    time = Fraction(Tautochrone(1).descent_time().digits(60))
    for angle in (1e-3, 1.5, 2.0, 2.5, 3.13):
        before, after = Tautochrone(angle).state([time - Fraction(1, 10**30), time + Fraction(1, 10**30)])
        assert before[0] > 0 > after[0]
        assert Tautochrone(angle).descent_time().limbs(3) == Tautochrone(1).descent_time().limbs(3)


@pytest.mark.parametrize("angle", [1e-150, 1.0, math.pi - 1e-12, math.pi])
def test_a_time_of_2_to_the_30_seconds_is_served_bit_for_bit(angle):
    with mp.workprec(2500):
        expected = swing(*(number(x) for x in (angle, 1, 9.81, 2**30)))
        for row in ROWS_OF_TIME:
            limbs = [correct_limbs(fraction(x), 3) for x in expected[row]]
            assert Tautochrone(angle).along(row, 2**30, limbs=3).tolist() == limbs


@pytest.mark.parametrize("route", ROUTES)
def test_a_start_a_trillionth_from_the_cusp_has_both_routes(route):
    problem = Tautochrone(math.pi - 1e-12)
    times = [Fraction(0), Fraction(1, 10**7), Fraction(1, 100)]
    assert min(each.digits for each in agreement(problem, "state", times, route)) >= 58


def test_the_closed_form_satisfies_the_equation_of_the_angle():
    """(1 + cos theta) theta'' - sin(theta) theta'^2/2 + (g/2R) sin theta = 0."""
    with mp.workprec(300):
        problem = Tautochrone(2.5, "0.7")
        form = problem.closed_form(MPMATH)
        radius, g = form.radius, form.g
        for t in (mp.mpf(1) / 3, mp.mpf(5)):
            theta, omega = form.state(t)
            omega_rate = mp.diff(lambda s: form.state(s)[1], t)
            assert abs(mp.diff(lambda s: form.state(s)[0], t) - omega) < mp.mpf(10) ** -35
            left = (1 + mp.cos(theta)) * omega_rate - mp.sin(theta) * omega**2 / 2 + g / (2 * radius) * mp.sin(theta)
            assert abs(left) < mp.mpf(10) ** -35
            rates = problem.derivative(MPMATH, 0, (theta, omega), {"radius": radius, "g": g})
            assert abs(rates[1] - omega_rate) < mp.mpf(10) ** -35


def test_the_equation_of_the_angle_is_lagranges():
    """d/dt (dL/domega) = dL/dtheta, L = R^2 (1 + cos theta) omega^2 - g R (1 - cos theta)."""
    theta, omega, radius, g = hy.make_vars("theta", "omega", "radius", "g")
    m = Heyoka()
    lagrangian = radius * radius * (1 + m.cos(theta)) * omega * omega - g * radius * (1 - m.cos(theta))
    momentum = hy.diff(lagrangian, omega)
    acceleration = angular_acceleration(m, theta, omega, radius, g)
    left = hy.diff(momentum, theta) * omega + hy.diff(momentum, omega) * acceleration - hy.diff(lagrangian, theta)
    energy = momentum * omega - lagrangian - swing_energy(m, theta, omega, radius, g)
    compiled = hy.cfunc([left, energy], [theta, omega, radius, g])
    points = np.random.default_rng(7).uniform(0.1, 2.5, (4, 100))
    assert np.abs(compiled(points)).max() < 1e-12


def test_the_arc_obeys_hamiltons_equations_and_is_separable():
    arc, rate, radius, g = hy.make_vars("arc", "rate", "radius", "g")
    parameters = {"radius": radius, "g": g}
    total = CycloidalPendulum.invariant(Heyoka(), (arc, rate), parameters)
    rates = CycloidalPendulum(1).derivative(Heyoka(), 0, (arc, rate), parameters)
    differences = [rates[0] - hy.diff(total, rate), rates[1] + hy.diff(total, arc)]
    points = np.random.default_rng(7).uniform(0.1, 3, (4, 100))
    assert np.abs(hy.cfunc(differences, [arc, rate, radius, g])(points)).max() < 1e-12


def test_the_energy_is_kept_and_is_the_same_by_angle_and_by_arc():
    problem = Tautochrone(2.5, 0.7)
    energy = float(problem.energy())
    times = np.linspace(0, 3, 20)
    theta, omega = problem.state(times).T
    arc, rate = problem.along("arc", times).T
    np.testing.assert_allclose(swing_energy(NUMPY, theta, omega, 0.7, 9.81), energy, rtol=1e-13)
    np.testing.assert_allclose(arc_energy(arc, rate, 0.7, 9.81), energy, rtol=1e-13)
    height = problem.along("position", times)[:, 1]
    np.testing.assert_allclose(rate**2 / 2 + 9.81 * height, energy, rtol=1e-13)
    assert problem.invariant(NUMPY, (0.0, 0.0), {"radius": 0.7, "g": 9.81}) == 0


def test_gravity_pulls_towards_the_bottom():
    for angle in (1e-3, 1.0, 3.1):
        rates = [angular_acceleration(NUMPY, side * angle, 0.0, 1.0, 9.81) for side in (1, -1)]
        assert rates[0] < 0 < rates[1]
        state = Tautochrone(angle).state("1e-3")
        assert state[1] < 0 < state[0] < angle


def test_the_pendulum_from_the_cusp_is_the_brachistochrone():
    """s of Cycloid is from the cusp, that of the pendulum from the bottom; the radius is 1 to sixty digits."""
    cycloid = Cycloid("3.14159265358979323846264338327950288419716939937510582097494459230781640628620899862803", 2)
    pendulum = CycloidalPendulum(4)
    times = [0.0, 0.1, 1.0, 5.0]
    down, up = cycloid.state(times), pendulum.state(times)
    np.testing.assert_allclose(down, [[4, 0]] - up, atol=1e-14)
    np.testing.assert_allclose(cycloid.rate(), pendulum.rate(), rtol=1e-15)


def test_the_motion_is_odd_in_the_start_and_even_in_time():
    states = Tautochrone(2.0).state([0.3, -0.3, 7.0], limbs=3)
    assert (Tautochrone(-2.0).state([0.3, -0.3, 7.0], limbs=3) == -states).all()
    assert (states[1] == states[0] * [[1], [-1]]).all()


def _slope(states, place, parameters):
    """d(omega')/d(state[place]) by a central difference."""
    moved = [[states[i] + sign * 1e-6 * (i == place) for i in range(2)] for sign in (1, -1)]
    above, below = (Tautochrone.derivative(NUMPY, 0, state, parameters)[1] for state in moved)
    return (above - below) / 2e-6


def test_a_bound_on_the_rate_holds_along_the_motion():
    for angle in (0.5, 2.0, 3.13):
        problem = Tautochrone(angle)
        parameters = {name: float(value) for name, value in problem.parameters.items()}
        states = problem.state(np.linspace(0, 2.5, 400)).T
        by_angle, by_velocity = (_slope(states, place, parameters) for place in range(2))
        assert np.abs(by_velocity).max() <= problem.rate() * 1.001
        assert np.sqrt(np.abs(by_angle).max()) <= problem.rate() * 1.001


def test_neighbours_start_nearer_to_rest():
    for problem in (Tautochrone(1.0), Tautochrone(-3.1), CycloidalPendulum(-2.0)):
        other = problem.neighbour(lambda x: x, Fraction(1, 2**53))
        assert type(other) is type(problem)
        assert 0 < 1 - other.start[0] / problem.start[0] < 1e-5


@pytest.mark.parametrize("angle", [0, math.nextafter(math.pi, 4), "-3.1415926535897932384626434", 1e300])
def test_an_angle_at_the_bottom_or_beyond_the_cusp_is_refused(angle):
    with pytest.raises(ValueError, match=r"^angle is .*; an angle with 0 < \|angle\| < pi is accepted\.$"):
        Tautochrone(angle)


@pytest.mark.parametrize("arc", [0, 4.0000001, -5])
def test_an_arc_at_the_bottom_or_beyond_the_cusp_is_refused(arc):
    with pytest.raises(ValueError, match=r"^arc is .*; an arc length with 0 < \|arc\| <= 4 radius is accepted\.$"):
        CycloidalPendulum(arc)


@pytest.mark.parametrize("kind", [Tautochrone, CycloidalPendulum])
@pytest.mark.parametrize("name", ["radius", "g"])
def test_radius_and_gravity_must_be_positive(kind, name):
    with pytest.raises(ValueError, match=rf"^{name} is -1\.0; a positive number is accepted\.$"):
        kind(1, **{name: -1})


@pytest.mark.parametrize(
    "problem", [Tautochrone("1/3", "2e-5", "9.81"), Tautochrone(-3.13), CycloidalPendulum("1/7"), CycloidalPendulum(-4)]
)
def test_a_pendulum_is_printed_as_what_makes_it(problem):
    names = {"Tautochrone": Tautochrone, "CycloidalPendulum": CycloidalPendulum}
    assert eval(repr(problem), names) == problem  # noqa: S307 (the string is our own)
    assert pickle.loads(pickle.dumps(problem)) == problem  # noqa: S301 (so are the bytes)


def test_times_that_no_flow_reaches_have_no_taylor_route():
    for t in (Fraction(-1), Fraction(10**6)):
        assert agreement(Tautochrone(1), "state", [t], "taylor") is None
        assert min(each.digits for each in agreement(Tautochrone(1), "state", [t], "quadrature")) >= 58
