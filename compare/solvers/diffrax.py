"""diffrax: solvers in JAX, compiled by XLA."""

from __future__ import annotations

from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.solvers.solver import RMS, Answer, Question, Solver, SolverError
from reference.arithmetic.namespaces import JAX

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.problem import Problem

__all__ = ["SOLVERS", "field_of"]

METHODS = ("Tsit5", "Dopri8")


def field_of(problem: Problem, tally: list[int] | None) -> Callable[[Any, Any], Any]:
    """dy/dt in JAX; with a tally, JAX calls back at every evaluation, which takes longer than it does."""
    import jax
    import jax.numpy as jnp

    parameters = {name: float(value) for name, value in problem.parameters.items()}

    def count() -> None:
        if tally is not None:
            tally[0] += 1

    def field(t: Any, y: Any) -> Any:
        if tally is not None:
            jax.debug.callback(count)
        return jnp.stack([jnp.asarray(rate, y.dtype) for rate in problem.derivative(JAX, t, y, parameters)])

    return field


@lru_cache(maxsize=8)
def _compiled(
    method: str, problem: Problem, event: Callable[[Any, Any], Any] | None = None, *, counting: bool = False
) -> tuple[Any, list[int]]:
    """A jitted solve(y0, times, rtol, steps), and a list with the number of evaluations if they are counted.

    It gives the states at the times, or with an event function the state at the first event.
    """
    import diffrax
    import jax
    from optimistix import Newton

    tally = [0]
    field = field_of(problem, tally if counting else None)

    def solve(start: Any, times: Any, rtol: Any, steps: int) -> Any:
        options: dict[str, Any] = {"saveat": diffrax.SaveAt(ts=times)}
        if event is not None:
            options = {"event": diffrax.Event(_condition(event), Newton(rtol=rtol, atol=rtol))}
        return diffrax.diffeqsolve(
            diffrax.ODETerm(lambda t, y, _args: field(t, y)),
            getattr(diffrax, method)(),
            t0=0.0,
            t1=times[-1],
            dt0=None,
            y0=start,
            stepsize_controller=diffrax.PIDController(rtol=rtol, atol=rtol),
            max_steps=steps,
            throw=False,
            **options,
        )

    return jax.jit(solve, static_argnums=3), tally


def _condition(event: Callable[[Any, Any], Any]) -> Callable[..., Any]:
    """An event function as diffrax calls it, which names its arguments."""

    def condition(t: Any, y: Any, args: Any, **_: Any) -> Any:  # noqa: ARG001
        return event(JAX, y)

    return condition


def _prepare(question: Question, method: str) -> Callable[[], Answer]:
    import jax

    def ask(*, counting: bool) -> tuple[np.ndarray, int]:
        solve, evaluations = _compiled(method, question.problem, counting=counting)
        before = evaluations[0]
        with jax.enable_x64(True):
            found = solve(question.start, question.times, question.rtol, question.limit)
            states = np.asarray(found.ys)
            jax.effects_barrier()
        _require(found)
        return states, evaluations[0] - before

    _, evaluations = ask(counting=True)
    ask(counting=False)
    return lambda: Answer(ask(counting=False)[0], evaluations, question.rtol)


def _require(found: Any) -> None:
    from diffrax import RESULTS, is_okay

    if not is_okay(found.result):
        raise SolverError(RESULTS[found.result])


def _events(question: Question, method: str) -> Sequence[float]:
    import jax

    solve, _ = _compiled(method, question.problem, question.event)
    with jax.enable_x64(True):
        found = solve(question.start, question.times, question.rtol, question.limit)
        happened, time = bool(found.event_mask), float(found.ts[-1])
        _require(found)
    return [time] if happened else []


def _solver(method: str) -> Solver:
    return Solver(
        name=f"diffrax.{method}",
        package="diffrax",
        call=f"diffeqsolve(ODETerm(f), {method}(), 0, T, None, y0, saveat=SaveAt(ts=times), "
        "stepsize_controller=PIDController(rtol=rtol, atol=rtol))",
        prepare=partial(_prepare, method=method),
        events=partial(_events, method=method),
        first_only=True,
        tolerance=RMS,
    )


SOLVERS = tuple(map(_solver, METHODS))
