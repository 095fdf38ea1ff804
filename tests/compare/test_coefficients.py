"""The coefficients of a step, read off it, and what is said of the one that is wrong."""

from __future__ import annotations

import math

import numpy as np
import pytest
import slips
import sound_and_slipped

from compare.claims.candidate import Candidate
from compare.claims.coefficients import slip
from compare.claims.frames import Scene
from compare.claims.heading import heading
from compare.methods import find
from compare.methods.own.forms import form_of
from reference import Pendulum


def said(step, order):
    return slip(Candidate(step, form_of(step), "it"), Scene(Pendulum(1)), order)


def changed(method, array, place, value):
    """A known method with one coefficient changed, as a step that takes the time."""
    numbers = sound_and_slipped.numbers_of(find(method))
    numbers[array][place] = value
    return sound_and_slipped.runge_kutta(numbers, 0)


@pytest.mark.parametrize(
    ("method", "array", "place", "value", "says"),
    [
        ("rk4", "b", 2, 0.3335, "b_3 is 0.3335, which is 1/3 in rk4"),
        ("rk4", "c", 2, 1.0, "stage 3 is taken at the time t + 1 h, and is the state at t + 0.5 h"),
        ("dopri5", "b", 3, 0.65, "b_4 is 0.65, which is 125/192 in dormand_prince54"),
        ("midpoint", "b", 1, 0.9, "b_2 is 0.9, which is 1 in midpoint"),
        ("midpoint", "a", (1, 0), 0.6, "stage 2 is taken at the time t + 0.5 h, and is the state at t + 0.6 h"),
    ],
)
def test_the_coefficient_that_is_off_is_named(method, array, place, value, says):
    assert said(changed(method, array, place, value), find(method).order) == says


def test_a_weight_that_goes_with_h_and_its_square_is_named():
    def step(f, y, h):
        slope = f(y)
        return y + h * slope + h * h / 2 * (f(y + h * slope) - slope)

    assert said(step, 2) == "b_1 goes in part with h^2, where it should go with h"


def test_a_known_method_has_no_slip():
    for name in ("euler", "rk4", "dopri5", "dop853"):
        method = find(name)
        assert said(sound_and_slipped.runge_kutta(sound_and_slipped.numbers_of(method), 0), method.order) is None


def test_a_splitting_is_read_as_drifts_and_kicks():
    numbers = sound_and_slipped.numbers_of(find("yoshida4"))
    kind, weight = numbers["flows"][0]
    numbers["flows"][0] = kind, weight + 1e-3
    told = said(sound_and_slipped.splitting(numbers, 0), 4)
    assert told.endswith("in yoshida4")
    assert told.startswith(("kick 1 is ", "drift 1 is "))
    assert said(sound_and_slipped.of_a_potential(numbers, 0), 4) == told


def h_squared(f, y, h):
    k = f(y)
    return y + h * f(y + h * h / 2 * k)


def of_order_one(f, y, h):
    return y + h * (0.4 * f(y) + 0.6 * f(y + h * f(y)))


def unpacked(f, y, h):
    theta, omega = y
    return y + h * f(np.array([theta, omega]))


def test_what_goes_with_the_square_of_h_and_what_breaks_a_condition_is_named():
    assert said(h_squared, 2) == "a_21 goes with h^2, where it should go with h"
    assert said(lambda f, y, h: y + 1000 * h * f(y), 1) == "the weights b sum to 1000, and not to 1"
    assert said(of_order_one, 2) == "a condition of order 2 has 0.6 in the place of 1/2"


def test_nothing_is_said_of_a_step_that_treats_components_in_different_ways():
    assert said(unpacked, 2) is None
    assert said(slips.forest_ruth_of_order_two, 4) is None


def rk4(f, y, h):
    return sound_and_slipped.untimed(sound_and_slipped.numbers_of(find("rk4")), 0)(f, y, h)


@pytest.mark.parametrize(
    ("step", "cause"),
    [
        (lambda f, y, h: y + h * h * f(y), "what it adds goes with h^2, where it should go with h"),
        (lambda f, y, h: rk4(f, y, h / 1000), "it goes on by 0.001 h, as where h is taken for milliseconds"),
        (lambda f, y, h: rk4(f, y, 2 * h), "it goes on by 2 h"),
        (
            lambda f, y, h: rk4(lambda z: f(np.array([math.radians(z[0]), z[1]])), y, h),
            "it goes along f of angles in degrees, where they are in radians",
        ),
        (
            lambda f, y, h: rk4(lambda z: f(np.array([math.degrees(z[0]), z[1]])), y, h),
            "it goes along f of angles in degrees, where they are in radians",
        ),
    ],
)
def test_a_step_that_goes_elsewhere_is_explained(step, cause):
    found = heading(Candidate(step, form_of(step), "it"), Scene(Pendulum(1)), 0.1)
    assert (found.consistent, found.cause) == (False, cause)
