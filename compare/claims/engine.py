"""One step over lanes: traced and compiled where it can be, else on arrays, else lane by lane; and many such steps.

A compiled step, or one on arrays, is trusted only where it agrees with plain evaluation on one state at a time: an
``if`` on a symbol is silently true.  Each lane has its own step size and start, of a whole integrator too.
"""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Protocol

import numpy as np

from compare.claims.frames import Exhausted, MisuseError
from compare.march.trace import agree, slopes_of
from compare.methods.own.hosting import real_numbers, repeatable
from reference.arithmetic.compiler import hy

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.claims.candidate import Candidate
    from compare.claims.frames import Scene

__all__ = ["Arrays", "Engine", "Lanes", "Marcher", "Steps", "Traced", "Whole", "chosen", "trial_states"]


class Marcher(Protocol):
    """What carries a state along."""

    @property
    def scene(self) -> Scene:
        """What it is tried on."""

    @property
    def whole(self) -> bool:
        """Whether it goes over a grid by itself."""

    @property
    def near(self) -> Marcher:
        """The same from a start close by."""

    def states(
        self, starts: np.ndarray, h: np.ndarray, wanted: Sequence[Sequence[int]], before: int = 0
    ) -> list[np.ndarray]:
        """For each lane the states [times, state] after the wanted numbers of steps, which increase.

        They begin ``before`` steps before the time zero.
        """


@dataclass(frozen=True)
class Steps:
    """A one-step integrator."""

    engine: Engine
    scene: Scene
    whole: ClassVar[bool] = False

    @property
    def near(self) -> Steps:
        """The same engine where the right-hand side is the same, else one of its kind."""
        scene = self.scene.neighbour()
        same = scene.same_equation(self.scene)
        return Steps(self.engine if same else type(self.engine)(self.engine.candidate, scene), scene)

    def states(
        self, starts: np.ndarray, h: np.ndarray, wanted: Sequence[Sequence[int]], before: int = 0
    ) -> list[np.ndarray]:
        """All lanes in lockstep, each until its last wanted step."""
        events: dict[int, list[tuple[int, int]]] = defaultdict(list)
        for lane, steps in enumerate(wanted):
            for place, step in enumerate(steps):
                events[step].append((lane, place))
        found = [np.empty((len(steps), len(starts))) for steps in wanted]
        last = np.array([steps[-1] for steps in wanted])
        alive = np.arange(len(wanted))
        y, sizes = starts.copy(), h.copy()
        for step in range(1, int(last.max()) + 1):
            y = self.engine.advance(y, sizes, (step - 1 - before) * sizes)
            if step in events:
                where = {int(lane): i for i, lane in enumerate(alive)}
                for lane, place in events[step]:
                    found[lane][place] = y[:, where[lane]]
                keep = last[alive] > step
                alive, y, sizes = alive[keep], y[:, keep], sizes[keep]
        return found


@dataclass(frozen=True)
class Whole:
    """An integrator that goes over a grid of times by itself."""

    candidate: Candidate
    scene: Scene
    whole: ClassVar[bool] = True

    @property
    def near(self) -> Whole:
        return Whole(self.candidate, self.scene.neighbour())

    def states(
        self, starts: np.ndarray, h: np.ndarray, wanted: Sequence[Sequence[int]], before: int = 0
    ) -> list[np.ndarray]:
        """One lane after another, each on its own grid."""
        found = []
        for start, size, steps in zip(starts.T, h, wanted, strict=True):
            last = max(steps[-1], len(start) + 1)  # more times than components: no doubt which is which
            grid = size * np.arange(-before, last + 1 - before)
            field = self.candidate.field(self.scene, len(grid))
            found.append(self.candidate.states(field, start, grid)[list(steps)])
        return found


TRACED_CALLS = 64
"""Calls of f in one step up to which its expressions are worth compiling."""
TRIALS = 8
TIMES, TURNS = 10.0, (20, 1000)
"""Trials are at times up to the first, where that is between so many steps."""
AROUND, NEAR = (0.7, 1.1), (0.95, 1.01)
"""Part of a state of the motion that a trial begins with, the second where the motion may be confined."""


class Lanes:
    """Plain evaluation: one state, one step size, one time after another."""

    name: ClassVar[str] = "lane by lane"
    cost: ClassVar[float] = 1.0
    """Calls of f for one step of all lanes, counted in steps of one lane."""

    def __init__(self, candidate: Candidate, scene: Scene) -> None:
        self.candidate, self.scene = candidate, scene
        self.field = candidate.field(scene)

    def advance(self, y: np.ndarray, h: np.ndarray, t: np.ndarray) -> np.ndarray:
        """The states [state, lanes] a step of h later."""
        columns = [self.one(y[:, i], float(h[i]), float(t[i])) for i in range(y.shape[1])]
        return np.stack(columns, axis=1)

    def one(self, y: np.ndarray, h: float, t: float) -> np.ndarray:
        """One state a step later.

        Raises:
            MisuseError: the step gave no state.
        """
        self.field.calls = 0
        return self.candidate.numbers(self.field, y, h, t)


class Arrays:
    """The step on arrays [state, lanes], with arrays of step sizes and of times.

    The last lane is repeated up to a power of two, from TRIALS on: JAX compiles a step for each shape, so a few times.
    """

    name: ClassVar[str] = "on arrays"

    def __init__(self, candidate: Candidate, scene: Scene) -> None:
        self.candidate, self.field = candidate, candidate.field(scene)

    def advance(self, y: np.ndarray, h: np.ndarray, t: np.ndarray) -> np.ndarray:
        """The states [state, lanes] a step of h later.

        Raises:
            MisuseError: the step does not work on arrays.
        """
        self.field.calls = 0
        lanes = np.minimum(np.arange(_filled(len(h))), len(h) - 1)
        wide = np.ascontiguousarray(y[:, lanes])
        found = real_numbers(self.candidate.step(self.field, wide, h[lanes], t[lanes]), self.candidate.name)
        if found.shape != wide.shape:
            raise MisuseError(f"{self.candidate.name} does not keep the shape of lanes.")
        return found[:, : len(h)]


class Traced:
    """The step on symbols, compiled; its derivative is exact."""

    name: ClassVar[str] = "compiled"

    def __init__(self, candidate: Candidate, scene: Scene) -> None:
        self.candidate = candidate
        d = scene.dimension
        self._variables = [hy.expression(f"y{i}") for i in range(d)]
        h, t = hy.expression("h"), hy.expression("t")
        field = candidate.field(scene)
        field.limit = TRACED_CALLS
        found = candidate.step(field, np.array(self._variables, dtype=object), h, t)
        array = np.array(found, dtype=object)
        if array.shape != (d,):
            raise MisuseError(f"{candidate.name} does not keep the shape of symbols.")
        self._step = [hy.expression(part) if isinstance(part, (int, float)) else part for part in array]
        if not all(isinstance(part, hy.expression) for part in self._step):
            raise MisuseError(f"{candidate.name} does not return symbols for symbols.")
        self._all = [*self._variables, h, t]
        self._function = hy.cfunc(self._step, vars=self._all)

    def advance(self, y: np.ndarray, h: np.ndarray, t: np.ndarray) -> np.ndarray:
        """The states [state, lanes] a step of h later."""
        return _called(self._function, y, h, t)

    def jacobian(self, y: np.ndarray, h: np.ndarray) -> np.ndarray:
        """d(step)/dy, exact but for rounding: [state, state, lanes], at time zero."""
        entries = slopes_of(self._step, self._variables)
        function = hy.cfunc(list(entries.ravel()), vars=self._all)
        return _called(function, y, h, np.zeros(len(h))).reshape(*entries.shape, -1)


Engine = Lanes | Arrays | Traced


def _called(function: Any, y: np.ndarray, h: np.ndarray, t: np.ndarray) -> np.ndarray:
    found: np.ndarray = function(np.ascontiguousarray(np.vstack([y, h, t])))
    return found


def _filled(count: int) -> int:
    """The number of lanes that takes so many."""
    return max(TRIALS, 1 << (count - 1).bit_length())


def trial_states(scene: Scene, h: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Some states about the motion [state, lanes], step sizes up to ``h``, and times."""
    random = np.random.default_rng(20260101)
    until = min(max(TIMES, TURNS[0] * scene.step), TURNS[1] * scene.step, scene.end / 4)
    times = random.uniform(0, until, TRIALS)
    part = NEAR if scene.confined else AROUND
    states = scene.problem.state(times).T * random.uniform(*part, (scene.dimension, TRIALS))
    return states, h * random.uniform(0.2, 1.0, TRIALS), times


def chosen(candidate: Candidate, scene: Scene, h: float) -> tuple[Engine, int, bool]:
    """The fastest engine that agrees with plain evaluation, the calls of f for a step, and whether f is given the time.

    Raises:
        MisuseError: the step fails, gives no finite state, or gives two answers to one question.
    """
    y, sizes, times = trial_states(scene, h)
    plain = Lanes(candidate, scene)
    answers, calls = [], 0
    for i in range(TRIALS):
        answers.append(_repeatable(plain, y[:, i], float(sizes[i]), float(times[i])))
        calls = max(calls, plain.field.calls)
    again = [plain.one(y[:, i], float(sizes[i]), float(times[i])) for i in reversed(range(TRIALS))]
    for before, after in zip(answers, reversed(again), strict=True):
        repeatable(candidate.name, before, after)
    expected = np.stack(answers, axis=1)
    for kind in (Traced, Arrays):
        engine = _trusted(kind, candidate, scene, (y, sizes, times), expected)
        if engine is not None:
            return engine, calls, plain.field.timed
    return plain, calls, plain.field.timed


def _repeatable(plain: Lanes, y: np.ndarray, h: float, t: float) -> np.ndarray:
    """One step, twice."""
    found = plain.one(y, h, t)
    if not np.all(np.isfinite(found)):
        state = ", ".join(f"{value:.4g}" for value in y)
        raise MisuseError(
            f"{plain.candidate.name} returned {found.tolist()} for y = ({state}) and h = {h:.4g}; "
            "finite numbers are accepted."
        )
    repeatable(plain.candidate.name, found, plain.one(y, h, t))
    return found


def _trusted(
    kind: type[Traced | Arrays],
    candidate: Candidate,
    scene: Scene,
    trial: tuple[np.ndarray, np.ndarray, np.ndarray],
    expected: np.ndarray,
) -> Traced | Arrays | None:
    """An engine, if it can be built and gives what plain evaluation gave."""
    try:
        engine = kind(candidate, scene)
        found = engine.advance(*trial)
    except (MisuseError, Exhausted):
        return None
    return engine if agree(found, expected) else None
