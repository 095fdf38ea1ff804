"""Claims on what an integrator gives beside states: dense output, error estimates, tolerances, events, derivatives."""

from __future__ import annotations

import json
import re

import people
import pytest

import compare
from compare.__main__ import main
from compare.claims.stiffness import stiff
from reference import Flow, Pendulum
from reference.problems.families import find_family


def only(found):
    (verdict,) = found.verdicts
    return verdict


@pytest.mark.parametrize(
    ("interpolant", "order", "standing", "says"),
    [
        (people.hermite, 3, "PASS", r"measured 3\.0\d ± 0\.\d\d, since in a step it goes with h\^4\.0\d$"),
        (people.hermite, 4, "FAIL", r"measured 3\.0"),
        (people.hermite_without_its_last_slope, 3, "FAIL", "its slope at the end of a step is zero"),
        (people.hermite_of_euler, 1, "FAIL", "at the end of a step it is not the new state"),
    ],
)
def test_dense_output_is_of_the_order_of_its_local_error(interpolant, order, standing, says):
    found = only(compare.check(people.rk4, dense=order, interpolant=interpolant))
    assert (found.claim, found.standing) == ("dense", standing)
    assert re.search(says, str(found))


@pytest.mark.parametrize(
    ("step", "order", "standing", "says"),
    [
        (people.bogacki_shampine, 2, "PASS", "measured 2.0"),
        (people.norm_of_the_estimate, 2, "PASS", "measured 2.0"),
        (people.bogacki_shampine, 1, "FAIL", "a factor h is too many"),
        (people.estimate_without_h, 2, "FAIL", "a factor h is missing"),
        (people.estimate_with_a_slip, 2, "FAIL", "measured 0.0"),
        (people.euler_with_heun, 1, "PASS", "measured 1.0"),
        (people.euler_with_twice_its_error, 1, "FAIL", "its error is 0.5 times the estimate"),
        (people.no_estimate, 3, "FAIL", "it is zero"),
        (people.estimate_between_orders, 2, "NOT ESTABLISHED", "of a method of that order with these steps"),
        (people.not_with_long_steps, 2, "PASS", "measured 2.0"),
    ],
)
def test_an_error_estimate_is_that_of_an_embedded_method(step, order, standing, says):
    found = only(compare.check(step, estimate=order))
    assert (found.claim, found.standing) == ("estimate", standing)
    assert says in str(found)


@pytest.mark.parametrize(
    ("solver", "power", "standing", "says"),
    [
        (people.adaptive, 1, "PASS", "measured rtol^(1.0"),
        (people.adaptive_to_the_end, 1, "PASS", "measured rtol^(1."),
        (people.deaf_to_rtol, 1, "FAIL", "it is not used"),
        (people.deaf_to_rtol_but_not_to_atol, 1, "FAIL", "it uses atol alone"),
        (people.by_the_root_of_rtol, 1, "FAIL", "measured rtol^(0.5"),
        (people.by_the_root_of_rtol, 0.5, "PASS", "an error that goes with rtol^0.5"),
        (people.with_a_loose_atol, 1, "FAIL", "its errors stop falling at 2e-05"),
    ],
)
def test_an_error_goes_with_the_tolerance(solver, power, standing, says):
    found = only(compare.check(solver, tolerance=power))
    assert (found.claim, found.standing) == ("tolerance", standing)
    assert says in str(found)


@pytest.mark.parametrize(
    ("step", "order", "standing", "says"),
    [
        (people.GAUSS, 2, "PASS", "measured 2.00"),
        (people.GAUSS, 4, "FAIL", "measured 2.00"),
        (people.RADAU, 2, "PASS", "measured 2.00"),
        (people.timed, 4, "FAIL", "it is explicit, not stable there"),
    ],
)
def test_orders_are_reduced_on_a_stiff_equation(step, order, standing, says):
    """Hairer and Wanner, Solving Ordinary Differential Equations II, table IV.15.1: both are of order 2 there."""
    from compare.claims.candidate import Candidate
    from compare.methods.own.forms import form_of

    found = stiff(Candidate(step, form_of(step), "it"), order)
    assert found.standing == standing
    assert says in str(found)


def test_a_stiff_order_of_a_step_without_the_time_is_not_established():
    found = only(compare.check(people.rk4, stiff=1))
    assert (found.standing, found.causes) == ("NOT ESTABLISHED", ("a step (f, t, y, h) would decide it",))


def test_the_stiff_equation_has_the_solution_that_it_says():
    """By its equation: the derivative of cos t + (y0 - 1) e^(lam t) at some times."""
    problem = find_family("prothero-robinson").problem(lam=-3, y0=2)
    t, d = 0.75, 1e-5
    before, here, after = (float(problem.state(time)[0]) for time in (t - d, t, t + d))
    from reference.arithmetic.namespaces import NUMPY

    (rate,) = problem.derivative(NUMPY, t, [here], {"lam": -3.0})
    assert (after - before) / (2 * d) == pytest.approx(rate, abs=1e-9)
    assert problem.certified("state", t).routes["taylor"] >= 45
    with pytest.raises(ValueError, match=r"^lam is 1; a negative number is accepted\.$"):
        find_family("prothero-robinson").problem(lam=1)


@pytest.mark.parametrize(
    ("how", "accuracy", "standing", "says"),
    [
        ({"h": 0.01}, 1e-6, "PASS", "8 of 8 found"),
        ({"h": 0.01}, 1e-9, "FAIL", "8 of 8 found, largest error 2"),
        ({"h": 0.01, "twice": True}, 1e-3, "FAIL", "told more than once at t = 0.5348, 1.604"),
        ({"h": 0.01, "one_way": True}, 1e-3, "FAIL", "those of one direction are missed"),
        ({"h": 0.01, "with_start": True}, 1e-3, "FAIL", "the beginning of the span is told as an event"),
        ({"h": 1.2}, 1e-1, "FAIL", "signs are to be seen between them too"),
    ],
)
def test_events_are_found_once_and_in_time(how, accuracy, standing, says):
    found = only(compare.check_events(people.crossings(**how), accuracy))
    assert (found.claim, found.standing) == ("events", standing)
    assert says in str(found)


def test_two_events_within_a_step_are_missed_by_their_signs():
    """The cubic of scipy's issue 9228, moved a little so that no crossing is at a rational time."""
    cubic = Flow({"y": "3*(t - 8)**2 + 12*(t - 8) - 4"}, start={"y": "-120.1"}, event="y", name="cubic")
    found = only(compare.check_events(people.signs_at_the_ends_of_steps, problem=cubic))
    assert found.standing == "FAIL"
    assert found.measured.startswith("1 of 3 found")
    assert found.causes[0] == "missed at t = 5.994, 10"
    assert found.causes[1].startswith("two within a step leave its ends with the same sign")


@pytest.mark.parametrize(
    ("function", "standing", "says"),
    [
        (people.derivatives, "PASS", "derivatives by theta, omega, g, length, t0 to 1e-06: largest relative error"),
        (people.with_no_initial_time, "FAIL", "d/dt0 is zero: the solution is not followed by it"),
        (people.with_a_sign, "FAIL", "d/dg has the wrong sign"),
        (people.twice_the_length, "FAIL", "d/dlength is 2 times what it should be"),
        (people.exchanged, "FAIL", "what is said to be d/dg is d/dlength"),
        (people.transposed, "FAIL", "the matrix is transposed"),
    ],
)
def test_derivatives_are_held_against_proven_sensitivities(function, standing, says):
    found = only(compare.check_gradients(function))
    assert (found.claim, found.standing) == ("gradients", standing)
    assert says in str(found)


@pytest.mark.parametrize(
    ("claim", "says"),
    [
        (lambda: compare.check(people.rk4, dense=3), "both are accepted"),
        (lambda: compare.check(people.rk4, dense=3, interpolant=people.rk4), r"\(f, y, h, theta\) or"),
        (lambda: compare.check(people.rk4, estimate=3), "gives no error estimate"),
        (lambda: compare.check(people.rk4, estimate=-1), "estimate is -1; a positive number below 100 is accepted"),
        (lambda: compare.check(people.rk4, tolerance=1), "which takes none; an argument rtol is accepted"),
        (lambda: compare.check(people.adaptive, dense=3, interpolant=people.hermite), "that of a step"),
        (lambda: compare.check_events(people.crossings(h=0.1), 2), "accuracy is 2; a number from 1e-14 to 1"),
        (lambda: compare.check_events(people.rk4), r"\(f, event, t_span, y0\) is accepted"),
        (lambda: compare.check_events(lambda _f, _e, _s, _y: "no"), "what is no list of times"),
        (
            lambda: compare.check_events(people.crossings(h=0.1), problem=find_family("lorenz").problem()),
            "has no event of which crossings are proven",
        ),
        (lambda: compare.check_events(lambda f, _e, _s, _y: f.foo), "raised AttributeError: "),
        (lambda: compare.check_gradients(people.derivatives, 2), "accuracy is 2"),
        (lambda: compare.check_gradients(people.derivatives, t=0), "t is 0.0; a time other than the start"),
        (lambda: compare.check_gradients(lambda _y, p, _t: p["l"], t=1), "raised KeyError: 'l'"),
        (
            lambda: compare.check_gradients(lambda _y, _p, _t: [[1, 0], [0, 1]], t=1e4, seconds=0.2),
            "the derivatives at t = 10000 take more than 0.2 s to be proven; an earlier time",
        ),
        (lambda: compare.check(people.with_its_own_equation, stiff=2, problem=Pendulum(1)), "its equation built in"),
        (lambda: compare.check_gradients(lambda _y, _p, _t: {"gg": [1, 2]}), "derivative 'gg' is unknown, perhaps g"),
        (lambda: compare.check_gradients(lambda _y, _p, _t: [1, 2]), r"\(2, 2\), dy\(t\)/dy0, or a dict"),
    ],
)
def test_misuse_is_one_sentence(claim, says):
    with pytest.raises(ValueError, match=says) as caught:
        claim()
    assert "\n" not in str(caught.value)


def test_assertions_say_the_verdict():
    compare.assert_dense(people.rk4, 3, people.hermite)
    compare.assert_estimate(people.bogacki_shampine, 2)
    compare.assert_events(people.crossings(h=0.01), 1e-6, problem=Pendulum(1))
    with pytest.raises(AssertionError, match=r"^with_a_sign on Pendulum\(.*\): FAIL  derivatives by .*\.$"):
        compare.assert_gradients(people.with_a_sign)
    with pytest.raises(AssertionError, match="it is not used"):
        compare.assert_tolerance(people.deaf_to_rtol)
    with pytest.raises(AssertionError, match="NOT ESTABLISHED  order 1 on a stiff equation"):
        compare.assert_stiff_order(people.rk4, 1)


HERE = people.__file__


@pytest.mark.parametrize(
    ("words", "code", "claims"),
    [
        (f"{HERE}:rk4 --order 4 --dense 3 --interpolant {HERE}:hermite", 0, ["order", "dense"]),
        (f"{HERE}:derivatives --gradients 1e-6", 0, ["gradients"]),
        (f"{HERE}:adaptive --tolerance 1", 0, ["tolerance"]),
        (f"{HERE}:with_a_sign --gradients 1e-6", 1, ["gradients"]),
    ],
)
@pytest.mark.usefixtures("without_a_process")
def test_the_command_line_claims_them_too(capsys, words, code, claims):
    assert main(["check", *words.split(), "--format", "json"]) == code
    found = json.loads(capsys.readouterr().out)
    assert [one["claim"] for one in found["verdicts"]] == claims
    assert found["claims_hold"] is (code == 0)


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ("--order 4", "a function MODULE:STEP or --process COMMAND is accepted, one of both."),
        (f"{HERE}:rk4 --process cat", "a function MODULE:STEP or --process COMMAND is accepted, one of both."),
        (
            f"{HERE}:rk4 --events 1e-3 --order 4",
            "--events is claimed of what is no step; it is accepted without --order.",
        ),
        (f"{HERE}:rk4 --dense x", "--dense is 'x'; a positive number is accepted."),
    ],
)
def test_the_command_line_refuses_what_contradicts_itself(capsys, words, says):
    assert main(["check", *words.split()]) == 2
    assert capsys.readouterr().err == f"error: {says}\n"
