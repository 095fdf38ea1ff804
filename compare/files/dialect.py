"""How a table of text is written: what separates its columns, and its decimal mark."""

from __future__ import annotations

import csv
import re

from compare.files.spellings import hexadecimal, spelled
from compare.files.written import DECIMAL, DECIMAL_COMMA, NOT_FINITE, Written, of_decimal
from reference.names import short

__all__ = ["SEPARATORS", "Dialect", "is_numeric"]

SEPARATORS = (";", "\t", "|", ",")
BOXES = str.maketrans("│┃║┆┊", "|||||")
"""What is drawn between columns, as a bar."""
GROUPED = re.compile(r"[+-]?\d[\d.,]*\d(?:[edq][+-]?\d+)?", re.IGNORECASE | re.ASCII)
"""A number that may have more than one mark, as thousands are separated: 1.234,5 or 1,234.5."""
SPACED = re.compile(r"[+-]?[0-9]{1,3}(?:['’\s][0-9]{3})+(?:[.,][0-9]*)?")
"""A number whose thousands are separated by apostrophes or blanks."""
TOGETHER = re.compile(r"[+-]?\d+\.\d+(?:[eEdDqQ][+-]?\d+)?(?:-\d+\.\d+(?:[eEdDqQ][+-]?\d+)?)+", re.ASCII)
"""Fixed columns that a minus fills to the last place."""
NUMERALS = frozenset("0123456789+-.")
BRACKETS = frozenset("(){}")
PART = re.compile(r"[+-]?\d+\.\d+(?:[eEdDqQ][+-]?\d+)?", re.ASCII)
COMMAS_BETWEEN = "where commas are decimal marks, columns with semicolons, tabs or blanks between them are accepted"


class Dialect:
    """The dialect of a table that has this line, and this separator where the table says it.

    Attributes:
        separator: ";", a tab, a bar, "," or None for blanks: the first of these that the line has.
        mark: "." or ",": the decimal mark of the first number that has one; "" before.
        together: whether numbers that run together were taken apart.
    """

    def __init__(self, line: str, separator: str = "") -> None:
        self.separator = separator or _separator(line)
        self.mark = ""
        self.together = False
        self._first = ""

    def split(self, line: str, width: int = 0) -> list[str]:
        """The words of a line, without their quotes; where they are not ``width``, without what runs together.

        Raises:
            ValueError: one is longer than any number.
        """
        if self.separator != "\t":
            line = line.strip() if self.separator else line.replace("\t", " ").strip()
        if self.separator == "|":
            line = line.translate(BOXES).strip()
            line = line.removeprefix("|")
            line = line.removesuffix("|")
        if line[:1] in {"(", "{"}:
            line = _opened(line)
        if '"' in line:
            try:
                words = next(csv.reader([line], delimiter=self.separator or " ", skipinitialspace=True))
            except csv.Error:  # nothing else can be wrong with a single line
                raise ValueError(
                    f"a field in quotes is longer than {csv.field_size_limit()} characters; numbers are accepted."
                ) from None
            return [word.strip() for word in words if word or self.separator]
        quoted = line.startswith("'")
        words = [word.strip().strip("'") if quoted else _unquoted(word.strip()) for word in line.split(self.separator)]
        return self._apart(words) if self.separator is None and len(words) != width else words

    def _apart(self, words: list[str]) -> list[str]:
        """The words, of which those are taken apart that run together at a minus."""
        if not any("-" in word[1:] and TOGETHER.fullmatch(word) for word in words):
            return words
        self.together = True
        return [part for word in words for part in (PART.findall(word) if TOGETHER.fullmatch(word) else [word])]

    def number(self, word: str, name: str, at: str) -> Written:
        """The decimal that a word spells, exactly, with a point in its text; ``name`` and ``at`` say which it is.

        Raises:
            ValueError: it spells none, or has another decimal mark than those before.
        """
        word = spelled(word) or word
        mark = "," if _has_comma(word) else "." if "." in word and DECIMAL.fullmatch(word) else ""
        if not mark and (_is_grouped(word) or SPACED.fullmatch(word)):
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


def _unquoted(word: str) -> str:
    """A word without the quotes about it; at the end of a name alone they are primes, as of a derivative."""
    bare = word.strip("'")
    return word if word.startswith(bare) and bare != word and not is_numeric(bare) else bare


def _opened(line: str) -> str:
    """A line without the brackets that some languages print about the numbers of a row."""
    inner = line.rstrip(", ")[1:-1].strip()
    whole = line.rstrip(", ")[-1] in ")}" and inner[:1] in NUMERALS and not BRACKETS & set(inner)
    return inner if whole else line


def _separator(line: str) -> str | None:
    line = line.translate(BOXES)
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
    if decimal or NOT_FINITE.fullmatch(word) or _is_grouped(word):
        return True
    return spelled(word) is not None or (len(word) < 200 and hexadecimal(word) is not None)


def _has_comma(word: str) -> bool:
    return "," in word and DECIMAL_COMMA.fullmatch(word) is not None


def _is_grouped(word: str) -> bool:
    """Whether a number has several marks."""
    return word.count(".") + word.count(",") > 1 and GROUPED.fullmatch(word) is not None
