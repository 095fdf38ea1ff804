"""extensisq: more methods for SciPy's `solve_ivp`."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from compare.solvers.scipy import ask_solve_ivp, events_of_solve_ivp
from compare.solvers.solver import RMS, Answer, Question, Solver

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["SOLVERS"]

METHODS = ("BS5", "Ts5", "Pr8", "Pr9", "CFMR7osc", "SWAG")


def _method(name: str) -> Any:
    import extensisq

    return getattr(extensisq, name)


def _prepare(question: Question, method: str) -> Callable[[], Answer]:
    kept: list[Any] = []
    base = _method(method)

    class Kept(base):  # type: ignore[misc, valid-type] # the package's class, known when it is imported
        """The same method, which can be asked afterwards what tolerance it took: the package does not say."""

        def __init__(self, *args: Any, **options: Any) -> None:
            super().__init__(*args, **options)
            kept.append(self)

    def run() -> Answer:
        found = ask_solve_ivp(question, Kept)
        return Answer(found.states, found.evaluations, float(kept[-1].rtol))

    return run


def _events(question: Question, method: str) -> list[float]:
    return events_of_solve_ivp(question, _method(method))


def _solver(method: str) -> Solver:
    return Solver(
        name=f"extensisq.{method}",
        package="extensisq",
        call=f"solve_ivp(f, (0, T), y0, method=extensisq.{method}, t_eval=times, rtol=rtol, atol=rtol)",
        prepare=partial(_prepare, method=method),
        events=partial(_events, method=method),
        tolerance=RMS,
    )


SOLVERS = tuple(map(_solver, METHODS))
