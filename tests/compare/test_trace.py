"""A compiled block is the plain step, in every format, or it is refused."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import heyoka as hy
import numpy as np
import pytest

from compare.march.equation import plain_system
from compare.march.precision import FORMATS, Precision, precision
from compare.march.trace import TraceError, compile_block, entry_rows, plain_block
from compare.methods import METHODS, find
from compare.methods.kinds.one_step import Tableau
from compare.methods.order.algebraic import Q
from reference import Pendulum

if TYPE_CHECKING:
    from compare.methods.kinds.protocol import Method

FLOAT64 = precision("float64")
PENDULUM = Pendulum(1.0)
LONG_STEP = 20
"""Evaluations of a step that takes long to compile."""


def lanes_of(fmt: Precision, count: int) -> tuple[np.ndarray, np.ndarray]:
    zero = fmt.zeros((count,))
    angles = fmt.array(Q(k + 1, count + 1) for k in range(count))
    ones = fmt.array([1] * count)
    parameters = np.stack([ones / 64, zero, ones * 10, ones])
    parameters[1] = plain_system(PENDULUM, fmt, parameters).invariant((angles, zero))
    return np.stack([angles, zero, zero, zero]), parameters


def gap_to_plain_steps(method: Method, fmt: Precision) -> float:
    """Between four compiled steps after a starting procedure, or one long one, and the same on NumPy arrays."""
    iterations = method.iterations(0.1, fmt.bits)
    steps = 4 if method.evaluations(iterations)[0] < LONG_STEP else 1
    block = compile_block(method, PENDULUM, fmt, steps, "every", min(8, fmt.lanes), iterations)
    lanes, parameters = lanes_of(fmt, 8)
    entry = entry_rows(method, PENDULUM, fmt, lanes[:2], parameters)[-1]
    out = fmt.zeros((block.out_rows(len(entry)), 8))
    block(entry, parameters, out)
    plain = plain_block(method, PENDULUM, fmt, lanes[:2], parameters, method.starting_steps + steps, iterations)
    gaps = out.reshape(steps, len(entry), 8)[:, :2] - plain[-steps:, :2]
    return float(np.max(np.abs(gaps.astype(np.float64))))


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.name)
def test_a_block_of_every_method_gives_the_plain_steps(method: Method) -> None:
    assert gap_to_plain_steps(method, FLOAT64) < 200 * FLOAT64.epsilon


@pytest.mark.parametrize(
    "name", ["rk4", "yoshida4", "implicit_midpoint", "abm4", "bdf2", "cowell4", "gonzalez", "taylor12"]
)
@pytest.mark.parametrize("fmt", [*FORMATS, precision("mp:150")], ids=lambda fmt: fmt.name)
def test_a_block_gives_the_plain_steps_in_every_format(name: str, fmt: Precision) -> None:
    assert gap_to_plain_steps(find(name), fmt) < 200 * fmt.epsilon


def test_a_block_with_its_sine_inlined_is_the_same_block() -> None:
    lanes, parameters = lanes_of(FLOAT64, 8)
    outs = []
    for inline in (False, True):
        block = compile_block(find("rk4"), PENDULUM, FLOAT64, 16, "every", 8, inline_sine=inline)
        outs.append(FLOAT64.zeros((block.out_rows(4), 8)))
        block(lanes, parameters, outs[-1])
    assert not np.array_equal(outs[0], outs[1])
    np.testing.assert_allclose(outs[0], outs[1], rtol=0, atol=1e-14)


def test_the_last_state_and_the_maxima_are_those_of_every_step() -> None:
    lanes, parameters = lanes_of(FLOAT64, 8)
    every = compile_block(find("rk4"), PENDULUM, FLOAT64, 16, "every", 8)
    last = compile_block(find("rk4"), PENDULUM, FLOAT64, 16, "last", 8)
    listed, ended = FLOAT64.zeros((64, 8)), FLOAT64.zeros((4, 8))
    every(lanes, parameters, listed)
    last(lanes, parameters, ended)
    steps = listed.reshape(16, 4, 8)
    np.testing.assert_allclose(ended[:2], steps[-1, :2], rtol=1e-13)
    np.testing.assert_allclose(ended[2], steps[:, 2].max(axis=0), rtol=1e-13)


def test_a_state_that_is_not_a_number_is_not_lost_in_the_maximum() -> None:
    lanes, parameters = lanes_of(FLOAT64, 8)
    lanes[0, 3] = np.nan
    block = compile_block(find("euler"), PENDULUM, FLOAT64, 16, "last", 8)
    out = FLOAT64.zeros((4, 8))
    block(lanes, parameters, out)
    assert np.isnan(out[2, 3])
    assert np.all(np.isfinite(np.delete(out, 3, axis=1)))


@dataclass(frozen=True)
class BranchingEuler(Tableau):
    """Euler's method that takes half a step where the angle is negative: no trace can follow it."""

    def step(self, system: Any, y: Any, h: Any, iterations: int = 0) -> Any:
        if isinstance(y[0], hy.expression):
            return super().step(system, y, h if y[0] else h / 2, iterations)
        slope = system.derivative(y)
        size = np.where(y[0] < 0, h / 2, h)
        return tuple(component + size * rate for component, rate in zip(y, slope, strict=True)), ()


def test_a_step_with_a_branch_on_a_symbol_is_refused() -> None:
    branching = BranchingEuler("branching", 1, "none", ((),), (Q(1),))
    with pytest.raises(TraceError, match="branching compiled for pendulum in float64 is off by"):
        compile_block(branching, PENDULUM, FLOAT64, 4, "last", 8)
