"""Rows of decimals from a text file: CSV and its relatives, line by line, each number exactly as written."""

from __future__ import annotations

import sys
from itertools import chain, islice
from typing import TYPE_CHECKING

from compare.submission.block import Blocks
from compare.submission.chunk import Chunk, Row
from compare.submission.dialect import Dialect, is_numeric
from compare.submission.lines import STANDARD_INPUT, Lines, opened, refuse_undecodable
from compare.submission.written import ROUND_TRIP_DIGITS, Written, of_value

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

    from compare.submission.columns import Columns

__all__ = ["STANDARD_INPUT", "TextRows"]

Line = tuple[int, str]
"""A line's number and text."""


class TextRows:
    """The rows of a text file, a chunk at a time.

    Columns are separated by semicolons, tabs, commas or blanks, whichever of these the first row has first; where it is
    not commas, these may be decimal marks.  A header names the columns, and without one they are in order.  Lines that
    are empty or begin with #, % or ! are passed over, but a header may begin so.

    Attributes:
        times: "as written"; or "binary64" where the states have no more digits than doubles have: then a time is the
            double that it spells, as it was in the program that wrote it.
    """

    def __init__(self, columns: Columns, *, as_written: bool) -> None:
        self._columns = columns
        self._as_written = as_written
        self.times = "as written"

    def chunks(self, path: Path, size: int) -> Iterator[Chunk]:
        """Read the file.

        Raises:
            ValueError: it is empty or no text, a column is missing, a row is ragged, or a word is no finite number.
        """
        with opened(path) as stream:
            lines = Lines(stream)
            first = next(lines, None)
            table = None if first is None else Table(self._columns, first, lines.comments)
            rest = lines if first is None or (table is not None and table.has_header) else chain([first], lines)
            begun = False
            while table is not None and (batch := list(islice(rest, size))):
                if not begun:
                    self._decide(table, batch)
                begun = True
                yield table.chunk(batch, doubles=self.times == "binary64")
            if not begun:
                raise ValueError(f"{_shown(path)} has no rows; a row for each time is accepted.")

    def _decide(self, table: Table, batch: Sequence[Line]) -> None:
        """Decide how times are read, by the digits of the first states."""
        most = max(number.digits for line in batch for number in table.row(line).state)
        if not self._as_written and most <= ROUND_TRIP_DIGITS:
            self.times = "binary64"


class Table:
    """A table that begins with the line ``first``, which may be a header; or else a comment before it may.

    Raises:
        ValueError: a column is missing, or there are others than are wanted where nothing names them.
    """

    def __init__(self, columns: Columns, first: Line, comments: Sequence[str]) -> None:
        self._columns = columns
        number, line = first
        self._dialect = Dialect(line)
        words = self._dialect.split(line)
        self._width = len(words)
        self.has_header = not all(map(is_numeric, words))
        self._places = self._named(words, number) if self.has_header else self._unnamed(line, comments)
        self._blocks: Blocks | None = None

    def _named(self, words: Sequence[str], number: int) -> list[int]:
        """Where the columns are that a header names; its other names may be of any encoding."""
        try:
            places = self._columns.among(words)
        except ValueError:
            refuse_undecodable("".join(words), number)
            raise
        refuse_undecodable("".join(words[place] for place in places), number)
        return places

    def _unnamed(self, line: str, comments: Sequence[str]) -> list[int]:
        """Where the columns are in a table that begins with numbers: a comment before it may be its header."""
        for comment in reversed(comments):
            names = Dialect(comment).split(comment)
            if len(names) == self._width and set(self._columns.names) <= set(names):
                return self._columns.among(names)
        hint = self._dialect.hint(line, self._width, len(self._columns.wanted))
        return self._columns.without_header(self._width, hint)

    def row(self, line: Line) -> Row:
        """The numbers of one line, exactly.

        Raises:
            ValueError: it has not as many fields as the first, or a word is no finite number.
        """
        number, text = line
        words = self._dialect.split(text)
        if len(words) != self._width:
            hint = self._dialect.hint(text, len(words), self._width)
            raise ValueError(
                f"line {number} has {len(words)} fields; {self._width} are accepted, as in the first line of the table"
                f"{hint}."
            )
        refuse_undecodable("".join(words[place] for place in self._places), number)
        at = f"line {number}"
        t, *state = (
            self._dialect.number(words[place], name, at)
            for name, place in zip(self._columns.wanted, self._places, strict=True)
        )
        return Row(t, tuple(state), at)

    def chunk(self, batch: Sequence[Line], *, doubles: bool) -> Chunk:
        """Some lines; their times are ``doubles``, or as they are written."""
        separator, mark = self._dialect.separator, self._dialect.mark
        if self._blocks is None and mark and mark != separator:
            self._blocks = Blocks(separator, mark, self._width, self._places)
        found = None if self._blocks is None else self._blocks.doubles([text for _, text in batch])

        exact = Exact(self, batch, doubles=doubles)
        if found is not None:
            return Chunk(len(batch), exact, found)
        rows = [exact(place) for place in range(len(batch))]
        return Chunk(len(rows), rows.__getitem__)


class Exact:
    """The exact rows of some lines, each read when it is asked for; their times are ``doubles``, or as written."""

    def __init__(self, table: Table, batch: Sequence[Line], *, doubles: bool) -> None:
        self._table, self._batch, self._doubles = table, batch, doubles

    def __call__(self, place: int) -> Row:
        row = self._table.row(self._batch[place])
        return row._replace(t=_as_double(row.t)) if self._doubles else row


def _shown(path: Path) -> str:
    return "standard input" if str(path) == STANDARD_INPUT else f"'{path}'"


def _as_double(t: Written) -> Written:
    """The double that a time of at most 17 digits spells."""
    if t.digits > ROUND_TRIP_DIGITS or abs(t.value) > sys.float_info.max:
        return t
    return of_value(float(t.value))._replace(text=t.text)
