"""Three routes to one number: each right by itself, and together to 45 digits."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from independent import fraction, mpmath_states

from reference import Pendulum
from reference.arithmetic import quadrature
from reference.arithmetic.limbs import interval
from reference.arithmetic.precision import ctx, mp
from reference.routes import enclosure, taylor
from reference.routes.agreement import REQUIRED_DIGITS, ROUTES, agreement

ROWS_OF_TIME = ("state", "sensitivity")
ROWS_OF_ONE = ("period", "energy", "modulus", "complementary_modulus", "dperiod_damplitude")
ROWS_OF_INDEX = ("zero_crossing", "turning_point")
AMPLITUDES = (0.001, 1.0, "3.1", math.pi - 1e-9)


@pytest.mark.parametrize("theta0", AMPLITUDES)
@pytest.mark.parametrize("row", ROWS_OF_TIME)
@pytest.mark.parametrize("route", ROUTES)
def test_trajectories_agree_to_45_digits(theta0, row, route):
    times = [Fraction(k, 7) for k in range(0, 80, 13)]
    found = agreement(Pendulum(theta0), row, times, route)
    assert len(found) == 2
    for one in found:
        assert one.digits >= REQUIRED_DIGITS
        assert one.checked == len(times)


@pytest.mark.parametrize("theta0", AMPLITUDES)
@pytest.mark.parametrize("row", ROWS_OF_ONE)
def test_scalars_agree_to_45_digits(theta0, row):
    routes = Pendulum(theta0).certified(row).routes
    assert routes["enclosure"] == math.inf
    assert routes["quadrature"] >= REQUIRED_DIGITS
    assert ("taylor" in routes) == (row not in {"modulus", "complementary_modulus"})
    assert min(routes.values()) >= REQUIRED_DIGITS


@pytest.mark.parametrize("row", ROWS_OF_INDEX)
@pytest.mark.parametrize("route", ROUTES)
def test_events_agree_to_45_digits(row, route):
    (found,) = agreement(Pendulum(2.0), row, [0, 1, 2, 5], route)
    assert found.digits >= REQUIRED_DIGITS


def test_routes_that_do_not_reach_a_time_say_so_by_absence():
    pendulum = Pendulum(1.0)
    for t in (Fraction(-1), Fraction(10**6)):
        assert pendulum.by_route("taylor", "state", [t], 50) is None
        assert agreement(pendulum, "state", [t], "taylor") is None
        assert agreement(pendulum, "state", [t], "quadrature")[0].digits >= REQUIRED_DIGITS


def test_the_period_by_quadrature_uses_no_elliptic_function(monkeypatch):
    def forbidden(*_arguments, **_options):
        raise AssertionError("an elliptic function was asked for")

    expected = Fraction(Pendulum(1.0).period().digits(70))
    for name in ("ellipk", "ellipf", "ellipfun", "agm"):
        monkeypatch.setattr(mp, name, forbidden)
    monkeypatch.setattr("reference.arithmetic.elliptic.MpmathElliptic.__init__", lambda *_: None)
    ((found,),) = Pendulum(1.0).by_route("quadrature", "period", [None], 60)
    assert abs(found - expected) < Fraction(1, 10**60)


@given(st.fractions(-(2**200), 2**200))
def test_an_mpmath_number_and_its_fraction_are_equal(x):
    with mp.workprec(500):
        number = mp.mpf(x.numerator) / x.denominator
        found = quadrature.to_fraction(number)
        assert found == fraction(number)
        assert mp.mpf(found.numerator) / found.denominator == number


def test_quadrature_integrates_what_is_analytic_and_refuses_what_is_not():
    with mp.workprec(200):
        assert abs(quadrature.integral(mp.exp, 0, 1) - (mp.e - 1)) < mp.mpf(10) ** -55
        with pytest.raises(ArithmeticError, match=r"quadrature stopped at an error of"):
            quadrature.integral(lambda x: abs(x - mp.mpf("0.3")), 0, 1)


def test_the_flow_of_the_equation_is_the_motion():
    times = [Fraction(1, 3), Fraction(7), Fraction(0), Fraction(1, 3)]
    pendulum = Pendulum(2.0)
    found = taylor.Flow(pendulum, 240).at(times)
    expected = mpmath_states(2.0, 9.81, 1.0, [mp.mpf(7)], 300)
    assert found[0] == found[3]
    assert found[2] == (2, 0)
    for component in range(2):
        assert abs(found[1][component] - expected[0][component]) < Fraction(1, 10**60)


def test_flows_of_one_equation_share_what_is_compiled_and_nothing_else():
    taylor._compiled.cache_clear()
    pendulums = [Pendulum(2.0), Pendulum(0.5, "1.62", "2/3"), Pendulum(0, omega0=7)]
    flows = [taylor.Flow(pendulum, bits) for pendulum, bits in zip(pendulums, (240, 250, 256), strict=True)]
    both = [[flow.at([Fraction(3)]) for flow in order] for order in (flows, flows[::-1])]
    assert both[0] == both[1][::-1]
    assert taylor._compiled.cache_info().misses == 1
    for pendulum, (state,) in zip(pendulums, both[0], strict=True):
        assert [float(value) for value in state] == pytest.approx(pendulum.state(3).tolist(), rel=1e-15)


def test_a_rate_may_be_a_plain_number():
    class Fall:
        state_names, parameters, start = ("y", "speed"), {}, (Fraction(0), Fraction(1, 3))

        @staticmethod
        def derivative(m, t, y, p):
            del t, p
            return y[1], m.number(Fraction(1, 3))

    assert [float(x) for x in taylor.Flow(Fall, 120).at([Fraction(3)])[0]] == pytest.approx([2.5, 4 / 3], rel=1e-15)


def test_variational_equations_start_from_the_identity():
    state = taylor.Flow(Pendulum(2.0), 240).at([Fraction(0)], ("theta",))[0]
    assert state == (2, 0, 1, 0)


def test_a_ball_of_the_enclosure_is_as_narrow_as_asked_and_holds_the_value():
    pendulum = Pendulum(1.0)
    ((theta, omega),) = enclosure.balls(pendulum, "state", [Fraction(123, 10)], 400)
    with mp.workprec(900):
        t = mp.mpf(123) / 10
    (truth,) = mpmath_states(1.0, 9.81, 1.0, [t], 900)
    for ball, value in zip((theta, omega), truth, strict=True):
        assert ball.rel_accuracy_bits() >= 400
        with ctx.workprec(1000):
            low, high, exponent = interval(ball)
        assert low * Fraction(2) ** exponent <= value <= high * Fraction(2) ** exponent
