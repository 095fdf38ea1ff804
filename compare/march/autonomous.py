"""An equation that depends on the time, with the time as a component of its state: y' = f(t, y), t' = 1.

So Runge-Kutta methods take the time at their own nodes, and kicks see the time that the drifts have come to: t stands
among the positions, with the rate one.  Methods for q'' = F(q) alone have no place for it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from reference.arithmetic.exact import exact_array
from reference.arithmetic.limbs import exact_limbs
from reference.declaration import Quantity
from reference.problem import Problem

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from flint import arb

    from reference.certified import Certified
    from reference.declaration import Row
    from reference.orbits import Orbits, Place
    from reference.row_domains import Domain

__all__ = ["autonomous", "clock_of"]


def autonomous(problem: Problem) -> Problem:
    """The problem itself, or where its equation depends on the time the same with the time in its state."""
    return problem if problem.autonomous else _WithTime(problem)


def clock_of(problem: Problem) -> int | None:
    """Where ``autonomous`` has put the time into the state; None where it has not."""
    return problem.place if isinstance(problem, _WithTime) else None


@dataclass(frozen=True, repr=False)
class _WithTime(Problem):
    """A problem whose state is (q, t, p) where it splits into kicks and drifts, else (y, t)."""

    inner: Problem

    def __post_init__(self) -> None:
        inner = self.inner
        space, components = inner.space, list(inner.space.components)
        time = next(name for name in ("t", "time", "instant") if name not in components)
        components.insert(self.place, time)
        odd = None if space.odd is None else (*space.odd, time)
        intervals = list(inner.trial.states)
        intervals.insert(self.place, (0.0, 3.0))
        declared = {
            "name": inner.name,
            "rows": inner.rows,
            "invariants": inner.invariants,
            "form": inner.form,
            "space": replace(space, along=time, odd=odd, order=tuple(components)),
            "trial": replace(inner.trial, states=tuple(intervals)),
        }
        for name, value in declared.items():
            object.__setattr__(self, name, value)

    @property
    def place(self) -> int:
        """Where the time stands."""
        return self.inner.positions or len(self.inner.space.components)

    def __repr__(self) -> str:
        return repr(self.inner)

    def __getattr__(self, name: str) -> Any:
        """An invariant, or the scale of one, of the state without the time.

        What is being unpickled is asked for names of Python's own before it has an inner problem.
        """
        if name == "inner" or name.startswith("__"):
            raise AttributeError(f"{type(self).__name__} has no attribute {name!r}")
        of_the_state = {one.value for one in self.inner.invariants} | {one.scale for one in self.inner.invariants}
        if name not in of_the_state:
            raise AttributeError(f"{type(self).__name__} has no attribute {name!r}")
        value = getattr(self.inner, name)
        return lambda m, y, p: value(m, self._split(y)[1], p)

    def _split(self, y: Sequence[Any]) -> tuple[Any, list[Any]]:
        """The time, and the state without it."""
        return y[self.place], [*y[: self.place], *y[self.place + 1 :]]

    def _with(self, state: Sequence[Any], time: Any) -> tuple[Any, ...]:
        return *state[: self.place], time, *state[self.place :]

    @property
    def original(self) -> Problem:
        return self.inner

    @property
    def parameters(self) -> dict[str, Fraction]:
        return self.inner.parameters

    @property
    def start(self) -> tuple[Fraction, ...]:
        return self._with(self.inner.start, Fraction(0))

    @property
    def positions(self) -> int:
        return self.inner.positions and self.inner.positions + 1

    @property
    def structure(self) -> Any:
        return type(self), self.inner.structure

    def derivative(self, m: Any, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """(y', 1)."""
        del t
        now, state = self._split(y)
        return self._with(tuple(self.inner.derivative(m, now, state, p)), m.number(Fraction(1)))

    def velocity(self, m: Any, momenta: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """(q', 1)."""
        split: Any = self.inner
        return *split.velocity(m, momenta, p), m.number(Fraction(1))

    def force(self, m: Any, t: Any, positions: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """p' at the time among the positions."""
        del t
        split: Any = self.inner
        found: tuple[Any, ...] = split.force(m, positions[-1], positions[:-1], p)
        return found

    def invariant(self, m: Any, y: Sequence[Any], p: dict[str, Any]) -> Any:
        return self.inner.invariant(m, self._split(y)[1], p)

    def kinetic(self, m: Any, y: Sequence[Any], p: dict[str, Any]) -> Any:
        return self.inner.kinetic(m, self._split(y)[1], p)

    def rate(self) -> float:
        return self.inner.rate()

    def neighbour(self, rounding: Callable[[Fraction], Fraction], epsilon: Fraction) -> Problem:
        """From the neighbour's start, at the same time."""
        return _WithTime(self.inner.neighbour(rounding, epsilon))

    def working_bits(self, arguments: Sequence[Any]) -> int:
        return self.inner.working_bits(arguments)

    def serves(self, row: str) -> bool:
        return self.inner.serves(row)

    def row(self, name: str) -> Row:
        """The original's row; that of the state with the time among its quantities."""
        found = self.inner.row(name)
        if name != "state":
            return found
        independent = self.inner.space.independent or "1"
        time = Quantity(self.state_names[self.place], independent, "time", "t")
        return replace(found, quantities=self._with(found.quantities, time))

    def certified(self, row: str, argument: Any = None, component: int = 0) -> Certified:
        return self.inner.certified(row, argument, component)

    def cycle(self) -> float:
        return self.inner.cycle()

    @property
    def inputs(self) -> dict[str, tuple[Any, str]]:
        return self.inner.inputs

    @property
    def equation(self) -> str:
        return self.inner.equation

    @property
    def lacks_of_orbits(self) -> str:
        return self.inner.lacks_of_orbits

    def domain(self, row: Row) -> Domain:
        return self.inner.domain(self.inner.row(row.name))

    def orbits(self) -> Orbits | None:
        known = self.inner.orbits()
        return None if known is None else _OrbitsInTime(known, self.place)

    def state(self, t: Any, limbs: int = 1) -> np.ndarray:
        """The proven state, and the time itself to as many limbs."""
        found = np.asarray(self.inner.state(t, limbs=limbs))
        times, shape = exact_array(t, "t")
        parts = np.array([exact_limbs(time, limbs) for time in times]).reshape(*shape, limbs)
        own = parts[..., 0] if limbs == 1 else parts
        return np.insert(found, self.place, own, axis=len(shape))


@dataclass(frozen=True)
class _OrbitsInTime:
    """The original's orbits, of a state with the time at a place of it."""

    known: Orbits
    at: int

    def truth(self, t: Fraction) -> Place:
        return self.known.truth(t)

    def place(self, y: Sequence[arb]) -> Place:
        return self.known.place([*y[: self.at], *y[self.at + 1 :]])
