"""The loop over steps: every number of steps and every start a lane, in memory that does not grow with N.

Lanes that can share a compiled block are marched together.  In a long march whose N is a multiple of a power of two
the block is long and gives its last state only, and samples fall on the ends of blocks; elsewhere the block is short
and gives every state.
"""

from __future__ import annotations

import copy
import math
import sys
import time
from collections import defaultdict
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.aspects import conserves
from compare.trace import compile_block, entry_rows, plain_block
from reference.arithmetic import BALL

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from flint import arb

    from compare.contract import Method
    from compare.precision import Precision
    from compare.trace import Block, Record
    from reference.problem import Problem

__all__ = ["Lane", "March", "StartInvariant", "iterations_for", "march", "march_alone", "sample_steps"]

LONG_BLOCKS, SHORT_BLOCK = (64, 32, 16), 8
LONG_MARCH = 8192
BLOCK_SIZE, WIDE_BLOCK_SIZE = 256, 32
"""Evaluations in a compiled block, about: many where a call costs as much as hundreds of steps, few in wide formats."""
JACOBIAN_SIZE, JACOBIAN_BATCH = 3, 16
"""A Jacobian and what is solved with it is code for so many evaluations, and fills the registers of so many lanes."""
INLINE_SINE = 10**9
"""Evaluations from which the sine is compiled into the march: the seconds that it takes are then won back."""
CLOCKED_RUNS, BRIEF = 3, 0.02
"""A march alone of less than BRIEF seconds is clocked this often."""
CONVERGED = 1000
"""A last iteration may change the state by this many roundings."""


@dataclass(frozen=True)
class Lane:
    """One march: a problem from its start in n steps of size h.

    Attributes:
        h: the exact step size, a number of the format.
        samples: the step numbers, increasing and at most n, at which the state is kept.
    """

    problem: Problem
    n: int
    h: Fraction
    samples: tuple[int, ...]


@dataclass(frozen=True)
class March:
    """What a lane gave.

    Attributes:
        states: [samples, state] in the format; NaN where the stage equations of an implicit method did not converge.
        max_drift: the largest |invariant - its start| after any step.
        evaluations: of the right-hand side, over the march.
        jacobians: evaluations of its Jacobian, or of the invariant's gradient.
    """

    states: np.ndarray
    max_drift: float
    evaluations: int
    jacobians: int


@dataclass(frozen=True)
class StartInvariant:
    """The invariant of a problem at its exact start, to be rounded to any format."""

    problem: Problem

    def ball(self) -> arb:
        """The enclosure at the precision in force; 0 where the problem conserves nothing."""
        if not conserves(self.problem):
            return BALL.number(Fraction(0))
        start = [BALL.number(value) for value in self.problem.start]
        parameters = {name: BALL.number(value) for name, value in self.problem.parameters.items()}
        ball: arb = self.problem.invariant(BALL, start, parameters)
        return ball


def sample_steps(n: int, count: int) -> tuple[int, ...]:
    """At most ``count`` steps spread evenly over 1 ... n, the last n, each at the end of a block of the march."""
    grain = _grain(n)
    spread = min(count, n // grain)
    return tuple(grain * -(-(n // grain) * (j + 1) // spread) for j in range(spread))


def _grain(n: int) -> int:
    """Steps per block where only the last state of each is wanted; 1 where every state is."""
    return next((block for block in LONG_BLOCKS if n % block == 0 and n >= LONG_MARCH), 1)


def _block_steps(grain: int, size: int, fmt: Precision, opening: int) -> int:
    """Steps that one compiled block takes: a divisor of the grain that keeps the block's code of moderate length."""
    shortest = 1 << max(opening - 1, 0).bit_length()
    room = BLOCK_SIZE if fmt.lanes > 1 else WIDE_BLOCK_SIZE
    while grain > shortest and grain * size > room:
        grain //= 2
    return grain


def iterations_for(method: Method, problem: Problem, h: float, bits: int) -> int:
    """Iterations that bring the equations of an implicit step to rounding; 0 for an explicit method."""
    return method.iterations(max(h * problem.rate(), sys.float_info.min), bits)


def march(method: Method, lanes: Sequence[Lane], fmt: Precision) -> list[March]:
    """March every lane, and return what each gave, in order.

    Raises:
        ValueError: the method needs a separable problem and this one is not.
        TraceError: the compiled step is not the plain one.
    """
    results: dict[int, March] = {}
    for members, group in _groups(method, lanes, fmt):
        results.update(zip(members, group.run(), strict=True))
    return [results[i] for i in range(len(lanes))]


def march_alone(method: Method, lanes: Sequence[Lane], fmt: Precision) -> list[tuple[March, float]]:
    """March every lane by itself, and return what each gave with the seconds of its loop over the steps.

    What the lanes share is compiled once, before; of a short march the shortest of a few counts.  Raises as ``march``.
    """
    results: dict[int, tuple[March, float]] = {}
    for members, group in _groups(method, lanes, fmt):
        for i in members:
            alone = group.alone(lanes[i])
            seconds = math.inf
            for _ in range(CLOCKED_RUNS):
                (result,) = alone.run()
                seconds = min(seconds, alone.seconds)
                if alone.seconds > BRIEF:
                    break
            results[i] = result, seconds
    return [results[i] for i in range(len(lanes))]


def _groups(method: Method, lanes: Sequence[Lane], fmt: Precision) -> Iterator[tuple[list[int], _Group]]:
    """The lanes, by their places, that share a compiled block, in order of falling N; each with its group."""
    groups: dict[Any, list[int]] = defaultdict(list)
    for i, lane in enumerate(lanes):
        if method.separable_only and not getattr(lane.problem, "positions", 0):
            raise ValueError(f"{method.name} splits kicks from drifts, and {lane.problem.name} is not separable.")
        iterations = iterations_for(method, lane.problem, float(lane.h), fmt.bits)
        grain = _grain(lane.n)
        if any(step % grain for step in lane.samples):
            grain = 1
        groups[_equation(lane.problem), grain, iterations].append(i)
    for (_, grain, iterations), members in groups.items():
        members.sort(key=lambda i: -lanes[i].n)
        yield members, _Group(method, [lanes[i] for i in members], fmt, grain, iterations)


def _equation(problem: Problem) -> Any:
    """What problems must share to share a block: an equation, which on a curve depends on more than parameters."""
    return type(problem), getattr(problem, "curve", None)


class _Group:
    """Lanes in order of falling N, marched in lockstep by one compiled block until the longest has ended."""

    def __init__(self, method: Method, lanes: Sequence[Lane], fmt: Precision, grain: int, iterations: int) -> None:
        self.method, self.lanes, self.fmt, self.iterations = method, lanes, fmt, iterations
        problem = lanes[0].problem
        self.every = grain == 1
        evaluations, jacobians = method.evaluations(iterations)[0], method.jacobians(iterations)
        inline = fmt.type is float and sum(lane.n for lane in lanes) * evaluations >= INLINE_SINE
        size = evaluations * (4 if inline else 1) + jacobians * JACOBIAN_SIZE
        self.steps = _block_steps(SHORT_BLOCK if self.every else grain, size, fmt, method.opening)
        lasting = sum(8 * lane.n >= lanes[0].n for lane in lanes)
        batch = min(fmt.lanes, 1 << (max(lasting, 8) - 1).bit_length())
        self.batch = min(batch, JACOBIAN_BATCH) if jacobians else batch
        self.dimension = len(problem.state_names)
        self.ends = np.array([lane.n for lane in lanes])
        record: Record = "every" if self.every else "last"
        self.block: Block = compile_block(
            method, problem, fmt, self.steps, record, self.batch, iterations, inline_sine=inline
        )
        self.states = [fmt.zeros((len(lane.samples), self.dimension)) for lane in lanes]
        self.maxima = np.zeros((len(lanes), 2))
        self.seconds = math.nan

    def alone(self, lane: Lane) -> _Group:
        """A group of one of the lanes that shares the compiled block."""
        one = copy.copy(self)
        one.lanes, one.ends = [lane], np.array([lane.n])
        one.states, one.maxima = [self.fmt.zeros((len(lane.samples), self.dimension))], np.zeros((1, 2))
        return one

    def run(self) -> list[March]:
        """March to the end of every lane, and note the seconds that the loop took."""
        lanes, parameters = self._start()
        rows = len(lanes)
        spare = self.fmt.zeros((self.block.out_rows(rows), lanes.shape[1]))
        out = self.fmt.zeros(spare.shape)
        events = self._events()
        taken = 0
        began = time.perf_counter()
        while lanes.shape[1]:
            if taken == 0 and self.method.opening:
                out[:] = self._opening(lanes, parameters)
            else:
                self.block(lanes, parameters, out)
            taken += self.steps
            lanes, out, spare = out[-rows:], spare, out
            if self.every or taken in events:
                self._keep(spare.reshape(-1, rows, lanes.shape[1]), taken, events.get(taken, ()))
                width = self._width(taken)
                if width < lanes.shape[1]:
                    shrunk = (np.ascontiguousarray(array[:, :width]) for array in (lanes, parameters, out, spare))
                    lanes, parameters, out, spare = shrunk
        self.seconds = time.perf_counter() - began
        return [self._result(i) for i in range(len(self.lanes))]

    def _start(self) -> tuple[np.ndarray, np.ndarray]:
        """Input rows and parameter rows of the padded lanes."""
        padded = [*self.lanes, *[self.lanes[-1]] * (self._width(0) - len(self.lanes))]
        starts = [self.fmt.array(lane.problem.start[i] for lane in padded) for i in range(self.dimension)]
        names = list(padded[0].problem.parameters)
        invariants = {lane.problem: self.fmt.number(StartInvariant(lane.problem)) for lane in padded}
        parameters = [
            self.fmt.array(lane.h for lane in padded),
            np.array([invariants[lane.problem] for lane in padded], dtype=self.fmt.type),
            *(self.fmt.array(lane.problem.parameters[name] for lane in padded) for name in names),
        ]
        values = np.stack(parameters)
        rows = entry_rows(self.method, padded[0].problem, self.fmt, np.stack(starts), values)[0]
        rows[-2:] = self.fmt.zeros((2, len(padded)))
        return rows, values

    def _opening(self, lanes: np.ndarray, parameters: np.ndarray) -> np.ndarray:
        """What the first block gives where the method cannot take its first steps itself."""
        problem, states = self.lanes[0].problem, lanes[: self.dimension]
        rows = plain_block(self.method, problem, self.fmt, states, parameters, self.steps, self.iterations)
        if self.every:
            return rows.reshape(-1, lanes.shape[1])
        return np.concatenate([rows[-1, :-2], rows[:, -2:].max(axis=0)])

    def _events(self) -> dict[int, list[tuple[int, int, int]]]:
        """Steps taken at the end of a block -> (lane, sample, index in the block's output) of the states to keep."""
        events: dict[int, list[tuple[int, int, int]]] = defaultdict(list)
        for i, lane in enumerate(self.lanes):
            for sample, step in enumerate(lane.samples):
                short = -step % self.steps
                events[step + short].append((i, sample, -1 - short))
        return events

    def _keep(self, outputs: np.ndarray, taken: int, events: Sequence[tuple[int, int, int]]) -> None:
        """Keep the wanted states of a block that ended at step ``taken``, and the largest drift and change."""
        for lane, sample, index in events:
            self.states[lane][sample] = outputs[index, : self.dimension, lane]
        count = min(len(self.lanes), outputs.shape[2])
        if self.every:
            values = outputs[:, -2:, :count].astype(np.float64)
            step = np.arange(taken - self.steps, taken)[:, None, None]
            largest = np.where(step < self.ends[:count], values, 0.0).max(axis=0)
            self.maxima[:count] = np.maximum(self.maxima[:count], largest.T)
        else:
            ended = np.flatnonzero(self.ends[:count] == taken)
            self.maxima[ended] = outputs[-1, -2:, ended].astype(np.float64)

    def _width(self, taken: int) -> int:
        """Lanes still marching, padded to whole batches."""
        return self.batch * -(-int(np.count_nonzero(self.ends > taken)) // self.batch)

    def _result(self, i: int) -> March:
        lane, states = self.lanes[i], self.states[i]
        drift, change = self.maxima[i]
        size = max(1.0, float(np.max(np.abs(states.astype(np.float64)))))
        if not change <= CONVERGED * self.fmt.epsilon * size:
            states, drift = np.full(states.shape, np.nan), math.nan
        per_step, once = self.method.evaluations(self.iterations)
        own = max(lane.n - self.method.opening, 0)
        return March(states, float(drift), per_step * own + once, self.method.jacobians(self.iterations) * own)
