"""How a table of text is written: what separates its columns, and its decimal mark."""

from __future__ import annotations

import csv
import re

from compare.submission.written import DECIMAL, DECIMAL_COMMA, NOT_FINITE, Written, of_decimal
from reference.names import short

__all__ = ["Dialect", "is_numeric"]

SEPARATORS = (";", "\t", ",")
GROUPED = re.compile(r"[+-]?\d[\d.,]*\d(?:[edq][+-]?\d+)?", re.IGNORECASE | re.ASCII)
"""A number that may have more than one mark, as thousands are separated: 1.234,5 or 1,234.5."""
COMMAS_BETWEEN = "where commas are decimal marks, columns with semicolons, tabs or blanks between them are accepted"


class Dialect:
    """The dialect of a table that has this first line.

    Attributes:
        separator: ";", a tab, "," or None for blanks: the first of these that the line has.
        mark: "." or ",": the decimal mark of the first number that has one; "" before.
    """

    def __init__(self, line: str) -> None:
        self.separator = _separator(line)
        self.mark = ""
        self._first = ""

    def split(self, line: str) -> list[str]:
        """The words of a line, without their quotes.

        Raises:
            ValueError: one is longer than any number.
        """
        if '"' in line and self.separator is not None:
            try:
                words = next(csv.reader([line], delimiter=self.separator, skipinitialspace=True))
            except csv.Error:  # nothing else can be wrong with a single line
                raise ValueError(
                    f"a field in quotes is longer than {csv.field_size_limit()} characters; numbers are accepted."
                ) from None
            return [word.strip() for word in words]
        return [word.strip().strip("\"'") for word in line.split(self.separator)]

    def number(self, word: str, name: str, at: str) -> Written:
        """The decimal that a word spells, exactly, with a point in its text; ``name`` and ``at`` say which it is.

        Raises:
            ValueError: it spells none, or has another decimal mark than those before.
        """
        mark = "," if DECIMAL_COMMA.fullmatch(word) else "." if "." in word and DECIMAL.fullmatch(word) else ""
        if not mark and _is_grouped(word):
            raise ValueError(
                f"{name} in {at} is '{short(word)}', with several marks; one decimal mark is accepted, and none "
                "between thousands."
            )
        if mark and self.mark and mark != self.mark:
            raise ValueError(
                f"{name} in {at} is '{short(word)}', and {self._first} has another decimal mark; points are accepted, "
                "or commas, the same throughout."
            )
        if mark and not self.mark:
            self.mark, self._first = mark, f"{name} in {at}"
        return of_decimal(word.replace(",", ".") if mark == "," else word, f"{name} in {at}")

    def hint(self, line: str, fields: int, wanted: int) -> str:
        """What is to be said of a line with more fields than are wanted, if they come of decimal commas; else ""."""
        doubtful = self.separator == "," and wanted < fields <= 2 * wanted and "." not in line
        return f"; {COMMAS_BETWEEN}" if doubtful else ""


def _separator(line: str) -> str | None:
    found = next((separator for separator in SEPARATORS if separator in line), None)
    if found != ",":
        return found
    by_blanks = line.split()
    decimal_commas = len(by_blanks) > 1 and all(map(is_numeric, by_blanks))
    return None if decimal_commas and not all(map(is_numeric, line.split(","))) else ","


def is_numeric(word: str) -> bool:
    """Whether a word is meant as a number: a header's is not."""
    digits = word.replace(",", ".", 1)
    decimal = DECIMAL.fullmatch(digits) and any(map(str.isdigit, digits))
    return bool(decimal or NOT_FINITE.fullmatch(word)) or _is_grouped(word)


def _is_grouped(word: str) -> bool:
    """Whether a number has several marks."""
    return word.count(".") + word.count(",") > 1 and GROUPED.fullmatch(word) is not None
