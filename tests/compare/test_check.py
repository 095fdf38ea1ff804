"""compare.check: right integrators pass, the classic slips do not, and the verdict says why."""

from __future__ import annotations

import inspect
import math
import re

import numpy as np
import pytest
import slips

import compare
from compare.claims.frames import Field, Frame, Scene
from compare.claims.order import Cell, fitted, ladder
from compare.methods.own.forms import form_of
from reference import Pendulum

RIGHT = [
    (slips.euler, 1, False, False),
    (slips.phi, 1, True, False),
    (slips.phi_star, 1, True, False),
    (slips.verlet, 2, True, True),
    (slips.separable_verlet, 2, True, True),
    (slips.implicit_midpoint, 2, True, True),
    (slips.loosely_implicit_midpoint, 2, True, True),
    (slips.rk4, 4, False, False),
    (slips.rk4_in_time, 4, False, False),
    (slips.rk4_over_a_grid, 4, False, False),
    (slips.yoshida4, 4, True, True),
    (slips.suzuki6, 6, True, True),
]


@pytest.mark.parametrize(("step", "order", "symplectic", "reversible"), RIGHT)
def test_a_right_integrator_is_what_it_says(step, order, symplectic, reversible):
    found = compare.check(step, order=order, symplectic=symplectic, reversible=reversible)
    assert found.claims_hold, found.verdict
    assert found.measured_order == pytest.approx(order, abs=0.03)
    assert found.order_interval[0] <= order <= found.order_interval[1]
    assert (found.symplecticity.none, found.reversibility.none) == (symplectic, reversible)
    assert found.verdict.startswith(f"claims order {order}, measured {found.measured_order:.2f} ± ")


SLIPS = [
    (slips.euler_called_symplectic, 1, {"symplectic": True}, 1),
    (slips.full_step_for_half, 4, {}, 1),
    (slips.sign_slip, 4, {}, 0),
    (slips.sign_slip_in_kutta, 3, {}, 1),
    (slips.same_half_twice, 2, {"symplectic": True}, 1),
    (slips.swapped_in_a_composition, 4, {"symplectic": True}, 2),
    (slips.forest_ruth_of_order_two, 4, {"symplectic": True}, 2),
    (slips.stages_at_the_wrong_times, 4, {}, 1),
    (slips.one_stage_at_the_wrong_time, 4, {}, 1),
    (slips.weights_that_miss_one, 4, {}, 0),
]


@pytest.mark.parametrize(("step", "claimed", "claims", "measured"), SLIPS)
def test_a_slip_is_caught(step, claimed, claims, measured):
    found = compare.check(step, order=claimed, **claims)
    assert not found.claims_hold
    assert found.measured_order == pytest.approx(measured, abs=0.1)
    if measured == 0:
        assert f"claims order {claimed}, does not converge" in found.verdict


def test_the_verdict_is_the_sentence_of_the_example():
    """Midpoint with a defect of its own size: the order, the defect and the step that it belongs to."""
    found = compare.check(slips.forest_ruth_of_order_two, order=4)
    assert re.match(
        r"claims order 4, measured 2\.00 ± 0\.0\d; symplectic \(defect \de-1\d at h = 0\.1\); ", found.verdict
    )
    found = compare.check(slips.rk4, order=4, symplectic=True)
    assert not found.claims_hold
    assert (
        "; claims to be symplectic, not symplectic (defect 1e-05 at h = 0.1); not reversible (defect " in found.verdict
    )


def test_wrong_times_show_where_the_time_enters_and_nowhere_else():
    found = compare.check(slips.stages_at_the_wrong_times, order=4)
    assert found.still.value == pytest.approx(4, abs=0.03)
    assert found.swinging.value == pytest.approx(1, abs=0.03)
    assert re.search(r"measured 1\.0\d ± 0\.0\d where the time enters, 3\.99 where it does not;", found.verdict)
    assert compare.check(slips.rk4).swinging is None


def test_more_than_is_claimed_is_no_lie():
    found = compare.check(slips.rk4, order=3)
    assert found.claims_hold
    assert "more than claimed" in found.verdict


def test_nothing_claimed_is_nothing_broken():
    found = compare.check(slips.weights_that_miss_one)
    assert found.claims_hold
    assert found.verdict.startswith("does not converge")


@pytest.mark.parametrize("integrate", [slips.adaptive, slips.dense])
def test_an_integrator_that_chooses_its_own_steps_shows_no_order(integrate):
    found = compare.check(integrate)
    assert found.claims_hold
    assert found.measured_order is found.order_interval is None
    assert found.verdict.startswith("chooses its own steps, error ")


def test_an_order_that_nothing_can_show_is_not_to_be_claimed():
    with pytest.raises(ValueError, match=r"chooses its own steps: .* so that its order cannot be measured"):
        compare.check(slips.adaptive, order=3)


def test_the_symplecticity_defect_of_rk4_is_that_of_its_stability_function():
    """On the linear oscillator det = |R(ih)|^2 = 1 - x^6/72 + x^8/576, x = w h, and a small pendulum is one."""
    found = compare.check(slips.rk4, problem=Pendulum(1e-6, g=9.81))
    x = 0.1 * math.sqrt(9.81)
    assert found.symplecticity_defect == pytest.approx(x**6 / 72 - x**8 / 576, rel=1e-6)


def test_the_defect_is_the_same_however_the_step_is_run():
    def with_a_branch(f, y, h):
        return slips.full_step_for_half(f, y, h) if y[0] < 100 else y

    def on_arrays(f, y, h):
        return np.abs(1.0) * slips.full_step_for_half(f, y, h) + 0 * np.sin(np.asarray(h, dtype=float))

    runs = [compare.check(step) for step in (slips.full_step_for_half, on_arrays, with_a_branch)]
    assert [found.engine for found in runs] == ["compiled", "on arrays", "lane by lane"]
    defects = [found.symplecticity_defect for found in runs]
    assert defects == pytest.approx([defects[0]] * 3, rel=1e-9)
    assert [found.measured_order for found in runs] == pytest.approx([1, 1, 1], abs=0.03)


def test_a_truth_value_of_a_symbol_is_not_trusted():
    """heyoka's expressions are true: compiled, the wrong branch would be taken."""

    def step(f, y, h):
        return slips.verlet(f, y, h) if y[0] - y[0] == 0 else slips.euler(f, y, h)

    found = compare.check(step, order=2, symplectic=True)
    assert found.engine == "lane by lane"
    assert found.claims_hold


def test_energy_is_bounded_drifting_or_lost():
    assert compare.check(slips.verlet).energy.behaviour == "bounded"
    rk4 = compare.check(slips.rk4).energy
    assert rk4.behaviour == "drifting"
    assert rk4.slope == pytest.approx(-8.6e-5, rel=0.1)
    assert compare.check(slips.euler).energy.behaviour == "lost"


@pytest.mark.parametrize("problem", [Pendulum(2.5, g=1.62, length=3), Pendulum(0.1, g=1, length=1, omega0=2.5)])
def test_another_problem_gives_the_same_verdict(problem):
    found = compare.check(slips.yoshida4, order=4, symplectic=True, reversible=True, problem=problem)
    assert found.claims_hold, found.verdict
    assert not compare.check(slips.swapped_in_a_composition, order=4, problem=problem).claims_hold


FORMS = {
    "f y h": ("step", "f y h"),
    "y dt rhs": ("step", "y h f"),
    "a b c": ("step", "f y h"),
    "f y0 t": ("integrator", "f y grid"),
    "a b t_eval": ("integrator", "f y grid"),
    "f t y h": ("timed", "f t y h"),
    "t y h f": ("timed", "t y h f"),
    "a b c d": ("timed", "f t y h"),
    "q p force h": ("separable", "q p force h"),
    "x v acc dt": ("separable", "q p force h"),
    "q p grad_v h": ("gradient", "q p gradient h"),
    "x v dV dt": ("gradient", "q p gradient h"),
    "y h": ("own", "y h"),
    "a b": ("own", "y h"),
    "dt u": ("own", "h y"),
    "t y h": ("own-timed", "t y h"),
    "q p dt": ("own-separable", "q p h"),
}


def taking(names: str, defaults: str = ""):
    def function(*_arguments):
        return None

    kind = inspect.Parameter.POSITIONAL_OR_KEYWORD
    needed = [inspect.Parameter(name, kind) for name in names.split()]
    given = [inspect.Parameter(name, kind, default=1) for name in defaults.split()]
    function.__signature__ = inspect.Signature(needed + given)
    return function


WITH_DEFAULTS = {
    ("f y", "h"): ("step", "f y h"),
    ("f y", "dt tol"): ("step", "f y h"),
    ("a b", "h"): ("step", "f y h"),
    ("f t y", "h"): ("timed", "f t y h"),
    ("a b c", "h"): ("timed", "f t y h"),
    ("f y h", "t"): ("timed", "f y h t"),
    ("f y", "h t"): ("timed", "f y h t"),
    ("q p force", "h"): ("separable", "q p force h"),
    ("f y h", "eps"): ("step", "f y h"),
    ("f y0 t", "h"): ("integrator", "f y grid"),
    ("f t y0", "h"): ("integrator", "f grid y"),
}


@pytest.mark.parametrize(("names", "defaults"), WITH_DEFAULTS)
def test_a_step_size_or_a_time_may_have_a_default(names, defaults):
    found = form_of(taking(names, defaults))
    form, roles = WITH_DEFAULTS[names, defaults]
    assert (found.name, found.roles) == (form, tuple(roles.split()))


@pytest.mark.parametrize("names", FORMS)
def test_arguments_are_known_by_their_names_or_by_their_number(names):
    form, roles = FORMS[names]
    for defaults in ("", "tol max_iterations"):
        found = form_of(taking(names, defaults))
        assert (found.name, found.roles) == (form, tuple(roles.split()))


def test_a_form_that_is_named_goes_before_the_names_of_arguments():
    assert form_of(taking("f y t"), "step").name == "step"
    assert form_of(taking("f y h"), "integrator").whole


def test_the_right_hand_side_takes_the_time_before_or_after_the_state():
    field = Field(Scene(Pendulum(1.0)), 10)
    y = np.array([0.3, 0.7])
    expected = [0.7, -9.81 * math.sin(0.3)]
    for answer in (field(y), field([0.3, 0.7]), field(2.0, y), field(y, 2.0)):
        assert answer.tolist() == pytest.approx(expected)
    lanes = field(np.zeros(5), np.tile(y[:, None], 5))
    assert lanes.shape == (2, 5)
    assert lanes[:, 3].tolist() == pytest.approx(expected)


def test_the_swinging_frame_has_the_motion_that_its_truth_says():
    """By differences: q' and p' of the displaced truth are the rates."""
    scene = Scene(Pendulum(1.0), Frame(0.5, 2.0))
    times = [1.0 - 2**-12, 1.0, 1.0 + 2**-12]
    before, here, after = (-scene.errors([t], np.zeros((1, 2)))[0] for t in times)
    rates = scene.rates(compare.claims.frames.NUMPY, 1.0, here)
    assert ((after - before) * 2**11).tolist() == pytest.approx(list(rates), abs=1e-5)
    assert scene.errors([0], scene.start[None]).tolist() == [[0, 0]]


def cells(errors, noise=1e-16):
    return [Cell(n, 1 / n, error, noise) for n, error in zip(ladder(10**6), errors, strict=False)]


def power(order, count, size=1.0):
    return [size * (8 / n) ** order for n in ladder(10**6)[:count]]


def test_a_slope_is_fitted_without_the_rounding_below_it():
    found = fitted(cells([max(error, 2e-15) for error in power(6, 20)]))
    assert (found.kind, found.plateau) == ("slope", None)
    assert found.value == pytest.approx(6, abs=1e-6)
    assert sum(cell.used for cell in found.cells) >= 6


def test_a_slope_that_ends_in_a_tolerance_is_told_from_one_that_bends():
    ends = fitted(cells([error + 1e-6 for error in power(4, 22)]))
    assert ends.value == pytest.approx(4, abs=0.05)
    assert ends.plateau == pytest.approx(1e-6, rel=0.1)
    bends = fitted(cells([a + b for a, b in zip(power(4, 22), power(1, 22, 1e-3), strict=True)]))
    assert bends.value == pytest.approx(1, abs=0.05)


def test_errors_that_never_fall_have_order_zero_and_those_at_rounding_none():
    flat = fitted(cells([0.3] * 12))
    assert (flat.kind, flat.value) == ("flat", 0.0)
    floor = fitted(cells([1e-15] * 12))
    assert (floor.kind, floor.value) == ("floor", None)


def test_an_order_that_is_still_rising_has_the_order_it_rises_to_in_its_interval():
    """An error of h exp(-16 h): its slope is 1 - 16 h."""
    found = fitted([Cell(n, 1 / n, math.exp(-16 / n) / n, 1e-16) for n in ladder(64)])
    assert found.kind == "slope"
    assert found.value < 0.75
    assert found.interval[1] == pytest.approx(1, abs=0.01)


def test_a_slope_that_begins_to_rise_is_not_said_to_be_flat():
    """Of h exp(-40 h) the finest slopes are below a half, and on their way to one."""
    found = fitted([Cell(n, 1 / n, math.exp(-40 / n) / n, 1e-16) for n in ladder(64)])
    assert (found.kind, found.value < 0.5) == ("slope", True)
    assert found.interval[1] == pytest.approx(1, abs=0.05)


def test_a_slope_that_is_bending_where_rounding_ends_it_is_not_said_to_be_sharp():
    """Coefficients of seven digits: order four, until the missing digits show."""
    found = fitted(cells([a + b for a, b in zip(power(4, 22), power(1, 22, 1e-8), strict=True)]))
    assert found.half_width > 0.3
    assert found.value + found.half_width > 3.9
