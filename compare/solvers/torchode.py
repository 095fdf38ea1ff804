"""torchode: Runge-Kutta methods in PyTorch, for many problems at once, of which one is asked here."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from compare.solvers.solver import RMS, Answer, Counted, Question, Solver, SolverError
from compare.solvers.torchdiffeq import field_of
from reference.arithmetic.namespaces import TORCH

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["SOLVERS"]

METHODS = ("Dopri5", "Tsit5")


def _prepare(question: Question, method: str) -> Callable[[], Answer]:
    import torch
    import torchode

    start, times = torch.as_tensor(question.start)[None], torch.as_tensor(question.times)[None]

    def run() -> Answer:
        counted = Counted(question, TORCH)
        term = torchode.ODETerm(field_of(counted))
        step = getattr(torchode, method)(term=term)
        controller = torchode.IntegralController(atol=question.rtol, rtol=question.rtol, term=term)
        solver = torchode.AutoDiffAdjoint(step, controller, max_steps=question.limit)
        found = solver.solve(torchode.InitialValueProblem(y0=start, t_eval=times))
        status = torchode.Status(int(found.status[0]))
        if status is not torchode.Status.SUCCESS:
            raise SolverError(status.name)
        return Answer(found.ys[0].numpy(), counted.evaluations, question.rtol)

    return run


def _solver(method: str) -> Solver:
    return Solver(
        name=f"torchode.{method}",
        package="torchode",
        call=f"AutoDiffAdjoint({method}(f), IntegralController(atol=rtol, rtol=rtol, term=f))"
        ".solve(InitialValueProblem(y0, t_eval=times))",
        prepare=partial(_prepare, method=method),
        tolerance=f"{RMS}; rounded to float32",
    )


SOLVERS = tuple(map(_solver, METHODS))
