"""Marches with a controlled step: their steps are SciPy's, errors follow the tolerance, and none is lost silently."""

from __future__ import annotations

import math
import pickle
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import compare
from compare.controlled import controlled
from compare.march.adaptive import AdaptiveLane, AdaptiveMarch, estimate_order, is_pair, march_adaptive
from compare.march.autonomous import autonomous
from compare.march.controllers import CONTROLLERS, Controller, controllers
from compare.march.lanes import Lane
from compare.march.march import fits
from compare.march.precision import precision
from compare.measure.truth import Course
from compare.methods import METHODS, find
from compare.methods.kinds.one_step import Embedded, Tableau
from compare.methods.order.algebraic import Q, enclose, root
from compare.show import render
from compare.show.study import page
from compare.study import problems_of, study
from reference import Flow, Pendulum
from reference.arithmetic.namespaces import NUMPY
from reference.problems.families import find_family

FLOAT64 = precision("float64")
PAIRS = [method for method in METHODS if is_pair(method)]
(ELEMENTARY,) = controllers(["i"])
GAMMA = 2 - root(2)
WEIGHT = root(2) / 4
TR_BDF2 = Tableau(
    name="tr_bdf2", order=2, source="Hosea and Shampine 1996, Appl. Numer. Math. 20, 21",
    a=((), (GAMMA / 2, GAMMA / 2), (WEIGHT, WEIGHT, GAMMA / 2)),
    b=(WEIGHT, WEIGHT, GAMMA / 2),
    embedded=(Embedded(3, ((1 - WEIGHT) / 3, (3 * WEIGHT + 1) / 3, GAMMA / 6)),),
)  # fmt: skip
BLOW_UP = Flow({"y": "y**2"}, start={"y": 1}, name="blow_up")


def asked(
    problem: Any, end: Any, rtol: float, controller: Controller = ELEMENTARY, samples: int = 1, fmt: Any = FLOAT64
) -> AdaptiveLane:
    h = fmt.round(Fraction(end) / samples)
    lane = Lane(autonomous(problem), samples, h, tuple(range(1, samples + 1)))
    return AdaptiveLane(lane, controller, Fraction(rtol), Fraction(rtol))


def one_march(name: str, lane: AdaptiveLane, **options: Any) -> AdaptiveMarch:
    (found,) = march_adaptive(find(name), [lane], FLOAT64, **options)  # type: ignore[arg-type]
    return found


def problem_of(name: str) -> Any:
    (problem,) = problems_of(find_family(name), {})
    return find_family(name).comparison.forms[0][1].problem(problem)


@pytest.mark.parametrize("name", ["pendulum", "lorenz", "kepler", "driven-pendulum"])
@pytest.mark.parametrize(("pair", "method"), [("bs32", "RK23"), ("dopri5", "RK45"), ("dop853", "DOP853")])
def test_with_the_elementary_controller_the_steps_are_those_of_scipy(name: str, pair: str, method: str) -> None:
    """SciPy's DOP853 evaluates the slope after a rejected step too, and after the last one."""
    from scipy.integrate import solve_ivp

    problem = problem_of(name)
    parameters = problem.parameters_in(NUMPY)
    for rtol in (1e-3, 1e-6):
        found = one_march(pair, asked(problem, 10, rtol))
        theirs = solve_ivp(
            lambda t, y: problem.derivative(NUMPY, t, y, parameters),
            (0.0, 10.0),
            np.array(problem.start_in(NUMPY)),
            method=method,
            rtol=rtol,
            atol=rtol,
        )
        assert found.accepted == len(theirs.t) - 1
        assert found.evaluations == theirs.nfev - (found.rejected + 1 if pair == "dop853" else 0)
        states = [found.states[-1][autonomous(problem).state_names.index(one)] for one in problem.state_names]
        np.testing.assert_allclose(states, theirs.y[:, -1], rtol=0, atol=1e-10)


def plain_march(pair: Tableau, controller: Controller, rtol: float, end: float) -> tuple[int, int, float]:
    """Accepted and rejected steps and the last angle of a pendulum, in Python's floats, powers for logarithms."""
    a = [[float(enclose(entry)) for entry in row] for row in pair.matrix]
    b = [float(enclose(entry)) for entry in pair.b]
    other = [float(enclose(entry)) for entry in pair.embedded[0].b]
    beta, alpha, k = [*map(float, controller.beta)], [*map(float, controller.alpha)], estimate_order(pair)
    aim, t, y = 0.9**k, 0.0, np.array([1.0, 0.0])

    def rates(y: Any) -> Any:
        return np.array([y[1], -9.81 * math.sin(y[0])])

    def size(errors: Any, scale: Any) -> float:
        return math.sqrt(sum((e / s) ** 2 for e, s in zip(errors, scale, strict=True)) / len(errors))

    scale = rtol + rtol * np.abs(y)
    d0, d1 = size(y, scale), size(rates(y), scale)
    h0 = 0.01 * d0 / d1
    d2 = size(rates(y + h0 * rates(y)) - rates(y), scale) / h0
    h = min(100 * h0, (0.01 / max(d1, d2)) ** (1 / k))
    errors: list[float] = []
    sizes: list[float] = []
    rejected, after_rejection = 0, False
    while t < end:
        h = end - t if t + h > end else h
        slopes: list[Any] = []
        for row in a:
            slopes.append(rates(y + h * sum((w * s for w, s in zip(row, slopes, strict=False)), np.zeros(2))))
        new = y + h * sum(w * s for w, s in zip(b, slopes, strict=True))
        apart = h * sum((w - v) * s for w, v, s in zip(b, other, slopes, strict=True))
        error = size(apart, rtol + rtol * np.maximum(np.abs(y), np.abs(new)))
        elementary = 0.9 * error ** (-1 / k)
        if error > 1:
            h, rejected, after_rejection = h * max(0.2, elementary), rejected + 1, True
            continue
        sizes.append(h)
        known = [error, *(max(one, 1e-4) for one in errors[::-1])]
        errors.append(error)
        deep = 1 + (2 if beta[2] or alpha[1] else 1 if beta[1] or alpha[0] else 0)
        ratio = elementary
        if len(errors) >= deep:
            ratio = math.prod((aim / e) ** (w / k) for w, e in zip(beta, known, strict=False) if w)
            ratio *= math.prod((sizes[-1 - i] / sizes[-2 - i]) ** -w for i, w in enumerate(alpha) if w)
        ratio = min(10.0, max(0.2, ratio))
        t, y, h = t + h, new, h * (min(1.0, ratio) if after_rejection else ratio)
        after_rejection = False
    return len(sizes), rejected, float(y[0])


@pytest.mark.parametrize("controller", CONTROLLERS, ids=lambda one: one.name)
def test_every_controller_takes_the_steps_of_a_march_in_plain_python(controller: Controller) -> None:
    pair = find("dopri5")
    assert isinstance(pair, Tableau)
    for rtol in (1e-3, 1e-7):
        found = one_march("dopri5", asked(Pendulum(1.0), 10, rtol, controller))
        accepted, rejected, angle = plain_march(pair, controller, rtol, 10.0)
        assert (found.accepted, found.rejected) == (accepted, rejected)
        assert found.states[-1, 0] == pytest.approx(angle, abs=1e-9)


@pytest.mark.parametrize("controller", CONTROLLERS, ids=lambda one: one.name)
def test_every_controller_settles_at_the_error_that_it_aims_at(controller: Controller) -> None:
    """With err = C h^k the logarithms of step sizes obey a recursion whose roots lie within the unit circle."""
    b, (near, far) = controller.beta, controller.alpha
    free = [1, -(1 - near), -(near - far), -far]
    closed = [free[0], *(float(one + weight) for one, weight in zip(free[1:], b, strict=True))]
    assert max(abs(np.roots(closed))) < 1
    assert sum(b) > 0


ZEROS_AT_MINUS_ONE = {"pid": 2, "h211pi": 1, "h211b": 1, "h312b": 2, "h321": 1}
"""The order of the filter, which is the last digit of its name in Söderlind's paper."""
DIFFERENCES = {"i": 1, "pi": 1, "pid": 1, "h211pi": 1, "h211b": 1, "h312b": 1, "h321": 2}
"""The order of adaptivity, which is the second digit there."""


@pytest.mark.parametrize("name", DIFFERENCES)
def test_a_filter_has_the_orders_of_its_name(name: str) -> None:
    (controller,) = controllers([name])
    (first, second, third), (near, far) = controller.beta, controller.alpha
    rows = [(first, second, third), (2 * first, second, Q(0)), (2 * first, Q(0), Q(0))]
    at_minus_one = [sum(weight * (-1) ** i for i, weight in enumerate(row)) for row in rows]
    order = ZEROS_AT_MINUS_ONE.get(name, 0)
    if name in ZEROS_AT_MINUS_ONE:
        whole = at_minus_one if third else [first - second, first, Q(0)]
        assert not any(whole[:order])
        assert whole[order] != 0
    assert (1 + near + far == 0) == (DIFFERENCES[name] == 2)


@pytest.mark.parametrize("pair", PAIRS, ids=lambda one: one.name)
def test_every_pair_marches_to_about_its_tolerance(pair: Any) -> None:
    course = Course(Pendulum(1.0), 32, Fraction(5), FLOAT64)
    assert fits(pair, course.problem)
    (found,) = march_adaptive(pair, [AdaptiveLane(course.lane, ELEMENTARY, Q(1, 10**6), Q(1, 10**6))], FLOAT64)
    assert found.failure == ""
    assert float(np.max(course.position_error(course.errors(found.states)))) < 3e-3
    work = pair.attempt_work(0)
    if pair.iterations(1.0, 53) == 0:
        states = found.accepted * work.at_state or 1
        assert found.evaluations == (found.accepted + found.rejected) * work.evaluations + states + 1


@pytest.mark.parametrize(
    ("name", "rtol"),
    [
        ("bs32", (1e-6, 1e-8)),
        *((name, (1e-8, 1e-11)) for name in ("rkf45", "rkck", "dopri5", "tsit5")),
        ("dop853", (1e-9, 1e-14)),
    ],
)
def test_the_error_is_proportional_to_the_tolerance_to_the_order_over_that_of_the_estimate(
    name: str, rtol: tuple[float, float]
) -> None:
    """To the tolerance itself but for Fehlberg's pair, which goes on with the result of the lower order."""
    pair = find(name)
    cells = compare.error_vs_rtol(Pendulum(1.0), [name], ["pi"], rtol, t_end=5, precision="longdouble")
    loose, tight = (cell.max_error for cell in cells)
    slope = math.log(loose / tight) / math.log(rtol[0] / rtol[1])
    assert slope == pytest.approx(pair.order / estimate_order(pair), abs=0.05)  # type: ignore[arg-type]


@pytest.mark.parametrize("fmt", ["float32", "longdouble", "float128", "mp:160"])
def test_a_controlled_step_is_taken_in_every_format(fmt: str) -> None:
    (cell,) = compare.error_vs_rtol(Pendulum(1.0), ["dopri5"], ["pi"], [1e-4], t_end=2, precision=fmt)
    (double,) = compare.error_vs_rtol(Pendulum(1.0), ["dopri5"], ["pi"], [1e-4], t_end=2)
    assert (cell.accepted, cell.evaluations) == (double.accepted, double.evaluations)
    assert cell.max_error == pytest.approx(double.max_error, rel=0.02)


def test_samples_cut_no_step_and_are_as_true_as_the_march() -> None:
    few, many = (one_march("dop853", asked(Pendulum(1.0), 10, 1e-8, samples=count)) for count in (1, 128))
    assert (few.accepted, few.rejected, few.evaluations) == (many.accepted, many.rejected, many.evaluations)
    np.testing.assert_allclose(few.states[-1], many.states[-1], rtol=0, atol=1e-14)
    course = Course(Pendulum(1.0), 128, Fraction(10), FLOAT64)
    errors = course.position_error(course.errors(many.states))
    assert many.accepted < 128
    assert max(errors) < 10 * errors[-1]


def test_lanes_that_share_a_march_give_what_each_gives_alone() -> None:
    lanes = [asked(Pendulum(a), 10, r, c, 16) for a in (0.5, 2.0) for r in (1e-3, 1e-9) for c in CONTROLLERS]
    together = march_adaptive(find("tsit5"), lanes, FLOAT64)  # type: ignore[arg-type]
    for lane, one in zip(lanes, together, strict=True):
        (alone,) = march_adaptive(find("tsit5"), [lane], FLOAT64)  # type: ignore[arg-type]
        assert np.array_equal(one.states, alone.states)
        assert (one.accepted, one.rejected) == (alone.accepted, alone.rejected)


def test_an_implicit_pair_takes_long_steps_on_a_stiff_equation_and_counts_its_jacobians() -> None:
    problem = Flow({"y": "1000*(cos(t) - y)"}, start={"y": 0}, autonomous=False)
    lane = asked(problem, 2, 1e-5)
    (stiff,) = march_adaptive(TR_BDF2, [lane], FLOAT64)
    explicit = one_march("dopri5", lane)
    exact = (1e6 * math.cos(2) + 1e3 * math.sin(2)) / (1e6 + 1)
    assert stiff.states[-1, 0] == pytest.approx(exact, abs=1e-4)
    assert stiff.accepted < explicit.accepted / 3
    iterations = TR_BDF2.iterations(0.5, 17)
    attempts = stiff.accepted + stiff.rejected
    assert stiff.evaluations == attempts * 2 * iterations + stiff.accepted + 1
    assert stiff.jacobians == attempts * 2 * (iterations - 1)


def test_a_march_into_a_singularity_is_lost_and_says_where() -> None:
    found = one_march("dopri5", asked(BLOW_UP, 2, 1e-6, samples=4))
    assert found.failure.startswith("lost at t = 1: a step of ")
    assert np.isfinite(found.states[0, 0])
    assert np.all(np.isnan(found.states[2:]))


def test_a_march_of_too_many_steps_is_lost_and_says_so() -> None:
    found = one_march("dopri5", asked(Pendulum(1.0), 10, 1e-8), most=100)
    assert found.accepted + found.rejected == 100
    assert found.failure.endswith("100 attempts at a step have not been enough")


def test_a_march_without_a_slope_at_its_start_is_lost_there() -> None:
    found = one_march("dopri5", asked(Flow({"y": "1/y"}, start={"y": 0}), 1, 1e-6))
    assert found.failure == "lost at the start: the right-hand side is no number there"
    assert np.isnan(found.states).all()


def test_the_absolute_tolerances_go_with_the_relative_ones() -> None:
    found = controlled(["dopri5"], ["i"], [1e-6, 1e-3], [1e-9, 1e-4]).asked
    assert [(float(one.rtol), float(one.atol)) for one in found] == [(1e-3, 1e-4), (1e-6, 1e-9)]
    assert {float(one.atol) for one in controlled(["dopri5"], ["i"], [1e-6, 1e-3], 1e-9).asked} == {1e-9}


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ((["rk4"],), "rk4 has no embedded result to estimate an error by"),
        ((["dopri6"],), "method 'dopri6' is unknown"),
        (([],), "adaptive is empty"),
        ((["dopri5"], ["p"]), "controller 'p' is unknown, perhaps pi"),
        ((["dopri5"], []), "controllers is empty"),
        ((["dopri5"], ["i"], [1.0]), "rtol is 1.0; a number with 0 < rtol < 1"),
        ((["dopri5"], ["i"], [1e-3], 0.0), "atol is 0.0; a positive number"),
        ((["dopri5"], ["i"], [1e-3, 1e-4], [1e-3] * 3), "atol has 3 numbers for 2 of rtol"),
        ((["dopri5"], ["i"], [1e-3], None, 0), "max_attempts is 0"),
    ],
)
def test_what_is_asked_wrongly_of_a_controlled_step_is_named(arguments: tuple[Any, ...], says: str) -> None:
    with pytest.raises(ValueError, match=says):
        controlled(*arguments)


def test_all_stands_for_every_pair() -> None:
    assert controlled(["all"]).pairs == tuple(PAIRS)


def test_a_pair_that_fits_no_problem_is_refused() -> None:
    with pytest.raises(ValueError, match=r"rk4 has no embedded result"):
        march_adaptive(find("rk4"), [asked(Pendulum(1.0), 1, 1e-3)], FLOAT64)  # type: ignore[arg-type]


def test_fixed_and_controlled_steps_stand_in_one_table() -> None:
    found = study(
        "pendulum", methods=["rk4"], n=[128, 1024], adaptive=["dopri5"], controllers=["pi"], rtol=[1e-4, 1e-8], t_end=5
    )
    assert found.scores == ("error", "work", "drift")
    assert found.parameters["adaptive"] == ["dormand_prince54"]
    text = render.render(page(found), "text", 100)
    rows = {line.partition("  ")[0]: line.split() for line in text.splitlines()}
    assert {"rk4", "dormand_prince54, pi"} <= rows.keys()
    title = next(line for line in text.splitlines() if line.startswith("Evaluations, theta0 = 1.0 rad"))
    assert "the least of those measured whose largest |theta - exact|, in rad, is below" in title
    loose, tight = found.adaptive or ()
    assert f"{loose.accepted}+{loose.rejected}" in text
    assert loose.max_error > tight.max_error > 0
    assert (loose.name, loose.theta0) == ("dormand_prince54, pi", 1.0)


def test_a_lost_march_is_told_in_a_table_of_its_own() -> None:
    found = study("pendulum", methods=(), adaptive=["bs32"], controllers=["i"], rtol=[1e-3, 1e-9], max_attempts=500)
    text = render.render(page(found), "text", 100)
    assert "Lost marches, theta0 = 1.0 rad" in text
    assert "500 attempts at a step have not been enough" in text
    assert found.error_vs_n == ()


def test_tolerances_without_a_pair_are_refused() -> None:
    with pytest.raises(ValueError, match="rtol is of pairs with a controlled step; adaptive says which"):
        study("pendulum", rtol=[1e-3])


def test_a_problem_with_the_time_in_its_state_goes_to_another_process() -> None:
    problem = autonomous(Flow({"y": "cos(t) - y"}, start={"y": 0}, autonomous=False))
    again = pickle.loads(pickle.dumps(problem))  # noqa: S301 - made here
    assert again.state_names == problem.state_names
