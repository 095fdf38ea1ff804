"""Rows of JSON: an object or an array a line, or one array of such rows, or columns in one object."""

from __future__ import annotations

import json
import re
from collections import Counter
from itertools import chain
from typing import TYPE_CHECKING, Any

from compare.files.chunk import Chunk, Row
from compare.files.columns import USUAL
from compare.files.dialect import Dialect, is_numeric
from compare.files.exact_rows import Exact
from compare.files.packed import rows_first
from reference.names import short

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from compare.files.columns import Columns
    from compare.files.lines import Line

__all__ = ["JsonTable", "is_json", "json_table"]

BEGINS = re.compile(r"\[\s*(?:[]\[{\"\d-]|$)|\{\s*(?:[\"}]|$)")

MOST_TEXT = 1 << 24
"""Characters of JSON that is not of lines, and must be read at once."""
ROWS = "an object or an array a line is accepted, or an array of them, or an object of columns"


class JsonTable:
    """Rows whose numbers are named by their keys; without these they are in order.

    Raises:
        ValueError: a column is missing, or there are others than are wanted where nothing names them.
    """

    def __init__(self, columns: Columns, names: Sequence[str] | None, width: int, unit: str) -> None:
        self._columns, self._names, self._width, self._unit = columns, names, width, unit
        self._places = columns.among(names) if names is not None else columns.without_header(width)
        self._dialect = Dialect("", ",")

    def row(self, line: Line) -> Row:
        """The numbers of one row, exactly.

        Raises:
            ValueError: it is no row like the first, or holds no finite number where one is wanted.
        """
        number, text = line
        at = f"{self._unit} {number}"
        found = _read(text, at)
        if isinstance(found, dict) and self._names is not None:
            lacking = [name for name in (self._names[place] for place in self._places) if name not in found]
            if lacking:
                raise ValueError(f"{at} has no {short(lacking[0])}; the keys of the first row are accepted in all.")
            words = [found[self._names[place]] for place in self._places]
        elif isinstance(found, list) and len(found) == self._width and (self._names is None or self._unit == "row"):
            words = [found[place] for place in self._places]
        else:
            raise ValueError(f"{at} is no row like the first; {ROWS}.")
        texts = [word if isinstance(word, str) else json.dumps(word) for word in words]  # null is no number either
        t, *state = (
            self._dialect.number(word, name, at) for name, word in zip(self._columns.wanted, texts, strict=True)
        )
        return Row(t, tuple(state), at)

    def chunk(self, batch: Sequence[Line], *, doubles: bool) -> Chunk:
        """Some rows; their times are ``doubles``, or as they are written."""
        exact = Exact(self, batch, doubles=doubles)
        rows = [exact(place) for place in range(len(batch))]
        return Chunk(len(rows), rows.__getitem__)

    def notes(self, _tail: object) -> list[str]:
        """There is nothing to be known: JSON that breaks off is none."""
        return []


def is_json(text: str) -> bool:
    """Whether a line begins as JSON of rows does, and no header in brackets."""
    return BEGINS.match(text) is not None


def json_table(columns: Columns, first: Line, lines: Iterator[Line]) -> tuple[JsonTable, Iterator[Line]]:
    """The table that begins with the line ``first``, and its rows as lines.

    Raises:
        ValueError: it is no JSON, or JSON of something else, or of more than can be read at once.
    """
    number, text = first
    second = next(lines, None)
    if second is not None and is_json(second[1]) and _closed(text):
        row = _read(text, f"line {number}")
        names = list(row) if isinstance(row, dict) else None
        return JsonTable(columns, names, len(row), "line"), chain([first, second], lines)
    parts, size = [text], len(text)
    for _, part in chain([] if second is None else [second], lines):
        size += len(part)
        if size > MOST_TEXT:
            raise ValueError(
                f"this JSON is of more than {MOST_TEXT} characters, and no object or array a line, of which there may "
                "be any number; fewer are accepted."
            )
        parts.append(part)
    names, rows = _rows_of(columns, _read("\n".join(parts), "the file"))
    table = JsonTable(columns, names, len(rows[0]) if rows else len(columns.wanted), "row")
    return table, ((place, json.dumps(row)) for place, row in enumerate(rows, start=1))


def _closed(text: str) -> bool:
    """Whether a line of JSON ends where it began."""
    return text.rstrip().endswith("}" if text.startswith("{") else "]") and not text.startswith("[[")


def _read(text: str, where: str) -> Any:
    """JSON whose numbers are strings, as they are written.

    Raises:
        ValueError: it is none, or an object has a key twice.
    """

    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        found = dict(pairs)
        if len(found) < len(pairs):
            raise ValueError(f"{where} has an object with a key twice; each once is accepted.")
        return found

    try:
        return json.loads(text, parse_float=str, parse_int=str, parse_constant=str, object_pairs_hook=once)
    except json.JSONDecodeError as error:
        raise ValueError(
            f"{where} begins as JSON, and is none: {error.msg} at its column {error.colno}; {ROWS}."
        ) from None
    except RecursionError:
        raise ValueError(f"{where} has brackets within brackets beyond any row; {ROWS}.") from None


def _rows_of(columns: Columns, found: Any) -> tuple[list[str] | None, list[list[Any]]]:
    """The names and the rows of JSON that was read at once: of an array of rows, or an object of columns.

    Raises:
        ValueError: it is something else, or its columns are not of one length.
    """
    if isinstance(found, dict) and isinstance(found.get("data"), list):
        names = _header(columns, found)
        return _rows_of(columns, found["data"] if names is None else [names, *found["data"]])
    if isinstance(found, dict) and any(isinstance(each, (list, dict)) for each in found.values()):
        return _of_columns(columns, found)
    single = isinstance(found, dict) or not any(isinstance(each, (list, dict)) for each in found)
    rows = [found] if found and single else found
    if rows and all(isinstance(row, dict) for row in rows):
        names = list(rows[0])
        if any(row.keys() != rows[0].keys() for row in rows):
            raise ValueError(f"the objects have different keys; {ROWS}, with the same keys in each.")
        return names, [[row[name] for name in names] for row in rows]
    if rows and all(isinstance(row, list) and len(row) == len(rows[0]) for row in rows):
        named = all(isinstance(word, str) and not is_numeric(word) for word in rows[0])
        return (rows[0], rows[1:]) if named else (None, rows)
    raise ValueError(f"the file is JSON of something else than rows; {ROWS}.")


def _header(columns: Columns, found: dict[str, Any]) -> list[Any] | None:
    """The names beside an array of rows: under "columns", as pandas writes it with orient="split", or another word."""
    if isinstance(found.get("columns"), list):
        names: list[Any] = found["columns"]
        return names
    first = found["data"][0] if found["data"] else None
    width = len(first) if isinstance(first, list) else 0
    lists = [each for each in found.values() if isinstance(each, list) and len(each) == width]
    named = [each for each in lists if each and all(isinstance(word, str) and not is_numeric(word) for word in each)]
    return next((each for each in named if columns.named_by(each)), named[0] if named else None)


def _flattened(columns: Columns, found: dict[str, Any]) -> dict[str, Any]:
    """An object whose objects of arrays are opened, as {"y": {"theta": [...]}} has one; its own names come first.

    Raises:
        ValueError: two of these have an array that is wanted.
    """
    flat = {name: each for name, each in found.items() if not _opens(each)}
    inner = [item for each in found.values() if _opens(each) for item in each.items() if isinstance(item[1], list)]
    for name, count in Counter(name for name, _ in inner if name not in flat).items():
        if count > 1 and name in {*columns.names, USUAL}:
            raise ValueError(f"there are {count} arrays called {short(name)}; one is accepted.")
        if count == 1:
            flat[name] = next(values for each, values in inner if each == name)
    return flat


def _opens(each: Any) -> bool:
    return isinstance(each, dict) and any(isinstance(values, list) for values in each.values())


def _of_columns(columns: Columns, found: dict[str, Any]) -> tuple[list[str], list[list[Any]]]:
    """The names and rows of an object of columns: arrays, or objects by the number of the row, as pandas writes them;
    or one of times and one of states, as SciPy's solvers give them.
    """
    lists = {
        name: list(each.values()) if isinstance(each, dict) else each
        for name, each in _flattened(columns, found).items()
    }
    lists = {name: each for name, each in lists.items() if isinstance(each, list)}
    time, *state = columns.names
    table = lists.get(USUAL, [])
    if time in lists and not set(state) & set(lists) and table and all(isinstance(row, list) for row in table):
        if any(len(row) != len(table[0]) for row in table):
            raise ValueError(f"{USUAL} has rows of different lengths; one length is accepted.")
        if rows_first(columns, USUAL, (len(table), len(table[0])), (len(lists[time]),)):
            table = list(map(list, zip(*table, strict=True)))
        lists = {time: lists[time], **dict(zip(columns.wanted[1:], table, strict=True))}
    flat = {name: each for name, each in lists.items() if not any(isinstance(one, (list, dict)) for one in each)}
    names = [list(flat)[place] for place in columns.among(list(flat))]
    lengths = [len(flat[name]) for name in names]
    if len(set(lengths)) > 1:
        said = ", ".join(f"{short(name)} {length}" for name, length in zip(names, lengths, strict=True))
        raise ValueError(f"the columns have different lengths, {said}; one length is accepted.")
    return list(columns.names), [list(row) for row in zip(*(flat[name] for name in names), strict=True)]
