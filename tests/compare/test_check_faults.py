"""compare.check: a fault as small as a tolerance is not excused as one, nor a slope that says nothing as an order."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import people
import pytest
import slips

import compare
from compare.__main__ import main
from compare.claims.order import Cell, fitted, ladder

SMALL_DEFECTS = [
    (slips.shrunk_verlet, "not symplectic"),
    (slips.shrunk_verlet_with_a_branch, "not symplectic"),
    (slips.shrunk_implicit_midpoint, "not symplectic"),
    (slips.runge_kutta_45_each_step, "not symplectic"),
    (slips.wavering_verlet, "undecided"),
]


@pytest.mark.parametrize(("step", "says"), SMALL_DEFECTS)
def test_a_small_defect_is_no_tolerance_where_nothing_says_so(step, says):
    found = compare.check(step, symplectic=True)
    assert 1e-9 < found.symplecticity_defect < 1e-5
    assert not found.claims_hold
    assert f"claims to be symplectic, {says}" in found.verdict
    assert not compare.check(step, reversible=True).claims_hold


def test_what_is_undecided_says_why():
    claimed, unclaimed = (compare.check(slips.wavering_verlet, symplectic=claim) for claim in (True, None))
    why = "undecided: defect 5e-08 at h = 0.1, the size of a tolerance or of a fault"
    assert f"claims to be symplectic, {why}" in claimed.verdict
    assert f"symplectic or not is {why}" in unclaimed.verdict
    assert unclaimed.claims_hold


INCONSISTENT = [
    (slips.rk4_of_seven_digits, 4, 1 - 1e-7, "0.9999999 h"),
    (slips.rk4_a_little_long, 4, 1 + 1e-9, "1.000000001 h"),
    (slips.rk4_a_little_long_with_a_branch, 4, 1 + 1e-9, "1.000000001 h"),
    (slips.separable_verlet_a_little_long, 2, 1 + 1e-8, "1.00000001 h"),
    (slips.weights_that_miss_one, 4, 7 / 6, "1.16666666667 h"),
]


@pytest.mark.parametrize(("step", "order", "advance", "words"), INCONSISTENT)
def test_a_step_that_does_not_advance_a_constant_slope_by_h_has_no_order(step, order, advance, words):
    found = compare.check(step, order=order)
    assert not found.claims_hold
    assert found.advance == pytest.approx(advance, abs=1e-13)
    assert f"; not consistent: a constant slope is advanced by {words};" in found.verdict
    assert "excused" not in found.verdict


def test_a_step_that_takes_the_momentum_for_the_slope_of_the_position_is_consistent():
    found = compare.check(slips.verlet_without_the_slope_of_positions, order=2, symplectic=True, reversible=True)
    assert found.claims_hold, found.verdict
    assert found.advance == 1


def test_a_whole_integrator_that_goes_a_little_too_far_is_found_on_a_constant_slope():
    found = compare.check(slips.rk4_over_a_grid_a_little_long, order=4)
    assert found.claims_hold is False, found.verdict
    assert found.advance == pytest.approx(1 + 1e-8, abs=1e-12)
    assert "where it stops falling; not consistent: a constant slope is advanced by 1.00000001 h;" in found.verdict


def test_a_plateau_that_is_excused_is_said_to_be():
    """Of one whose calls of f vary a constant slope tells nothing, for it may be a tolerance."""
    right = compare.check(slips.rk4, order=4)
    plateau = replace(right, powers=None, still=replace(right.still, plateau=5e-8))
    assert "where it stops falling, excused as a tolerance (it may be a fault);" in plateau.verdict


def test_an_order_with_a_wide_interval_is_not_established():
    right = replace(compare.check(slips.rk4, order=4), powers=None)
    wide = replace(right, still=replace(right.still, half_width=0.31))
    assert right.claims_hold
    assert wide.claims_hold is wide.order_holds is None
    assert wide.verdict.startswith("claims order 4, order not established: 3.99 ± 0.31; plain arithmetic, on numbers ")
    bends = [(8 / n) ** 4 + 1e-8 * (8 / n) for n in ladder(10**6)[:22]]
    cells = [Cell(n, 1 / n, error, 1e-16) for n, error in zip(ladder(10**6), bends, strict=False)]
    assert not replace(right, still=fitted(cells)).claims_hold


def test_the_wider_of_two_orders_speaks():
    """A sharp order where the time does not enter does not hide one that is not established where it does."""
    right = replace(compare.check(slips.rk4_in_time, order=4), powers=None)
    assert right.claims_hold
    assert right.swinging is not None
    assert not replace(right, swinging=replace(right.swinging, value=4.1, half_width=0.9)).claims_hold


@pytest.mark.parametrize(("value", "claim", "more"), [(3.6, 3.5, False), (3.99, 3, True), (3.7, 3, True)])
def test_more_than_claimed_is_more_than_the_interval(value, claim, more):
    right = replace(compare.check(slips.rk4, order=claim), powers=None)
    found = replace(right, still=replace(right.still, value=value, half_width=0.2))
    assert found.claims_hold
    assert ("more than claimed" in found.verdict) is more


def test_orders_whose_intervals_meet_do_not_tell_of_wrong_times():
    found = compare.check(people.WithFrozenTime, order=4)
    cause = "a stage is taken at a wrong time"
    assert cause in found.verdict
    wide = replace(found.swinging, value=found.still.value - 1, half_width=2.0)
    assert cause not in replace(found, swinging=wide).verdict


@pytest.mark.usefixtures("without_a_process")
def test_a_step_is_called_what_the_user_called_it(capsys):
    """Not by the name of the closure that it is."""
    slip = Path(__file__).parent / "slips.py"
    assert main(["check", f"{slip}:suzuki6", "--order", "6"]) == 0
    assert capsys.readouterr().out.splitlines()[2].startswith("suzuki6: claims order 6")
    assert main(["check", f"{slip}:suzuki6", "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["name"], found["form"], found["advance_of_a_constant_slope"]) == ("suzuki6", "step", 1)
