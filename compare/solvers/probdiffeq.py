"""probdiffeq: filters in JAX, which take a solution for a random process and condition it on the equation."""

from __future__ import annotations

from functools import lru_cache, partial
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.solvers.diffrax import field_of
from compare.solvers.solver import Answer, Question, Solver, StoppedError

if TYPE_CHECKING:
    from collections.abc import Callable

    from reference.problem import Problem

__all__ = ["SOLVERS"]

DERIVATIVES = 5
"""Of the solution, beside itself, in the state of the filter."""
COUNTS = "calls of the right-hand side, with those in its Jacobians, once it has its start: a Taylor series and a step"


def _model(method: str, ode: Any) -> tuple[Any, Any]:
    """The state-space model, and what conditions it: on f at the prediction, or on f and its Jacobian there."""
    from probdiffeq import probdiffeq

    if method == "TS0":
        model = probdiffeq.state_space_model_isotropic()
        return model, model.constraint_ode_ts0(ode)
    model = probdiffeq.state_space_model_dense()
    return model, model.constraint_residual(probdiffeq.residual_from_ode(ode))


class _Tally:
    """How many evaluations there were, and whether there may be more."""

    def __init__(self) -> None:
        self.count = [0]
        self.limit = 0

    def on(self) -> np.ndarray:
        """Whether the limit is not reached."""
        return np.asarray(self.count[0] < self.limit)


@lru_cache(maxsize=8)
def _compiled(method: str, problem: Problem, *, counting: bool) -> tuple[Any, _Tally]:
    """A jitted solve(y0, times, rtol), and the tally of evaluations if they are counted."""
    import jax
    from probdiffeq import ivpsolve, probdiffeq

    tally = _Tally()
    field, counted = field_of(problem, None), field_of(problem, tally.count if counting else None)

    def vector_field(y: Any, /, *, t: Any) -> Any:
        return field(t, y)

    def counted_field(y: Any, /, *, t: Any) -> Any:
        return counted(t, y)

    def bounded(condition: Callable[[Any], Any], body: Callable[[Any], Any], first: Any) -> Any:
        """A loop that ends where no more evaluations are granted."""
        may = jax.ShapeDtypeStruct((), bool)
        return jax.lax.while_loop(
            lambda state: condition(state) & jax.experimental.io_callback(tally.on, may, ordered=False), body, first
        )

    def solve(start: Any, times: Any, rtol: Any) -> Any:
        expand = probdiffeq.jetexpand_ode_padded_scan(num=DERIVATIVES)
        series, _ = expand(probdiffeq.ode(vector_field), (start,), t=times[0])
        model, constraint = _model(method, probdiffeq.ode(counted_field))
        asked = ivpsolve.solve_adaptive_save_at(
            solver=probdiffeq.solver_dynamic(strategy=probdiffeq.strategy_filter(), constraint=constraint),
            error=probdiffeq.error_residual_std(constraint=constraint),
            while_loop=bounded if counting else jax.lax.while_loop,
        )
        first = ivpsolve.dt0_adaptive(
            vector_field, (start,), t0=times[0], error_contraction_rate=DERIVATIVES, rtol=rtol, atol=rtol
        )
        prior = model.prior_wiener_integrated(series)
        return asked(prior, times, atol=rtol, rtol=rtol, dt0=first).u.mean[0]

    return jax.jit(solve), tally


def _prepare(question: Question, method: str) -> Callable[[], Answer]:
    import jax
    import jax.experimental

    def ask(*, counting: bool) -> tuple[np.ndarray, int]:
        solve, tally = _compiled(method, question.problem, counting=counting)
        tally.count[0], tally.limit = 0, question.limit
        with jax.enable_x64(True):
            states = np.asarray(solve(question.start, question.times, question.rtol))
            jax.effects_barrier()
        if tally.count[0] >= question.limit:
            raise StoppedError(f"stopped after {question.limit} evaluations of the right-hand side")
        return states, tally.count[0]

    _, evaluations = ask(counting=True)
    ask(counting=False)
    return lambda: Answer(ask(counting=False)[0], evaluations, question.rtol)


def _solver(method: str, model: str) -> Solver:
    return Solver(
        name=f"probdiffeq.{method}",
        package="probdiffeq",
        project="probdiffeq",
        call=f"solve_adaptive_save_at(solver=solver_dynamic(strategy_filter(), {method}), "
        f"error=error_residual_std({method}))(prior, times, atol=rtol, rtol=rtol), "
        f"with {DERIVATIVES} derivatives in a state-space model that is {model}",
        prepare=partial(_prepare, method=method),
        counts=COUNTS,
        tolerance="root mean square of s_i h / (atol + rtol |y_i|) over the components, at most 1 in a step; "
        "s_i the calibrated standard deviation of the residual of the equation",
    )


SOLVERS = (_solver("TS0", "isotropic"), _solver("TS1", "dense"))
