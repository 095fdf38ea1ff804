"""desolver: Runge-Kutta methods, explicit and implicit, behind a `solve_ivp` of its own."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.solvers.solver import Answer, Counted, Question, Solver, SolverError
from reference.arithmetic.namespaces import NUMPY

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

__all__ = ["SOLVERS"]

METHODS = ("RK45", "RK8713M", "RK108")


def _ask(question: Question, method: str, **options: Any) -> tuple[Any, int]:
    """What desolver.solve_ivp returns, and how often it evaluated the right-hand side."""
    from desolver import solve_ivp

    counted = Counted(question)

    def field(t: float, y: Any) -> np.ndarray:
        return np.array(counted.derivative(t, y))

    found = solve_ivp(
        field, (0.0, question.end), question.start, method=method, rtol=question.rtol, atol=question.rtol, **options
    )
    if not found.success:
        raise SolverError(found.message)
    return found, counted.evaluations


def _prepare(question: Question, method: str) -> Callable[[], Answer]:
    import desolver  # noqa: F401 - imported before the seconds are counted

    def run() -> Answer:
        found, evaluations = _ask(question, method, t_eval=question.times)
        return Answer(found.y.T, evaluations, float(found.ode_system.rtol))

    return run


def _events(question: Question, method: str) -> Sequence[float]:
    def event(_t: float, y: Any) -> Any:
        return question.happens(NUMPY, y)

    found, _ = _ask(question, method, events=event, dense_output=True)
    return [float(state.t) for state in found.t_events]


def _solver(method: str) -> Solver:
    return Solver(
        name=f"desolver.{method}",
        package="desolver",
        call=f"solve_ivp(f, (0, T), y0, method='{method}', t_eval=times, rtol=rtol, atol=rtol)",
        prepare=partial(_prepare, method=method),
        events=partial(_events, method=method),
        tolerance="root of the sum of squares of e_i / (atol + rtol s_i), at most about 1 in a step; "
        "s_i a running mean of the larger of |y_i| and |y_i'|",
    )


SOLVERS = tuple(map(_solver, METHODS))
