"""Rows of decimals from a text file: CSV and its relatives, line by line, each number exactly as written."""

from __future__ import annotations

import re
import shlex
from collections import deque
from itertools import chain, islice
from typing import TYPE_CHECKING

from compare.files.block import Blocks
from compare.files.chunk import Chunk, Row
from compare.files.dialect import Dialect, is_numeric, is_rule, read_head, trimmed
from compare.files.ending import Ending
from compare.files.exact_rows import Exact, Times
from compare.files.json_rows import is_json, json_table
from compare.files.lines import STANDARD_INPUT, Lines, opened, refuse_undecodable
from reference.names import short

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from pathlib import Path

    from compare.files.columns import Columns
    from compare.files.dialect import Head
    from compare.files.json_rows import JsonTable
    from compare.files.lines import Line, Passed

__all__ = ["STANDARD_INPUT", "TextRows"]

TAIL = 64
"""Rows at the end among which the last is looked at."""
UNUSUAL = frozenset(';,|"+─┌└├╞│(\t')
"""How a line begins that may hold nothing."""
MARK = re.compile(r"[^\w\s.,;|+\-\"']+")
"""What may begin a comment, and no field."""
FOOTER = re.compile(r"\((\d+) rows?\)")
"""What a database's client says under a table."""


class TextRows:
    """The rows of a text file, a chunk at a time.

    Columns are separated by semicolons, tabs, bars, commas or blanks, whichever of these the first row has first; where
    it is not commas, these may be decimal marks.  A header names the columns, and without one they are in order.  Lines
    that are empty or begin with #, % or ! are passed over, but a header may begin so.  JSON is read too.

    Attributes:
        notes: sentences on what did not count, or may be amiss.
    """

    def __init__(self, columns: Columns, passed: Passed, times: Times) -> None:
        self._columns, self._passed, self._times = columns, passed, times
        self.notes: list[str] = []

    def chunks(self, path: Path, size: int) -> Iterator[Chunk]:
        """Read the file.

        Raises:
            ValueError: it is empty or no text, a column is missing, a row is ragged, or a word is no finite number.
        """
        with opened(path) as stream:
            lines = Lines(stream, self._passed)
            table, rest = self._table(lines)
            begun = False
            tail: deque[Line] = deque(maxlen=TAIL)
            while table is not None and (batch := list(islice(rest, size))):
                if not begun:
                    self._times.decide(number for line in batch for number in table.row(line).state)
                begun = True
                tail.extend(batch)
                yield table.chunk(batch, doubles=self._times.doubles)
            if not begun:
                raise ValueError(f"{_shown(path)} has no rows; a row for each time is accepted.")
            if table is not None:
                self.notes += table.notes(tail)

    def _table(self, lines: Lines) -> tuple[Table | JsonTable | None, Iterator[Line]]:
        """The table, and its rows."""
        first = next(lines, None)
        if first is None:
            return None, iter(())
        if is_json(first[1]):
            return json_table(self._columns, first, lines)
        head = read_head(chain([first], lines), lines.comment, self._columns)
        if head is None:
            return None, iter(())
        self.notes += head.notes
        table = Table(self._columns, head, lines.comments)
        return table, table.rows(chain(head.taken, lines))


class Table:
    """A table that begins with this head; where it has no header, a comment before it may be one.

    Raises:
        ValueError: a column is missing, or there are others than are wanted where nothing names them.
    """

    def __init__(self, columns: Columns, head: Head, comments: Sequence[str]) -> None:
        self._columns, self._dialect, self._header = columns, head.dialect, head.header
        words = head.names if head.header else trimmed(head.dialect.split(head.first))
        self._width = len(words)
        self._places = columns.among(words) if head.header else self._unnamed(head, comments)
        self._last = self._places.index(max(self._places)) if max(self._places) == self._width - 1 else None
        self._blocks: Blocks | None = None

    def _unnamed(self, head: Head, comments: Sequence[str]) -> list[int]:
        """Where the columns are in a table that begins with numbers: a comment before it may be its header."""
        for comment in reversed(comments):
            names = Dialect(comment).split(comment)
            if len(names) == self._width and self._columns.named_by(names) and not all(map(is_numeric, names)):
                return self._columns.among(names)
        hint = self._dialect.hint(head.first, self._width, len(self._columns.wanted))
        return self._columns.without_header(self._width, hint)

    def rows(self, lines: Iterable[Line]) -> Iterator[Line]:
        """The lines that hold rows: not those that are drawn or have empty fields alone, nor a client's last word.

        Raises:
            ValueError: the client counted other rows.
        """
        count = 0
        for line in lines:
            if line[1][0] in UNUSUAL:
                text = line[1]
                footer = FOOTER.fullmatch(text)
                if footer and int(footer[1]) != count:
                    raise ValueError(f"line {line[0]} is '{text}', after {count} rows; all of them are accepted.")
                if footer or not any(self._dialect.split(text)) or is_rule(text):
                    continue
            count += 1
            yield line

    def row(self, line: Line) -> Row:
        """The numbers of one line, exactly.

        Raises:
            ValueError: it has not as many fields as the first, or a word is no finite number.
        """
        number, text = line
        words = trimmed(self._dialect.split(text, self._width), self._width)
        if len(words) != self._width:
            raise ValueError(
                f"line {number} has {len(words)} fields; {self._width} are accepted, as in the first line of the table"
                f"{self._hint(text, words)}."
            )
        refuse_undecodable("".join(words[place] for place in self._places), number)
        at = f"line {number}"
        t, *state = (
            self._dialect.number(words[place], name, at)
            for name, place in zip(self._columns.wanted, self._places, strict=True)
        )
        return Row(t, tuple(state), at)

    def _hint(self, text: str, words: Sequence[str]) -> str:
        """What a line with other fields than the first may be, and what would read it."""
        mark = MARK.match(text)
        if mark and mark[0].isprintable():
            return f"; if it is a comment, --comment {shlex.quote(short(mark[0]))} would pass over it"
        found = self._dialect.hint(text, len(words), self._width)
        if found:
            return found
        if self._header and len(words) == self._width + 1:
            numbers = ",".join(str(place + 2) for place in self._places)
            return (
                f"; where the first field of a row is its number or name, --skip {self._header} --columns {numbers} "
                "would read them"
            )
        return ""

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

    def notes(self, tail: Iterable[Line]) -> list[str]:
        """What is to be known of the table after its last rows."""
        found = ["Numbers that run together at a minus were taken apart."] if self._dialect.together else []
        if self._last is not None:
            found += Ending([self.row(line) for line in tail], self._columns.wanted, self._last).notes()
        return found


def _shown(path: Path) -> str:
    return "standard input" if str(path) == STANDARD_INPUT else f"'{path}'"
