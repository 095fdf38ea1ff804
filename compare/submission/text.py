"""Rows of decimals from a text file: CSV and its relatives, line by line, each number exactly as written."""

from __future__ import annotations

import io
import sys
from contextlib import contextmanager
from itertools import islice
from typing import TYPE_CHECKING, BinaryIO

from compare.submission.chunk import Chunk
from compare.submission.written import DECIMAL, NOT_FINITE, ROUND_TRIP_DIGITS, Written, of_decimal, of_value

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from pathlib import Path

    from compare.submission.columns import Columns

__all__ = ["STANDARD_INPUT", "TextRows"]

MAX_LINE = 1 << 20
"""Characters of a line that is still taken for one."""
COMMENTS = ("#", "%", "!")
MAX_COMMENTS = 64
"""Comments before the first row among which the header is looked for."""
SEPARATORS = (";", "\t", ",")
STANDARD_INPUT = "-"

Row = tuple[Written, tuple[Written, ...], str]
"""A time, a state, and where they stand."""


class TextRows:
    """The rows of a text file, a chunk at a time.

    Columns are separated by semicolons, tabs, commas or blanks, whichever of these the first row has first.  A header
    names them, and without one they are in order.  Lines that are empty or begin with #, % or ! are passed over, but a
    header may begin so.

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
        with _opened(path) as stream:
            rows = self._rows(_Lines(stream))
            begun = False
            while batch := list(islice(rows, size)):
                if not begun:
                    self._decide(state for _, state, _ in batch)
                begun = True
                read = _as_double if self.times == "binary64" else _as_it_is
                yield Chunk(
                    [read(t) for t, _, _ in batch], [state for _, state, _ in batch], [at for _, _, at in batch]
                )
            if not begun:
                raise ValueError(f"{_shown(path)} has no rows; a row for each time is accepted.")

    def _decide(self, states: Iterable[tuple[Written, ...]]) -> None:
        """Decide how times are read, by the digits of the first states."""
        most = max(number.digits for state in states for number in state)
        if not self._as_written and most <= ROUND_TRIP_DIGITS:
            self.times = "binary64"

    def _rows(self, lines: _Lines) -> Iterator[Row]:
        first = next(lines, None)
        if first is None:
            return
        separator = _separator(first[1])
        words = _split(first[1], separator)
        if all(_is_numeric(word) for word in words):
            places = self._places(lines.comments, len(words))
            yield self._row(first[0], words, places)
        else:
            places = self._columns.among(words)
        width = len(words)
        for number, line in lines:
            words = _split(line, separator)
            if len(words) != width:
                raise ValueError(
                    f"line {number} has {len(words)} fields; {width} are accepted, as in the first line of the table."
                )
            yield self._row(number, words, places)

    def _places(self, comments: Sequence[str], count: int) -> list[int]:
        """Where the columns are in a table that begins with numbers: a comment before it may be its header."""
        for comment in reversed(comments):
            names = _split(comment, _separator(comment))
            if len(names) == count and set(self._columns.names) <= set(names):
                return self._columns.among(names)
        return self._columns.without_header(count)

    def _row(self, number: int, words: Sequence[str], places: Sequence[int]) -> Row:
        at = f"line {number}"
        t, *state = (
            of_decimal(words[place], f"{name} in {at}")
            for name, place in zip(self._columns.wanted, places, strict=True)
        )
        return t, tuple(state), at


def _shown(path: Path) -> str:
    return "standard input" if str(path) == STANDARD_INPUT else f"'{path}'"


def _as_double(t: Written) -> Written:
    """The double that a time of at most 17 digits spells."""
    if t.digits > ROUND_TRIP_DIGITS or abs(t.value) > sys.float_info.max:
        return t
    return of_value(float(t.value))._replace(text=t.text)


def _as_it_is(t: Written) -> Written:
    return t


class _Lines:
    """The numbered lines of a table, stripped; the comments before its first line are kept."""

    def __init__(self, stream: io.TextIOBase) -> None:
        self._stream = stream
        self._number = 0
        self.comments: list[str] = []

    def __iter__(self) -> _Lines:
        return self

    def __next__(self) -> tuple[int, str]:
        while line := self._stream.readline(MAX_LINE):
            self._number += 1
            if len(line) == MAX_LINE:
                raise ValueError(f"line {self._number} is longer than {MAX_LINE} characters; a text file is accepted.")
            text = line.strip()
            if text.startswith(COMMENTS):
                self.comments = [*self.comments, text.lstrip("#%! ")][:MAX_COMMENTS]
            elif text:
                return self._number, text
        raise StopIteration


def _separator(line: str) -> str | None:
    return next((separator for separator in SEPARATORS if separator in line), None)


def _split(line: str, separator: str | None) -> list[str]:
    return [word.strip().strip("\"'") for word in line.split(separator)]


def _is_numeric(word: str) -> bool:
    """Whether a word is meant as a number: a header's is not."""
    digits = word.replace(",", ".", 1)
    return bool((DECIMAL.fullmatch(digits) and any(map(str.isdigit, digits))) or NOT_FINITE.fullmatch(word))


@contextmanager
def _opened(path: Path) -> Iterator[io.TextIOBase]:
    """The file as text: UTF-8, or UTF-16 where its first two bytes say so."""
    if str(path) == STANDARD_INPUT:
        yield _decoded(sys.stdin.buffer)
        return
    with path.open("rb") as stream:
        yield _decoded(stream)


def _decoded(stream: BinaryIO) -> io.TextIOBase:
    buffered = stream if isinstance(stream, io.BufferedReader) else io.BufferedReader(stream)  # type: ignore[type-var]
    wide = buffered.peek(2)[:2] in {b"\xff\xfe", b"\xfe\xff"}
    return io.TextIOWrapper(buffered, encoding="utf-16" if wide else "utf-8-sig", errors="replace")
