"""torchdiffeq: Runge-Kutta methods in PyTorch."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from compare.solvers.solver import RMS, Answer, Counted, Question, Solver
from reference.arithmetic.namespaces import TORCH

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

__all__ = ["SOLVERS", "field_of"]

METHODS = ("dopri5", "dopri8")


def field_of(counted: Counted) -> Callable[[Any, Any], Any]:
    """dy/dt in PyTorch, of a state whose last axis has the components."""
    import torch

    def field(t: Any, y: Any) -> Any:
        components = y.unbind(-1)
        none = torch.zeros_like(components[0])
        return torch.stack([none + rate for rate in counted.derivative(t, components)], dim=-1)

    return field


def _prepare(question: Question, method: str) -> Callable[[], Answer]:
    import torch
    from torchdiffeq import odeint

    def run() -> Answer:
        counted = Counted(question, TORCH)
        start, times = torch.as_tensor(question.start), torch.as_tensor(question.times)
        states = odeint(field_of(counted), start, times, method=method, rtol=question.rtol, atol=question.rtol)
        return Answer(states.numpy(), counted.evaluations, question.rtol)

    return run


def _events(question: Question, method: str) -> Sequence[float]:
    import torch
    from torchdiffeq import odeint_event

    def event(_t: Any, y: Any) -> Any:
        return question.happens(TORCH, y)

    time, _ = odeint_event(
        field_of(Counted(question, TORCH)),
        torch.as_tensor(question.start),
        torch.as_tensor(question.times[0]),
        event_fn=event,
        method=method,
        rtol=question.rtol,
        atol=question.rtol,
    )
    return [float(time)]


def _solver(method: str) -> Solver:
    return Solver(
        name=f"torchdiffeq.{method}",
        package="torchdiffeq",
        call=f"odeint(f, y0, times, method='{method}', rtol=rtol, atol=rtol); "
        "its events by odeint_event(..., event_fn=...)",
        prepare=partial(_prepare, method=method),
        events=partial(_events, method=method),
        first_only=True,
        tolerance=RMS,
    )


SOLVERS = tuple(map(_solver, METHODS))
