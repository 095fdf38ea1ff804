"""A method and a problem, traced once with symbols and compiled by heyoka: a block of steps over lanes.

Every lane is one march of its own, with its own start, step size and parameters.  A block takes some steps; it gives
the state after every step, or after the last one with the running maxima of the energy error.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from compare.algebraic import Q
from compare.sine import LaneArithmetic
from reference.arithmetic import NUMPY, Heyoka
from reference.compiler import hy

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.algebraic import Coefficient
    from compare.method import Method, State
    from compare.precision import Precision
    from reference.arithmetic import Arithmetic
    from reference.problem import Problem

__all__ = ["Block", "BoundSystem", "Record", "TraceError", "compile_block", "plain_block"]

Record = Literal["every", "last"]
CHECK_LANES = 8


class TraceError(ArithmeticError):
    """A compiled step does not do what the plain step does."""


class BoundSystem:
    """A problem's equation in one arithmetic, its parameters numbers of that arithmetic."""

    def __init__(self, problem: Problem, m: Arithmetic, parameters: dict[str, Any], fmt: Precision) -> None:
        self.positions: int = getattr(problem, "positions", 0)
        self._problem: Any = problem
        self._m = m
        self._parameters = parameters
        self._fmt = fmt
        self._numbers: dict[Coefficient, Any] = {}

    def number(self, value: Coefficient) -> Any:
        if value not in self._numbers:
            rounded = self._fmt.number(value)
            self._numbers[value] = hy.expression(rounded) if isinstance(self._m, Heyoka) else rounded
        return self._numbers[value]

    def derivative(self, y: State) -> State:
        return tuple(self._problem.derivative(self._m, y, self._parameters))

    def velocity(self, momenta: State) -> State:
        return tuple(self._problem.velocity(self._m, momenta, self._parameters))

    def force(self, positions: State) -> State:
        return tuple(self._problem.force(self._m, positions, self._parameters))

    def invariant(self, y: State) -> Any:
        """The problem's conserved quantity above its least value."""
        return self._problem.invariant(self._m, y, self._parameters)


@dataclass(frozen=True)
class Block:
    """``steps`` compiled steps over lanes.

    Rows of the input are the state, then two that carry the running maxima of |invariant - start| and of the change
    by the last fixed-point iteration.  Rows of the output are the same: once, or with record "every" once per step
    with the values of that step in place of the maxima.  Parameter rows: h, the start's invariant, the parameters.
    """

    function: Any
    steps: int
    batch: int
    record: Record

    def __call__(self, lanes: np.ndarray, parameters: np.ndarray, out: np.ndarray) -> None:
        """Advance C-contiguous ``lanes`` [rows, lanes], whose number is a multiple of the batch, into ``out``."""
        self.function(lanes, pars=parameters, outputs=out, batch_parallel=False)

    def out_rows(self, rows: int) -> int:
        """How many rows the output has for inputs of ``rows`` rows."""
        return rows * (self.steps if self.record == "every" else 1)


def _greater(a: Any, b: Any) -> Any:
    """max(a, b), where a NaN in ``a`` wins."""
    return hy.select(hy.lte(a, b), b, a)


def _size(values: Sequence[Any]) -> Any:
    """The largest absolute value of some expressions."""
    sizes = [hy.select(hy.lt(value, 0.0), -value, value) for value in values]
    largest = sizes[0]
    for size in sizes[1:]:
        largest = _greater(size, largest)
    return largest


def compile_block(
    method: Method,
    problem: Problem,
    fmt: Precision,
    steps: int,
    record: Record,
    batch: int,
    iterations: int = 0,
    *,
    drift: bool = True,
    inline_sine: bool = False,
) -> Block:
    """Trace ``steps`` steps of a method and compile them.

    ``iterations`` is for implicit methods; without ``drift`` the invariant is not followed and its row stays as it was.
    ``inline_sine``, for doubles, marches faster and compiles slower.

    Raises:
        TraceError: the compiled block does not agree with the plain steps at random points.
    """
    y = _variables(problem.state_names)
    symbols = {name: hy.par[i + 2] for i, name in enumerate(problem.parameters)}
    arithmetic = (LaneArithmetic if inline_sine else Heyoka)(fmt.number)
    system = BoundSystem(problem, arithmetic, symbols, fmt)
    maxima = _variables(("drift", "change"))
    every: list[Any] = []
    state, largest = y, maxima
    for _ in range(steps):
        state, changes = method.step(system, state, hy.par[0], iterations)
        off = _size([system.invariant(state) - hy.par[1]]) if drift else maxima[0]
        moved = _size(changes) if changes else hy.expression(0.0)
        every += [*state, off, moved]
        largest = (_greater(off, largest[0]) if drift else off), _greater(moved, largest[1])
    outputs = every if record == "every" else [*state, *largest]
    function = hy.cfunc(outputs, vars=[*y, *maxima], batch_size=batch, **fmt.compiler_options)
    block = Block(function, steps, batch, record)
    _trust(block, method, problem, fmt, iterations)
    return block


def _variables(names: Sequence[str]) -> tuple[Any, ...]:
    return tuple(hy.expression(name) for name in names)


def plain_block(
    method: Method,
    problem: Problem,
    fmt: Precision,
    lanes: np.ndarray,
    parameters: np.ndarray,
    steps: int,
    iterations: int,
) -> np.ndarray:
    """The same steps on NumPy arrays, nothing compiled: states of shape [steps, state, lanes]."""
    values = dict(zip(problem.parameters, parameters[2:], strict=True))
    system = BoundSystem(problem, NUMPY, values, fmt)
    state: State = tuple(lanes[: len(problem.state_names)])
    found = []
    for _ in range(steps):
        state, _change = method.step(system, state, parameters[0], iterations)
        found.append(np.stack(state))
    return np.stack(found)


def _trust(block: Block, method: Method, problem: Problem, fmt: Precision, iterations: int) -> None:
    """Hold the compiled block against the plain steps at random points: an ``if`` on a symbol is silently true."""
    lanes, parameters = _random_points(problem, fmt, block.batch)
    rows = len(problem.state_names)
    out = fmt.zeros((block.out_rows(len(lanes)), lanes.shape[1]))
    block(lanes, parameters, out)
    plain = plain_block(method, problem, fmt, lanes, parameters, block.steps, iterations)
    traced = out.reshape(-1, len(lanes), lanes.shape[1])[:, :rows]
    gap = np.max(np.abs((traced - plain[-len(traced) :]).astype(np.float64)))
    allowed = 1000 * block.steps * fmt.epsilon * (1 + np.max(np.abs(plain.astype(np.float64))))
    if not gap <= allowed:
        raise TraceError(
            f"{method.name} compiled for {problem.name} in {fmt.name} is off by {gap:.1e} from its plain evaluation "
            f"({allowed:.1e} is allowed); a step whose path depends on its values cannot be traced."
        )


def _random_points(problem: Problem, fmt: Precision, batch: int) -> tuple[np.ndarray, np.ndarray]:
    """Random states within (-3, 3), step sizes within (0.01, 0.1) and parameters within (1/2, 2)."""
    random = np.random.default_rng(20260101)
    lanes_count = batch * -(-CHECK_LANES // batch)

    def column(low: float, high: float) -> np.ndarray:
        return fmt.array(Q(float(value)) for value in random.uniform(low, high, lanes_count))

    zero = fmt.zeros((lanes_count,))
    lanes = np.stack([*(column(-3, 3) for _ in problem.state_names), zero, zero])
    values = [column(0.5, 2) for _ in problem.parameters]
    return lanes, np.stack([column(0.01, 0.1), zero, *values])
