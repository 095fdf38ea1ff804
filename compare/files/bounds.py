"""Bounds in doubles on what the enclosure would find of many rows: their errors, digits, phases and amplitudes.

Each is above what the exact number can be (of digits, below), so that a row whose bounds change nothing of a summary
need not be judged exactly.  Not a number is no bound.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from compare.files.pendulum_bounds import SLACK, Places, sketch

if TYPE_CHECKING:
    from compare.files.pendulum_bounds import Found
    from reference.problem import Problem
    from reference.problems.pendulum import Pendulum

__all__ = ["Bounder", "Bounds", "bounder"]


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


class Bounder:
    """What the rows of a file share."""

    def __init__(self, problem: Pendulum) -> None:
        self._sketch, self._places = sketch(problem), Places(problem)

    def bounds(self, numbers: np.ndarray, rounding: float) -> Bounds | None:
        """The bounds of rows of t, theta and omega, each of which may be wrong by ``rounding`` of itself.

        None where the motion has no sketch.
        """
        if self._sketch is None:
            return None
        t, theta, omega = numbers.T
        with np.errstate(all="ignore"):
            true = self._sketch.states(t, rounding)
            truths = np.stack([true.theta, true.omega], axis=1)
            apart = np.stack([true.theta_within, true.omega_within], axis=1)
            within = apart + SLACK * np.abs(numbers[:, 1:])
            about = numbers[:, 1:] - truths
            errors, least = np.abs(about) + within, np.abs(truths) - within
            digits = np.where(least > 0, np.maximum(0.0, -np.log10(errors / least) - SLACK), 0.0)
            found = self._places.found(theta, omega, true, np.abs(t) * rounding * self._sketch.frequency)
        return Bounds(about, errors, digits, np.abs(truths) + apart, found)


def bounder(problem: Problem) -> Bounder | None:
    """What bounds the rows of a problem; None where nothing here does."""
    from reference.problems.pendulum import Pendulum

    known = isinstance(problem, Pendulum) and problem.motion in {"libration", "rotation"}
    return Bounder(problem) if known and isinstance(problem, Pendulum) else None
