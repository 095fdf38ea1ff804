"""What a solver is: a record of how its own users call it, the question that it is asked, and its answer."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

import numpy as np

from reference.arithmetic.namespaces import NUMPY

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.problem import Problem

__all__ = [
    "CALLS",
    "LARGEST",
    "RMS",
    "STEP",
    "Answer",
    "Counted",
    "Question",
    "Solver",
    "SolverError",
    "StoppedError",
    "step_for",
]

CALLS = "calls of the right-hand side"
"""What a solver's evaluations are, unless it counts something else."""
RMS = "root mean square of e_i / (atol + rtol |y_i|) over the components, at most 1 in a step; e_i its own estimate"
LARGEST = "largest e_i / (atol + rtol |y_i|) over the components, at most 1 in a step; e_i its own estimate"
STEP = "nothing: there is no estimate; the step is rtol^(1/order) over the fastest rate of the problem"
"""What tolerances bound, in words that several solvers share."""


class SolverError(RuntimeError):
    """A solver gave no answer; the text is its own message."""


class StoppedError(SolverError):
    """A solver was stopped, because it had used up the evaluations that it was granted."""


class Counted:
    """An equation of motion that counts its evaluations and refuses to be asked without end: in floats, of itself.

    Raises:
        StoppedError: it was evaluated more often than the limit.
    """

    def __init__(self, question: Question, arithmetic: Any = NUMPY) -> None:
        self.evaluations = 0
        self._m = arithmetic
        self._limit = question.limit
        self._problem: Any = question.problem
        self._parameters = question.parameters

    def count(self) -> None:
        """One more evaluation."""
        self.evaluations += 1
        if self.evaluations > self._limit:
            raise StoppedError(f"stopped after {self._limit} evaluations of the right-hand side")

    def derivative(self, t: float, y: Any) -> Any:
        """dy/dt."""
        self.count()
        return self._problem.derivative(self._m, t, y, self._parameters)

    def velocity(self, momenta: Any) -> Any:
        """dq/dt of a separable problem, which costs nothing beside the force and is not counted."""
        return np.asarray(self._problem.velocity(self._m, momenta, self._parameters))

    def force(self, t: float, positions: Any) -> Any:
        """dp/dt of a separable problem."""
        self.count()
        return np.asarray(self._problem.force(self._m, t, positions, self._parameters))


@dataclass(frozen=True)
class Question:
    """An initial value problem in binary64, with the tolerance that is asked for.

    Attributes:
        problem: the equation and its exact solution.
        times: where the state is wanted, increasing from 0, s.
        rtol: the relative tolerance, which is the absolute one too.
        limit: the most evaluations of the right-hand side that a solver is granted.
        event: a function (m, y) whose zeros are the events, in any arithmetic m; None where there are none.
    """

    problem: Problem
    times: np.ndarray
    rtol: float
    limit: int
    event: Callable[[Any, Sequence[Any]], Any] | None = None

    @property
    def start(self) -> np.ndarray:
        """The initial state."""
        return np.array(self.problem.start_in(NUMPY))

    @property
    def end(self) -> float:
        """The last time, s."""
        return float(self.times[-1])

    @property
    def parameters(self) -> dict[str, float]:
        """The problem's parameters as floats."""
        return self.problem.parameters_in(NUMPY)

    @property
    def positions(self) -> int:
        """How many components of the state are positions, 0 where the problem is not separable."""
        return self.problem.positions

    @property
    def newtonian(self) -> bool:
        """Whether the equation splits with q' = p."""
        momenta = np.arange(1.0, 1.0 + self.positions)
        return self.positions > 0 and np.array_equal(Counted(self).velocity(momenta), momenta)

    @property
    def paired(self) -> bool:
        """Whether the state is positions and then their rates, one for each."""
        space = self.problem.space
        return space.components == (*space.positions, *space.rates) and len(space.positions) == len(space.rates)

    def happens(self, m: Any, y: Any) -> Any:
        """The event function at a state, in an arithmetic.

        Raises:
            ValueError: the problem has no events.
        """
        if self.event is None:
            raise ValueError(f"{self.problem.name} has no events.")
        return self.event(m, y)


def step_for(question: Question, order: int) -> float:
    """rtol^(1/order) over the problem's rate: the step in s whose error per step is of the tolerance's size."""
    return float(question.rtol ** (1 / order) / question.problem.rate())


@dataclass(frozen=True)
class Answer:
    """What a solver gave.

    Attributes:
        states: float64 [times, state].
        evaluations: what it took, in the solver's own ``counts``.
        used: the tolerance or step that it worked with, which may not be the one asked for.
    """

    states: np.ndarray
    evaluations: int
    used: float


@dataclass(frozen=True)
class Solver:
    """A solver as its own users call it.

    Attributes:
        name: its package and its own name, such as "scipy.RK45".
        package: as it is imported.
        call: the call in one line.
        tolerance: what its tolerance bounds, in words.
        prepare: from a question to a function without arguments that asks it; what compiles does so before.
        events: from a question to the times at which its event function found the events; None if it has none.
        aliases: other names it answers to.
        dial: what the tolerance is called, or what stands in its place.
        counts: what ``evaluations`` are.
        first_only: whether it stops at the first event.
        project: its package as it is installed, where that is called otherwise.
        accepts: what it can solve, in words, where that is not every problem; with ``solves``, which decides.
    """

    name: str
    package: str
    call: str
    prepare: Callable[[Question], Callable[[], Answer]]
    events: Callable[[Question], Sequence[float]] | None = None
    aliases: tuple[str, ...] = ()
    dial: str = "rtol"
    counts: str = CALLS
    first_only: bool = False
    accepts: str = "every problem"
    solves: Callable[[Question], bool] = lambda _: True
    project: str = ""
    _: KW_ONLY
    tolerance: str

    @property
    def install(self) -> str:
        """The command that installs it."""
        return f"pip install {self.project or self.package}"

    @property
    def version(self) -> str | None:
        """The version of its package that is here; None where it is missing."""
        if find_spec(self.package) is None:
            return None
        try:
            return version(self.project or self.package)
        except PackageNotFoundError:
            return "unknown"
