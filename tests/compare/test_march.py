"""A march does what its steps do, whatever lanes it shares a block with."""

from __future__ import annotations

import tracemalloc
from dataclasses import replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from compare.march.equation import BoundSystem, plain_system
from compare.march.lanes import Lane, StartInvariant, sample_steps
from compare.march.march import iterations_for, march
from compare.march.precision import precision
from compare.march.trace import compile_block, plain_block
from compare.methods import METHODS, find
from compare.methods.kinds.nystrom import RungeKuttaNystrom
from compare.methods.kinds.one_step import Splitting
from reference import Pendulum

if TYPE_CHECKING:
    from compare.methods.kinds.protocol import Method
    from reference.problem import Problem

FLOAT64 = precision("float64")
PENDULUM = Pendulum(1.0)


def lane(n: int, problem: Problem = PENDULUM, t_end: int = 10) -> Lane:
    return Lane(problem, n, FLOAT64.round(Fraction(t_end, n)), sample_steps(n, 128))


def plain_march(name: str, one: Lane, iterations: int = 0) -> np.ndarray:
    """The states at the samples by NumPy alone, one lane, one step after another."""
    h = float(one.h)
    states = np.array([[float(value)] for value in one.problem.start])
    level = float(FLOAT64.number(StartInvariant(one.problem)))
    parameters = np.array([[h], [level], *([float(value)] for value in one.problem.parameters.values())])
    rows = plain_block(find(name), one.problem, FLOAT64, states, parameters, one.n, iterations)
    return rows[np.array(one.samples) - 1, :2, 0]


@pytest.mark.parametrize("n", [1, 7, 128, 200, 1000, 4096, 8192, 9984, 8208])
def test_samples_are_spread_to_the_very_end(n: int) -> None:
    steps = sample_steps(n, 128)
    assert steps[-1] == n
    assert len(steps) == len(set(steps)) == min(n, 128)
    assert list(steps) == sorted(steps)
    assert max(np.diff((0, *steps))) <= max(1, 2 * n / 128)


@pytest.mark.parametrize("n", [1, 5, 100, 1000, 9984, 8200])
@pytest.mark.parametrize("name", ["rk4", "verlet"])
def test_a_march_gives_the_states_of_the_plain_steps(name: str, n: int) -> None:
    one = lane(n, t_end=2)
    (result,) = march(find(name), [one], FLOAT64)
    np.testing.assert_allclose(result.states, plain_march(name, one), rtol=0, atol=1e-11)


def test_lanes_of_many_lengths_and_starts_do_not_mix() -> None:
    lanes = [lane(n, Pendulum(theta0)) for n in (128, 16384, 300, 8192, 1) for theta0 in (0.1, 1.0, 3.0)]
    together = march(find("yoshida4"), lanes, FLOAT64)
    for one, result in zip(lanes, together, strict=True):
        (alone,) = march(find("yoshida4"), [one], FLOAT64)
        np.testing.assert_allclose(result.states, alone.states, rtol=0, atol=1e-9)
        assert result.max_drifts[0] == pytest.approx(alone.max_drifts[0], rel=1e-3)


@pytest.mark.parametrize("n", [100, 8192])
def test_the_largest_drift_is_that_of_every_step_and_no_more(n: int) -> None:
    every = replace(lane(n), samples=tuple(range(1, n + 1)))
    (result,) = march(find("verlet"), [lane(n)], FLOAT64)
    states = plain_march("verlet", every)
    above = states[:, 1] ** 2 / 2 + 2 * 9.81 * np.sin(states[:, 0] / 2) ** 2
    assert result.max_drifts[0] == pytest.approx(np.max(np.abs(above - 2 * 9.81 * np.sin(0.5) ** 2)), rel=1e-6)


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.name)
def test_evaluations_are_counted_as_they_are_made(method: Method) -> None:
    """By a system that counts; what steps share is counted once, such as a processor or the force of a last kick.

    Derivatives at the ends of a march are not counted, only those that every step adds.
    """
    one = lane(16)
    (result,) = march(method, [one], FLOAT64)
    iterations = iterations_for(method, PENDULUM, float(one.h), 53)
    level = float(FLOAT64.number(StartInvariant(PENDULUM)))
    counted = Counter(plain_system(PENDULUM, FLOAT64, np.array([0.1, level, 9.81, 1.0])))
    _, y = method.start(counted, (1.0, 0.0), 0.1)
    for _ in range(16 - method.starting_steps):
        y, _change = method.step(counted, y, 0.1, iterations)
    sharing = isinstance(method, (Splitting, RungeKuttaNystrom))
    assert result.evaluations == counted.evaluations - sharing * 15 * method.evaluations(iterations)[1]
    gradients = [kind for kind, _ in getattr(method, "flows", ())].count("gradient")
    assert counted.jacobians == 16 * gradients if gradients else result.jacobians == counted.jacobians
    assert result.jacobians <= counted.jacobians


class Counter:
    """An equation that counts what is asked of it."""

    def __init__(self, system: BoundSystem) -> None:
        self.system = system
        self.evaluations = self.jacobians = 0

    def __getattr__(self, name: str) -> Any:
        found = getattr(self.system, name)
        kinds = {
            "force": "evaluations", "derivative": "evaluations",
            "jacobian": "jacobians", "gradient": "jacobians", "force_along": "jacobians",
        }  # fmt: skip
        if name not in kinds:
            return found

        def counted(*arguments: Any) -> Any:
            setattr(self, kinds[name], getattr(self, kinds[name]) + 1)
            return found(*arguments)

        return counted

    def jet(self, y: Any, order: int) -> Any:
        """A jet of order p counts as p evaluations."""
        self.evaluations += order
        return self.system.jet(y, order)


def test_an_implicit_method_with_too_large_a_step_gives_no_number() -> None:
    (coarse, fine) = march(find("implicit_midpoint"), [lane(5), lane(200)], FLOAT64)
    assert np.all(np.isnan(coarse.states))
    assert np.isnan(coarse.max_drifts[0])
    assert np.all(np.isfinite(fine.states))


def test_an_implicit_step_solves_its_equation_to_rounding() -> None:
    one = lane(100)
    (result,) = march(find("implicit_midpoint"), [one], FLOAT64)
    before, after = np.array([1.0, 0.0]), result.states[0]
    middle = (before + after) / 2
    expected = before + float(one.h) * np.array([middle[1], -9.81 * np.sin(middle[0])])
    np.testing.assert_allclose(after, expected, rtol=0, atol=1e-15)


def test_a_splitting_needs_a_separable_problem() -> None:
    class Whole(Pendulum):
        positions = 0

    with pytest.raises(ValueError, match="verlet needs positions apart from momenta; pendulum is not separable"):
        march(find("verlet"), [lane(100, Whole(1.0))], FLOAT64)


def test_a_long_march_of_many_lanes_gives_what_its_lanes_give_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    lanes = [lane(16384, Pendulum(theta0)) for theta0 in (1.0, 1.1, 2.0, 3.0)]
    plain = march(find("rk4"), lanes, FLOAT64)
    monkeypatch.setattr("compare.march.block_size.INLINE_SINE", 1)
    inlined = march(find("rk4"), lanes, FLOAT64)
    assert any(not np.array_equal(one.states, other.states) for one, other in zip(plain, inlined, strict=True))
    for one, other in zip(plain, inlined, strict=True):
        np.testing.assert_allclose(one.states, other.states, rtol=0, atol=1e-9)


def test_a_block_is_compiled_once_for_all_lanes_that_come_back_to_it(monkeypatch: pytest.MonkeyPatch) -> None:
    compiled = []

    def compile_and_count(*words: Any, **options: Any) -> Any:
        compiled.append(words)
        return compile_block(*words, **options)

    monkeypatch.setattr("compare.march.march.compile_block", compile_and_count)
    method = replace(find("rk4"), name="rk4_once")
    for amplitude in (1.0, 2.0):
        march(method, [lane(200, Pendulum(amplitude))], FLOAT64)
    assert len(compiled) == 1
    march(method, [lane(8192)], FLOAT64)
    assert len(compiled) == 2


def test_memory_does_not_grow_with_n() -> None:
    def peak(n: int) -> int:
        march(find("verlet"), [lane(n)], FLOAT64)
        tracemalloc.start()
        march(find("verlet"), [lane(n)], FLOAT64)
        _, largest = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        return largest

    assert peak(2**20) < 1.2 * peak(2**13) + 20_000
