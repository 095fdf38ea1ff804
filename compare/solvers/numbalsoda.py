"""numbalsoda: LSODA and DOP853 on equations that numba has compiled."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.solvers.solver import Answer, Question, Solver, SolverError
from compare.solvers.source import SOURCE, Term

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

__all__ = ["SOLVERS"]

FAILED = "success is False"
MAX_STEPS = 1_000_000
"""Steps from one time to the next: numbalsoda's own bound of 10000 is for looser tolerances."""


def _source(question: Question) -> tuple[str, str]:
    """The equations of motion and the event as bodies of functions (t, u, out, data); data[0] counts."""
    names = list(question.problem.parameters)
    parameters = {name: Term(f"data[{place}]") for place, name in enumerate(names, start=1)}
    state = [Term(f"u[{i}]") for i in range(len(question.start))]
    rates = question.problem.derivative(SOURCE, state, parameters)
    lines = [f"out[{i}] = {rate}" for i, rate in enumerate(rates)]
    event = f"out[0] = {question.happens(SOURCE, state)}" if question.event else "pass"
    return "\n    ".join(["data[0] += 1.0", *lines]), event


@lru_cache(maxsize=8)
def _compiled(body: str) -> Any:
    """A body as a numba cfunc of numbalsoda's signature."""
    from numba import cfunc
    from numbalsoda import lsoda_sig

    space: dict[str, Any] = {"math": math}
    exec(f"def function(t, u, out, data):\n    {body}\n", space)  # noqa: S102 - the source is written here, from the equation
    return cfunc(lsoda_sig)(space["function"])


def _data(question: Question) -> np.ndarray:
    return np.array([0.0, *question.parameters.values()])


def _prepare(question: Question, method: str) -> Callable[[], Answer]:
    import numbalsoda

    solve = getattr(numbalsoda, method)
    function = _compiled(_source(question)[0])

    def run() -> Answer:
        data = _data(question)
        states, success = solve(
            function.address,
            question.start,
            question.times,
            data=data,
            rtol=question.rtol,
            atol=question.rtol,
            mxstep=MAX_STEPS,
        )
        if not success:
            raise SolverError(FAILED)
        return Answer(states, int(data[0]), question.rtol)

    run()  # numba compiles the driver now
    return run


def _prepare_lsoda(question: Question) -> Callable[[], Answer]:
    return _prepare(question, "lsoda")


def _prepare_dop853(question: Question) -> Callable[[], Answer]:
    return _prepare(question, "dop853")


def _events(question: Question) -> Sequence[float]:
    from numbalsoda import solve_ivp

    body, event = _source(question)
    data = _data(question)
    found = solve_ivp(
        _compiled(body).address,
        np.array([0.0, question.end]),
        question.start,
        n_events=1,
        event_fcn=_compiled(event).address,
        data=data.ctypes.data,
        rtol=question.rtol,
        atol=question.rtol,
    )
    if not found.success:
        raise SolverError(found.message)
    return [found.t_event] if found.event_found else []


SOLVERS = (
    Solver(
        name="numbalsoda.lsoda",
        package="numbalsoda",
        call="lsoda(f.address, y0, times, data, rtol=rtol, atol=rtol)",
        prepare=_prepare_lsoda,
    ),
    Solver(
        name="numbalsoda.dop853",
        package="numbalsoda",
        call="dop853(f.address, y0, times, data, rtol=rtol, atol=rtol); its events by solve_ivp(..., event_fcn=...)",
        prepare=_prepare_dop853,
        events=_events,
        first_only=True,
    ),
)
