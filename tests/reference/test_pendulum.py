"""The pendulum released from rest: its equations, its closed form, and every returned bit."""

from __future__ import annotations

import math
import pickle
import random
from fractions import Fraction

import heyoka as hy
import numpy as np
import pytest
from independent import correct_limbs, fraction, landen_states, mpmath_states

from reference import Pendulum
from reference.arithmetic.limbs import WorkBoundError
from reference.arithmetic.namespaces import BALL, MPMATH, NUMPY, Heyoka
from reference.arithmetic.precision import ctx, mp
from reference.problems.pendulum.equations import angular_acceleration, energy, energy_above_rest
from reference.problems.pendulum.events import MAX_EVENTS

BITS = 3 * 159
AMPLITUDES = (0.001, 0.301, 1.0, math.pi / 2, 3.0, math.pi - 1e-9)


def amplitudes(count: int) -> list[float]:
    rng = random.Random(1656)
    ends = [0.001, math.pi - 1e-9, math.nextafter(math.pi / 2, 0)]
    near = [math.pi - 10 ** rng.uniform(-9, -1) for _ in range(count // 3)]
    return ends + near + [rng.uniform(0.001, math.pi - 1e-9) for _ in range(count - count // 3)]


@pytest.mark.parametrize("route", [mpmath_states, landen_states])
def test_every_limb_is_the_correct_rounding_of_a_value_at_three_times_the_precision(route):
    rng = random.Random(1673)
    for theta0 in amplitudes(60):
        times = [rng.uniform(0, 1e6) for _ in range(20)]
        found = Pendulum(theta0).state(times, limbs=3)
        expected = route(theta0, 9.81, 1.0, times, BITS + 160)
        assert found.tolist() == [[correct_limbs(x, 3) for x in state] for state in expected]


def test_scalars_are_correctly_rounded_too():
    for theta0 in amplitudes(10):
        pendulum = Pendulum(theta0)
        with mp.workprec(BITS + 160):
            half = mp.mpf(theta0) / 2
            omega0 = mp.sqrt(mp.mpf(9.81))
            expected = {
                "period": 2 * mp.pi / (omega0 * mp.agm(1, mp.cos(half))),
                "energy": -mp.mpf(9.81) * mp.cos(theta0),
                "modulus": mp.sin(half),
                "complementary_modulus": mp.cos(half),
            }
            for name, value in expected.items():
                assert list(pendulum.certified(name).limbs(3)) == correct_limbs(fraction(value), 3), name


def test_more_limbs_only_append_to_fewer():
    five = Pendulum(2.0).state([0.1, 7.3], limbs=5)
    for count in (2, 3, 4):
        assert (Pendulum(2.0).state([0.1, 7.3], limbs=count) == five[..., :count]).all()
    assert (Pendulum(2.0).state([0.1, 7.3]) == five[..., 0]).all()


def test_the_tail_is_smaller_than_half_a_unit_of_the_limb_before_it():
    limbs = Pendulum(2.0).state(np.linspace(0.1, 100, 200), limbs=3).reshape(-1, 3)
    assert (np.abs(limbs[:, 1]) <= np.spacing(np.abs(limbs[:, 0])) / 2).all()
    assert (np.abs(limbs[:, 2]) <= np.spacing(np.abs(limbs[:, 1])) / 2).all()


def test_periods_agree_with_the_literature():
    # T/T0 for amplitudes in degrees: Beléndez et al. (2007) and any table of K(sin(theta0/2)) 2/pi.
    for degrees, ratio in ((30, 1.01741), (60, 1.07318), (90, 1.18034), (120, 1.37288), (150, 1.76220)):
        found = float(Pendulum(math.radians(degrees), g=1.0).period()) / (2 * math.pi)
        assert round(found, 5) == ratio


def test_the_period_at_a_right_angle_is_gauss_lemniscate_constant():
    with mp.workprec(300):
        right_angle = fraction(mp.pi / 2)
        found = mp.mpf(Pendulum(right_angle, g=1).period().digits(80))
        assert abs(found - mp.gamma(0.25) ** 2 / mp.sqrt(mp.pi)) < mp.mpf(10) ** -75


def test_the_period_grows_as_the_logarithm_of_the_distance_from_upright():
    with mp.workprec(300):
        half_gap = (mp.pi - mp.mpf(math.pi)) / 2
        found = mp.mpf(Pendulum(math.pi, g=1).period().digits(60))
        assert abs(found - 4 * mp.log(4 / mp.sin(half_gap))) < mp.mpf(10) ** -30


def test_the_period_has_the_series_of_small_amplitudes():
    a = Fraction(1, 1000)
    series = 1 + a**2 / 16 + 11 * a**4 / 3072 + 173 * a**6 / 737280 + 22931 * a**8 / 1321205760
    with mp.workprec(200):
        ratio = mp.mpf(Pendulum(a, g=1).period().digits(50)) / (2 * mp.pi)
        assert abs(ratio - mp.mpf(series.numerator) / series.denominator) < mp.mpf(10) ** -32


def test_force_and_velocity_are_hamiltons_equations_of_the_energy():
    theta, omega, g, length = hy.make_vars("theta", "omega", "g", "length")
    m = Heyoka()
    total = energy(m, theta, omega, g, length)
    rates = Pendulum(1).derivative(m, 0, (theta, omega), {"g": g, "length": length})
    differences = [rates[0] - hy.diff(total, omega), rates[1] + hy.diff(total, theta)]
    compiled = hy.cfunc(differences, [theta, omega, g, length])
    points = np.random.default_rng(7).uniform(0.1, 3, (4, 100))
    assert np.abs(compiled(points)).max() < 1e-14
    assert np.abs(hy.cfunc([rates[1]], [theta, omega, g, length])(points)).min() > 1e-3


def test_the_energy_above_rest_is_the_energy_without_its_minimum():
    with mp.workprec(300):
        for theta, omega in ((0.1, 2.0), (3.0, -1.0), (1e-12, 1e-12), (-2.0, 0.0)):
            numbers = [mp.mpf(x) for x in (theta, omega, 9.81, 0.7)]
            minimum = energy(MPMATH, mp.mpf(0), mp.mpf(0), *numbers[2:])
            assert abs(energy(MPMATH, *numbers) - minimum - energy_above_rest(MPMATH, *numbers)) < mp.mpf(10) ** -80


def test_the_energy_above_rest_keeps_its_digits_at_tiny_amplitudes():
    assert energy_above_rest(NUMPY, 1e-9, 0.0, 9.81, 1.0) == pytest.approx(9.81e-18 / 2, rel=1e-14)


def test_gravity_pulls_back_to_the_lower_rest_position():
    for theta in (1e-3, 1.0, 3.0):
        assert angular_acceleration(NUMPY, theta, 9.81, 1.0) < 0 < angular_acceleration(NUMPY, -theta, 9.81, 1.0)
        angle, velocity = Pendulum(theta).state("1e-3")
        assert velocity < 0 < angle < theta


@pytest.mark.parametrize("theta0", [0.1, 1.0, 3.1])
@pytest.mark.parametrize("t", [0.7, -3.0, 100.0])
def test_the_closed_form_satisfies_the_equation(theta0, t):
    with mp.workprec(300):
        pendulum = Pendulum(theta0, length=0.7)
        form = pendulum.closed_form(MPMATH)
        theta, omega = form.state(mp.mpf(t))
        rates = [mp.diff(lambda s, i=i: form.state(s)[i], mp.mpf(t)) for i in range(2)]
        parameters = {name: MPMATH.number(value) for name, value in pendulum.parameters.items()}
        for rate, expected in zip(rates, Pendulum(1).derivative(MPMATH, 0, (theta, omega), parameters), strict=True):
            assert abs(rate - expected) < mp.mpf(10) ** -35 * (1 + abs(expected))


@pytest.mark.parametrize("theta0", [0.1, 1.0, 3.1])
@pytest.mark.parametrize("t", [0.0, 0.7, 20.0])
def test_sensitivities_are_derivatives_of_the_closed_form_by_the_amplitude(theta0, t):
    with mp.workprec(300):
        form = Pendulum(theta0).closed_form(MPMATH)

        def at(amplitude, i):
            half = amplitude / 2
            k, omega0 = mp.sin(half), mp.sqrt(mp.mpf(9.81))
            u = omega0 * t
            if i == 0:
                return 2 * mp.asin(k * mp.ellipfun("cd", u, k=k))
            return -2 * k * mp.cos(half) * omega0 * mp.ellipfun("sd", u, k=k)

        for i, found in enumerate(form.sensitivity(mp.mpf(t))):
            expected = mp.diff(lambda amplitude, i=i: at(amplitude, i), mp.mpf(theta0))
            assert abs(found - expected) < mp.mpf(10) ** -35 * (1 + abs(expected))


@pytest.mark.parametrize("theta0", [0.1, 1.0, 3.1])
def test_the_sensitivity_of_the_period_is_its_derivative(theta0):
    with mp.workprec(300):
        expected = mp.diff(lambda a: 2 * mp.pi / (mp.sqrt(mp.mpf(9.81)) * mp.agm(1, mp.cos(a / 2))), mp.mpf(theta0))
        found = mp.mpf(Pendulum(theta0).certified("dperiod_damplitude").digits(40))
        assert abs(found - expected) < mp.mpf(10) ** -37 * abs(expected)


@pytest.mark.parametrize("theta0", AMPLITUDES)
def test_energy_is_kept_in_balls(theta0):
    pendulum = Pendulum(theta0)
    with ctx.workprec(300):
        form = pendulum.closed_form(BALL)
        for t in (0.1, 3.3, 1e5):
            gap = energy(BALL, *form.state(BALL.number(Fraction(t))), form.g, form.length) - form.energy
            assert gap.contains(0)
            assert gap.rad() < 1e-60


def test_at_rest_the_state_is_exact():
    for limbs in (1, 3):
        found = Pendulum("1/3").state(0, limbs=limbs).reshape(2, -1)
        assert list(found[0]) == correct_limbs(Fraction(1, 3), limbs)
        assert not found[1].any()
        assert not np.signbit(found[1]).any()


def test_the_motion_is_even_in_time_and_half_periodic():
    times = np.array([0.3, 2.5, 77.0])
    pendulum = Pendulum(2.0)
    assert (pendulum.state(-times, limbs=3) == pendulum.state(times, limbs=3) * [[1], [-1]]).all()
    period = Fraction(pendulum.period().digits(60))
    later = pendulum.state([Fraction(t) + period / 2 for t in times.tolist()])
    assert later == pytest.approx(-pendulum.state(times), abs=1e-14)


def test_a_time_of_2_to_the_30_seconds_is_served_bit_for_bit():
    expected = landen_states(1.0, 9.81, 1.0, [2.0**30], BITS + 160)
    assert Pendulum(1.0).state(2**30, limbs=3).tolist() == [correct_limbs(x, 3) for x in expected[0]]


def test_tiny_and_nearly_upright_amplitudes_are_served():
    with mp.workprec(600):
        harmonic = [fraction(x) / 10**200 for x in (mp.cos(1), -mp.sin(1))]
    assert Pendulum("1e-200", g=1).state("1").tolist() == [correct_limbs(x, 1)[0] for x in harmonic]
    upright = Pendulum(math.pi)
    assert upright.theta0 == Fraction(math.pi)
    assert upright.state(1)[0] == pytest.approx(math.pi, abs=1e-14)
    assert upright.state(float(upright.period()) / 4)[0] == pytest.approx(0, abs=1e-12)


def test_states_take_the_shape_of_their_times():
    pendulum = Pendulum(1.0)
    assert pendulum.state(1).shape == (2,)
    assert pendulum.state("1/3", limbs=3).shape == (2, 3)
    assert pendulum.state(np.zeros((4, 5)), limbs=2).shape == (4, 5, 2, 2)
    assert pendulum.state([Fraction(1, 3)]).shape == (1, 2)
    assert pendulum.state(np.array(1.0)).shape == (2,)
    assert pendulum.state(1).dtype == np.float64


def test_float_and_decimal_parameters_are_different_pendulums():
    assert Pendulum(1, g=9.81) != Pendulum(1, g="9.81")
    assert Pendulum(1, g=9.81) == Pendulum(1.0, g=Fraction(9.81), length="1")
    assert Pendulum(1, g=9.81).period().digits(20) != Pendulum(1, g="9.81").period().digits(20)


@pytest.mark.parametrize("arguments", [(1, 9.81, 1), ("1/3", "9.81", 2), (1.0, "1e-3", "7/9")])
def test_a_pendulum_is_printed_as_what_makes_it(arguments):
    pendulum = Pendulum(*arguments)
    assert eval(repr(pendulum), {"Pendulum": Pendulum}) == pendulum  # noqa: S307 (the string is our own)
    assert pickle.loads(pickle.dumps(pendulum)) == pendulum  # noqa: S301 (so are the bytes)


@pytest.mark.parametrize("theta0", [0, -1.0, math.nextafter(math.pi, 4), "3.1415926535897932384626434", 1e300])
def test_an_amplitude_outside_the_open_interval_is_refused(theta0):
    with pytest.raises(ValueError, match=r"^theta0 is .*; an amplitude with 0 < theta0 < pi is accepted\.$"):
        Pendulum(theta0)


def test_amplitudes_are_told_from_pi_however_close():
    assert Pendulum("3.1415926535897932384626433").theta0 < 4
    assert float(Pendulum(math.pi).theta0) == math.pi


@pytest.mark.parametrize("name", ["g", "length"])
@pytest.mark.parametrize("value", [0, -9.81, "-1/3"])
def test_gravity_and_length_must_be_positive(name, value):
    with pytest.raises(ValueError, match=rf"^{name} is .*; a positive number is accepted\.$"):
        Pendulum(1.0, **{name: value})


@pytest.mark.parametrize("limbs", [0, -1, 1.5, True, "3", None])
def test_limbs_must_be_a_positive_integer(limbs):
    with pytest.raises(ValueError, match=r"^limbs is .*; a positive integer is accepted\.$"):
        Pendulum(1.0).state(1, limbs=limbs)


@pytest.mark.parametrize("t", [[], math.nan, [1.0, math.inf], "soon"])
def test_times_must_be_finite_numbers(t):
    with pytest.raises(ValueError, match=r"^t is "):
        Pendulum(1.0).state(t)


def test_an_unknown_row_is_a_key_error():
    with pytest.raises(KeyError, match=r"amplitude"):
        Pendulum(1.0).row("amplitude")


def test_a_value_beyond_the_range_of_a_double_is_refused_but_has_digits():
    energy_of = Pendulum(1, g=1e308, length=1e-308).energy()
    with pytest.raises(OverflowError, match=r"^the value is beyond the range of a double"):
        float(energy_of)
    assert energy_of.digits(5) == "-5.4030e+615"


def test_a_failed_call_leaves_the_working_precision_as_it_was(monkeypatch):
    before = ctx.prec, mp.prec
    monkeypatch.setattr(Pendulum, "max_bits", 150)
    with pytest.raises(WorkBoundError):
        Pendulum(1.0).state(1.0, limbs=3)
    monkeypatch.undo()
    monkeypatch.setattr("reference.routes.quadrature.mp.quad", lambda *_a, **_k: (mp.mpf(1), mp.mpf(1)))
    with pytest.raises(ArithmeticError, match=r"quadrature stopped at an error of"):
        Pendulum(1.0).period().routes  # noqa: B018 (computed when asked for)
    assert (ctx.prec, mp.prec) == before


def test_events_come_in_order_and_alternate():
    pendulum = Pendulum(1.0)
    events = pendulum.events(until=10)
    crossings, turns = ([float(time) for time in times] for times in (events.zero_crossings, events.turning_points))
    period = float(pendulum.period())
    assert (len(crossings), len(turns)) == (9, 9)
    assert crossings == pytest.approx([(2 * j + 1) * period / 4 for j in range(9)], rel=1e-15)
    assert turns == pytest.approx([(j + 1) * period / 2 for j in range(9)], rel=1e-15)
    merged = [time for pair in zip(crossings, turns, strict=True) for time in pair]
    assert merged == sorted(merged)
    assert merged[-1] <= 10


def test_the_state_changes_sign_at_every_event():
    pendulum = Pendulum(2.5)
    events = pendulum.events(until=12)
    for component, times in ((0, events.zero_crossings), (1, events.turning_points)):
        for time in times:
            exact_time = Fraction(time.digits(30))
            before, after = pendulum.state([exact_time - Fraction(1, 10**25), exact_time + Fraction(1, 10**25)])
            assert before[component] * after[component] < 0


def test_until_is_compared_exactly():
    first = Pendulum(1.0).certified("zero_crossing", 0)
    below, above = (Fraction(first.digits(60)) + Fraction(side, 10**50) for side in (-1, 1))
    assert len(Pendulum(1.0).events(below).zero_crossings) == 0
    assert len(Pendulum(1.0).events(above).zero_crossings) == 1
    assert Pendulum(1.0).events(0).turning_points == ()


def test_too_many_events_are_refused_before_any_is_made():
    with pytest.raises(ValueError, match=rf"^until is .* events before it; at most {MAX_EVENTS} are accepted\.$"):
        Pendulum(1.0).events("1e30")
    with pytest.raises(ValueError, match=r"a time that is not negative is accepted"):
        Pendulum(1.0).events(-1)
