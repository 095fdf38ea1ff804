"""scikit-sundae: SUNDIALS' CVODE, with the methods of Adams and of backward differentiation."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from compare.solvers.solver import RMS, Answer, Counted, Question, Solver, SolverError
from reference.arithmetic.namespaces import NUMPY

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

__all__ = ["SOLVERS"]

METHODS = ("Adams", "BDF")


def _ask(question: Question, method: str, **options: Any) -> tuple[Any, int]:
    """What CVODE's solve returns, and how often it evaluated the right-hand side."""
    from sksundae.cvode import CVODE

    counted = Counted(question)

    def field(t: float, y: Any, rates: Any) -> None:
        rates[:] = counted.derivative(t, y)

    solver = CVODE(
        field, method=method, rtol=question.rtol, atol=question.rtol, max_num_steps=question.limit, **options
    )
    found = solver.solve(question.times, question.start)
    if not found.success:
        raise SolverError(found.message)
    return found, counted.evaluations


def _prepare(question: Question, method: str) -> Callable[[], Answer]:
    import sksundae.cvode  # noqa: F401 - imported before the seconds are counted

    def run() -> Answer:
        found, evaluations = _ask(question, method)
        return Answer(found.y, evaluations, question.rtol)

    return run


def _events(question: Question, method: str) -> Sequence[float]:
    def event(_t: float, y: Any, values: Any) -> None:
        values[0] = question.happens(NUMPY, y)

    event.terminal = [False]  # type: ignore[attr-defined] # the package reads it there
    found, _ = _ask(question, method, eventsfn=event, num_events=1)
    return [] if found.t_events is None else [float(time) for time in found.t_events]


def _solver(method: str) -> Solver:
    return Solver(
        name=f"sksundae.CVODE_{method}",
        package="sksundae",
        project="scikit-sundae",
        call=f"CVODE(f, method='{method}', rtol=rtol, atol=rtol, max_num_steps=limit).solve(times, y0)",
        prepare=partial(_prepare, method=method),
        events=partial(_events, method=method),
        aliases=(f"CVODE_{method}",),
        tolerance=RMS,
    )


SOLVERS = tuple(map(_solver, METHODS))
