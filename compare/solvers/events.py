"""The events that solvers are asked to find, and the proven times of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.problem import Problem

__all__ = ["event_of", "exact_events"]

LIMBS = 2


def event_of(problem: Problem) -> Callable[[Any, Sequence[Any]], Any] | None:
    """The event function of a problem; None where it has no events."""
    return None if problem.passages(0.0) is None else problem.event


def exact_events(problem: Problem, until: float) -> np.ndarray:
    """The proven times of the events in (0, until], as float64 limbs [events, limbs]; none where it has no events."""
    known = problem.passages(until)
    if known is None:
        return np.empty((0, LIMBS))
    row, count = known
    if not count:
        return np.empty((0, LIMBS))
    found: np.ndarray = problem.values(row, range(count), LIMBS)[:, 0]
    return found
