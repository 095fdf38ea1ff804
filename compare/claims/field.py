"""The right-hand side as a user's function sees it: f(y) or f(t, y), on floats, arrays of lanes, and symbols."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from compare.claims.expansion import Expansion
from reference.arithmetic.compiler import hy
from reference.arithmetic.namespaces import NUMPY, Heyoka

if TYPE_CHECKING:
    from compare.claims.frames import Scene

__all__ = ["Exhausted", "Field", "MisuseError"]

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
