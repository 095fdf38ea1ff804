"""What an integrator is tried on: equations with a proven solution, one of them with the time in it.

The second is the first seen from a frame that swings: with theta(t) a solution of theta'' = F(theta) and
s(t) = a (1 - cos(w t)), the positions q = theta + s obey q'' = F(q - s) + s'', and start where theta starts.  A stage
that is taken at the wrong time sees the wrong s.

The right-hand side as a user's function sees it: f(y) or f(t, y), on floats, arrays of lanes, and symbols.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.claims.expansion import Expansion
from compare.measure.truth import errors_of_doubles
from reference.arithmetic.compiler import hy
from reference.arithmetic.namespaces import NUMPY, Heyoka
from reference.once import cached_property

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.arithmetic.protocols import Arithmetic
    from reference.problem import SeparableProblem

__all__ = ["Exhausted", "Field", "Frame", "MisuseError", "Scene", "scale_of_time"]

SYMBOLS = Heyoka()


class MisuseError(ValueError):
    """A user's function is not what can be checked; its text is one sentence."""


class Exhausted(BaseException):
    """A user's function asked for more than it may: no ``except Exception`` of its own keeps it."""


class Field:
    """f(y), or f(t, y), with the time in either place: an array or a sequence gives an array of the same shape.

    Attributes:
        calls: how often it was called.
        timed: whether it was ever given a time.
        limit: calls after which Exhausted is raised.
    """

    def __init__(self, scene: Scene, limit: int) -> None:
        self.scene, self.limit = scene, limit
        self.calls = 0
        self.timed = False

    def __call__(self, *arguments: Any) -> np.ndarray:
        self.calls += 1
        if self.calls > self.limit:
            raise Exhausted(f"called f more than {self.limit} times")
        t, y = self._time_and_state(arguments)
        if len(y) != self.scene.dimension:
            raise MisuseError(
                f"f was called with a state of shape {y.shape}; {self.scene.dimension} components along the first axis "
                "are accepted."
            )
        if y.dtype == object:
            series = next((part.home for part in (*y, t) if isinstance(part, Expansion)), None)
            if series is not None:
                return np.array(self.scene.rates(series, t, tuple(y)), dtype=object)
            moment = hy.expression(float(t)) if isinstance(t, (int, float)) else t
            return np.array(self.scene.rates(SYMBOLS, moment, tuple(y)), dtype=object)
        rates = self.scene.rates(NUMPY, t, tuple(y))
        return np.array(rates) if y.ndim == 1 else np.array(np.broadcast_arrays(*rates))

    def _time_and_state(self, arguments: tuple[Any, ...]) -> tuple[Any, np.ndarray]:
        """Of two arguments the one with more axes is the state."""
        first = np.asarray(arguments[0]) if arguments else np.empty(0)
        if len(arguments) == 1 and first.ndim:
            return 0.0, first
        second = np.asarray(arguments[1]) if len(arguments) == 2 else first
        if first.ndim == second.ndim:
            shapes = ", ".join(str(np.shape(argument)) for argument in arguments) or "none"
            raise MisuseError(f"f was called with arguments of the shapes {shapes}; f(y) or f(t, y) is accepted.")
        self.timed = True
        t, y = (first, second) if first.ndim < second.ndim else (second, first)
        return t[()], y


BINARY32 = Fraction(1, 1 << 24)
"""A step may work in numbers of so few bits, and both starts must differ in them."""


@dataclass(frozen=True)
class Frame:
    """s(t) = a (1 - cos(w t)), with the first two of its derivatives; w in rad/s."""

    a: float
    w: float

    def at(self, m: Arithmetic, t: Any) -> tuple[Any, Any, Any]:
        """(s, s', s'') at t."""
        a, w = self.a, self.w
        return a * (1.0 - m.cos(w * t)), a * w * m.sin(w * t), a * w * w * m.cos(w * t)


@dataclass(frozen=True)
class Scene:
    """A separable problem, still or seen from a frame that swings.

    Attributes:
        problem: the problem, with as many positions as momenta.
        frame: how every position is displaced, or None.
    """

    problem: SeparableProblem
    frame: Frame | None = None

    @property
    def dimension(self) -> int:
        """How many numbers a state has."""
        return len(self.problem.state_names)

    @property
    def start(self) -> np.ndarray:
        """The initial state, in doubles."""
        return np.array([float(value) for value in self.problem.start])

    @cached_property
    def _parameters(self) -> dict[str, Any]:
        return {name: float(value) for name, value in self.problem.parameters.items()}

    def neighbour(self) -> Scene:
        """The same from a start close by."""
        near = self.problem.neighbour(lambda value: Fraction(float(value)), BINARY32)
        return Scene(near, self.frame)  # type: ignore[arg-type]

    def rates(self, m: Arithmetic, t: Any, y: Sequence[Any]) -> tuple[Any, ...]:
        """dy/dt in an arithmetic whose numbers mix with floats."""
        if self.frame is None:
            return tuple(self.problem.derivative(m, t, y, self._parameters))
        s, speed, acceleration = self.frame.at(m, t)
        positions = self.problem.positions
        still = [*(q - s for q in y[:positions]), *(p - speed for p in y[positions:])]
        rates = self.problem.derivative(m, t, still, self._parameters)
        return *(rate + speed for rate in rates[:positions]), *(rate + acceleration for rate in rates[positions:])

    def errors(self, times: Sequence[Fraction], y: np.ndarray) -> np.ndarray:
        """y - truth, [times, state]."""
        if self.frame is not None:
            s, speed, _ = self.frame.at(NUMPY, np.array([float(t) for t in times]))
            positions = self.problem.positions
            displacement = np.stack([s] * positions + [speed] * (self.dimension - positions), axis=1)
            y = y - displacement
        return errors_of_doubles(self.problem, times, y)

    def energy(self, y: np.ndarray) -> np.ndarray:
        """(E - E0)/(E0 - Emin) of states [times, state] of the still problem."""
        start = float(self.problem.invariant(NUMPY, list(self.start), self._parameters))
        found: np.ndarray = np.asarray(self.problem.invariant(NUMPY, list(y.T), self._parameters)) / start - 1.0
        return found


def scale_of_time(problem: SeparableProblem) -> float:
    """One digit of 0.3/rate, the step at which defects are measured: 0.1 s for a pendulum of 1 m."""
    size = 0.3 / problem.rate()
    unit = 10.0 ** math.floor(math.log10(size))
    return float(f"{round(size / unit) * unit:.0e}")
