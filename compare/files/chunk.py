"""Some consecutive rows of a submission: their doubles all at once, their exact numbers where they are asked for."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from compare.files.written import Written

__all__ = ["Chunk", "Doubles", "Row"]


class Row(NamedTuple):
    """A time, a state, and where they stand, such as "line 7"."""

    t: Written
    state: tuple[Written, ...]
    place: str


class Doubles(NamedTuple):
    """The numbers of a chunk, each rounded to the nearest double.

    Attributes:
        numbers: float64 [rows, time and state].
        digits: the most digits that a number of the states has.
        last: the least power of ten of the last digit of a number of the states; -infinite where one is no decimal.
    """

    numbers: np.ndarray
    digits: float
    last: float


class Chunk:
    """Rows of one file; other processes can take it where they can take ``row``, which gives the exact rows.

    Attributes:
        doubles: the same numbers as doubles; None where they take as long as the exact numbers.
    """

    def __init__(self, size: int, row: Callable[[int], Row], doubles: Doubles | None = None) -> None:
        self._size, self._row = size, row
        self.doubles = doubles

    def __len__(self) -> int:
        return self._size

    def increases_from(self, last: Written | None) -> bool:
        """Whether the times increase even as doubles, from that after ``last`` on."""
        if self.doubles is None:
            return False
        times = self.doubles.numbers[:, 0]
        if last is not None and (abs(last.value) > sys.float_info.max or times[0] <= float(last.value)):
            return False
        return bool((np.diff(times) > 0).all())

    def rows(self, places: Iterable[int] | None = None) -> list[Row]:
        """The exact rows at some places, counted from 0, or all.

        Raises:
            ValueError: one holds what is no finite number.
        """
        return [self._row(place) for place in (range(self._size) if places is None else places)]
