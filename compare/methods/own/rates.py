"""The right-hand side as a user's function is given it: on floats, on symbols, and in what numba or JAX compiles."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.methods.own.hosting import MisuseError
from compare.methods.own.jitted import is_traced, numba_type

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["Forces", "Gradients", "Rates"]


class Rates(ABC):
    """f(y), or f(t, y), with the time in either place: an array or a sequence gives an array of the same shape.

    Attributes:
        dimension: components of a state.
        positions: those of them that are positions, 0 where the equation is not separable.
        timed: whether it was ever given a time.
    """

    dimension: int
    positions: int
    timed: bool = False

    @property
    @abstractmethod
    def key(self) -> Any:
        """What those have in common that give the same: a step that JAX compiled for one serves the others."""

    @abstractmethod
    def of(self, t: Any, y: Any) -> Any:
        """The rates, counted, as an array or one after another; the time is None where it was not given."""

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and other.key == self.key

    def __hash__(self) -> int:
        return hash(self.key)

    @property
    def _numba_type_(self) -> Any:
        return numba_type(self)

    def __call__(self, *arguments: Any) -> Any:
        traced = bool(arguments) and type(arguments[-1]) is not np.ndarray and any(map(is_traced, arguments))
        numbers = import_module("jax.numpy") if traced else np
        t, y = self.time_and_state(arguments, numbers.asarray)
        if y.shape[0] != self.dimension:
            raise MisuseError(
                f"f was called with a state of shape {y.shape}; {self.dimension} components along the first axis are "
                "accepted."
            )
        rates = self.of(t, y)
        if isinstance(rates, np.ndarray):
            return rates
        if traced:
            return numbers.stack([numbers.broadcast_to(rate, y.shape[1:]) for rate in rates])
        return np.array(rates, dtype=object if y.dtype == object else np.float64)

    def time_and_state(self, arguments: Sequence[Any], array: Any = np.asarray) -> tuple[Any, Any]:
        """Of two arguments the one with more axes is the state; of one the time is None."""
        parts = [array(argument) for argument in arguments]
        if len(parts) == 1 and parts[0].ndim:
            return None, parts[0]
        if len(parts) != 2 or parts[0].ndim == parts[1].ndim:
            shapes = ", ".join(str(part.shape) for part in parts) or "none"
            raise MisuseError(f"f was called with arguments of the shapes {shapes}; f(y) or f(t, y) is accepted.")
        self.timed = True
        t, y = sorted(parts, key=lambda part: part.ndim)
        return t[()], y


@dataclass(frozen=True)
class Forces:
    """force(q): the rates of the momenta, of the shape of q; equal where the right-hand sides are."""

    rates: Rates

    @property
    def _numba_type_(self) -> Any:
        return numba_type(self)

    def __call__(self, q: Any) -> Any:
        numbers = import_module("jax.numpy") if is_traced(q) else np
        q, count = numbers.asarray(q), self.rates.positions
        if q.size % count or q.shape[:1] not in {(), (count,)}:
            raise MisuseError(
                f"force was called with an array of shape {q.shape}; {count} positions along the first axis are "
                "accepted."
            )
        zeros = numbers.zeros((self.rates.dimension - count, *q.shape[1:])).astype(q.dtype)
        found = self.rates(numbers.concatenate([q.reshape(count, *q.shape[1:]), zeros]))[count:]
        return found.reshape(q.shape)


class Gradients(Forces):
    """grad_V(q): the slopes of the potential, of the shape of q."""

    def __call__(self, q: Any) -> Any:
        return -super().__call__(q)
