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
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.march.block_size import Shape
from compare.march.lanes import CommonEquation, Lane, March, grain_of, initial_invariants
from compare.march.lanewise import Lanewise, obstacle
from compare.march.trace import carried, compile_block, entry_rows, plain_block
from reference.arithmetic.namespaces import NUMPY

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from compare.march.precision import Precision
    from compare.march.trace import Block
    from compare.methods.kinds.protocol import Method
    from reference.problem import Problem

__all__ = [
    "BRIEF",
    "CLOCKED_RUNS",
    "converged",
    "fits",
    "iterations_for",
    "lacking",
    "march",
    "march_alone",
]

CLOCKED_RUNS, BRIEF = 3, 0.02
"""A march alone of less than BRIEF seconds is clocked this often."""
WAITING = 256
"""Blocks whose last states wait to be kept."""
LINEAR = 1e-12
"""Of the sizes of velocities: by so much a sum of momenta may give others than their sum."""
CONVERGED = 1000
"""A last iteration may change the state by this many roundings."""


def iterations_for(method: Method, problem: Problem, h: float, bits: int) -> int:
    """Iterations that bring the equations of an implicit step to rounding; 0 for an explicit method."""
    return method.iterations(max(h * _rate(problem), sys.float_info.min), bits)


def lacking(method: Method, problem: Problem) -> str:
    """What a method needs that the problem has not, in words; "" where it fits."""
    if method.separable_only and not problem.positions:
        return f"needs positions apart from momenta; {problem.name} is not separable"
    if method.opaque and method.separable_only and (missing := _lacking_for_a_function(problem)):
        return missing
    if method.second_order_only and not problem.second_order:
        return f"marches q'' = F(q), which {problem.name} is not"
    if method.linear_velocities_only and not _moves_linearly(problem):
        return f"turns forces into velocities, which are not linear in the momenta in {problem.name}"
    if method.family == "conservative" and not problem.invariants:
        return f"keeps an invariant, and {problem.name} has none"
    return ""


def _lacking_for_a_function(problem: Problem) -> str:
    """What a separable step of somebody else's needs that the problem has not."""
    if not problem.original.autonomous:
        return f"gives its force no time, on which {problem.name} depends"
    return "" if _moves_by_momenta(problem) else f"takes p for the rate of q, which it is not in {problem.name}"


@lru_cache(maxsize=256)
def _moves_by_momenta(problem: Problem) -> bool:
    """Whether the momenta of a problem that splits are the rates of its positions, as is seen at some."""
    split: Any = problem
    momenta = [(3 * k + 2) / 7 for k in range(problem.positions)]
    parameters = {name: float(value) for name, value in problem.parameters.items()}
    return [float(rate) for rate in split.velocity(NUMPY, momenta, parameters)] == momenta


@lru_cache(maxsize=256)
def _moves_linearly(problem: Problem) -> bool:
    """Whether the velocities of a problem that splits are linear in its momenta, as is seen at some."""
    split: Any = problem
    parameters = {name: float(value) for name, value in problem.parameters.items()}
    count = len(problem.state_names) - problem.positions
    first, second = ([(part * k + 2) / 7 for k in range(count)] for part in (3, -5))
    points = ([a + b for a, b in zip(first, second, strict=True)], first, second, [0.0] * count)
    both, one, other, rest = ([float(v) for v in split.velocity(NUMPY, p, parameters)] for p in points)
    sizes = zip(both, one, other, rest, strict=True)
    return all(abs((a + z) - (b + c)) <= LINEAR * (abs(a) + abs(b) + abs(c) + abs(z)) for a, b, c, z in sizes)


def fits(method: Method, problem: Problem) -> bool:
    """Whether the problem has what the method needs: positions apart from momenta, q'' = F(q), or an invariant."""
    return not lacking(method, problem)


@lru_cache(maxsize=256)
def _rate(problem: Problem) -> float:
    return problem.rate()


def march(method: Method, lanes: Sequence[Lane], fmt: Precision, among: Sequence[Lane] | None = None) -> list[March]:
    """March every lane, and return what each gave, in order.

    Args:
        method: what takes the steps.
        lanes: what is marched.
        fmt: in which numbers.
        among: lanes for which blocks have been compiled, to be used again for these; none if None.

    Raises:
        ValueError: the problem lacks what the method needs: positions apart from momenta, or an invariant.
        TraceError: the compiled step is not the plain one.
    """
    results: dict[int, March] = {}
    for members, group in _groups(method, lanes, fmt, among):
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


def _groups(
    method: Method, lanes: Sequence[Lane], fmt: Precision, among: Sequence[Lane] | None = None
) -> Iterator[tuple[list[int], _Group | Lanewise]]:
    """The lanes, by their places, that share a compiled block, in order of falling N; each with its group."""
    groups = _sorted(method, lanes, fmt)
    known = groups if among is None else _sorted(method, among, fmt)
    for key, members in groups.items():
        mine = [lanes[i] for i in members]
        shared = [among[i] for i in known[key]] if among is not None and key in known else mine
        _, grain, iterations = key
        if obstacle(method, mine[0].problem, fmt):
            yield members, Lanewise(method, mine, fmt)
        else:
            yield members, _Group(method, mine, fmt, Shape.of(method, shared, fmt, grain, iterations))


def _sorted(method: Method, lanes: Sequence[Lane], fmt: Precision) -> dict[tuple[CommonEquation, int, int], list[int]]:
    """The places of the lanes that can share a block, by (equation, grain, iterations), in order of falling N."""
    groups: dict[tuple[CommonEquation, int, int], list[int]] = defaultdict(list)
    for i, lane in enumerate(lanes):
        if missing := lacking(method, lane.problem):
            raise ValueError(f"{method.name} {missing}.")
        iterations = iterations_for(method, lane.problem, float(lane.h), fmt.bits)
        grain = grain_of(lane.n)
        ends_of_blocks = math.gcd(*lane.samples) % grain == 0
        groups[CommonEquation.of(lane.problem), grain if ends_of_blocks else 1, iterations].append(i)
    for members in groups.values():
        members.sort(key=lambda i: -lanes[i].n)
    return groups


def converged(change: float, states: np.ndarray, start: np.ndarray, fmt: Precision) -> bool:
    """Whether the last iterations of implicit steps, which changed states by so much, were the last that count."""
    size = max(1.0, *(float(np.max(np.abs(one.astype(np.float64)))) for one in (states, start)))
    return change <= CONVERGED * fmt.epsilon * size


@lru_cache(maxsize=64)
def _compiled(method: Method, equation: CommonEquation, fmt: Precision, shape: Shape) -> Block:
    """``compile_block``, kept: a study comes back to the same block with other lanes."""
    return compile_block(
        method,
        equation.problem,
        fmt,
        shape.steps,
        shape.record,
        shape.batch,
        shape.iterations,
        inline_sine=shape.inline_sine,
        brief=shape.brief,
    )


class _Group:
    """Lanes in order of falling N, marched in lockstep by one compiled block until the longest has ended."""

    def __init__(self, method: Method, lanes: Sequence[Lane], fmt: Precision, shape: Shape) -> None:
        self.method, self.lanes, self.fmt = method, lanes, fmt
        self.every, self.steps, self.batch = shape.record == "every", shape.steps, shape.batch
        self.iterations = shape.iterations
        self.dimension, self.carried = len(lanes[0].problem.state_names), carried(lanes[0].problem)
        self.ends = np.array([lane.n for lane in lanes])
        self.block = _compiled(method, CommonEquation.of(lanes[0].problem), fmt, shape)
        self.states = self._room(lanes)
        self.maxima = np.zeros((len(lanes), self.carried))
        self.seconds = math.nan

    def alone(self, lane: Lane) -> _Group:
        """A group of one of the lanes that shares the compiled block."""
        one = copy.copy(self)
        one.lanes, one.ends = [lane], np.array([lane.n])
        one.states, one.maxima = self._room([lane]), np.zeros((1, self.carried))
        return one

    def _room(self, lanes: Sequence[Lane]) -> np.ndarray:
        """Zeros for the states to be kept: [lanes, samples, state], the samples those of the lane that has most."""
        return self.fmt.zeros((len(lanes), max(len(lane.samples) for lane in lanes), self.dimension))

    def run(self) -> list[March]:
        """March to the end of every lane, and note the seconds that the loop took."""
        lanes, parameters = self._start()
        rows = len(lanes)
        spare = self.fmt.zeros((self.block.out_rows(rows), lanes.shape[1]))
        out = self.fmt.zeros(spare.shape)
        events = self._events()
        closing = set((-(-self.ends // self.steps) * self.steps).tolist())
        waiting: list[tuple[np.ndarray, np.ndarray]] = []
        taken = 0
        began = time.perf_counter()
        while lanes.shape[1]:
            if taken == 0 and self.method.starting_steps:
                out[:] = self._opening(lanes, parameters)
            else:
                self.block(lanes, parameters, out)
            taken += self.steps
            lanes, out, spare = out[-rows:], spare, out
            if self.every:
                self._keep(spare.reshape(-1, rows, lanes.shape[1]), taken, events.get(taken))
            elif taken in events:
                waiting.append((events[taken], spare[: self.dimension].copy()))
            if len(waiting) == WAITING or (waiting and taken in closing):
                self._settle(waiting)
            if taken in closing:
                self._close(spare[-self.carried :], taken)
                width = self._width(taken)
                if width < lanes.shape[1]:
                    shrunk = (np.ascontiguousarray(array[:, :width]) for array in (lanes, parameters, out, spare))
                    lanes, parameters, out, spare = shrunk
        self.seconds = time.perf_counter() - began
        return [self._result(i) for i in range(len(self.lanes))]

    def _start(self) -> tuple[np.ndarray, np.ndarray]:
        """Input rows and parameter rows of the padded lanes."""
        padded = [*self.lanes, *[self.lanes[-1]] * (self._width(0) - len(self.lanes))]
        begins = [lane.start or lane.problem.start for lane in padded]
        starts = [self.fmt.array(begin[i] for begin in begins) for i in range(self.dimension)]
        names = list(padded[0].problem.parameters)
        parameters = [
            self.fmt.array(lane.h for lane in padded),
            *np.array([initial_invariants(lane.problem, self.fmt) for lane in padded], dtype=self.fmt.type).T,
            *(self.fmt.array(lane.problem.parameters[name] for lane in padded) for name in names),
        ]
        values = np.stack(parameters)
        rows = entry_rows(self.method, padded[0].problem, self.fmt, np.stack(starts), values)[0]
        rows[-self.carried :] = self.fmt.zeros((self.carried, len(padded)))
        return rows, values

    def _opening(self, lanes: np.ndarray, parameters: np.ndarray) -> np.ndarray:
        """What the first block gives where the method cannot take its first steps itself."""
        problem, states = self.lanes[0].problem, lanes[: self.dimension]
        rows = plain_block(self.method, problem, self.fmt, states, parameters, self.steps, self.iterations)
        if self.every:
            return rows.reshape(-1, lanes.shape[1])
        return np.concatenate([rows[-1, : -self.carried], rows[:, -self.carried :].max(axis=0)])

    def _events(self) -> dict[int, np.ndarray]:
        """Steps taken at the end of a block -> rows (lane, sample, index in the block's output) of states to keep."""
        steps = np.concatenate([lane.samples for lane in self.lanes])
        lanes = np.repeat(np.arange(len(self.lanes)), [len(lane.samples) for lane in self.lanes])
        samples = np.concatenate([np.arange(len(lane.samples)) for lane in self.lanes])
        short = -steps % self.steps
        order = np.argsort(steps + short, kind="stable")
        ends, first = np.unique((steps + short)[order], return_index=True)
        rows = np.split(np.stack([lanes, samples, -1 - short])[:, order], first[1:], axis=1)
        return dict(zip(ends.tolist(), rows, strict=True))

    def _keep(self, outputs: np.ndarray, taken: int, events: np.ndarray | None) -> None:
        """Keep the wanted states of a block of every state that ended at step ``taken``, and the largest maxima."""
        if events is not None:
            lane, sample, index = events
            self.states[lane, sample] = outputs[index, : self.dimension, lane]
        count = min(len(self.lanes), outputs.shape[2])
        values = outputs[:, -self.carried :, :count].astype(np.float64)
        step = np.arange(taken - self.steps, taken)[:, None, None]
        largest = np.where(step < self.ends[:count], values, 0.0).max(axis=0)
        self.maxima[:count] = np.maximum(self.maxima[:count], largest.T)

    def _settle(self, waiting: list[tuple[np.ndarray, np.ndarray]]) -> None:
        """Keep the wanted ones of the last states of many blocks: together they take little longer than one does."""
        lane, sample, _ = np.concatenate([events for events, _ in waiting], axis=1)
        block = np.repeat(np.arange(len(waiting)), [events.shape[1] for events, _ in waiting])
        self.states[lane, sample] = np.stack([states for _, states in waiting])[block, :, lane]
        waiting.clear()

    def _close(self, maxima: np.ndarray, taken: int) -> None:
        """Keep the largest drift and change of the lanes that end here, where blocks carry them along."""
        if not self.every:
            ended = np.flatnonzero(self.ends == taken)
            self.maxima[ended] = maxima[:, ended].T.astype(np.float64)

    def _width(self, taken: int) -> int:
        """Lanes still marching, padded to whole batches."""
        return self.batch * -(-int(np.count_nonzero(self.ends > taken)) // self.batch)

    def _result(self, i: int) -> March:
        lane = self.lanes[i]
        states = self.states[i, : len(lane.samples)]
        *drifts, change = map(float, self.maxima[i])
        if not converged(change, states, self.fmt.array(lane.start or lane.problem.start), self.fmt):
            states, drifts = np.full(states.shape, np.nan), [math.nan] * len(drifts)
        declared = self.method.evaluations(self.iterations)
        per_step, once = (self.block.calls, 0) if self.method.opaque else declared
        own = max(lane.n - self.method.starting_steps, 0)
        return March(states, tuple(drifts), per_step * own + once, self.method.jacobians(self.iterations) * own)
