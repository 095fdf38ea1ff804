"""Marches of embedded pairs with a controlled step: every problem, tolerance and controller a lane, compiled.

An attempt at a step is traced with its error, its acceptance and the next step size, so that the loop over attempts is
calls of one compiled function, of which each takes what the one before gave.  The rules stand in
``compare.march.controllers``.

The steps go as they please and only the last is cut, at the end.  The state at a sample is that of a step of the same
pair from the last accepted state before it, exactly as long as the sample is away: it errs by no more than the step
that passes it, and what it costs is not the march's.
"""

from __future__ import annotations

import math
import time
from collections import defaultdict
from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any, TypeGuard

import numpy as np

from compare.march import controllers as rules
from compare.march.equation import BoundSystem, plain_system
from compare.march.lanes import CommonEquation, initial_invariants
from compare.march.march import lacking
from compare.march.trace import TraceError, random_points
from compare.methods.kinds.protocol import Pair
from reference.arithmetic.compiler import hy, parameter_rows
from reference.arithmetic.namespaces import Heyoka

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.march.controllers import Controller
    from compare.march.lanes import Lane
    from compare.march.precision import Precision
    from compare.methods.kinds.protocol import Method
    from reference.problem import Problem

__all__ = ["MOST_ATTEMPTS", "AdaptiveLane", "AdaptiveMarch", "estimate_order", "is_pair", "march_adaptive", "refusal"]

MOST_ATTEMPTS = 200_000
"""At a step, accepted or not: a march that takes more is lost."""
FEW_CALLS, MANY_CALLS = 64, 2048
"""Of the compiled attempt, between two looks at what they gave: twice as many each time."""
BATCH = 8
"""Lanes in a batch at most: wider ones take longer to compile than they save."""
STIFFNESS = 0.5
"""The step times the Lipschitz rate up to which an implicit pair's iterations suffice; a longer one is rejected."""
ROUNDINGS = 1000
"""By which a compiled step may be off from the plain one."""
LARGEST = 1e30
"""An error of so many tolerances tells nothing."""
CARRIED = ("time", "h", "last_h", "last_ratio", "last_error", "error_before", "accepted", "attempts", "rejected")
"""What a lane carries from attempt to attempt behind its state; errors and ratios as logarithms."""
PARAMETERS = ("end", "shortest", "most", "rtol", "atol", "b1", "b2", "b3", "a2", "a3", "depth")
"""What a lane has besides the problem's parameters: the shortest step is a part of the time, the most attempts are a
number, and b_i are over k."""


@dataclass(frozen=True)
class AdaptiveLane:
    """One march with a controlled step.

    Attributes:
        lane: the problem, its end n h, and where samples are: at multiples of h.
        controller: of the step size.
        rtol, atol: the tolerances, numbers of the format; the error tolerated is atol + rtol |y| in each component.
    """

    lane: Lane
    controller: Controller
    rtol: Fraction
    atol: Fraction


@dataclass(frozen=True)
class AdaptiveMarch:
    """What a lane gave.

    Attributes:
        states: [samples, state] in the format; NaN after the time at which a march is lost.
        accepted, rejected: attempts at a step.
        evaluations: of the right-hand side, those for the first step size among them.
        jacobians: evaluations of its Jacobian.
        failure: why the march is lost, or "".
        seconds: of the loop over the attempts, of all lanes that went through it together.
    """

    states: np.ndarray
    accepted: int
    rejected: int
    evaluations: int
    jacobians: int
    failure: str
    seconds: float


def is_pair(method: Method) -> TypeGuard[Pair]:
    """Whether a method has an embedded result that tells the error of its step."""
    return isinstance(method, Pair) and bool(method.embedded)


def refusal(method: Method, problem: Problem) -> str:
    """Why a method cannot control its step on a problem, in words; "" where it can."""
    return lacking(method, problem) if is_pair(method) else "has no embedded result to estimate an error by"


def estimate_order(pair: Pair) -> int:
    """k, where the error that is estimated is of the order h^k."""
    orders = sorted({min(pair.order, other.order) for other in pair.embedded}, reverse=True)
    return orders[0] + 1 if len(orders) == 1 else 2 * (orders[0] + 1) - (orders[1] + 1)


def march_adaptive(
    pair: Pair, lanes: Sequence[AdaptiveLane], fmt: Precision, most: int = MOST_ATTEMPTS
) -> list[AdaptiveMarch]:
    """March every lane, and return what each gave, in order; one that is lost says why.

    Args:
        pair: what takes the steps and estimates their errors.
        lanes: what is marched.
        fmt: in which numbers.
        most: attempts at a step that a lane is granted.

    Raises:
        ValueError: the method has no embedded result, or the problem lacks what it needs.
        TraceError: the compiled step is not the plain one.
    """
    groups: dict[tuple[CommonEquation, int], list[int]] = defaultdict(list)
    for i, one in enumerate(lanes):
        if why := refusal(pair, one.lane.problem):
            raise ValueError(f"{pair.name} {why}.")
        bits = math.ceil(-math.log2(one.rtol))
        groups[CommonEquation.of(one.lane.problem), pair.iterations(STIFFNESS, bits)].append(i)
    results: dict[int, AdaptiveMarch] = {}
    for (_, iterations), members in groups.items():
        members.sort(key=lambda i: lanes[i].rtol)
        group = _Group(pair, [lanes[i] for i in members], fmt, iterations, most)
        results.update(zip(members, group.run(), strict=True))
    return [results[i] for i in range(len(lanes))]


@dataclass(frozen=True)
class _Rows:
    """Where everything stands among the rows of an attempt: the state, then what is carried."""

    dimension: int

    def __getitem__(self, name: str) -> int:
        return self.dimension + CARRIED.index(name)

    @property
    def count(self) -> int:
        return self.dimension + len(CARRIED)


@dataclass(frozen=True)
class _Attempt:
    """A compiled attempt; of the parameter rows the function takes those up to the last that occurs in it."""

    function: Any
    batch: int
    parameters: int = field(repr=False)

    def __call__(self, rows: np.ndarray, parameters: np.ndarray, out: np.ndarray) -> None:
        self.function(rows, pars=parameters[: self.parameters], outputs=out, batch_parallel=False)


@lru_cache(maxsize=64)
def _compiled(pair: Pair, equation: CommonEquation, fmt: Precision, iterations: int) -> _Attempt:
    """An attempt at a step, traced and compiled; briefly, for few marches are so long that optimizing is won back."""
    problem, batch = equation.problem, min(fmt.lanes, BATCH)
    y = tuple(map(hy.expression, problem.state_names))
    carried = {name: hy.expression(f"carried_{name}") for name in CARRIED}
    given = {name: hy.par[i] for i, name in enumerate(PARAMETERS)}
    symbols = {name: hy.par[len(PARAMETERS) + i] for i, name in enumerate(problem.parameters)}
    system = BoundSystem(problem, Heyoka(fmt.number), symbols, fmt, ())
    outputs = _traced(pair, system, y, carried, given, iterations)
    options = {"fast_math": False, "opt_level": 0 if fmt.lanes > 1 else 3, **fmt.compiler_options}
    function = hy.cfunc(outputs, vars=[*y, *carried.values()], batch_size=batch, **options)
    attempt = _Attempt(function, batch, parameter_rows(outputs))
    _trust(attempt, pair, problem, fmt, iterations)
    return attempt


def _trust(attempt: _Attempt, pair: Pair, problem: Problem, fmt: Precision, iterations: int) -> None:
    """Hold the compiled attempt against the plain one at random points, where everything is tolerated."""
    states, parameters = random_points(problem, fmt, attempt.batch)
    h, values = parameters[0], parameters[1 + len(problem.invariants) :]
    width, one = h.shape, fmt.number(Fraction(1))
    carried = {name: fmt.zeros(width) for name in CARRIED} | {"h": h, "last_h": fmt.zeros(width) + one}
    given = {name: fmt.zeros(width) + one for name in PARAMETERS}
    given |= {"end": h + h, "atol": fmt.zeros(width) + fmt.number(Fraction(LARGEST)), "shortest": fmt.zeros(width)}
    rows = np.stack([*states, *carried.values()])
    out = fmt.zeros(rows.shape)
    attempt(rows, np.stack([*given.values(), *values]), out)
    plain, _, _ = pair.attempt(plain_system(problem, fmt, parameters), tuple(states), h, iterations)
    expected = np.stack([value + fmt.zeros(width) for value in plain]).astype(np.float64)
    gap = np.max(np.abs(out[: len(states)].astype(np.float64) - expected))
    allowed = ROUNDINGS * fmt.epsilon * (1 + np.max(np.abs(expected)))
    if not gap <= allowed:
        raise TraceError(
            f"{pair.name} compiled for {problem.name} in {fmt.name} is off by {gap:.1e} from its plain evaluation "
            f"({allowed:.1e} is allowed); a step whose path depends on its values cannot be traced."
        )


def _traced(
    pair: Pair, system: BoundSystem, y: tuple[Any, ...], carried: dict[str, Any], given: dict[str, Any], iterations: int
) -> list[Any]:
    """The rows after an attempt, as expressions; those of a lane that has ended are the rows before it."""
    number, k = system.number, estimate_order(pair)
    now, goes = carried["time"], _goes(system, carried, given)
    beyond = now + carried["h"]
    then = hy.select(hy.gt(beyond, given["end"]), given["end"], beyond)
    h = then - now  # exactly, unlike the step that is added
    after, estimates, changes = pair.attempt(system, y, h, iterations)
    error = _error(pair, system, (y, after), estimates, given)
    usable = [hy.lte(error, number(Fraction(LARGEST)))]
    if changes:
        usable.append(hy.lte(_norm(system, (y, after), changes, given), number(rules.CONVERGED)))
    accepted = hy.logical_and([*usable, hy.lte(error, number(Fraction(1)))])
    # errors are told from s^k, at which every controller aims
    aim = Fraction(k * math.log(rules.SAFETY))
    told = hy.log(_greater(error, system.tiny)) - number(aim)
    least = number(Fraction(math.log(rules.LEAST_KNOWN)) - aim)
    ratio = hy.log(h / carried["last_h"])
    elementary = -told / number(Fraction(k))
    filtered = -(
        given["b1"] * told
        + given["b2"] * carried["last_error"]
        + given["b3"] * carried["error_before"]
        + given["a2"] * ratio
        + given["a3"] * carried["last_ratio"]
    )
    chosen = hy.select(hy.lte(given["depth"], carried["accepted"]), filtered, elementary)
    longer, shorter = (_held(system, hy.exp(change)) for change in (chosen, elementary))
    one = number(Fraction(1))
    longer = hy.select(hy.lt(number(Fraction(0)), carried["rejected"]), _less(longer, one), longer)
    shorter = hy.select(hy.logical_and(usable), shorter, number(rules.HALVED))
    changed = {
        "time": (then, now),
        "h": (h * longer, h * shorter),
        "last_h": (h, carried["last_h"]),
        "last_ratio": (ratio, carried["last_ratio"]),
        "last_error": (_greater(told, least), carried["last_error"]),
        "error_before": (carried["last_error"], carried["error_before"]),
        "accepted": (carried["accepted"] + one, carried["accepted"]),
        "attempts": (carried["attempts"] + one,) * 2,
        "rejected": (number(Fraction(0)), one),
    }
    before = [*y, *carried.values()]
    found = [*zip(after, y, strict=True), *changed.values()]
    outputs = [hy.select(accepted, *both) for both in found]
    return [hy.select(goes, *both) for both in zip(outputs, before, strict=True)]


def _goes(system: BoundSystem, carried: dict[str, Any], given: dict[str, Any]) -> Any:
    """Whether a lane is still on its way."""
    return hy.logical_and(
        [
            hy.lt(carried["time"], given["end"]),
            hy.lt(carried["attempts"], given["most"]),
            hy.lt(carried["time"] * given["shortest"] + system.tiny, carried["h"]),
        ]
    )


def _error(pair: Pair, system: BoundSystem, ends: Any, estimates: Sequence[Any], given: dict[str, Any]) -> Any:
    """The error of an attempt, where 1 is just tolerated."""
    by_order: dict[int, list[Any]] = defaultdict(list)
    for other, estimate in zip(pair.embedded, estimates, strict=True):
        by_order[min(pair.order, other.order)].append(_norm(system, ends, estimate, given))
    higher, *lower = (_largest(found) for _, found in sorted(by_order.items(), reverse=True))
    if not lower:
        return higher
    square = higher * higher
    size = square + system.number(rules.DAMPING) * (lower[0] * lower[0])
    return square / hy.sqrt(_greater(size, system.tiny))


def _norm(system: BoundSystem, ends: Any, errors: Any, given: dict[str, Any]) -> Any:
    """The root mean square over the components but the time, each over what is tolerated of it."""
    parts = []
    for i, (before, after, error) in enumerate(zip(*ends, errors, strict=True)):
        if i != system.clock:
            part = error / (given["atol"] + given["rtol"] * _greater(_size(before), _size(after)))
            parts.append(part * part)
    return hy.sqrt(hy.sum(parts) / system.number(Fraction(len(parts))))


def _held(system: BoundSystem, ratio: Any) -> Any:
    return _less(_greater(ratio, system.number(rules.SHORTEST)), system.number(rules.LONGEST))


def _greater(a: Any, b: Any) -> Any:
    """max(a, b), where a NaN in ``a`` wins."""
    return hy.select(hy.lte(a, b), b, a)


def _less(a: Any, b: Any) -> Any:
    return hy.select(hy.lte(a, b), a, b)


def _largest(values: Sequence[Any]) -> Any:
    largest = values[0]
    for value in values[1:]:
        largest = _greater(value, largest)
    return largest


def _size(value: Any) -> Any:
    return _greater(value, -value)


class _Group:
    """Lanes with one compiled attempt, marched in lockstep until the longest has ended."""

    def __init__(self, pair: Pair, lanes: Sequence[AdaptiveLane], fmt: Precision, iterations: int, most: int) -> None:
        self.pair, self.lanes, self.fmt, self.iterations, self.most = pair, lanes, fmt, iterations, most
        self.problem = lanes[0].lane.problem
        self.rows = _Rows(len(self.problem.state_names))
        self.attempt = _compiled(pair, CommonEquation.of(self.problem), fmt, iterations)
        self.times = [_Times(one.lane, fmt) for one in lanes]
        self.levels, self.values = _constants([one.lane.problem for one in lanes], fmt)
        self.passed: list[_Passed] = []
        self.last = np.zeros((self.rows.count, len(lanes)))

    def run(self) -> list[AdaptiveMarch]:
        """March to the end of every lane, and note the seconds that the loop took."""
        with np.errstate(all="ignore"):
            rows, parameters = self._start()
            seconds = self._loop(rows, parameters)
            states = self._sampled()
        return [self._result(i, states[i], seconds) for i in range(len(self.lanes))]

    def _loop(self, rows: np.ndarray, parameters: np.ndarray) -> float:
        """Attempt after attempt; lanes that have ended leave when a batch of them has.  The seconds of the calls."""
        places, seconds, calls = np.arange(len(self.lanes)), 0.0, FEW_CALLS
        while len(places):
            width = self.attempt.batch * -(-len(places) // self.attempt.batch)
            pad = np.concatenate([np.arange(len(places)), np.zeros(width - len(places), dtype=int)])
            table = self.fmt.zeros((calls + 1, len(rows), width))
            table[0] = rows[:, pad]
            given = np.ascontiguousarray(parameters[:, pad])
            began = time.perf_counter()
            for i in range(calls):
                self.attempt(table[i], given, table[i + 1])
            seconds += time.perf_counter() - began
            for column, place in enumerate(places):
                self._pass(int(place), table[:, :, column])
            self.last[:, places] = table[-1, :, : len(places)].astype(np.float64)
            attempts = table[-1, self.rows["attempts"], : len(places)].astype(np.float64)
            moved = attempts > table[-2, self.rows["attempts"], : len(places)].astype(np.float64)
            going = np.flatnonzero(moved)
            rows, parameters, places = table[-1][:, going], parameters[:, going], places[going]
            calls = min(2 * calls, MANY_CALLS)
        return seconds

    def _start(self) -> tuple[np.ndarray, np.ndarray]:
        """The rows of the lanes before the first attempt, and their parameters."""
        fmt, k = self.fmt, estimate_order(self.pair)
        starts = [one.lane.start or one.lane.problem.start for one in self.lanes]
        states = np.stack([fmt.array(start[i] for start in starts) for i in range(self.rows.dimension)])
        given = [self._given(one, k) for one in self.lanes]
        parameters = [
            *(fmt.array(each[name] for each in given) for name in PARAMETERS),
            *self.values,
        ]
        firsts = self._first_steps(states, k)
        carried = {name: fmt.zeros((len(self.lanes),)) for name in CARRIED}
        carried["h"] = fmt.array(Fraction(h) if math.isfinite(h) else Fraction(0) for h in firsts)
        carried["last_h"] = carried["last_h"] + fmt.number(Fraction(1))
        return np.stack([*states, *carried.values()]), np.stack(parameters)

    def _given(self, one: AdaptiveLane, k: int) -> dict[str, Fraction]:
        beta = [weight / k for weight in one.controller.beta]
        numbers = (
            one.lane.n * one.lane.h,
            rules.SMALLEST_STEP * self.fmt.exact_epsilon,
            Fraction(self.most),
            *(one.rtol, one.atol, *beta, *one.controller.alpha, Fraction(one.controller.depth)),
        )
        return dict(zip(PARAMETERS, numbers, strict=True))

    def _first_steps(self, states: np.ndarray, k: int) -> np.ndarray:
        """The first step size of each lane, with two evaluations: Hairer, Nørsett and Wanner I, II.4, page 169.

        No number where the right-hand side is none at the start.
        """
        system = self._system(range(len(self.lanes)), self.fmt.zeros(states.shape[1:]))
        kept = [i for i in range(self.rows.dimension) if i != system.clock]
        y, rates = states.astype(np.float64), self._rates(system, states)
        rtol, atol, end = (
            np.array([float(value) for value in values])
            for values in zip(*((one.rtol, one.atol, one.lane.n * one.lane.h) for one in self.lanes), strict=True)
        )
        scale = atol + rtol * np.abs(y)

        def norm(values: np.ndarray) -> np.ndarray:
            sizes: np.ndarray = np.sqrt(np.mean((values / scale)[kept] ** 2, axis=0))
            return sizes

        size, speed = norm(y), norm(rates)
        trial = np.minimum(np.where((size < 1e-5) | (speed < 1e-5), 1e-6, 0.01 * size / speed), end)
        bend = norm(self._rates(system, (y + trial * rates).astype(states.dtype)) - rates) / trial
        most = np.maximum(speed, bend)
        first = np.where(most <= 1e-15, np.maximum(1e-6, 1e-3 * trial), (0.01 / most) ** (1 / k))
        chosen: np.ndarray = np.minimum(np.minimum(100 * trial, first), end)
        return chosen

    def _rates(self, system: BoundSystem, states: np.ndarray) -> np.ndarray:
        zero = np.zeros(states.shape[1:])
        found = system.derivative(tuple(states))
        return np.stack([np.asarray(rate + self.fmt.zeros(zero.shape)).astype(np.float64) for rate in found])

    def _system(self, places: Sequence[int] | np.ndarray, h: np.ndarray) -> BoundSystem:
        """The equation over NumPy arrays, a lane of this group a column."""
        return plain_system(self.problem, self.fmt, np.stack([h, *self.levels[:, places], *self.values[:, places]]))

    def _pass(self, place: int, table: np.ndarray) -> None:
        """Note from where each sample is reached that the attempts [attempt, row] of a lane have passed."""
        times, at = self.times[place], self.rows["time"]
        series = table[:, at].astype(np.float64)
        until = int(np.searchsorted(times.near, series[-1], side="right"))
        wanted = np.arange(times.told, until)
        if not len(wanted):
            return
        before = np.maximum(np.searchsorted(series, times.near[wanted], side="left") - 1, 0)
        away = (times.high[wanted] - table[before, at]) + times.low[wanted]
        self.passed.append(_Passed(place, wanted, table[before, : self.rows.dimension].T.copy(), away))
        times.told = until

    def _sampled(self) -> list[np.ndarray]:
        """The states at the samples of each lane, each by a step from the last accepted state before it."""
        shapes = ((len(one.lane.samples), self.rows.dimension) for one in self.lanes)
        states = [_unknown(self.fmt, shape) for shape in shapes]
        if not self.passed:
            return states
        places = np.concatenate([np.full(len(one.samples), one.place) for one in self.passed])
        samples = np.concatenate([one.samples for one in self.passed])
        before = np.concatenate([one.before for one in self.passed], axis=1)
        away = np.concatenate([one.away for one in self.passed])
        system, zero = self._system(places, away), self.fmt.zeros(away.shape)
        after, _, _ = self.pair.attempt(system, tuple(before), away, self.iterations)
        reached = np.stack([component + zero for component in after], axis=1)
        for place, sample, state in zip(places, samples, reached, strict=True):
            states[place][sample] = state
        return states

    def _result(self, i: int, states: np.ndarray, seconds: float) -> AdaptiveMarch:
        one, last = self.lanes[i], dict(zip(CARRIED, self.last[self.rows.dimension :, i], strict=True))
        accepted, attempts = int(last["accepted"]), int(last["attempts"])
        ended = last["time"] >= float(self.fmt.number(one.lane.n * one.lane.h))
        work = self.pair.attempt_work(self.iterations)
        starts = accepted + (not ended)
        evaluations = attempts * work.evaluations + (starts * work.at_state if work.at_state else 1) + 1
        jacobians = attempts * work.jacobians + starts * work.jacobians_at_state
        failure = "" if ended else self._failure(last)
        return AdaptiveMarch(states, accepted, attempts - accepted, evaluations, jacobians, failure, seconds)

    def _failure(self, last: dict[str, float]) -> str:
        """Why a march has not come to its end."""
        where = f"at t = {last['time']:.6g}"
        if not last["attempts"]:
            return "lost at the start: the right-hand side is no number there"
        if last["attempts"] >= self.most:
            return f"lost {where}: {self.most} attempts at a step have not been enough"
        return f"lost {where}: a step of {last['h']:.1e} is too short for the time to go on"


def _constants(problems: Sequence[Problem], fmt: Precision) -> tuple[np.ndarray, np.ndarray]:
    """The invariants at the start, and the parameters, of problems that share an equation: a problem a column."""
    shape = (0, len(problems))
    known = {problem: problem.parameters for problem in problems}
    levels = np.array([initial_invariants(problem, fmt) for problem in problems], dtype=fmt.type).T
    values = [fmt.array(known[problem][name] for problem in problems) for name in known[problems[0]]]
    return levels if len(levels) else fmt.zeros(shape), np.stack(values) if values else fmt.zeros(shape)


def _unknown(fmt: Precision, shape: tuple[int, ...]) -> np.ndarray:
    """An array that holds no numbers yet."""
    found = fmt.zeros(shape)
    found[...] = hy.real(math.nan, fmt.bits) if fmt.type is hy.real else fmt.type(math.nan)
    return found


class _Times:
    """The times of a lane's samples, each the sum of two numbers of the format, and how many have been passed."""

    def __init__(self, lane: Lane, fmt: Precision) -> None:
        exact = [step * lane.h for step in lane.samples]
        self.high = fmt.array(exact)
        self.low = fmt.array(moment - fmt.round(moment) for moment in exact)
        self.near = self.high.astype(np.float64)
        self.told = 0


@dataclass(frozen=True)
class _Passed:
    """Samples of a lane, the states [state, samples] before them, and how far away they are from these."""

    place: int
    samples: np.ndarray
    before: np.ndarray
    away: np.ndarray
