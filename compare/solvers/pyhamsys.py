"""pyhamsys: symplectic splittings, which take a step where others take a tolerance."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.solvers.solver import STEP, Answer, Counted, Question, Solver, StoppedError, step_for

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["SOLVERS"]

ORDERS = {"Verlet": 2, "BM4": 4, "BM6": 6}
MAX_STEPS = 20_000
"""Steps that are asked for at most: pyhamsys searches all of its times at every step, n^2 comparisons for n steps."""


def _prepare(question: Question, method: str) -> Callable[[], Answer]:
    from pyhamsys import HamSys, Parameters

    size, step = question.positions, step_for(question, ORDERS[method])
    if question.end > MAX_STEPS * step:
        raise StoppedError(f"not asked for {question.end / step:.0f} steps, of which its time takes the square")
    options = Parameters(step=step, solver=method, display=False)

    def run() -> Answer:
        counted = Counted(question)

        def flow(h: float, t: float, y: Any) -> np.ndarray:
            """The drift by h, then the kick by h."""
            q = y[:size] + h * counted.velocity(y[size:])
            return np.concatenate([q, y[size:] + h * counted.force(t, q)])

        def adjoint(h: float, t: float, y: Any) -> np.ndarray:
            """The kick by h, then the drift by h."""
            p = y[size:] + h * counted.force(t, y[:size])
            return np.concatenate([y[:size] + h * counted.velocity(p), p])

        system = HamSys(ndof=size, chi=flow, chi_star=adjoint)
        found = system.integrate(question.start, question.times, options)
        return Answer(found.y.T, counted.evaluations, float(found.step))

    return run


def _solver(method: str) -> Solver:
    return Solver(
        name=f"pyhamsys.{method}",
        package="pyhamsys",
        call=f"HamSys(chi, chi_star).integrate(y0, times, Parameters(step=rtol^(1/{ORDERS[method]})/rate, "
        f"solver='{method}'))",
        prepare=partial(_prepare, method=method),
        dial="step",
        tolerance=STEP,
        counts="evaluations of the force",
        accepts="separable problems",
        solves=lambda question: question.positions > 0,
    )


SOLVERS = tuple(map(_solver, ORDERS))
