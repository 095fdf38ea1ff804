"""A method and a problem, traced once with symbols and compiled by heyoka: a block of steps over lanes.

Every lane is one march of its own, with its own start, step size and parameters.  A block takes some steps; it gives
the state after every step, or after the last one with the running maxima of the changes of what is conserved.  What a
method remembers of earlier steps stands behind the state and is marched with it.

A step's expressions, differentiated, give its derivative by the state it starts from, exact but for rounding.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from compare.march.equation import BoundSystem, plain_system
from compare.march.sine import LaneArithmetic
from compare.methods.order.algebraic import Q
from compare.methods.own.hosting import hosted
from reference.arithmetic.compiler import hy, parameter_rows
from reference.arithmetic.namespaces import Heyoka

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from compare.march.precision import Precision
    from compare.methods.kinds.protocol import Method, State
    from reference.problem import Problem

__all__ = [
    "Block",
    "Record",
    "TraceError",
    "agree",
    "carried",
    "compile_block",
    "compiled_rates",
    "entry_rows",
    "plain_block",
    "random_points",
    "slopes_of",
]


def slopes_of(step: Sequence[Any], variables: Sequence[Any]) -> np.ndarray:
    """d(step)/d(variables) as expressions of heyoka: [step, variables]."""
    tensors = hy.diff_tensors(list(step), diff_args=list(variables), diff_order=1)
    return np.asarray(tensors.jacobian, dtype=object)


def compiled_rates(
    rates: Sequence[Any],
    variables: Sequence[Any],
    inputs: np.ndarray,
    plain: Sequence[Any],
    parameters: np.ndarray | None = None,
    **options: Any,
) -> Callable[..., np.ndarray] | None:
    """Rates [rate, lanes] of inputs [variable, lanes], compiled; None where they differ from the plain ones of these.

    Parameters are those up to the last that occurs.
    """
    outputs = [rate if isinstance(rate, hy.expression) else hy.expression(float(rate)) for rate in rates]
    function, rows = hy.cfunc(outputs, vars=list(variables), **options), parameter_rows(outputs)

    def evaluated(inputs: np.ndarray, parameters: np.ndarray | None = None) -> np.ndarray:
        given = {} if parameters is None else {"pars": parameters[:rows]}
        found: np.ndarray = function(inputs, **given)
        return found

    return (
        evaluated
        if agree(evaluated(np.ascontiguousarray(inputs), parameters), np.array(np.broadcast_arrays(*plain)))
        else None
    )


def agree(found: np.ndarray, plain: np.ndarray) -> bool:
    """Whether they differ by no more than AGREEMENT of their size, or of 1."""
    return bool(np.all(np.abs(found - plain) <= AGREEMENT * (1 + np.abs(plain))))


AGREEMENT = 1e-12
Record = Literal["every", "last"]
CHECK_LANES = 8


class TraceError(ArithmeticError):
    """A compiled step does not do what the plain step does."""


@dataclass(frozen=True)
class Block:
    """``steps`` compiled steps over lanes.

    Rows of the input are the state, the method's memory, then those that carry the running maxima: of each
    |invariant - start|, and of the change by the last iteration.  Rows of the output are the same: once, or with record
    "every" once per step with the values of that step in place of the maxima.  Parameter rows: h, the invariants at the
    start, the parameters; of these the function takes those up to the last that occurs in it.  ``calls`` are those of
    the right-hand side in a step, as they were counted.
    """

    function: Any
    steps: int
    batch: int
    record: Record
    parameters: int
    calls: int

    def __call__(self, lanes: np.ndarray, parameters: np.ndarray, out: np.ndarray) -> None:
        """Advance C-contiguous ``lanes`` [rows, lanes], whose number is a multiple of the batch, into ``out``."""
        self.function(lanes, pars=parameters[: self.parameters], outputs=out, batch_parallel=False)

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
    brief: bool = False,
    fast_math: bool = False,
) -> Block:
    """Trace ``steps`` steps of a method and compile them.

    ``iterations`` is for implicit methods; without ``drift`` the invariant is not followed and its row stays as it was.
    ``inline_sine``, for doubles, marches faster and compiles slower; ``brief`` compiles faster and marches slower;
    ``fast_math`` lets the compiler change the order of sums, and is for comparison alone.

    Raises:
        TraceError: the compiled block does not agree with the plain steps at random points.
    """
    dimension = len(problem.state_names)
    remembered = method.memory(dimension, problem.positions)
    y = _variables([*problem.state_names, *(f"memory_{i}" for i in range(remembered))])
    kept = len(problem.invariants)
    initial = [hy.par[1 + i] for i in range(kept)]
    symbols = {name: hy.par[i + 1 + kept] for i, name in enumerate(problem.parameters)}
    arithmetic = (LaneArithmetic if inline_sine else Heyoka)(fmt.number)
    system = BoundSystem(problem, arithmetic, symbols, fmt, initial)
    maxima = _variables((*(f"drift_{i}" for i in range(kept)), "change"))
    every: list[Any] = []
    state, largest = y, maxima
    for _ in range(steps):
        state, changes = method.step(system, state, hy.par[0], iterations)
        now = zip(system.invariants(state[:dimension]), initial, strict=True) if drift else ()
        off = [_size([value - level]) for value, level in now] if drift else list(maxima[:-1])
        moved = _size(changes) if changes else hy.expression(0.0)
        every += [*state, *off, moved]
        drifts = [_greater(*pair) for pair in zip(off, largest[:-1], strict=True)] if drift else off
        largest = *drifts, _greater(moved, largest[-1])
    outputs = list(map(_expression, every if record == "every" else [*state, *largest]))
    options = {"fast_math": fast_math, **fmt.compiler_options, **({"opt_level": 0} if brief else {})}
    function = hy.cfunc(outputs, vars=[*y, *maxima], batch_size=batch, **options)
    block = Block(function, steps, batch, record, parameter_rows(outputs), system.calls // steps)
    _trust(block, method, problem, fmt, iterations)
    return block


def _variables(names: Sequence[str]) -> tuple[Any, ...]:
    return tuple(hy.expression(name) for name in names)


def _expression(value: Any) -> Any:
    """A remembered slope of a curve's own coordinate is a number of the format, which a block gives as a constant."""
    return value if isinstance(value, hy.expression) else hy.expression(value)


def entry_rows(
    method: Method, problem: Problem, fmt: Precision, states: np.ndarray, parameters: np.ndarray
) -> np.ndarray:
    """The start of a march and every step of the method's starting procedure: [starting steps + 1, rows, lanes].

    The rows are those of a block's input; the last of them are complete, the others have zeros for a memory.
    """
    system = plain_system(problem, fmt, parameters)
    opened, y = method.start(system, tuple(states), parameters[0])
    before = [tuple(states), *opened][: method.starting_steps]
    blank = (fmt.zeros(states.shape[1:]),) * (len(y) - len(states))
    return np.stack([_rows(system, fmt, state, ()) for state in (*((*state, *blank) for state in before), y)])


def carried(problem: Problem) -> int:
    """How many rows carry maxima: one for each invariant, and one for the change by the last iteration."""
    return len(problem.invariants) + 1


def plain_block(
    method: Method,
    problem: Problem,
    fmt: Precision,
    states: np.ndarray,
    parameters: np.ndarray,
    steps: int,
    iterations: int,
) -> np.ndarray:
    """The first steps of a march on NumPy arrays, the method's starting procedure among them: [steps, rows, lanes].

    A step of somebody else's is for one state, and may give another answer for many: it is given one after another.
    """
    if method.opaque and states.ndim > 1:
        each: list[np.ndarray] = []
        with hosted(method.name, lambda: len(each)):
            lanes = zip(states.T, parameters.T, strict=True)
            each.extend(plain_block(method, problem, fmt, *lane, steps, iterations) for lane in lanes)
        return np.stack(each, axis=-1)
    system = plain_system(problem, fmt, parameters)
    found = list(entry_rows(method, problem, fmt, states, parameters))
    y: State = tuple(found[-1][: -carried(problem)])
    while len(found) <= steps:
        y, changes = method.step(system, y, parameters[0], iterations)
        found.append(_rows(system, fmt, y, changes))
    return np.stack(found[1:])


def _rows(system: BoundSystem, fmt: Precision, y: State, changes: State) -> np.ndarray:
    """State, memory, each |invariant - start| and the largest change of one step over all lanes."""
    zero = fmt.zeros(np.shape(y[0]))
    now = zip(system.invariants(y[: system.dimension]), system.initial, strict=True)
    off = [np.abs(value - level) + zero for value, level in now]
    moved = np.max(np.abs(np.stack(np.broadcast_arrays(*changes))), axis=0) if changes else zero
    return np.stack([*(component + zero for component in y), *off, moved])


def _trust(block: Block, method: Method, problem: Problem, fmt: Precision, iterations: int) -> None:
    """Hold the compiled block against the plain steps at random points: an ``if`` on a symbol is silently true."""
    states, parameters = random_points(problem, fmt, block.batch)
    plain = plain_block(method, problem, fmt, states, parameters, method.starting_steps + block.steps, iterations)
    entry = entry_rows(method, problem, fmt, states, parameters)[-1]
    out = fmt.zeros((block.out_rows(len(entry)), states.shape[1]))
    block(entry, parameters, out)
    traced = out.reshape(-1, *entry.shape)[:, : len(states)]
    expected = plain[-len(traced) :, : len(states)]
    gap = np.max(np.abs((traced - expected).astype(np.float64)))
    allowed = 1000 * block.steps * fmt.epsilon * (1 + np.max(np.abs(expected.astype(np.float64))))
    if not gap <= allowed:
        raise TraceError(
            f"{method.name} compiled for {problem.name} in {fmt.name} is off by {gap:.1e} from its plain evaluation "
            f"({allowed:.1e} is allowed); a step whose path depends on its values cannot be traced."
        )


def random_points(problem: Problem, fmt: Precision, batch: int) -> tuple[np.ndarray, np.ndarray]:
    """Random states, step sizes and parameters within the problem's intervals for a trial, each its own initial."""
    random = np.random.default_rng(20260101)
    lanes_count = batch * -(-CHECK_LANES // batch)
    trial, kept = problem.trial, len(problem.invariants)

    def column(low: float, high: float) -> np.ndarray:
        return fmt.array(Q(float(value)) for value in random.uniform(low, high, lanes_count))

    states = np.stack([column(*interval) for interval in trial.states])
    values = [column(*trial.parameters[name]) for name in problem.parameters]
    h = column(*trial.step)
    parameters = np.stack([h, *[fmt.zeros(h.shape)] * kept, *values])
    for i, level in enumerate(plain_system(problem, fmt, parameters).invariants(tuple(states))):
        parameters[1 + i] = level
    return states, parameters
