"""Exact rows of lines, each read when it is asked for."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Protocol

from compare.files.written import ROUND_TRIP_DIGITS, Written, of_value

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from compare.files.chunk import Row
    from compare.files.lines import Line

__all__ = ["Exact", "Times", "as_double"]


class Times:
    """How the times of a file are read that are decimals.

    Attributes:
        doubles: whether each is the double that it spells, as it was in the program that wrote it; else as written.
    """

    def __init__(self, *, as_written: bool) -> None:
        self._as_written, self.doubles = as_written, False

    def decide(self, states: Iterable[Written]) -> None:
        """Decide it by the digits of the first states: doubles have no more than 17."""
        self.doubles = not self._as_written and max(number.digits for number in states) <= ROUND_TRIP_DIGITS

    def __str__(self) -> str:
        return "binary64" if self.doubles else "as written"


class Reader(Protocol):
    """What reads a line."""

    def row(self, line: Line) -> Row:
        """The numbers of one line, exactly."""


class Exact:
    """The exact rows of some lines, each read when it is asked for; their times are ``doubles``, or as written."""

    def __init__(self, table: Reader, batch: Sequence[Line], *, doubles: bool) -> None:
        self._table, self._batch, self._doubles = table, batch, doubles

    def __call__(self, place: int) -> Row:
        row = self._table.row(self._batch[place])
        return row._replace(t=as_double(row.t)) if self._doubles else row


def as_double(t: Written) -> Written:
    """The double that a time of at most 17 digits spells."""
    if t.last is None or t.digits > ROUND_TRIP_DIGITS or abs(t.value) > sys.float_info.max:
        return t
    return of_value(float(t.value))._replace(text=t.text)
