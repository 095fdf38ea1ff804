"""Three routes to one number: each right by itself, and together to 45 digits."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st
from independent import fraction, mpmath_states

from reference import Pendulum
from reference.arithmetic import quadrature
from reference.arithmetic.limbs import interval
from reference.arithmetic.precision import ctx, mp
from reference.declaration import Quantity, Row, StateSpace
from reference.problem import Problem
from reference.routes import enclosure, flow
from reference.routes.agreement import REQUIRED_DIGITS, ROUTES, agreement
from reference.row_domains import ONCE, TIME

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
    found = flow.Flow(pendulum, 240).at(times)
    expected = mpmath_states(2.0, 9.81, 1.0, [mp.mpf(7)], 300)
    assert found[0] == found[3]
    assert found[2] == (2, 0)
    for component in range(2):
        assert abs(found[1][component] - expected[0][component]) < Fraction(1, 10**60)


def test_flows_of_one_equation_share_what_is_compiled_and_nothing_else():
    flow._compiled.cache_clear()
    pendulums = [Pendulum(2.0), Pendulum(0.5, "1.62", "2/3"), Pendulum(0, omega0=7)]
    flows = [flow.Flow(pendulum, bits) for pendulum, bits in zip(pendulums, (240, 250, 256), strict=True)]
    both = [[flow.at([Fraction(3)]) for flow in order] for order in (flows, flows[::-1])]
    assert both[0] == both[1][::-1]
    assert flow._compiled.cache_info().misses == 1
    for pendulum, (state,) in zip(pendulums, both[0], strict=True):
        assert [float(value) for value in state] == pytest.approx(pendulum.state(3).tolist(), rel=1e-15)


def test_a_rate_may_be_a_plain_number():
    class Fall:
        structure, state_names, parameters = "fall", ("y", "speed"), {}
        start = (Fraction(0), Fraction(1, 3))

        @staticmethod
        def derivative(m, t, y, p):
            del t, p
            return y[1], m.number(Fraction(1, 3))

    assert [float(x) for x in flow.Flow(Fall, 120).at([Fraction(3)])[0]] == pytest.approx([2.5, 4 / 3], rel=1e-15)


def test_variational_equations_start_from_the_identity():
    state = flow.Flow(Pendulum(2.0), 240).at([Fraction(0)], ("theta",))[0]
    assert state == (2, 0, 1, 0)


@dataclass(frozen=True)
class Driven(Problem):
    """x'' = -k x + cos(t): an equation, a start and a state, and a row of which nothing else is declared."""

    name = "driven"
    space = StateSpace(
        positions=("x",), velocities=("v",), angles=(), odd=None, along=None, scale="units", independent="s"
    )
    rows = (
        Row("state", (Quantity("x", "m", "place", "x'' = -k x + cos(t)"), Quantity("v", "m s-1", "rate", "x'")), TIME),
        Row("mean", (Quantity("mean", "m", "mean of x", "0"),), ONCE),
    )
    invariants = ()
    autonomous = False
    k: Fraction = Fraction(4)

    @property
    def parameters(self):
        return {"k": self.k}

    @property
    def start(self):
        return Fraction(1, 2), Fraction(0)

    def derivative(self, m, t, y, p):
        return y[1], m.cos(t) - p["k"] * y[0]


def test_a_problem_that_declares_an_equation_alone_has_the_taylor_route_of_its_state():
    times = [Fraction(0), Fraction(1, 3), Fraction(20)]
    for k in (Fraction(4), Fraction(9)):
        found = Driven(k).by_route("taylor", "state", times, 60)
        with mp.workprec(300):
            w, forced = mp.sqrt(k.numerator), 1 / mp.mpf(int(k) - 1)
            for t, (x, v) in zip(times, found, strict=True):
                moment = mp.mpf(t.numerator) / t.denominator
                expected = (mp.mpf(1) / 2 - forced) * mp.cos(w * moment) + forced * mp.cos(moment)
                rate = (forced - mp.mpf(1) / 2) * w * mp.sin(w * moment) - forced * mp.sin(moment)
                assert abs(x - fraction(expected)) < Fraction(1, 10**60)
                assert abs(v - fraction(rate)) < Fraction(1, 10**60)


def test_flows_of_problems_that_differ_in_parameters_alone_share_what_is_compiled():
    flow._compiled.cache_clear()
    for k in (1, 2, 3):
        Driven(Fraction(k)).by_route("taylor", "state", [Fraction(1)], 60)
    assert flow._compiled.cache_info().misses == 1


def test_the_work_of_a_flow_is_bounded_where_the_problem_bounds_it_no_sharper():
    assert Driven().by_route("taylor", "state", [Fraction(-1)], 60) is None
    assert Driven().by_route("taylor", "state", [Fraction(1), Fraction(10**9)], 60) is None


def test_a_row_that_is_not_declared_for_the_taylor_route_is_an_error_that_says_so():
    with pytest.raises(ValueError, match=r"mean of Driven\(.*\) is not declared for the Taylor route"):
        Driven().by_route("taylor", "mean", [None], 60)


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
