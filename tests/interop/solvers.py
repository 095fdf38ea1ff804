"""Solvers of other packages as they are, on problems of every kind; ``make interop`` names this file."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from compare.solvers import diffrax, numbalsoda, torchdiffeq
from compare.solvers.catalogue import SOLVERS
from compare.solvers.events import exact_events
from compare.solvers.score import score_events, score_solver
from compare.solvers.solver import Counted, Question, Solver
from compare.solvers.study import questions
from compare.study import problems_of
from reference.arithmetic.namespaces import TORCH
from reference.problems.families import FAMILIES, find_family

if TYPE_CHECKING:
    from reference.family import Family

BUILT = frozenset({"numbalsoda"})
"""Packages without a wheel, which 'make interop' does not build."""
INSTALLED = tuple(solver for solver in SOLVERS if solver.package not in BUILT)
PROBLEMS = {"pendulum": "2", "lorenz": "2", "kepler": "2", "driven-pendulum": "3", "pleiades": "0.5"}
"""One that splits and has events, one that does neither, one of two dimensions, one of the time, one of bodies."""
LOOSE, TIGHT = 1e-4, 1e-7
WITHIN = 3e4
"""Times the tolerance: the error of Lorenz' motion grows by so much more than that of a step."""
OF_ORDER_ONE = frozenset({("gala.Ruth4", "driven-pendulum"), ("gala.RK5", "driven-pendulum")})
"""Their stages are all at the time of the end of a step."""
STEPS_OF_NO_END = ("rebound.IAS15", "pendulum")
"""Its acceleration passes through zero in one dimension, where its criterion finds no step small enough."""


def asked(name: str, end: str, *rtol: float) -> list[Question]:
    return list(questions(find_family(name).problem(), Fraction(end), rtol, 200_000))


@pytest.mark.parametrize("solver", INSTALLED, ids=lambda solver: solver.name)
def test_a_solver_is_here_in_a_version(solver: Solver) -> None:
    assert solver.version not in {None, "unknown"}


@pytest.mark.filterwarnings("default")
@pytest.mark.parametrize("name", PROBLEMS)
@pytest.mark.parametrize("solver", INSTALLED, ids=lambda solver: solver.name)
def test_a_solver_follows_its_tolerance_on_every_kind_of_problem(solver: Solver, name: str) -> None:
    cells = score_solver(solver, asked(name, PROBLEMS[name], LOOSE, TIGHT))
    if not cells[0].suited:
        assert cells[0].failure.startswith(f"it solves {solver.accepts}")
        return
    if (solver.name, name) == STEPS_OF_NO_END:
        assert cells[1].stopped
        return
    loose, tight = cells
    assert (loose.failure, tight.failure) == ("", "")
    assert loose.evaluations is not None
    assert 0 < loose.evaluations <= (tight.evaluations or 0)
    if (solver.name, name) in OF_ORDER_ONE:
        assert tight.max_error > 1e-3
        return
    assert tight.max_error < WITHIN * TIGHT
    assert tight.max_error < max(loose.max_error / 5, 1e-12)


@pytest.mark.filterwarnings("default")
@pytest.mark.parametrize("solver", [s for s in INSTALLED if s.events is not None], ids=lambda solver: solver.name)
def test_events_are_those_that_are_proven(solver: Solver) -> None:
    (question,) = asked("pendulum", "4", TIGHT)
    found = score_events(solver, question, exact_events(question.problem, question.end))
    assert found is not None
    assert (found.failure, found.matched, found.spurious) == ("", found.expected, 0)
    assert found.max_error < 1e-4


def _rates(question: Question, state: np.ndarray, t: float) -> dict[str, Any]:
    """The rates of change in each form of the equation."""
    import jax
    import torch

    in_torch = torchdiffeq.field_of(Counted(question, TORCH))
    tensor = torch.as_tensor(state)
    with jax.enable_x64(True):
        in_jax = np.asarray(diffrax.field_of(question.problem, None)(t, jax.numpy.asarray(state)))
    space: dict[str, Any] = {"math": math}
    body, _ = numbalsoda._source(question)
    exec(f"def rates(t, u, out, data):\n    {body}", space)  # noqa: S102 - it was written one line above
    in_source = np.empty(len(state))
    space["rates"](t, state, in_source, numbalsoda._data(question))
    return {
        "JAX": in_jax,
        "PyTorch": in_torch(torch.tensor(t), tensor).numpy(),
        "PyTorch, several": in_torch(torch.tensor([t]), tensor[None]).numpy()[0],
        "source": in_source,
    }


@pytest.mark.parametrize("family", FAMILIES, ids=lambda family: family.name)
def test_every_equation_is_the_same_in_every_arithmetic(family: Family) -> None:
    problem = problems_of(family, {})[0]
    question = next(questions(problem, 1, [LOOSE], 1000))
    state = problem.state([Fraction(3, 8)])[0]
    expected = np.array(Counted(question).derivative(0.375, state), dtype=float)
    assert np.isfinite(expected).all()
    for form, rates in _rates(question, state, 0.375).items():
        assert np.abs(rates - expected).max() <= 1e-15 * np.abs(expected).max(), form
