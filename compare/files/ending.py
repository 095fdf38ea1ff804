"""Whether a table of text breaks off in its last number: what is left of it is a number too, and wrong."""

from __future__ import annotations

from typing import TYPE_CHECKING

from reference.names import short

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.files.chunk import Row
    from compare.files.written import Written

__all__ = ["Ending"]

LEAST_ROWS = 3
"""Rows before the last, besides the first of a file, whose numbers are often short: the start's are chosen."""
CLEAR = 2
"""Digits by which a number that was cut off is clearly shorter than the shortest before it."""


class Ending:
    """The last rows of a table, of which the number at ``place`` among ``names`` is the last that a line has."""

    def __init__(self, rows: Sequence[Row], names: Sequence[str], place: int) -> None:
        self._rows, self._name = rows, names[place]
        self._numbers = [(row.t, *row.state)[place] for row in rows]

    def notes(self) -> list[str]:
        """A sentence where the last number has fewer digits, and fewer places, than those of the rows before."""
        *before, last = self._numbers
        before = before[1:]
        if len(before) < LEAST_ROWS or not all(map(_is_decimal, (last, *before))):
            return []
        digits, places = min(number.digits for number in before), max(number.last or 0 for number in before)
        if last.digits > digits - CLEAR or (last.last or 0) <= places:
            return []
        said = f"'{short(last.text)}', of {int(last.digits)} digits, and those before it have {int(digits)} and more"
        return [f"{self._name} in {self._rows[-1].place}, the last row, is {said}: the file may break off there."]


def _is_decimal(number: Written) -> bool:
    return number.last is not None
