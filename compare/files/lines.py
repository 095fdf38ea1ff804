"""The lines of a table of text, numbered."""

from __future__ import annotations

import io
import re
import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING, BinaryIO, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

__all__ = ["NOTHING", "STANDARD_INPUT", "Line", "Lines", "Passed", "opened", "refuse_undecodable"]

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
