"""heyoka's adaptive Taylor method in double precision."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.solvers.solver import Answer, Question, Solver, SolverError
from reference.arithmetic.compiler import hy, not_kept
from reference.arithmetic.namespaces import Heyoka

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

__all__ = ["SOLVERS"]


def _equations(question: Question) -> tuple[tuple[Any, ...], list[tuple[Any, Any]]]:
    """The state's symbols, and the equations of motion as heyoka takes them."""
    names = question.problem.state_names
    state = tuple(hy.expression(name) for name in names)
    rates = question.problem.derivative(Heyoka(), hy.time, state, question.parameters)
    return state, [(symbol, hy.expression(rate)) for symbol, rate in zip(state, rates, strict=True)]


def _integrator(question: Question, **options: Any) -> Any:
    with not_kept():
        return hy.taylor_adaptive(_equations(question)[1], question.start, tol=question.rtol, **options)


def _finished(outcome: Any) -> None:
    if outcome != hy.taylor_outcome.time_limit:
        raise SolverError(str(outcome))


def _prepare(question: Question) -> Callable[[], Answer]:
    integrator = _integrator(question)

    def run() -> Answer:
        integrator.time = 0.0
        integrator.state[:] = question.start
        outcome, _, _, steps, _, states = integrator.propagate_grid(question.times)
        _finished(outcome)
        return Answer(states, steps * integrator.order, integrator.tol)

    return run


def _events(question: Question) -> Sequence[float]:
    times: list[float] = []

    def note(_integrator: Any, time: float, _sign: int) -> None:
        times.append(time)

    state, _ = _equations(question)
    event = hy.nt_event(question.happens(Heyoka(), state), note)
    _finished(_integrator(question, nt_events=[event]).propagate_until(question.end)[0])
    return times


SOLVERS = (
    Solver(
        name="heyoka.taylor",
        package="heyoka",
        call="taylor_adaptive(equations, y0, tol=rtol).propagate_grid(times)",
        prepare=_prepare,
        events=_events,
        aliases=("taylor",),
        dial="tol",
        tolerance="largest last terms of the Taylor series in a step, over the larger of 1 and the largest |y_i|; "
        "the order is 1 - ln(tol) / 2, rounded up",
        counts="Taylor coefficients of the right-hand side (steps x order)",
    ),
)
