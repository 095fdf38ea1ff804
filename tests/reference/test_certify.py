"""Certified numbers, and what happens when a route is wrong."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest
from independent import correct_limbs, fraction

from reference import Certified, Descent, Pendulum, PolarBrachistochrone
from reference.arithmetic.limbs import WorkBoundError
from reference.arithmetic.precision import mp
from reference.routes.agreement import DisagreementError, agreement


def period_to(bits: int):
    with mp.workprec(bits):
        return 2 * mp.pi / (mp.sqrt(mp.mpf(9.81)) * mp.agm(1, mp.cos(mp.mpf(0.5))))


def test_a_certified_number_is_its_nearest_double_and_a_tail():
    period = Pendulum(1.0).period()
    expected = correct_limbs(fraction(period_to(600)), 3)
    assert isinstance(period, Certified)
    assert float(period) == expected[0]
    assert list(period.tail) == expected[1:]
    assert list(period.limbs()) == expected
    assert period.limbs(1) == (expected[0],)


@pytest.mark.parametrize("count", [1, 2, 17, 50, 1000])
def test_any_number_of_digits_is_correctly_rounded(count):
    with mp.workdps(count + 50):
        scaled = period_to(mp.prec) * mp.mpf(10) ** (count - 1)
        expected = str(int(mp.nint(scaled)))
    text = Pendulum(1.0).period().digits(count)
    assert text.replace(".", "") == expected
    assert len(expected) == count


@pytest.mark.parametrize("count", [0, -3, 2.0, True, "7", None])
def test_a_number_of_digits_must_be_a_positive_integer(count):
    with pytest.raises(ValueError, match=r"^digits is .*; a positive integer is accepted\.$"):
        Pendulum(1.0).period().digits(count)


def test_a_certified_number_is_printed_with_its_name_digits_and_units():
    assert repr(Pendulum(1.0).period()) == "period = 2.1391376005586888 s"
    assert repr(Pendulum(1.0).certified("modulus")).startswith("modulus = 0.4794255386042030")
    assert repr(Pendulum(1.0).certified("state", Fraction(0), 1)) == "omega = 0 rad s-1"


def test_it_knows_the_quantity_that_it_is():
    quantity = Pendulum(1.0).energy().quantity
    assert (quantity.name, quantity.units) == ("energy", "s-2")
    assert "cos(theta)" in quantity.definition


def test_an_exact_value_has_exact_digits_limbs_and_routes():
    start = Pendulum("1/3").certified("state", Fraction(0))
    assert start.digits(5) == "0.33333"
    assert list(start.limbs(3)) == correct_limbs(Fraction(1, 3), 3)
    assert min(start.routes.values()) >= 45


def test_every_route_is_named_with_the_digits_to_which_it_agrees():
    routes = Pendulum(1.0).period().routes
    assert list(routes) == ["enclosure", "taylor", "quadrature"]
    assert routes["enclosure"] == math.inf
    assert all(45 <= routes[name] <= 60 for name in ("taylor", "quadrature"))


def wrong_by(relative: Fraction, only: str):
    honest = Pendulum.by_route

    def by_route(self, route, row, arguments, digits):
        found = honest(self, route, row, arguments, digits)
        if route != only or found is None:
            return found
        return [tuple(value * (1 + relative) for value in values) for values in found]

    return by_route


@pytest.mark.parametrize("route", ["taylor", "quadrature"])
def test_a_wrong_route_is_an_error_that_names_problem_parameters_time_and_both_values(monkeypatch, route):
    monkeypatch.setattr(Pendulum, "by_route", wrong_by(Fraction(1, 10**40), route))
    with pytest.raises(DisagreementError) as error:
        agreement(Pendulum(1.0), "state", [Fraction(1), Fraction(10)], route)
    message = str(error.value)
    assert "theta of Pendulum(theta0=1.0, g=9.81, length=1.0) at t = 1 is " in message
    assert f"by {route}" in message
    assert message.count(" -0.98006699293340489454621472384644479630") == 2
    assert "40.0 digits agree where 45 must." in message
    with pytest.raises(DisagreementError, match=r"at the given parameters is 2.139"):
        Pendulum(1.0).period().routes  # noqa: B018 (computed when asked for)


def test_a_route_that_is_wrong_only_after_45_digits_is_recorded_as_such(monkeypatch):
    monkeypatch.setattr(Pendulum, "by_route", wrong_by(Fraction(1, 10**50), "taylor"))
    assert Pendulum(1.0).period().routes["taylor"] == pytest.approx(50, abs=0.1)


@pytest.mark.parametrize("theta0", ["1e-400", 1e-300])
def test_a_wrong_route_is_found_below_the_range_of_doubles_too(monkeypatch, theta0):
    monkeypatch.setattr(Pendulum, "by_route", wrong_by(Fraction(1, 10**40), "quadrature"))
    with pytest.raises(DisagreementError, match=r"modulus of Pendulum"):
        Pendulum(theta0).certified("modulus").routes  # noqa: B018 (computed when asked for)


def test_a_wrong_index_is_named(monkeypatch):
    monkeypatch.setattr(Pendulum, "by_route", wrong_by(Fraction(1, 10**30), "quadrature"))
    with pytest.raises(DisagreementError, match=r"zero_crossing of Pendulum.* at index 4 is .*: 30.0 digits agree"):
        agreement(Pendulum(1.0), "zero_crossing", [4], "quadrature")


def test_over_an_index_each_value_is_its_own_scale(monkeypatch):
    """An error in the first, of 50 digits of itself and of 59 digits of the last."""
    honest = Pendulum("1").by_route("quadrature", "zero_crossing", [0, 10**9], 60)
    found = [(honest[0][0] * (1 + Fraction(1, 10**50)),), honest[1]]
    monkeypatch.setattr(Pendulum, "by_route", lambda *_: found)
    assert agreement(Pendulum(1.0), "zero_crossing", [0, 10**9], "quadrature")[0].digits == pytest.approx(50, abs=0.1)


def test_what_needs_more_bits_than_the_limit_is_an_error(monkeypatch):
    monkeypatch.setattr(Pendulum, "max_bits", 256)
    assert Pendulum(1.0).period().digits(20)
    with pytest.raises(WorkBoundError, match=r"^period of Pendulum\(theta0=1.0.* could not be decided with 256 bits"):
        Pendulum(1.0).period().digits(200)


def test_a_disagreement_is_no_value_error_because_the_user_did_nothing_wrong():
    assert issubclass(DisagreementError, ArithmeticError)
    assert not issubclass(DisagreementError, ValueError)


def test_a_number_is_decided_though_another_of_its_row_is_not():
    """The height at the end, log(2) - log(2), is a zero that no ball decides."""
    fall = Descent("log(x) - log(2)", start=3, end=2)
    assert fall.certified("passage", 1, component=0).digits(30) == fall.descent_time().digits(30)
    assert fall.certified("passage", 1, component=1).limbs() == (2.0, 0.0, 0.0)
    sentence = r"^passage_y of Descent\('log\(x\) - log\(2\)', .*\) could not be decided with 2048 bits"
    with pytest.raises(WorkBoundError, match=sentence):
        fall.certified("passage", 1, component=2).digits(5)


def test_the_bound_that_an_argument_is_beyond_is_shown_as_short_as_it_is_exact():
    for z0, told in ((0.2, r"0\.2 \(0x1\.999999999999ap-3\)"), ("0.2", r"0\.2"), ("1/3", "1/3"), (0.5, r"0\.5")):
        with pytest.raises(ValueError, match=rf"^z is 0\.1; a number with {told} <= z <= 1 is accepted\.$"):
            PolarBrachistochrone(z0).certified("by_z", 0.1)
