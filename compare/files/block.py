"""Many lines of decimals at once, as doubles: what the plain ones among tables of text allow.

A line is plain where every field is a decimal of ordinary length.  Python's ``float`` rounds a decimal correctly, so
that each double is the nearest to the number as written.
"""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING

import numpy as np

from compare.files.chunk import Doubles

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

__all__ = ["Blocks"]

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
        self._most, self._last = 0, math.inf

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
            self._place(column)
        return Doubles(numbers, self._most, self._last)

    def _count(self, words: Iterable[str]) -> None:
        """Learn the significant digits of decimals; one with fewer letters than the most has not more digits."""
        for letters in " ".join(words).replace(".", "").split(" "):
            digits = letters.lstrip("+-0")
            if len(digits) > self._most:
                self._most = max(self._most, len(EXPONENT.split(digits, maxsplit=1)[0]))

    def _place(self, words: Sequence[str]) -> None:
        """Learn the least last place of decimals; one with few letters and no exponent has not more places."""
        if EXPONENT.search("".join(words)):
            parts = [EXPONENT.split(word, maxsplit=1) for word in words]
            found = min(int(rest[0] if rest else 0) - len(mantissa.partition(".")[2]) for mantissa, *rest in parts)
            self._last = min(self._last, found)
            return
        for word in words:
            if len(word) > -self._last:
                self._last = min(self._last, -len(word.partition(".")[2]))
