"""A step of somebody else's, one state after another in doubles, where it cannot be traced; and whether it can.

It is given a state of numbers, so that it may branch on them, work in place or call compiled code of its own; and so is
a whole integrator, which is given the grid of the steps.  What it evaluates is counted.
"""

from __future__ import annotations

import copy
import math
import time
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.march.equation import BoundSystem, FormatArithmetic, plain_system
from compare.march.lanes import CommonEquation, March, initial_invariants
from compare.march.trace import TraceError, agree, carried, compile_block, compiled_rates, random_points
from compare.methods.kinds.compensated import Compensated
from compare.methods.own.hosting import MAX_CALLS, Exhausted, MisuseError, hosted, repeatable
from compare.methods.own.step_function import StepFunction
from reference.arithmetic.compiler import hy
from reference.arithmetic.namespaces import Heyoka
from reference.names import printable
from reference.problem import NO_TIME

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from compare.march.lanes import Lane
    from compare.march.precision import Precision
    from compare.methods.kinds.protocol import Method, State
    from reference.problem import Problem

__all__ = ["Lanewise", "obstacle", "stepped"]

TRACED_CALLS = 64
"""Calls of f in one step up to which its expressions are worth compiling."""
MOST_SAID = 120
"""Characters of what stands in the way that are repeated."""
TRIAL_GRID = 16
"""Steps of the grid that a whole integrator is tried on."""
PART = 4096
"""Steps of which the states are held at a time."""
LONGEST_GRID = 1 << 24
"""Steps of the longest grid that a whole integrator is given."""


class CountedSystem(BoundSystem):
    """A problem's equation for one state of doubles, compiled, with its evaluations counted.

    ``limit`` is how many of them there may be.
    """

    def __init__(self, problem: Problem, fmt: Precision, parameters: np.ndarray) -> None:
        kept = 1 + len(problem.invariants)
        self._names = tuple(problem.parameters)
        self.values = np.array(parameters[kept:], dtype=np.float64)
        named = dict(zip(self._names, parameters[kept:], strict=True))
        super().__init__(problem, FormatArithmetic(fmt), named, fmt, tuple(parameters[1:kept]))
        self._rates = _rates(CommonEquation.of(problem), fmt)
        self.limit = MAX_CALLS

    def derivative(self, y: State) -> State:
        return tuple(self._rates(np.array(y, dtype=np.float64), self.asked()))

    def with_parameters(self, m: Any, y: State, values: Any) -> State:
        """The rates in another arithmetic, with other parameters."""
        found: State = self._problem.derivative(m, NO_TIME, y, dict(zip(self._names, values, strict=True)))
        return found

    def asked(self) -> np.ndarray:
        """The parameters, for one evaluation more."""
        self.calls += 1
        if self.calls > self.limit:
            raise Exhausted(f"called f more than {MAX_CALLS} times")
        return self.values


@lru_cache(maxsize=64)
def _rates(equation: CommonEquation, fmt: Precision) -> Callable[..., np.ndarray]:
    """The right-hand side of one state with parameters, compiled, and held against the plain one."""
    problem = equation.problem
    variables = [hy.expression(name) for name in problem.state_names]
    symbols = {name: hy.par[i] for i, name in enumerate(problem.parameters)}
    rates = BoundSystem(problem, Heyoka(fmt.number), symbols, fmt, ()).derivative(tuple(variables))
    states, rows = random_points(problem, fmt, 1)
    plain = plain_system(problem, fmt, rows).derivative(tuple(states))
    values = np.ascontiguousarray(rows[1 + len(problem.invariants) :])
    found = compiled_rates(rates, variables, states, plain, values, **fmt.compiler_options)
    if found is None:
        raise TraceError(f"the compiled rates of {problem.name} are not its plain ones.")
    return found


class Lanewise:
    """Lanes one after another, each state by state; with what a compiled group has."""

    def __init__(self, method: Method, lanes: Sequence[Lane], fmt: Precision) -> None:
        self.method, self.lanes, self.fmt = method, lanes, fmt
        self.seconds = math.nan
        self._taken = 0

    def alone(self, lane: Lane) -> Lanewise:
        """A group of one of the lanes."""
        one = copy.copy(self)
        one.lanes = [lane]
        return one

    def run(self) -> list[March]:
        """March to the end of every lane, and note the seconds that the steps took.

        Raises:
            MisuseError: a step fails, or does not return.
        """
        self.seconds = 0.0
        with hosted(self.method.name, lambda: self._taken):
            return [self._told(lane) for lane in self.lanes]

    def _told(self, lane: Lane) -> March:
        """The march of a lane; what is wrong with a step is said with where it was."""
        try:
            return self._march(lane)
        except MisuseError as error:
            raise MisuseError(f"on {lane.problem.original!r} with N = {lane.n}, {error}") from error

    def _march(self, lane: Lane) -> March:
        problem, fmt = lane.problem, self.fmt
        levels = initial_invariants(problem, fmt)
        values = map(fmt.number, problem.parameters.values())
        system = CountedSystem(problem, fmt, np.array([fmt.number(lane.h), *levels, *values], dtype=np.float64))
        y = tuple(fmt.array(lane.start or problem.start))
        whole = _whole(self.method)
        states, samples = np.full((len(lane.samples), len(y)), math.nan), np.array(lane.samples)
        drifts, taken = np.zeros(len(levels)), 0
        for rows in self._grid(whole, system, lane, y) if whole else self._parts(system, lane, y):
            low, high = np.searchsorted(samples, [taken + 1, taken + len(rows) + 1])
            states[low:high] = rows[samples[low:high] - taken - 1]
            with np.errstate(all="ignore"):
                for i, value in enumerate(system.invariants(tuple(rows.T))):
                    drifts[i] = np.maximum(drifts[i], np.max(np.abs(value - levels[i])))
            taken += len(rows)
        if taken < lane.n:
            drifts[:] = math.nan
        return March(states, tuple(map(float, drifts)), system.calls, 0)

    def _parts(self, system: CountedSystem, lane: Lane, y: State) -> Iterator[np.ndarray]:
        """The states after each step, so many at a time, up to the first that is no number."""
        h = self.fmt.number(lane.h)
        for first in range(0, lane.n, PART):
            rows = np.empty((min(PART, lane.n - first), len(y)))
            began = time.perf_counter()
            for i in range(len(rows)):
                system.time, system.limit = (first + i) * h, system.calls + MAX_CALLS
                y, _ = self.method.step(system, y, h)
                rows[i] = y
                self._taken += 1
                if not all(map(math.isfinite, y)):
                    self.seconds += time.perf_counter() - began
                    yield rows[: i + 1]
                    return
            self.seconds += time.perf_counter() - began
            yield rows

    def _grid(self, own: StepFunction, system: CountedSystem, lane: Lane, y: State) -> Iterator[np.ndarray]:
        """The states after each step, of a whole integrator."""
        if lane.n > LONGEST_GRID:
            raise MisuseError(
                f"{own.name} is a whole integrator, whose grid has at most {LONGEST_GRID} steps; fewer than "
                f"{lane.n} are accepted."
            )
        system.limit = MAX_CALLS * (lane.n + 1)
        begin = 0.0 if system.clock is None else float(y[system.clock])
        began = time.perf_counter()
        found = own.states(system, y, begin + self.fmt.number(lane.h) * np.arange(lane.n + 1))
        self.seconds += time.perf_counter() - began
        self._taken += lane.n
        yield found[1:]


def stepped(
    method: Method, problem: Problem, fmt: Precision, states: np.ndarray, parameters: np.ndarray, times: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """The states [state, lanes] a step later, one lane after another, and the evaluations of each.

    Raises:
        MisuseError: a step fails, or does not return.
    """
    found, calls = np.empty_like(states), np.zeros(states.shape[1], dtype=int)
    with hosted(method.name, lambda: int(np.count_nonzero(calls))):
        for i, y in enumerate(states.T):
            system = CountedSystem(problem, fmt, parameters[:, i])
            system.time = float(times[i])
            found[:, i], _ = method.step(system, tuple(y), parameters[0, i])
            calls[i] = system.calls
    return found, calls


def obstacle(method: Method, problem: Problem, fmt: Precision) -> str:
    """Why a method is marched state by state, in a few words; "" where it is traced and compiled.

    Raises:
        MisuseError: a step of somebody else's fails, gives no finite state or two answers to one question, or its
            additions cannot be compensated.
    """
    if not method.opaque:
        return ""
    equation = CommonEquation.of(problem)
    if not isinstance(method, Compensated):
        return _obstacle(method, equation, fmt)
    if why := _obstacle(method.base, equation, fmt) or _unsummed(method, equation, fmt):
        raise MisuseError(
            f"{method.base.name} cannot have compensated sums: {why}; a step that is traced, and adds increments to y, "
            "is accepted."
        )
    return ""


@lru_cache(maxsize=256)
def _unsummed(method: Method, equation: CommonEquation, fmt: Precision) -> str:
    """Why the additions of a step that is traced cannot be compensated."""
    try:
        compile_block(method, equation.problem, fmt, 1, "every", 1, brief=True)
    except (ValueError, TypeError, ArithmeticError, AttributeError) as error:
        return _shortened(error)
    return ""


@lru_cache(maxsize=256)
def _obstacle(method: Method, equation: CommonEquation, fmt: Precision) -> str:
    problem = equation.problem
    if (whole := _whole(method)) is not None:
        _hold_whole(whole, problem, fmt)
        return "it goes over the grid of the steps by itself"
    states, parameters, times = _trials(problem, fmt)
    expected, calls = stepped(method, problem, fmt, states, parameters, times)
    again, _ = stepped(method, problem, fmt, *(array[..., ::-1] for array in (states, parameters, times)))
    repeatable(method.name, expected, again[:, ::-1])
    _hold_finite(method, expected, states)
    if calls.min() < calls.max():
        return "its evaluations vary from step to step"
    if calls[0] > TRACED_CALLS:
        return f"it takes {calls[0]} evaluations in a step"
    try:
        block = compile_block(method, problem, fmt, 1, "every", 1, brief=True)
    except (ValueError, TypeError, ArithmeticError, RuntimeError) as error:
        return f"it cannot be traced with symbols: {_shortened(error)}"
    rows = np.vstack([states, fmt.zeros((carried(problem), states.shape[1]))])
    out = fmt.zeros(rows.shape)
    block(rows, parameters, out)
    return (
        "" if agree(out[: len(states)], expected) and block.calls == calls[0] else "what it does depends on its values"
    )


def _trials(problem: Problem, fmt: Precision) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Random states, parameter rows and times, and the problem's own start, where components may be exactly zero."""
    states, parameters = random_points(problem, fmt, 1)
    own = [parameters[0, 0], *initial_invariants(problem, fmt), *map(fmt.number, problem.parameters.values())]
    states = np.column_stack([states, fmt.array(problem.start)])
    parameters = np.column_stack([parameters, np.array(own, dtype=np.float64)])
    return states, parameters, parameters[0] * np.arange(states.shape[1])[::-1]


def _whole(method: Method) -> StepFunction | None:
    """The method, if it goes over a grid of times by itself."""
    return method if isinstance(method, StepFunction) and method.whole else None


def _hold_whole(method: StepFunction, problem: Problem, fmt: Precision) -> None:
    """Try a whole integrator twice, from the problem's start."""
    states, parameters, _ = _trials(problem, fmt)
    grid, answers = parameters[0, 0] * np.arange(TRIAL_GRID + 1), []
    for _ in range(2):
        system = CountedSystem(problem, fmt, parameters[:, -1])
        system.limit = MAX_CALLS * len(grid)
        with hosted(method.name):
            answers.append(method.states(system, tuple(states[:, -1]), grid))
    repeatable(method.name, *answers)
    _hold_finite(method, answers[0].T, states[:, -1:])


def _hold_finite(method: Method, found: np.ndarray, states: np.ndarray) -> None:
    """Refuse what is no number, of states that are."""
    if not np.all(np.isfinite(found)):
        lane = int(np.argmin(np.isfinite(found).all(axis=0)))
        y = ", ".join(f"{value:.4g}" for value in states[:, min(lane, states.shape[1] - 1)])
        raise MisuseError(
            f"{method.name} returned {found[:, lane].tolist()} for y = ({y}); finite numbers are accepted."
        )


def _shortened(error: Exception) -> str:
    """What an exception says, in no more than MOST_SAID characters."""
    said = printable(" ".join(str(error).split())).rstrip(".")
    return f"{said[:MOST_SAID]}..." if len(said) > MOST_SAID else said
