"""The events that solvers are asked to find, as event functions, and the proven times of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.problem import Problem

__all__ = ["event_of", "exact_events"]

LIMBS = 2


def at_the_bottom(m: Any, y: Sequence[Any]) -> Any:
    """sin(theta/2): zero where a pendulum hangs at the bottom, in whichever turn."""
    return m.sin(y[0] / 2)


EVENTS: dict[str, tuple[str, Callable[[Any, Sequence[Any]], Any]]] = {"pendulum": ("zero_crossing", at_the_bottom)}
"""The row of each family's proven times, and the event function."""


def event_of(problem: Problem) -> Callable[[Any, Sequence[Any]], Any] | None:
    """The event function of a problem; None where it has no events."""
    row, event = EVENTS.get(problem.name, ("", None))
    return event if row and problem.serves(row) else None


def exact_events(problem: Any, until: float) -> np.ndarray:
    """The proven times of the events in (0, until], as float64 limbs [events, limbs]; none where it has no events."""
    if event_of(problem) is None:
        return np.empty((0, LIMBS))
    count = len(problem.events(until).zero_crossings)
    found: np.ndarray = problem.values(EVENTS[problem.name][0], range(count), LIMBS)[:, 0]
    return found
