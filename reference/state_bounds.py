"""Bounds in doubles on what a proof would find of many states: their errors, digits, phases, amplitudes and energies.

Each is above what the exact number can be (of digits, below), so that a state whose bounds change nothing of a summary
need not be judged exactly.  Not a number is no bound.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Protocol

if TYPE_CHECKING:
    import numpy as np

__all__ = ["Bounds", "Found", "StateBounds"]


class Found(NamedTuple):
    """Bounds on what is found of rows, float64 [rows].

    Attributes:
        phase: at least |phase error|, rad; infinite where the row may have none.
        amplitude: at least |amplitude error|, rad.
        energy: at least |energy error|.
        lost: whether the row may be on no orbit of the exact motion's kind.
    """

    phase: np.ndarray
    amplitude: np.ndarray
    energy: np.ndarray
    lost: np.ndarray


class Bounds(NamedTuple):
    """Of rows.

    Attributes:
        about: number - truth, [rows, state], nearer to the exact error than ``errors`` tell.
        errors: at least |number - truth|, [rows, state].
        digits: at most the correct digits of each number, [rows, state].
        truths: at least |truth|, [rows, state].
        found: the bounds on phase, amplitude and energy.
    """

    about: np.ndarray
    errors: np.ndarray
    digits: np.ndarray
    truths: np.ndarray
    found: Found


class StateBounds(Protocol):
    """What bounds many states of one problem."""

    def bounds(self, numbers: np.ndarray, rounding: float) -> Bounds | None:
        """The bounds of rows of the time and the state, each of which may be wrong by ``rounding`` of itself."""
