"""How a table of text is written: what separates its columns, its decimal mark, and where it begins.

Before its first row may come comments and other lines, a header, and rows of units or of types under that.
"""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from compare.files.columns import unit
from compare.files.lines import refuse_undecodable
from compare.files.spellings import hexadecimal, spelled
from compare.files.written import DECIMAL, DECIMAL_COMMA, NOT_FINITE, Written, of_decimal
from reference.names import short

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from compare.files.columns import Columns
    from compare.files.lines import Line

__all__ = ["SEPARATORS", "Dialect", "Head", "is_numeric", "is_rule", "read_head", "trimmed"]

MOST_BEFORE = 200
"""Lines among which the beginning of a table is looked for."""
MOST_UNDER = 6
"""Lines of text under a header: units, long names, remarks, types of the columns."""
SEP = re.compile(r'"?sep=(.|\\t|tab)"?', re.IGNORECASE)
"""A spreadsheet's first line that says what separates the columns."""
COMMENTED = (";", "//", "--", "*")
"""What marks lines before a table as comments, where all of them begin so."""
SURELY = ("//", "--", "*")
"""Of these what begins no name or field."""
DRAWN = frozenset(" \t:|+=-─━═┌┐└┘├┤┬┴┼╞╡╪╭╮╰╯│┆")
"""What lines are drawn with in a table of Markdown, or of a database's client; runs of it are RUNS and longer."""
RUNS = ("--", "==", "──", "━━", "══")
ATTEMPT = re.compile(r"\W*\d")
"""How a number begins, right or wrong; a unit such as 1/s is known."""
MISSING = frozenset({"", "na", "n/a", "#n/a", "null", "none", "nil", "nat", "missing", "-", "--", "?", ".", "nothing"})
"""What stands for a number that there is not."""


@dataclass
class Head:
    """The beginning of a table.

    Attributes:
        dialect: how it is written.
        header: the number of the line that names the columns; 0 where there is none.
        names: the names, without empty ones at the end; [] where there is no header.
        taken: the lines that were read after the header, of which the first is a row.
        notes: what was passed over, in sentences.
    """

    dialect: Dialect
    header: int = 0
    names: list[str] = field(default_factory=list)
    taken: list[Line] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    @property
    def first(self) -> str:
        """The first row; "" where there is none."""
        return self.taken[0][1] if self.taken else ""


def read_head(lines: Iterator[Line], comment: Callable[[str], None], columns: Columns) -> Head | None:
    """The head of the table that begins in these lines; None where there are none.

    ``comment`` is told the lines before it that are comments.

    Raises:
        ValueError: a column is missing, or in other units than the truth's.
    """
    before: list[Line] = []
    separator = ""
    for number, text in lines:
        told = SEP.fullmatch(text.strip()) if not before else None
        if told:
            separator = {"\\t": "\t", "tab": "\t"}.get(told[1].lower(), told[1])
            continue
        if is_rule(text):
            continue
        if text.startswith(SURELY):
            before.append((number, text))
            continue
        head = Head(Dialect(text, separator))
        words = trimmed(head.dialect.split(text))
        if not words:
            continue
        if columns.named_by(words) and not all(map(is_numeric, words)):
            head.names, head.header = words, number
            _understand(head, before, lines, columns)
            return head
        if len(words) > 1 and all(map(is_numeric, words)):
            head.taken = [(number, text)]
            _pass_over(head, before, comment, columns)
            return head
        before.append((number, text))
        if len(before) == MOST_BEFORE:
            break
    return _without_rows(before, separator, columns) if before else None


def trimmed(words: Sequence[str], width: int = 0) -> list[str]:
    """The words without empty ones at the end, but not fewer than ``width``."""
    count = len(words)
    while count > width and not words[count - 1]:
        count -= 1
    return list(words[:count])


def is_rule(text: str) -> bool:
    """Whether a line is drawn, and holds nothing."""
    return text[0] in DRAWN and any(run in text for run in RUNS) and set(text) <= DRAWN


def _understand(head: Head, before: Sequence[Line], lines: Iterator[Line], columns: Columns) -> None:
    """Take in what stands about a header: units that are the truth's, remarks; the first row after these."""
    number = head.header
    places = columns.among(head.names)
    refuse_undecodable("".join(head.names[place] for place in places), number)
    for _, text in before:
        words = trimmed(head.dialect.split(text))
        if len(words) == len(head.names) and all(unit(word) for word in words if word):
            columns.refuse_units([words[place] for place in places], alone=True)
    if before:
        head.notes.append(f"{_counted(before)} before the header, which is line {number}, did not count.")
    under: list[int] = []
    for at, text in lines:
        if is_rule(text):
            if text.startswith("-") and not set(text) & set("+|"):
                under.append(at)  # numbers that are missing may be written so
            continue
        words = trimmed(head.dialect.split(text), len(head.names))
        cells = [words[place] for place in places] if len(words) == len(head.names) else []
        if len(under) == MOST_UNDER or not cells or not _is_remark(cells, words):
            head.taken = [(at, text)]
            break
        columns.refuse_units(cells, alone=True)
        if not all(unit(cell) for cell in cells):
            under.append(at)
    if under:
        which = f"Line {under[0]}" if len(under) == 1 else f"Lines {', '.join(map(str, under))}"
        head.notes.append(f"{which} under the header, of text, did not count.")
    _read_as_rows(head)


def _is_remark(cells: Sequence[str], words: Sequence[str]) -> bool:
    """Whether a line under the header is of text alone: no number, no attempt at one, and none that is missing."""
    if not any(words):
        return True
    return all(
        unit(cell) or not (ATTEMPT.match(cell) or cell.casefold() in MISSING or is_numeric(cell)) for cell in cells
    )


def _read_as_rows(head: Head) -> None:
    """Take the separator of the first row, where the header's would not give as many fields; and where rows begin with
    their names in quotes, as R writes them, let the header have a name for these too.
    """
    words = trimmed(head.dialect.split(head.first, len(head.names)))
    if not head.first or len(words) == len(head.names):
        return
    if len(words) == len(head.names) + 1 and head.first.lstrip().startswith('"') and head.first.count('"') == 2:
        head.names = ["", *head.names]
        return
    other = Dialect(head.first)
    words = other.split(head.first)
    if other.separator != head.dialect.separator and len(words) == len(head.names) and all(map(is_numeric, words)):
        head.dialect = other


def _pass_over(head: Head, before: Sequence[Line], comment: Callable[[str], None], columns: Columns) -> None:
    """Take lines before rows for comments, where they are marked as such; or for a header whose names do not matter,
    because the columns were asked for by their numbers.

    Raises:
        ValueError: one of them should be the header, and is not.
    """
    if not before:
        return
    mark = next((mark for mark in COMMENTED if all(text.startswith(mark) for _, text in before)), None)
    if mark is not None:
        for _, text in before:
            comment(text)
        head.notes.append(f"{_counted(before)} before the table, beginning with {mark}, did not count.")
        return
    number, text = head.taken[0]
    width = len(trimmed(head.dialect.split(text)))
    candidates = [(at, words) for at, line in before if len(words := _words(line, head.dialect)) == width]
    for at, other in before:
        refuse_undecodable(other, at)
    if candidates:
        head.header, head.names = candidates[-1]
        places = columns.among(head.names)
        for _, words in candidates:
            if all(unit(word) for word in words if word):
                columns.refuse_units([words[place] for place in places], alone=True)
        head.notes.append(f"{_counted(before)} before the first row, which is line {number}, did not count.")
        return
    which = "" if width == len(columns.wanted) else ", and --columns would say which of its columns they are"
    raise ValueError(
        f"no line before line {number}, the first of numbers, names {', '.join(columns.names)}; a header with these "
        f"names is accepted, or --skip {number - 1} would begin the table at line {number}{which}."
    )


def _counted(lines: Sequence[Line]) -> str:
    return f"{len(lines)} lines" if len(lines) > 1 else "One line"


def _words(text: str, dialect: Dialect) -> list[str]:
    """The words of a line that may be a header: by the table's separator, or its own."""
    words = trimmed(dialect.split(text))
    return words if len(words) > 1 else trimmed(Dialect(text).split(text))


def _without_rows(before: Sequence[Line], separator: str, columns: Columns) -> Head:
    """The head of lines among which there is no header, and no row of several numbers.

    Raises:
        ValueError: a column is missing in the first, which should be the header.
    """
    number, text = before[0]
    dialect = Dialect(text, separator)
    words = trimmed(dialect.split(text))
    if all(map(is_numeric, words)):
        return Head(dialect, taken=list(before))
    refuse_undecodable("".join(words), number)
    columns.among(words)
    return Head(dialect, number, words, list(before[1:]))  # its columns were asked for by their numbers


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
