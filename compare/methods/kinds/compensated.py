"""Compensated summation for any method: what a step's additions to the state lose to rounding is added by the next.

A step adds increments to the state with ``+``; here the state is made of sums that remember what they lost, so that no
method knows of it.  What is lost is carried behind the state from step to step, as any memory is.

The compiler could undo it, for (s + d) - s is d on paper; heyoka keeps sums as they are written, and so does LLVM
without fast-math.  A test holds them to it.  See W. Kahan, Comm. ACM 8 (1965), 40.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

from compare.methods.order.algebraic import Q

if TYPE_CHECKING:
    from compare.methods.kinds.protocol import Method, State, System

__all__ = ["Compensated", "Sum", "compensate"]


class Sum:
    """A number that grows by increments, and what the roundings of its additions have lost so far."""

    __array_ufunc__ = None
    """NumPy's arrays leave arithmetic with sums to the sums."""
    __hash__ = None  # type: ignore[assignment]

    def __init__(self, value: Any, lost: Any) -> None:
        self.value, self.lost = value, lost

    def __add__(self, change: Any) -> Sum:
        wanted = change + self.lost
        total = self.value + wanted
        return Sum(total, wanted - (total - self.value))

    __radd__ = __add__

    def __sub__(self, other: Sum) -> Any:
        """How far two sums are apart: a plain number."""
        return (self.value - other.value) + (self.lost - other.lost)

    def __eq__(self, other: object) -> Any:
        return self.value == other

    def __ne__(self, other: object) -> Any:
        return self.value != other


class _ValueSystem:
    """An equation that reads the values of sums."""

    def __init__(self, system: System) -> None:
        self._system = system
        self.number, self.tiny = system.number, system.tiny
        self.dimension, self.positions, self.clock = system.dimension, system.positions, system.clock

    @property
    def time(self) -> Any:
        return self._system.time

    @property
    def initial_invariant(self) -> Any:
        return self._system.initial_invariant

    def derivative(self, y: State) -> State:
        return self._system.derivative(_values(y))

    def jacobian(self, y: State) -> tuple[State, ...]:
        return self._system.jacobian(_values(y))

    def velocity(self, momenta: State) -> State:
        return self._system.velocity(_values(momenta))

    def force(self, positions: State) -> State:
        return self._system.force(_values(positions))

    def force_along(self, positions: State, direction: State) -> State:
        return self._system.force_along(_values(positions), _values(direction))

    def jet(self, y: State, order: int) -> list[State]:
        return self._system.jet(_values(y), order)

    def invariant(self, y: State) -> Any:
        return self._system.invariant(_values(y))

    def gradient(self, y: State) -> State:
        return self._system.gradient(_values(y))


def _values(y: State) -> State:
    return tuple(number.value if isinstance(number, Sum) else number for number in y)


@dataclass(frozen=True)
class Compensated:
    """A method whose additions to the state are compensated; in all else it is the ``base``."""

    base: Method

    @property
    def name(self) -> str:
        return f"{self.base.name}_compensated"

    def __getattr__(self, name: str) -> Any:
        """What is asked of the table is asked of the base."""
        if name.startswith("__") or name == "base":
            raise AttributeError(name)
        return getattr(self.base, name)

    def memory(self, dimension: int, positions: int) -> int:
        return self.base.memory(dimension, positions) + dimension

    def start(self, system: System, y: State, h: Any) -> tuple[tuple[State, ...], State]:
        zero = system.number(Q(0))
        opened, full = self.base.start(_ValueSystem(system), tuple(Sum(number, zero) for number in y), h)
        return tuple(_values(state) for state in opened), self._flat(full, system.dimension)

    def step(self, system: System, y: State, h: Any, iterations: int = 0) -> tuple[State, State]:
        inner, lost = y[: -system.dimension], y[-system.dimension :]
        state = tuple(map(Sum, inner, lost))
        new, changes = self.base.step(_ValueSystem(system), state + inner[len(state) :], h, iterations)
        return self._flat(new, system.dimension), changes

    @staticmethod
    def _flat(y: State, dimension: int) -> State:
        """Values, memory of the base, losses."""
        return (*_values(y), *(number.lost for number in y[:dimension]))


def compensate(method: Method) -> Method:
    """Return the method with compensated additions: an option on any method with a fixed step."""
    return cast("Method", Compensated(method))
