"""The lines of a table of text, numbered."""

from __future__ import annotations

import io
import re
import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING, BinaryIO

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

__all__ = ["STANDARD_INPUT", "Lines", "opened", "refuse_undecodable"]

MAX_LINE = 1 << 20
"""Characters of a line that is still taken for one."""
COMMENTS = ("#", "%", "!")
MAX_COMMENTS = 64
"""Comments before the first row among which the header is looked for."""
STANDARD_INPUT = "-"
UNDECODABLE = re.compile("[\udc80-\udcff]")
"""What stands for a byte that is not UTF-8."""
TEXT = "a table of text in UTF-8 is accepted, or in UTF-16 with a byte order mark"


class Lines:
    """The numbered lines of a table, stripped; the comments before its first line are kept.

    Raises:
        ValueError: a line is too long, or has a NUL character: it is no text.
    """

    def __init__(self, stream: io.TextIOBase) -> None:
        self._stream = stream
        self._number = 0
        self.comments: list[str] = []

    def __iter__(self) -> Lines:
        return self

    def __next__(self) -> tuple[int, str]:
        while line := self._stream.readline(MAX_LINE):
            self._number += 1
            if len(line) == MAX_LINE:
                raise ValueError(f"line {self._number} is longer than {MAX_LINE} characters; a text file is accepted.")
            if "\0" in line:
                raise ValueError(f"line {self._number} has a NUL character, as no text file has; {TEXT}.")
            text = line.strip()
            if text.startswith(COMMENTS):
                self.comments = [*self.comments, text.lstrip("#%! ")][:MAX_COMMENTS]
            elif text:
                return self._number, text
        raise StopIteration


@contextmanager
def opened(path: Path) -> Iterator[io.TextIOBase]:
    """The file as text: UTF-8, or UTF-16 where its first two bytes say so; "-" is the standard input."""
    if str(path) == STANDARD_INPUT:
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
