"""Angles that are wrong by whole turns, as a wrapped angle is where the motion's own goes on."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["Turns"]

TURN = 2 * math.pi
NEAR = 0.5
"""rad: a poor integrator's error may be added to the turns."""
MOST = 0.9
"""The least part of the angles wrong by more than half a turn that is wrong by whole ones where angles are wrapped:
an error that merely grows is as often a half as a whole."""
FARTHEST = 1e12
"""rad: larger errors are no turns; doubles, which are then 1e-4 apart and more, soon tell no turn from its parts."""


class Turns:
    """Counts, of the rows of a submission, the angles that are wrong by whole turns.

    ``names`` and ``units`` are of the state's numbers; those in rad are angles.
    """

    def __init__(self, names: Sequence[str], units: Sequence[str]) -> None:
        self._angles = {i: name for i, name in enumerate(names) if units[i] == "rad"}
        self._first: dict[int, int] = {}
        self._turned, self._astray, self._rows = dict.fromkeys(self._angles, 0), dict.fromkeys(self._angles, 0), 0

    def add(self, errors: np.ndarray) -> None:
        """Take in the errors of the next rows, [rows, state]."""
        for i in self._angles:
            size = np.abs(errors[:, i])
            astray = size > TURN / 2
            turned = astray & (size < FARTHEST) & (_past_turns(size) < NEAR)
            if i not in self._first and turned.any():
                self._first[i] = self._rows + int(np.argmax(turned)) + 1
            self._turned[i] += int(turned.sum())
            self._astray[i] += int(astray.sum())
        self._rows += len(errors)

    def unsure(self, errors: np.ndarray, within: np.ndarray) -> np.ndarray:
        """The rows that may count otherwise than with these errors, which are right to ``within``, [rows, state]."""
        found = np.zeros(len(errors), dtype=bool)
        for i in self._angles:
            size, least = np.abs(errors[:, i]), within[:, i]
            for measure, edge in ((size, TURN / 2), (size, FARTHEST), (_past_turns(size), NEAR)):
                found |= ~(np.abs(measure - edge) > least)  # what is not a number is unsure
        return found

    def notes(self) -> list[str]:
        """A sentence for each angle that is wrong by whole turns."""
        return [
            f"{name} is wrong by whole turns of 2 pi in {self._turned[i]} of {self._rows} rows, from row "
            f"{self._first[i]} on, as an angle that is wrapped would be; one that goes on from turn to turn is "
            "accepted, as numpy.unwrap makes it."
            for i, name in self._angles.items()
            if self._turned[i] and self._turned[i] >= MOST * self._astray[i]
        ]


def _past_turns(size: np.ndarray) -> np.ndarray:
    """How far each is from the nearest whole turns; what is beyond FARTHEST is taken for that."""
    within = np.minimum(size, FARTHEST)
    found: np.ndarray = np.abs(within - np.rint(within / TURN) * TURN)
    return found
