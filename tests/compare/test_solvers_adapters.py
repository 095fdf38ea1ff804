"""How packages that may not be installed are called, held against stand-ins that answer the same calls."""

from __future__ import annotations

import math
import sys
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from compare.solvers import numbalsoda
from compare.solvers.catalogue import select
from compare.solvers.events import exact_events
from compare.solvers.numbalsoda import SOURCE, Term
from compare.solvers.score import score_events, score_solver
from compare.solvers.study import questions
from reference import Pendulum
from reference.arithmetic.namespaces import NUMPY, TORCH
from reference.problems.families import find_family

PENDULUM = Pendulum(1.0)
FAKES = Path(__file__).parent / "fakes"
NAMES = [path.stem for path in FAKES.iterdir() if path.suffix == ".py" or (path / "__init__.py").exists()]


@pytest.fixture
def fakes(monkeypatch):
    """The stand-ins in place of the packages, whether those are installed or not."""
    for name in [module for module in sys.modules if module.split(".")[0] in NAMES]:
        monkeypatch.delitem(sys.modules, name)
    numbalsoda._compiled.cache_clear()
    vars(TORCH).clear()
    monkeypatch.syspath_prepend(FAKES)
    yield
    numbalsoda._compiled.cache_clear()
    vars(TORCH).clear()
    for name in NAMES:
        sys.modules.pop(name, None)


def asked(name, rtol, t_end=4.0, limit=200_000, problem=PENDULUM):
    (solver,) = select([name])
    return solver, list(questions(problem, t_end, rtol, limit))


@pytest.mark.usefixtures("fakes")
@pytest.mark.parametrize(
    ("name", "rtol", "used", "error", "evaluations"),
    [
        ("extensisq.BS5", 1e-5, 1e-5, 1e-3, None),
        ("extensisq.BS5", 1e-9, 1e-7, 1e-5, None),
        ("desolver.RK45", 1e-6, 1e-6, 1e-8, 128 * 8 * 4),
        ("pyhamsys.Verlet", 1e-4, 4 / 128 / 10, 1e-4, 128 * 10 * 2),
        ("rebound.IAS15", 1e-6, 1e-6, 1e-5, 1 + 128 * 32),
        ("rebound.IAS15_global", 1e-6, 1e-6, 1e-6, 1 + 128 * 64),
        ("numbalsoda.lsoda", 1e-6, 1e-6, 1e-8, 128 * 8 * 4),
        ("numbalsoda.dop853", 1e-6, 1e-6, 1e-8, 128 * 8 * 4),
        ("rebound.BS", 1e-6, 1e-6, 1e-9, 128 * 16 * 4),
        ("sksundae.CVODE_Adams", 1e-6, 1e-6, 1e-8, 128 * 8 * 4),
        ("CVODE_BDF", 1e-6, 1e-6, 1e-8, 128 * 8 * 4),
        ("torchdiffeq.dopri5", 1e-6, 1e-6, 1e-8, 128 * 8 * 4),
        ("torchode.Tsit5", 1e-6, 1e-6, 1e-8, 128 * 8 * 4),
        ("gala.DOPRI853", 1e-6, 1e-6, 1e-8, 128 * 8 * 4),
        ("gala.Leapfrog", 1e-4, 4 / 128 / 10, 1e-4, 128 * 10),
    ],
)
def test_a_package_is_called_as_it_wants_to_be_and_its_evaluations_are_counted(name, rtol, used, error, evaluations):
    solver, series = asked(name, [rtol])
    (cell,) = score_solver(solver, series)
    assert cell.failure == ""
    assert cell.used == pytest.approx(used, rel=1e-12)
    assert 0 < cell.max_error < error
    assert evaluations is None or cell.evaluations == evaluations


@pytest.mark.usefixtures("fakes")
@pytest.mark.parametrize(
    ("name", "expected", "error"),
    [
        ("extensisq.BS5", 3, 1e-4),
        ("desolver.RK45", 3, 1e-5),
        ("numbalsoda.dop853", 1, 1e-5),
        ("sksundae.CVODE_BDF", 3, 1e-5),
        ("torchdiffeq.dopri8", 1, 1e-6),
    ],
)
def test_a_package_is_asked_for_events_by_its_own_event_function(name, expected, error):
    solver, (question,) = asked(name, [1e-7])
    found = score_events(solver, question, exact_events(PENDULUM, question.end)[:3])
    assert (found.failure, found.expected, found.matched) == ("", expected, expected)
    assert 0 < found.max_error < error


@pytest.mark.usefixtures("fakes")
@pytest.mark.parametrize(
    ("name", "rtol", "says"),
    [
        ("desolver.RK108", 1e-3, "Integration has not been run"),
        ("pyhamsys.BM4", 1e-3, "ValueError: Solver 'BM4' not recognized."),
        ("sksundae.CVODE_Adams", 1e-16, "Too much accuracy requested."),
        ("torchode.Dopri5", 1e-13, "REACHED_DT_MIN"),
        ("numbalsoda.lsoda", 1e-13, "success is False; it printed: lsoda -- too much accuracy requested"),
    ],
)
def test_a_package_that_fails_is_reported_in_its_own_words(name, rtol, says):
    solver, series = asked(name, [rtol])
    (cell,) = score_solver(solver, series)
    assert (cell.failure, cell.stopped) == (says, False)
    assert np.isnan(cell.max_error)
    assert cell.evaluations is None


@pytest.mark.usefixtures("fakes")
@pytest.mark.parametrize(
    ("problem", "name", "answers"),
    [
        ("lorenz", "rebound.BS", True),
        ("lorenz", "sksundae.CVODE_BDF", True),
        ("lorenz", "torchode.Dopri5", True),
        ("lorenz", "rebound.IAS15", False),
        ("lorenz", "pyhamsys.Verlet", False),
        ("lorenz", "gala.DOPRI853", False),
        ("arenstorf", "gala.DOPRI853", True),
        ("arenstorf", "gala.Leapfrog", False),
        ("kepler", "gala.Leapfrog", True),
        ("double-pendulum", "pyhamsys.Verlet", False),
        ("pleiades", "rebound.IAS15", True),
        ("double-pendulum", "rebound.IAS15", False),
    ],
)
def test_a_problem_is_asked_of_the_solvers_that_it_suits(problem, name, answers):
    solver, series = asked(name, [1e-4], t_end=0.25, problem=find_family(problem).problem())
    (cell,) = score_solver(solver, series)
    assert cell.suited == answers
    assert cell.failure == "" if answers else cell.failure.startswith(f"it solves {solver.accepts}")


@pytest.mark.usefixtures("fakes")
@pytest.mark.parametrize("name", ["rebound.IAS15", "rebound.BS"])
def test_compiled_code_that_calls_back_is_stopped_at_the_limit(name):
    solver, series = asked(name, [1e-6, 1e-8], limit=1000)
    first, second = score_solver(solver, series)
    assert first.failure == "stopped after 1000 evaluations of the right-hand side"
    assert (first.stopped, second.stopped) == (True, True)
    assert second.failure == "not asked: it was stopped at rtol 1e-06"


@pytest.mark.usefixtures("fakes")
def test_a_splitting_is_not_asked_for_steps_whose_square_takes_too_long():
    solver, series = asked("pyhamsys.Verlet", [1e-12])
    (cell,) = score_solver(solver, series)
    assert cell.stopped
    assert cell.failure.startswith("not asked for 1252")


@pytest.mark.usefixtures("fakes")
def test_a_step_is_not_taken_more_often_than_evaluations_are_granted():
    solver, series = asked("gala.Leapfrog", [1e-12])
    (cell,) = score_solver(solver, series)
    assert cell.stopped
    assert cell.failure.startswith("not asked for 1252")


def test_the_source_of_an_equation_computes_what_the_equation_does():
    random = np.random.default_rng(7)
    parameters = {name: Term(f"p[{i}]") for i, name in enumerate(PENDULUM.parameters)}
    rates = PENDULUM.derivative(SOURCE, 0, [Term("y[0]"), Term("y[1]")], parameters)
    code = compile(f"({', '.join(map(str, rates))})", "rates", "eval")
    for _ in range(20):
        y, p = random.uniform(-3, 3, 2), random.uniform(0.5, 20, 2)
        found = eval(code, {"math": math, "y": y, "p": p})  # noqa: S307 - it was written two lines above
        assert found == pytest.approx(
            PENDULUM.derivative(NUMPY, 0, y, dict(zip(parameters, p, strict=True))), rel=1e-15
        )


def test_source_keeps_the_order_of_operations():
    def formula(m, x, y):
        return (-x + 2) * (3 - y) / (1 / x - y) + m.power(m.exp(x) + m.cosh(y) * m.pi(), Fraction(3, 2)) - x**2 * 5

    text = str(formula(SOURCE, Term("x"), Term("y")) - SOURCE.number(Fraction(1, 4)))
    for x, y in ((1.3, 0.4), (0.2, -0.7), (2.5, 3.0)):
        found = eval(text, {"math": math, "x": x, "y": y})  # noqa: S307 - as above
        assert found == pytest.approx(formula(NUMPY, x, y) - 0.25, rel=1e-14)
