"""compare.check: a right method never fails its own claim, and what cannot be told is not established."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import oddities
import pytest
import slips

import compare
from compare.__main__ import main
from compare.claims.defects import Defect
from compare.claims.findings import Claims

ODDITIES = str(Path(__file__).parent / "oddities.py")

HOLD = [
    (oddities.dop853, {"order": 8}),
    (oddities.dop853_of_no_time, {"order": 8}),
    (oddities.midpoint_with_a_default, {"order": 2}),
    (oddities.splitting_of("sofroniou_spaletta10"), {"order": 10, "symplectic": True, "reversible": True}),
    (oddities.with_coefficients_of("butcher6"), {"order": 6}),
    (oddities.leapfrog_without_its_half_step, {"order": 1, "symplectic": True}),
    (oddities.midpoint_that_keeps_the_energy_of_the_pendulum, {"order": 2}),
    (oddities.the_same_on_doubles, {"order": 2}),
]


@pytest.mark.parametrize(("step", "claims"), HOLD)
def test_a_right_claim_holds_within_its_interval(step, claims):
    found = compare.check(step, **claims)
    assert found.claims_hold is True, found.verdict
    assert found.order_interval[0] <= claims["order"] <= found.order_interval[1]
    assert "more than claimed" not in found.verdict


def test_an_order_that_shows_late_is_pursued_to_finer_steps():
    found = compare.check(oddities.diagonally_implicit_of_order_one, order=1, seconds=600)
    assert found.claims_hold is True, found.verdict
    assert found.order_interval[0] < 1 < found.order_interval[1]
    slopes = [cell.slope for cell in found.still.cells[1:]]
    assert slopes[-2:] == sorted(slopes)[-2:]
    assert slopes[-1] > 0.9


@pytest.mark.parametrize("claims", [{"symplectic": True}, {"reversible": True}, {"order": 4}])
def test_no_claim_holds_of_a_step_that_cannot_go_back(claims):
    """It is symplectic and reversible in every march forwards."""
    found = compare.check(oddities.yoshida_of_the_size_of_h, **claims)
    assert found.symplecticity.none
    assert found.reversibility.none
    assert found.consistent
    assert found.claims_hold is False
    assert "; wrong for h < 0: a step back does not go back along f as one forward goes along it;" in found.verdict


FAIL = [
    (oddities.dop853, {"order": 9}, "claims order 9, order 8 by its power series in h (slopes "),
    (oddities.dop853_of_no_time, {"order": 9}, "claims order 9, order 8 by its power series in h (slopes 8.40 ± "),
    (oddities.euler_of_the_size_of_h, {"order": 1}, "wrong for h < 0"),
    (oddities.rk4_with_a_stage_of_the_size_of_h, {"order": 1}, "wrong for h < 0"),
    (oddities.still, {"symplectic": True}, "not consistent: it does not move;"),
    (oddities.still, {"reversible": True}, "not consistent: it does not move;"),
    (oddities.still_over_a_grid, {"symplectic": True}, "not consistent"),
    (oddities.hard_wired, {"order": 4}, "not consistent: it makes no use of f, and moves the same way whatever f is;"),
    (oddities.verlet_of_a_gradient, {"order": 2}, "the momenta go against the force, as with the gradient of the"),
    (oddities.verlet_of_a_gradient, {"symplectic": True}, "force = -gradient is what a step is given"),
    (oddities.against_the_slope, {"order": 2}, "it goes backwards"),
    (oddities.leapfrog_without_its_half_step, {"order": 2}, "of order 2 with velocities half a step before"),
    (oddities.leapfrog_the_other_way, {"order": 2}, "of order 2 with velocities half a step after"),
    (oddities.with_coefficients_of("dop853", slip=(8, 6)), {"order": 8}, "claims order 8, "),
    (oddities.with_coefficients_of("kutta3", slip=(1, 0)), {"order": 3}, "claims order 3, measured 1.0"),
]


@pytest.mark.parametrize(("step", "claims", "says"), FAIL)
def test_a_wrong_claim_fails_and_its_cause_is_named(step, claims, says):
    found = compare.check(step, **claims)
    assert found.claims_hold is False
    assert says in found.verdict


OPEN = [
    (
        oddities.rk4_with_a_node_of_ten_digits,
        {"order": 4},
        "order not established: ",
        "of more digits would decide it;",
    ),
    (oddities.verlet_that_refuses_to_go_back, {"symplectic": True}, "measured 2.00", "takes no step with h < 0;"),
]


@pytest.mark.parametrize(("step", "claims", "says", "why"), OPEN)
def test_what_is_not_established_neither_holds_nor_fails(step, claims, says, why):
    found = compare.check(step, **claims)
    assert found.claims_hold is None
    assert says in found.verdict
    assert why in found.verdict


@pytest.mark.parametrize("claim", [8, 9])
def test_an_order_that_only_slopes_could_tell_and_do_not_is_not_established(claim):
    """As where a step turns everything into doubles: DOP853's slopes in the swinging frame are 7.6 to 8.3."""
    found = replace(compare.check(oddities.dop853, order=claim), powers=None)
    assert found.claims_hold is None
    assert found.order_interval[0] < 8 < found.order_interval[1]
    assert f"claims order {claim}, order not established: 7." in found.verdict
    assert "; plain arithmetic, on numbers that are not turned into floats, and without a branch on" in found.verdict


def test_what_may_be_a_tolerance_or_a_fault_is_not_established():
    found = compare.check(slips.verlet, order=2, symplectic=True)
    doubtful = replace(found, symplecticity=Defect(1e-8, 0.1, none=False, undecided=True))
    assert found.claims_hold is True
    assert doubtful.claims_hold is None
    assert replace(doubtful, claims=Claims(order=3, symplectic=True)).claims_hold is False


def test_a_step_that_refuses_to_go_back_has_its_order():
    found = compare.check(oddities.verlet_that_refuses_to_go_back, order=2)
    assert found.claims_hold is True
    assert found.heading.backward == "refused"


def test_a_step_that_never_calls_f_has_a_verdict_without_any_claim():
    found = compare.check(oddities.hard_wired)
    assert found.claims_hold is True
    assert not found.consistent
    assert "it makes no use of f, and moves the same way whatever f is" in found.verdict


@pytest.mark.parametrize(
    ("name", "claim", "code"),
    [("dop853", "8", 0), ("still", "1", 1), ("rk4_with_a_node_of_ten_digits", "4", 3)],
)
@pytest.mark.usefixtures("without_a_process")
def test_the_exit_code_tells_what_fails_from_what_is_not_established(name, claim, code, capsys):
    assert main(["check", f"{ODDITIES}:{name}", "--order", claim, "--format", "json"]) == code
    found = json.loads(capsys.readouterr().out)
    assert found["claims_hold"] is found["order_holds"] is {0: True, 1: False, 3: None}[code]
    assert found["step_back"] == ("wrong" if name == "still" else "right")
    assert found["order_by_power_series"] == {"dop853": 8, "still": 0}.get(name)


@pytest.mark.parametrize(("claim", "more"), [(3, True), (4, False)])
def test_the_exact_order_is_not_more_than_is_claimed(claim, more):
    found = compare.check(slips.rk4, order=claim)
    assert found.claims_hold is True
    assert ("more than claimed" in found.verdict) is more
