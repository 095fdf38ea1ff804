"""A march of a pendulum with cubic Hermite interpolation between its steps, as the sources read theirs."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from compare.march.lanes import Lane
from compare.march.march import march
from compare.march.precision import precision
from compare.methods import find
from reference.arithmetic.namespaces import NUMPY

if TYPE_CHECKING:
    from fractions import Fraction

    from reference import Pendulum

__all__ = ["Dense", "dense"]

State = tuple[float, float]
BISECTIONS = 60
"""A step halved so often is no wider than a rounding."""


@dataclass(frozen=True)
class Dense:
    """States (angle, velocity) at the times 0, h, 2 h, ..., with their rates."""

    h: float
    states: tuple[State, ...]
    rates: tuple[State, ...]

    def at(self, t: float) -> State:
        """The state at a time, each component by the cubic through its values and rates at both ends of the step."""
        step = min(int(t / self.h), len(self.states) - 2)
        theta, omega = (self._between(component, step, t / self.h - step) for component in (0, 1))
        return theta, omega

    def first_passage(self) -> float:
        """The first time at which the angle falls through zero.

        Raises:
            ValueError: it does not.
        """
        for step, (before, after) in enumerate(pairwise(self.states)):
            if before[0] > 0 >= after[0]:
                low, high = 0.0, 1.0
                for _ in range(BISECTIONS):
                    middle = (low + high) / 2
                    low, high = (middle, high) if self._between(0, step, middle) > 0 else (low, middle)
                return (step + high) * self.h
        raise ValueError(f"the angle does not pass zero in {len(self.states) - 1} steps; a longer march is accepted.")

    def _between(self, component: int, step: int, part: float) -> float:
        """Hermite's cubic at a part of a step."""
        y0, y1 = (state[component] for state in self.states[step : step + 2])
        d0, d1 = (rate[component] for rate in self.rates[step : step + 2])
        rest = 1 - part
        return (
            rest * rest * ((1 + 2 * part) * y0 + part * self.h * d0)
            + part * part * ((1 + 2 * rest) * y1 - rest * self.h * d1)
        )  # fmt: skip


@lru_cache(maxsize=32)
def dense(problem: Pendulum, method: str, step: Fraction, end: Fraction) -> Dense:
    """March a pendulum in doubles, in steps of one size, to ``end`` or beyond it by less than a step."""
    fmt = precision("float64")
    h, n = fmt.round(step), -(-end // step)
    (found,) = march(find(method), [Lane(problem, n, h, tuple(range(1, n + 1)))], fmt)
    start = tuple(float(value) for value in problem.start)
    states = [start, *map(tuple, found.states.tolist())]
    parameters: dict[str, Any] = {name: float(value) for name, value in problem.parameters.items()}
    rates = (tuple(map(float, problem.derivative(NUMPY, state, parameters))) for state in states)
    return Dense(float(h), tuple(states), tuple(rates))  # type: ignore[arg-type]
