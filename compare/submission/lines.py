"""The lines of a table of text, numbered."""

from __future__ import annotations

import io
import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING, BinaryIO

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

__all__ = ["STANDARD_INPUT", "Lines", "opened"]

MAX_LINE = 1 << 20
"""Characters of a line that is still taken for one."""
COMMENTS = ("#", "%", "!")
MAX_COMMENTS = 64
"""Comments before the first row among which the header is looked for."""
STANDARD_INPUT = "-"


class Lines:
    """The numbered lines of a table, stripped; the comments before its first line are kept."""

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
    return io.TextIOWrapper(buffered, encoding="utf-16" if wide else "utf-8-sig", errors="replace")
