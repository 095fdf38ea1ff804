"""Taylor's method is the Taylor polynomial of the solution, for every problem, in every format, as heyoka finds it."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING, Any

import heyoka as hy
import numpy as np
import pytest
from flint import arb

import compare
from compare.march.equation import plain_system
from compare.march.lanes import Lane, sample_steps
from compare.march.march import march
from compare.march.precision import FORMATS, Precision, precision
from compare.march.trace import compile_block
from compare.methods import find
from compare.methods.kinds.taylor import Taylor
from compare.methods.order.algebraic import Q, enclose
from compare.methods.order.conditions import order_by_steps
from compare.methods.taylor import TAYLOR, TAYLOR4, TAYLOR8, TAYLOR20
from reference import (
    Cycloid,
    CycloidalPendulum,
    Descent,
    LinearPendulum,
    Pendulum,
    PolarBrachistochrone,
    Tautochrone,
    Tunnel,
)
from reference.arithmetic.dual import DualArithmetic
from reference.arithmetic.namespaces import BALL, Heyoka
from reference.arithmetic.precision import ctx
from reference.arithmetic.series import jet
from reference.problems.cycloid.arc import CycloidCurve
from reference.problems.polar.paths import PolarByPsi, PolarByZ

if TYPE_CHECKING:
    from compare.methods.kinds.protocol import State
    from reference.problem import Problem

FLOAT64 = precision("float64")
ORDER = 20
FORMULA = "x = p; y = (4 - p)**(5/3) + exp(-p) + atan(2 - p)/9 + log(4 + p)/99 + tanh(1 - p)/9 + asin(p/9) - tan(p/5)/9"
PROBLEMS: tuple[Problem, ...] = (
    Pendulum(1.0),
    LinearPendulum(1.0),
    Cycloid(1, 1),
    CycloidCurve(1),
    Tautochrone(1.0),
    CycloidalPendulum(1.0),
    PolarBrachistochrone(z0="1/2"),
    PolarByZ("1/3"),
    PolarByPsi("1/3"),
    Tunnel(z0="1/2"),
    Descent("quartic"),
    Descent("circular_arc"),
    Descent("quarter_ellipse"),
    Descent("cycloid"),
    Descent(FORMULA, start=0, end=2),
)
SINGULAR = ("cycloid arc", "polar curve in z")
"""Problems that start where the slope is no power series."""
by_problem = pytest.mark.parametrize("problem", PROBLEMS, ids=repr)
by_method = pytest.mark.parametrize("method", TAYLOR, ids=lambda method: method.name)


def trial(problem: Problem) -> tuple[list[float], dict[str, float]]:
    """A state and parameters at which the equation is real, in the middle of the intervals."""
    intervals = problem.trial
    middle = [0.4 * low + 0.6 * high for low, high in intervals.states]
    return middle, {name: float(np.mean(intervals.parameters[name])) for name in problem.parameters}


def integrator(problem: Problem, state: list[float], parameters: dict[str, float]) -> Any:
    """heyoka's own Taylor integrator of order 20."""
    names = hy.make_vars(*problem.state_names)
    rates = problem.derivative(Heyoka(), 0, names, parameters)
    equations = [(name, hy.expression(rate)) for name, rate in zip(names, rates, strict=True)]
    found = hy.taylor_adaptive(equations, state, tol=np.finfo(float).eps)
    assert found.order == ORDER
    return found


def system_of(problem: Problem, parameters: dict[str, float], fmt: Precision = FLOAT64) -> Any:
    values = [fmt.number(Fraction(value)) for value in (0.0, *[0.0] * len(problem.invariants), *parameters.values())]
    return plain_system(problem, fmt, np.array(values, dtype=fmt.type))


@by_problem
def test_jets_are_those_of_heyokas_integrator(problem: Problem) -> None:
    """Normalized derivatives up to order 20, each within roundings of the largest term of the series."""
    state, parameters = trial(problem)
    other = integrator(problem, state, parameters)
    other.step(write_tc=True)
    found = np.array([state, *system_of(problem, parameters).jet(tuple(state), ORDER)], dtype=float).T
    assert found.shape == other.tc.shape
    reach = other.last_h ** np.arange(ORDER + 1)
    sizes = np.max(np.abs(other.tc * reach), axis=1, keepdims=True)
    assert np.max(np.abs(found - other.tc) * reach / sizes) < 1e-13
    np.testing.assert_allclose(found, other.tc, rtol=1e-8, atol=1e-300)


@by_problem
def test_a_step_is_that_of_heyokas_integrator_clamped_to_it(problem: Problem) -> None:
    """Where a step is so short that both leave out nothing."""
    state, parameters = trial(problem)
    other = integrator(problem, state, parameters)
    h = problem.trial.step[0]
    outcome, taken = other.step(max_delta_t=h)
    assert (outcome, taken) == (hy.taylor_outcome.time_limit, h)
    new, _ = TAYLOR20.step(system_of(problem, parameters), tuple(state), h)
    np.testing.assert_allclose(new, other.state, rtol=0, atol=4e-15)


@pytest.mark.parametrize("fmt", [*FORMATS, precision("mp:200")], ids=lambda fmt: fmt.name)
@by_problem
def test_a_compiled_step_is_the_plain_one_for_every_problem_in_every_format(problem: Problem, fmt: Precision) -> None:
    """``compile_block`` holds one against the other."""
    block = compile_block(TAYLOR8, problem, fmt, 1, "every", min(8, fmt.lanes), brief=True)
    assert block.steps == 1


@pytest.mark.parametrize("problem", [p for p in PROBLEMS if p.name not in SINGULAR], ids=repr)
def test_every_problem_that_is_analytic_at_its_start_comes_to_the_truth(problem: Problem) -> None:
    t_end = {"pendulum": 2, "polar": 1, "tunnel": 1}.get(problem.name, Fraction(1, 2))
    (cell,) = compare.error_vs_n(problem, methods=("taylor12",), n=[64], t_end=t_end)
    assert cell.max_error < 3e-14
    assert cell.evaluations == 64 * 12


@pytest.mark.parametrize("problem", [p for p in PROBLEMS if p.name in SINGULAR], ids=repr)
def test_a_start_at_which_there_is_no_power_series_gives_no_number(problem: Problem) -> None:
    lane = Lane(problem, 16, Fraction(1, 64), sample_steps(16, 4))
    (result,) = march(TAYLOR4, [lane], FLOAT64)
    assert not np.any(np.isfinite(result.states[:, 0]))


@by_method
def test_orders_are_proven_by_steps_over_trees(method: Taylor) -> None:
    assert method.proven_order() == method.order


@dataclass(frozen=True)
class Unscaled(Taylor):
    """A slip: the derivative of one order has lost its factor 1/2."""

    slipped: int = 0

    def step(self, system: Any, y: State, h: Any, iterations: int = 0) -> Any:
        class Slipped:
            def jet(_, y: State, order: int) -> list[State]:  # noqa: N805
                return [
                    tuple(2 * value for value in one) if k == self.slipped else one
                    for k, one in enumerate(system.jet(y, order), 1)
                ]

        return super().step(Slipped(), y, h, iterations)


@pytest.mark.parametrize("slipped", [1, 3, 8, 9, 12])
def test_a_slip_in_one_derivative_lowers_the_proven_order(slipped: int) -> None:
    assert Unscaled("unscaled", 12, "none", slipped=slipped).proven_order() == slipped - 1


def test_steps_over_trees_prove_the_orders_of_tables_too() -> None:
    orders = {name: order_by_steps(find(name)) for name in ("euler", "heun", "rk4", "butcher6", "rk4_misprinted")}
    assert orders == {"euler": 1, "heun": 2, "rk4": 4, "butcher6": 6, "rk4_misprinted": 1}


@pytest.mark.parametrize("other", ["rk4", "three_eighths"])
def test_on_a_linear_equation_every_method_of_as_many_stages_as_orders_is_taylors(other: str) -> None:
    marches = [
        march(method, [Lane(LinearPendulum(1.0), 64, Fraction(1, 32), (64,))], FLOAT64)[0]
        for method in (TAYLOR4, find(other))
    ]
    np.testing.assert_allclose(marches[0].states, marches[1].states, rtol=0, atol=1e-14)


@cache
def area(order: int, size: int) -> arb:
    """det J - 1 of a step of 1/size of the pendulum theta'' = -sin theta, J by dual balls."""
    duals = DualArithmetic(BALL, 2)

    class Swing:
        number = staticmethod(enclose)

        def jet(self, y: State, order: int) -> list[State]:
            return jet(duals, lambda m, state: (state[1], -m.sin(state[0])), y, order)

    start = duals.variable(arb(1), 0), duals.variable(arb(1) / 2, 1)
    (q, p), _ = Taylor("taylor", order, "none").step(Swing(), start, arb(1) / size)
    return q.slopes[0] * p.slopes[1] - q.slopes[1] * p.slopes[0] - 1


@pytest.mark.parametrize("order", [4, 8, 12])
def test_area_is_kept_to_the_order_and_no_further(order: int) -> None:
    with ctx.workprec(400):
        coarse, fine = area(order, 64), area(order, 128)
        assert abs(fine) > 0
        assert order + 0.9 < float((abs(coarse) / abs(fine)).log() / arb(2).log()) < order + 2.1


@by_method
def test_a_step_of_order_p_counts_as_p_evaluations(method: Taylor) -> None:
    assert method.evaluations(0) == (method.order, 0)
    (result,) = march(method, [Lane(Pendulum(1.0), 100, Fraction(1, 16), (100,))], FLOAT64)
    assert (result.evaluations, result.jacobians) == (100 * method.order, 0)


def test_reciprocals_are_those_of_the_format() -> None:
    """y' = y from 1: the coefficients are 1/k!, to the last digits of 200 bits."""
    fmt = precision("mp:200")
    system = system_of(Pendulum(1.0), {"g": 1.0, "length": 1.0}, fmt)
    found = jet(system._m, lambda _, y: (y[0],), (fmt.number(Q(1)),), 10)
    gap = abs(found[-1][0] * fmt.number(Q(3628800)) - fmt.number(Q(1)))
    assert float(gap) < 20 * fmt.epsilon
