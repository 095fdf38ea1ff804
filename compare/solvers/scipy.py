"""SciPy's solvers: `solve_ivp` with its six methods, and `odeint`; and whatever else `solve_ivp` takes as a method."""

from __future__ import annotations

import re
import warnings
from functools import partial
from typing import TYPE_CHECKING, Any

from compare.solvers.solver import LARGEST, RMS, Answer, Counted, Question, Solver, SolverError
from reference.arithmetic.namespaces import NUMPY

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

__all__ = ["SOLVERS", "ask_solve_ivp", "events_of_solve_ivp"]

METHODS = ("RK23", "RK45", "DOP853", "Radau", "BDF", "LSODA")
RAISED = re.compile(r"np\.maximum\(rtol, ([0-9.e+-]+)\)")
"""How SciPy says what it takes in place of a tolerance that it finds too small."""
SUCCESS = "Integration successful."


def ask_solve_ivp(question: Question, method: Any) -> Answer:
    """The states at the times, by solve_ivp(..., t_eval=times).

    Raises:
        SolverError: it did not reach the end; the text is its message.
    """
    from scipy.integrate import solve_ivp

    counted = Counted(question)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = solve_ivp(
            counted.derivative,
            (0.0, question.end),
            question.start,
            method=method,
            t_eval=question.times,
            rtol=question.rtol,
            atol=question.rtol,
        )
    for warning in caught:
        warnings.warn_explicit(warning.message, warning.category, warning.filename, warning.lineno)
    if not found.success:
        raise SolverError(found.message)
    return Answer(found.y.T, counted.evaluations, _used(question.rtol, [str(w.message) for w in caught]))


def _used(asked: float, warned: Sequence[str]) -> float:
    """The tolerance that SciPy worked with, by its own words where it raised the one asked for."""
    raised = [float(match[1]) for match in map(RAISED.search, warned) if match]
    return max([asked, *raised])


def events_of_solve_ivp(question: Question, method: Any) -> list[float]:
    """The times of the events, by solve_ivp(..., events=event).

    Raises:
        SolverError: it did not reach the end; the text is its message.
    """
    from scipy.integrate import solve_ivp

    found = solve_ivp(
        Counted(question).derivative,
        (0.0, question.end),
        question.start,
        method=method,
        events=lambda _, y: question.happens(NUMPY, y),
        rtol=question.rtol,
        atol=question.rtol,
    )
    if not found.success:
        raise SolverError(found.message)
    return [float(time) for time in found.t_events[0]]


def _prepare(question: Question, method: str) -> Callable[[], Answer]:
    import scipy.integrate  # noqa: F401 - imported before the seconds are counted

    return partial(ask_solve_ivp, question, method)


def _prepare_odeint(question: Question) -> Callable[[], Answer]:
    from scipy.integrate import odeint

    def run() -> Answer:
        counted = Counted(question)
        states, found = odeint(
            counted.derivative,
            question.start,
            question.times,
            tfirst=True,
            rtol=question.rtol,
            atol=question.rtol,
            full_output=True,
        )
        if found["message"] != SUCCESS:
            raise SolverError(found["message"])
        return Answer(states, counted.evaluations, question.rtol)

    return run


def _solver(method: str) -> Solver:
    return Solver(
        name=f"scipy.{method}",
        package="scipy",
        call=f"solve_ivp(f, (0, T), y0, method='{method}', t_eval=times, rtol=rtol, atol=rtol)",
        prepare=partial(_prepare, method=method),
        events=partial(events_of_solve_ivp, method=method),
        aliases=(method,),
        tolerance=LARGEST if method == "LSODA" else RMS,
    )


SOLVERS = (
    *map(_solver, METHODS),
    Solver(
        name="scipy.odeint",
        package="scipy",
        call="odeint(f, y0, times, tfirst=True, rtol=rtol, atol=rtol, full_output=True)",
        prepare=_prepare_odeint,
        aliases=("odeint",),
        tolerance=LARGEST,
    ),
)
