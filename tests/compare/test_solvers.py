"""Solvers as people call them: what is reported of them, whatever they do."""

from __future__ import annotations

import math
import os
import sys
import warnings
from dataclasses import replace
from fractions import Fraction

import heyoka as hy
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from compare.solvers import study as study_module
from compare.solvers.catalogue import SOLVERS, select
from compare.solvers.events import exact_events
from compare.solvers.score import heard, score_events, score_solver
from compare.solvers.solver import Answer, Solver
from compare.solvers.study import questions, study
from reference import Pendulum
from reference.command.executors import processes

PENDULUM = Pendulum(1.0)
LIMIT = 20_000


def question(rtol=1e-6, t_end=4.0, limit=LIMIT):
    return next(questions(PENDULUM, t_end, [rtol], limit))


def made(run, **options):
    """A solver of ours that does what ``run`` does with a question."""
    return Solver("made.solver", "heyoka", "run()", lambda q: lambda: run(q), tolerance="nothing", **options)


def scored(solver, *rtol, **options):
    return score_solver(solver, [question(value, **options) for value in rtol or (1e-6,)])


def truth_and(offset):
    return lambda q: Answer(q.problem.state([Fraction(float(t)) for t in q.times]) + offset, 7, q.rtol)


def test_an_error_is_the_distance_from_the_proven_state_at_the_times_asked_for():
    offset = np.zeros((129, 2))
    offset[40, 0], offset[-1, 0], offset[17, 1] = -3e-9, 1e-9, 5e-8
    (cell,) = scored(made(truth_and(offset)))
    assert cell.max_error == pytest.approx(3e-9, rel=1e-6)
    assert cell.end_error == pytest.approx(1e-9, rel=1e-6)
    assert cell.velocity_error == pytest.approx(5e-8, rel=1e-6)
    assert (cell.evaluations, cell.used, cell.failure) == (7, 1e-6, "")


def test_a_correctly_rounded_answer_has_an_error_below_its_rounding_and_not_zero():
    (cell,) = scored(made(truth_and(0.0)))
    assert 1e-20 < cell.max_error <= 2.0**-54


@pytest.mark.parametrize("name", [solver.name for solver in SOLVERS if solver.package in {"scipy", "heyoka"}])
def test_every_solver_of_scipy_and_heyoka_follows_its_tolerance(name):
    (solver,) = select([name])
    loose, tight = scored(solver, 1e-4, 1e-7)
    assert (loose.failure, tight.failure) == ("", "")
    assert 0 < tight.max_error < min(loose.max_error / 50, 2e-5)
    assert loose.evaluations < tight.evaluations
    assert loose.seconds > 0


def test_evaluations_are_counted_where_they_happen():
    calls = []

    def field(_t, y):
        calls.append(1)
        return y[1], -9.81 * np.sin(y[0])

    for method in ("RK45", "Radau"):
        calls.clear()
        options = {"method": method, "t_eval": question().times, "rtol": 1e-6, "atol": 1e-6}
        found = solve_ivp(field, (0.0, 4.0), [1.0, 0.0], **options)
        (cell,) = scored(select([method])[0])
        assert cell.evaluations == len(calls)
    assert found.nfev < len(calls)  # SciPy leaves those out by which it differentiates


def test_what_heyoka_takes_is_its_steps_times_its_order():
    theta, omega = hy.make_vars("theta", "omega")
    equations = [(theta, omega), (omega, -9.81 * hy.sin(theta))]
    integrator = hy.taylor_adaptive(equations, [1.0, 0.0], tol=1e-9)
    steps = integrator.propagate_grid(question().times)[3]
    (cell,) = scored(select(["taylor"])[0], 1e-9)
    assert (cell.evaluations, cell.used) == (steps * integrator.order, 1e-9)


@pytest.mark.parametrize("method", ["RK45", "LSODA"])
def test_a_tolerance_that_scipy_raises_is_reported_as_the_one_it_used(method):
    kept, raised = scored(select([method])[0], 1e-8, 1e-16)
    assert (kept.used, kept.said) == (1e-8, "")
    assert raised.used == 100 * np.finfo(float).eps
    assert "`rtol` is too small" in raised.said


def test_a_solver_that_refuses_a_tolerance_is_reported_in_its_own_words_and_the_others_go_on():
    found = study(solvers=["odeint", "taylor"], rtol=[1e-16, 1e-6], t_end=2.0)
    refused = [cell for cell in found.error_vs_rtol if cell.failure]
    assert [(cell.solver, cell.rtol) for cell in refused] == [("scipy.odeint", 1e-16)]
    assert refused[0].failure.startswith("Illegal input detected")
    assert math.isnan(refused[0].max_error)
    assert not refused[0].stopped
    assert len(found.error_vs_rtol) == 4


def _exits(_question):
    raise SystemError("the\n   library is  gone")


def _prints(_question):
    sys.stdout.write("to Python's stdout\n")
    sys.stderr.write("to Python's stderr\n")
    os.write(1, b"to the stdout of compiled code\n")
    raise ArithmeticError("no convergence")


@pytest.mark.parametrize(
    ("run", "says"),
    [
        (_exits, "SystemError: the library is gone"),
        (lambda _: 1 / 0, "ZeroDivisionError: division by zero"),
        (lambda q: Answer(np.zeros((3, 2)), 1, q.rtol), "it returned states of shape (3, 2)"),
        (lambda q: Answer(np.full((129, 2), math.nan), 1, q.rtol), "it returned states that are not finite"),
        (_prints, "ArithmeticError: no convergence; it printed: to the stdout of compiled code"),
    ],
)
def test_a_failure_of_any_kind_is_an_answer(run, says, capfd):
    (cell,) = scored(made(run))
    assert cell.failure.startswith(says)
    assert math.isnan(cell.max_error)
    assert math.isnan(cell.used)
    assert (cell.evaluations, cell.seconds, cell.stopped) == (None, None, False)
    assert capfd.readouterr() == ("", "")


def test_an_interrupt_is_not_a_failure_of_the_solver():
    def interrupted(_question):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        scored(made(interrupted))


def test_a_message_is_one_line_of_bounded_length():
    def long(_question):
        raise ValueError("word " * 1000)

    (cell,) = scored(made(long))
    assert len(cell.failure) <= 160
    assert cell.failure.endswith("...")


def test_warnings_are_kept_once_each_and_those_for_developers_are_not():
    def warned():
        for _ in range(3):
            warnings.warn("the step is small", RuntimeWarning, stacklevel=1)
        warnings.warn("use another name", DeprecationWarning, stacklevel=1)
        return 5

    found = heard(warned)
    assert (found.value, found.failure, found.said) == (5, "", ("the step is small",))


def test_a_solver_is_stopped_when_its_evaluations_are_used_up_and_not_asked_for_more():
    cells = scored(select(["RK23"])[0], 1e-4, 1e-9, 1e-12, limit=2000)
    assert [cell.stopped for cell in cells] == [False, True, True]
    assert cells[1].failure == "stopped after 2000 evaluations of the right-hand side"
    assert cells[2].failure == "not asked: it was stopped at rtol 1e-09"


def test_a_solver_is_not_asked_what_it_cannot_solve():
    (cell,) = scored(made(truth_and(0.0), accepts="linear problems", solves=lambda _: False))
    assert not cell.suited
    assert cell.failure == "it solves linear problems; pendulum is none of them"


def test_a_missing_package_is_listed_with_its_install_line(monkeypatch):
    absent = replace(select(["RK45"])[0], name="absent.RK45", package="no_such_package_anywhere")
    monkeypatch.setattr(study_module, "select", lambda _names: (absent, *select(["taylor"])))
    found = study(solvers=["any"], rtol=[1e-6], t_end=1.0)
    assert [(entry.solver, entry.version is None) for entry in found.solvers] == [
        ("absent.RK45", True),
        ("heyoka.taylor", False),
    ]
    assert found.solvers[0].install == "pip install no_such_package_anywhere"
    assert [cell.solver for cell in found.error_vs_rtol] == ["heyoka.taylor"]


def test_a_package_that_cannot_be_imported_is_reported_in_its_own_words(tmp_path, monkeypatch):
    (tmp_path / "brokenpackage.py").write_text("raise ImportError('libfortran.so.5 is not here')\n")
    monkeypatch.syspath_prepend(tmp_path)

    def prepare(_question):
        import brokenpackage

        return brokenpackage.solve

    broken = Solver("broken.solver", "brokenpackage", "solve()", prepare, tolerance="nothing")
    assert broken.version == "unknown"
    (cell,) = scored(broken)
    assert cell.failure == "ImportError: libfortran.so.5 is not here"


CROSSINGS = exact_events(PENDULUM, 10.0)


@pytest.mark.parametrize("name", ["RK45", "DOP853", "taylor"])
def test_events_are_held_against_the_proven_ones(name):
    (found,) = (score_events(solver, question(1e-9, 10.0), CROSSINGS) for solver in select([name]))
    assert (found.expected, found.matched, found.spurious, found.failure) == (9, 9, 0, "")
    assert 0 < found.max_error < 1e-7


def events_of(times, **options):
    solver = made(truth_and(0.0), events=lambda _: times, **options)
    return score_events(solver, question(t_end=10.0), CROSSINGS)


def test_other_processes_find_the_same_events_in_the_same_order(monkeypatch):
    monkeypatch.setattr("compare.solvers.score.WORTH_PROCESSES", 0.0)
    options = {"solvers": ["RK23", "taylor", "odeint"], "rtol": [1e-3, 1e-6], "t_end": 4.0, "theta0": [1.0, 2.0]}
    alone = study(**options)
    with processes(2) as executor:
        assert study(**options, executor=executor).events == alone.events
    assert [(event.solver, event.theta0, event.rtol) for event in alone.events] == [
        (solver, theta0, rtol)
        for solver in ("scipy.RK23", "heyoka.taylor")
        for theta0 in (1.0, 2.0)
        for rtol in (1e-3, 1e-6)
    ]


def test_where_no_event_happens_none_is_asked_for():
    found = study(solvers=["RK45"], rtol=[1e-3], t_end=0.25)
    assert found.scored
    assert found.events == ()


def test_events_are_not_asked_of_a_solver_that_gave_no_states():
    found = study(solvers=["RK23"], rtol=[1e-3, 1e-9], t_end=4.0, max_evaluations=1000)
    assert [bool(cell.failure) for cell in found.error_vs_rtol] == [False, True]
    assert [event.rtol for event in found.events] == [1e-3]


def test_a_call_is_repeated_three_times_and_a_long_one_is_not(monkeypatch):
    for passed, made_calls in ((0.0, 3), (0.06, 2), (0.5, 1)):
        clock, calls = iter(range(100)), []
        monkeypatch.setattr(
            "compare.solvers.score.time.perf_counter", lambda clock=clock, passed=passed: next(clock) * passed
        )
        scored(made(lambda q, calls=calls: (calls.append(1), truth_and(0.0)(q))[1]))
        assert len(calls) == made_calls


def test_missed_doubled_and_invented_events_are_told_apart():
    exact = CROSSINGS[:, 0]
    found = events_of([exact[0] + 1e-6, exact[1], exact[1] - 3e-9, *exact[3:7], exact[7] + 0.6, exact[8]])
    assert (found.expected, found.matched, found.spurious) == (9, 7, 2)
    assert found.max_error == pytest.approx(1e-6, rel=1e-6)


def test_no_events_where_there_are_some_is_not_an_error_of_zero():
    found = events_of([])
    assert (found.matched, found.spurious) == (0, 0)
    assert math.isnan(found.max_error)


def test_a_solver_that_stops_at_the_first_event_is_asked_for_no_other():
    found = events_of([CROSSINGS[0, 0] + 2e-8], first_only=True)
    assert (found.expected, found.matched, found.spurious, found.first_only) == (1, 1, 0, True)
    assert found.max_error == pytest.approx(2e-8, rel=1e-6)


def test_an_error_of_an_event_is_taken_beyond_the_double_it_is_held_against():
    nearest = events_of(list(CROSSINGS[:, 0]))
    assert 1e-20 < nearest.max_error < 2.0**-50


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"rtol": [0.0]}, "rtol is 0"),
        ({"rtol": [1.0]}, "rtol is 1.0; a number with 0 < rtol < 1"),
        ({"rtol": [math.nan]}, "rtol is nan"),
        ({"rtol": []}, "rtol is empty"),
        ({"theta0": [4.0]}, "theta0 is 4.0"),
        ({"theta0": [1.0, 1.0]}, "one amplitude twice"),
        ({"t_end": 0}, "t_end is 0"),
        ({"t_end": "1e400"}, "t_end is"),
        ({"max_evaluations": 0}, "max_evaluations is 0"),
        ({"solvers": ["RK46"]}, "solver 'RK46' is unknown, perhaps RK45"),
        ({"solvers": ["numpy"]}, "accepted are scipy, heyoka"),
        ({"solvers": []}, "solvers is empty"),
    ],
)
def test_a_mistake_is_named(options, says):
    with pytest.raises(ValueError, match=says):
        study(**{"solvers": ["taylor"], "rtol": [1e-3], **options})


def test_a_package_stands_for_its_solvers_and_a_name_counts_once():
    assert [solver.name for solver in select(["odeint", "scipy", "scipy.RK23"])].count("scipy.odeint") == 1
    assert len(select(["scipy"])) == 7
    assert len({name for solver in SOLVERS for name in (solver.name, *solver.aliases)}) == sum(
        1 + len(solver.aliases) for solver in SOLVERS
    )
