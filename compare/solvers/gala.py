"""gala's integrators of orbits: an adaptive one, and three that take a step where others take a tolerance."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.solvers.solver import RMS, STEP, Answer, Counted, Question, Solver, StoppedError, step_for

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["SOLVERS"]

STEPPED = {"Leapfrog": (2, 1), "Ruth4": (4, 4), "RK5": (5, 6)}
"""Their orders, and how often they evaluate the right-hand side in a step."""
PAIRED = "problems whose state is positions and one velocity or momentum for each"
NEWTONIAN = "problems with q' = p"


def _integrator(question: Question, method: str, **options: Any) -> tuple[Any, Counted]:
    from gala import integrate

    counted = Counted(question)

    def field(t: float, w: Any) -> np.ndarray:
        """dw/dt of one orbit, whose number has an axis of its own."""
        rates = counted.derivative(float(t), w.reshape(len(w)))
        return np.array(rates, dtype=float).reshape(w.shape)

    return getattr(integrate, f"{method}Integrator")(field, **options), counted


def _states(integrator: Any, start: np.ndarray, times: np.ndarray) -> np.ndarray:
    """The states at the times, [times, state]."""
    found: np.ndarray = integrator(start, t=times).w().reshape(len(start), len(times)).T
    return found


def _prepare(question: Question) -> Callable[[], Answer]:
    import gala.integrate  # noqa: F401 - imported before the seconds are counted

    def run() -> Answer:
        integrator, counted = _integrator(
            question, "DOPRI853", rtol=question.rtol, atol=question.rtol, nsteps=question.limit
        )
        states = _states(integrator, question.start, question.times)
        return Answer(states, counted.evaluations, question.rtol)

    return run


def _prepare_stepped(question: Question, method: str) -> Callable[[], Answer]:
    import gala.integrate  # noqa: F401 - imported before the seconds are counted

    order, stages = STEPPED[method]
    intervals = len(question.times) - 1
    each = math.ceil(question.end / intervals / step_for(question, order))
    if intervals * each * stages > question.limit:
        raise StoppedError(f"not asked for {intervals * each} steps, of {stages} evaluations each")
    times = np.linspace(0.0, question.end, intervals * each + 1)

    def run() -> Answer:
        integrator, counted = _integrator(question, method)
        states = _states(integrator, question.start, times)[::each]
        return Answer(states, counted.evaluations, float(times[1]))

    return run


def _stepped(method: str, accepts: str, solves: Callable[[Question], bool]) -> Solver:
    order, _ = STEPPED[method]
    return Solver(
        name=f"gala.{method}",
        package="gala",
        call=f"{method}Integrator(f)(y0, t=fine), of steps up to rtol^(1/{order})/rate between the times",
        prepare=partial(_prepare_stepped, method=method),
        dial="step",
        tolerance=STEP,
        accepts=accepts,
        solves=solves,
    )


SOLVERS = (
    Solver(
        name="gala.DOPRI853",
        package="gala",
        call="DOPRI853Integrator(f, rtol=rtol, atol=rtol, nsteps=limit)(y0, t=times)",
        prepare=_prepare,
        tolerance=RMS,
        accepts=PAIRED,
        solves=lambda question: question.paired,
    ),
    _stepped("Leapfrog", NEWTONIAN, lambda question: question.newtonian),
    _stepped("Ruth4", NEWTONIAN, lambda question: question.newtonian),
    _stepped("RK5", PAIRED, lambda question: question.paired),
)
