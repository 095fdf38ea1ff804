"""The lines of a table of text, numbered.

Many lines of decimals at once, as doubles: what the plain ones among tables of text allow.

A line is plain where every field is a decimal of ordinary length.  Python's ``float`` rounds a decimal correctly, so
that each double is the nearest to the number as written.
"""

from __future__ import annotations

import io
import re
import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING, BinaryIO, NamedTuple

import numpy as np

from compare.files.chunk import Doubles

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from pathlib import Path

__all__ = ["NOTHING", "STANDARD_INPUT", "Blocks", "Line", "Lines", "Passed", "opened", "refuse_undecodable"]

NUMBER = r"[+-]?+(?:\d{1,300}+(?:MARK\d{0,300}+)?+|MARK\d{1,300}+)(?:[eE][+-]?+\d{1,3}+)?+"
"""A decimal whose exponent is far within the limits of an input."""
EXPONENT = re.compile("[eE]")


class Blocks:
    """Lines of ``width`` fields, of which those at ``places`` are the time and the state.

    Between them are separators, or blanks where that is None; ``mark`` is the decimal mark.
    """

    def __init__(self, separator: str | None, mark: str, width: int, places: Sequence[int]) -> None:
        self._mark, self._separator = mark, separator
        self._width, self._places = width, list(places)
        number = NUMBER.replace("MARK", re.escape(mark))
        between = r"[ \t]++" if separator is None else rf" *+{re.escape(separator)} *+"
        row = rf"{number}(?:{between}{number}){{{width - 1}}}"
        self._plain = re.compile(rf"(?:{row}\n)*+", re.ASCII)
        self._most = 0

    def doubles(self, lines: Sequence[str]) -> Doubles | None:
        """Their numbers, or None where a line is not plain or a number is beyond the doubles."""
        block = "".join(f"{line}\n" for line in lines)
        if not self._plain.fullmatch(block):
            return None
        if self._separator is not None:
            block = block.replace(self._separator, " ")
        words = (block.replace(",", ".") if self._mark == "," else block).split()
        columns = [words[place :: self._width] for place in self._places]
        numbers = np.array([list(map(float, column)) for column in columns]).T
        if not np.isfinite(numbers).all():
            return None
        for column in columns[1:]:
            self._count(column)
        return Doubles(numbers, self._most)

    def _count(self, words: Iterable[str]) -> None:
        """Learn the significant digits of decimals; one with fewer letters than the most has not more digits."""
        for letters in " ".join(words).replace(".", "").split(" "):
            digits = letters.lstrip("+-0")
            if len(digits) > self._most:
                self._most = max(self._most, len(EXPONENT.split(digits, maxsplit=1)[0]))


MAX_LINE = 1 << 20
"""Characters of a line that is still taken for one."""
COMMENTS = ("#", "%", "!")
MAX_COMMENTS = 64
"""Comments before the first row among which the header is looked for."""
STANDARD_INPUT = "-"
BLANKS = " \r\n\v\f\u00a0"
"""What is no part of a line at its ends; a tab there may separate an empty column."""
ERROR = re.compile(r"#(?:N/A|NUM!|DIV/0!|VALUE!|REF!|NAME\?|NULL!|SPILL!|CALC!)", re.IGNORECASE)
"""What a spreadsheet has where there is no number: no comment."""
MARKS = "\ufeff"
"""Byte order marks; who joins files may leave several."""
UNDECODABLE = re.compile("[\udc80-\udcff]")
"""What stands for a byte that is not UTF-8."""
TEXT = "a table of text in UTF-8 is accepted, or in UTF-16 with a byte order mark"

Line = tuple[int, str]
"""A line's number and text."""


class Passed(NamedTuple):
    """What the user said is no part of a table: so many ``lines`` at its beginning, and those that begin with
    ``comment``, "" for none besides the usual ones.
    """

    lines: int = 0
    comment: str = ""


NOTHING = Passed()
"""Nothing besides the usual comments."""


class Lines:
    """The numbered lines of a table, without blanks at their ends; the comments before its first line are kept.

    Raises:
        ValueError: a line is too long, or has a NUL character: it is no text.
    """

    def __init__(self, stream: io.TextIOBase, passed: Passed) -> None:
        self._stream, self._skip = stream, passed.lines
        self._number = 0
        self._marks = (*COMMENTS, passed.comment) if passed.comment else COMMENTS
        self.comments: list[str] = []

    def __iter__(self) -> Lines:
        return self

    def __next__(self) -> Line:
        while line := self._stream.readline(MAX_LINE):
            self._number += 1
            if len(line) == MAX_LINE:
                raise ValueError(f"line {self._number} is longer than {MAX_LINE} characters; a text file is accepted.")
            if self._number <= self._skip:
                continue
            if "\0" in line:
                raise ValueError(f"line {self._number} has a NUL character, as no text file has; {TEXT}.")
            text = line.strip(BLANKS) if self._number > 1 else line.lstrip(MARKS).strip(BLANKS)
            bare = text.strip()
            if bare.startswith(self._marks) and not ERROR.match(bare):
                self.comment(bare)
            elif bare:
                return self._number, text
        raise StopIteration

    def comment(self, text: str) -> None:
        """Keep a comment, without what marks it as one."""
        mark = next((mark for mark in self._marks if text.startswith(mark)), "")
        self.comments = [*self.comments, text.removeprefix(mark).lstrip("#%!;/*- \t")][:MAX_COMMENTS]


@contextmanager
def opened(path: Path) -> Iterator[io.TextIOBase]:
    """The file as text: UTF-8, or UTF-16 where its first two bytes say so; "-" is the standard input.

    Raises:
        ValueError: the standard input is closed.
    """
    if str(path) == STANDARD_INPUT:
        if sys.stdin is None:
            raise ValueError("the standard input is closed; a table of text is accepted.")
        yield _decoded(sys.stdin.buffer)
        return
    with path.open("rb") as stream:
        yield _decoded(stream)


def _decoded(stream: BinaryIO) -> io.TextIOBase:
    buffered = stream if isinstance(stream, io.BufferedReader) else io.BufferedReader(stream)  # type: ignore[type-var]
    wide = buffered.peek(2)[:2] in {b"\xff\xfe", b"\xfe\xff"}
    if wide:
        return io.TextIOWrapper(buffered, encoding="utf-16", errors="replace")
    return io.TextIOWrapper(buffered, encoding="utf-8-sig", errors="surrogateescape")


def refuse_undecodable(text: str, number: int) -> None:
    """Refuse what stands in line ``number`` where bytes of it are not UTF-8; in comments and such they do no harm.

    Raises:
        ValueError: there are such bytes.
    """
    if not text.isascii() and UNDECODABLE.search(text):
        raise ValueError(f"line {number} has bytes that are not UTF-8; {TEXT}.")
