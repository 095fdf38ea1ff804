"""What a command shows, before it has a format: tables and sentences for readers, and the same records for programs."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from compare.show.text_table import Table

__all__ = ["Block", "Head", "Lines", "Page", "Sentence", "field_names", "fields_of", "in_lines", "plain", "word"]


@dataclass(frozen=True)
class Head:
    """What stands above the tables.

    Attributes:
        entries: labels with their facts, in two columns, or sentences.
        title: the heading of the Markdown form, at this ``level``.
        needs: the first comment of the LaTeX form, or "".
    """

    entries: tuple[tuple[str, str] | str, ...]
    title: str
    level: int = 2
    needs: str = r"needs \usepackage{booktabs}"


@dataclass(frozen=True)
class Sentence:
    """A line by itself; in LaTeX a comment."""

    text: str


Block = Table | Head | Sentence | str
"""A part of a page; a string is finished text of the format that was asked for."""


@dataclass(frozen=True)
class Lines:
    """A list or an object of JSON with a line for each entry; other lists and objects stand in one line.

    It stands in other lines, or directly in what stands in one.
    Where there is no entry it stands in one line too, unless it is to be ``opened`` always.
    """

    entries: Sequence[Any] | Mapping[str, Any]
    opened: bool = False


@dataclass(frozen=True)
class Page:
    """Everything that a command shows.

    Attributes:
        name: what its files are called.
        blocks: from a readable format and the width of a line to the parts of the page.
        data: what the JSON form holds.
        sheets: the rows of the CSV form by the name of their table, the first one its header.
        widths: the width of a line in formats that do not take the terminal's.
        between: what stands between two blocks, where it is not one empty line.
        indent: spaces for each level of the JSON form.
    """

    name: str
    blocks: Callable[[str, int], Iterable[Block]]
    data: Callable[[], Any]
    sheets: Callable[[], Mapping[str, Iterable[Iterable[object]]]] = dict
    widths: Mapping[str, int] = field(default_factory=lambda: {"markdown": 100, "latex": 72})
    between: Mapping[str, str] = field(default_factory=dict)
    indent: int = 2


def field_names(kind: type, *without: str) -> tuple[str, ...]:
    """The fields of a frozen record in their order, but for those that are not shown."""
    return tuple(one.name for one in dataclasses.fields(kind) if one.name not in without)


def fields_of(record: Any, *without: str) -> dict[str, Any]:
    """The fields of one record with their values."""
    return {name: getattr(record, name) for name in field_names(type(record), *without)}


def in_lines(value: Any) -> Any:
    """The value with a line for each entry of every list and object in it."""
    if isinstance(value, Mapping):
        return Lines({key: in_lines(item) for key, item in value.items()})
    return Lines([in_lines(item) for item in value]) if isinstance(value, (list, tuple)) else value


def plain(value: Any) -> Any:
    """The value in JSON's own types; None for a number that is not finite."""
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if value is None or isinstance(value, (bool, int, str)):
        return value
    number = float(value)
    return number if math.isfinite(number) else None


def word(value: Any) -> str:
    """A fact of a method or an entry as readers take it."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, tuple):
        return ", ".join(map(str, value)) or "none"
    return "not known" if value is None else str(value)
