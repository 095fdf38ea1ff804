"""A study of any kind as a page: what was computed, against what and by what, then its tables and all its records."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from compare.show.page import Head, Lines, Page, plain

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from compare.show.page import Block
    from compare.show.text_table import Table

__all__ = ["Columns", "header", "rows", "study_page"]

Columns = dict[str, tuple[str, ...]]
"""The fields of each table of a study, by the table's name."""
RANGES = {"n_range": ("n_from", "n_to")}
"""Fields that hold two numbers, and what the two are called in CSV."""


def study_page(study: Any, tables: Callable[[Any, int], Iterable[Table]], columns: Columns, prefix: str = "") -> Page:
    """The page of a study.

    Args:
        study: frozen records by the name of their table, one that was not asked for None; problem, parameters,
            reference and engine.
        tables: from a study and the width of a line to its readable tables.
        columns: the fields of its tables for programs.
        prefix: what its files' names have before the problem's.
    """

    def blocks(_: str, width: int) -> Iterator[Block]:
        yield Head(tuple(header(study)), study.problem)
        yield from tables(study, width)

    present = [table for table in columns if getattr(study, table) is not None]

    def data() -> Lines:
        """Problem, parameters, reference, engine, tables; one line a row."""
        head = {name: getattr(study, name) for name in ("problem", "parameters", "reference", "engine")}
        found = Lines({table: Lines(rows(study, table, columns)) for table in present})
        return Lines({**head, "tables": found})

    return Page(
        name=prefix + study.problem,
        blocks=blocks,
        data=data,
        sheets=lambda: {table: _sheet(study, table, columns) for table in present},
        between={"text": "\n\n"},
    )


def rows(study: Any, table: str, columns: Columns) -> list[dict[str, Any]]:
    """One table of the study as plain rows; an input that a record's case does not have is None."""
    keys = _fields(study, columns[table])
    return [{key: plain(getattr(record, key, None)) for key in keys} for record in getattr(study, table)]


def _fields(study: Any, keys: Iterable[str]) -> tuple[str, ...]:
    """The keys, with the inputs of the study's cases in the place of a "case"."""
    inputs = tuple(dict.fromkeys(name for case in getattr(study, "cases", ()) for name, _ in case.inputs))
    return tuple(name for key in keys for name in (inputs if key == "case" else (key,)))


def _sheet(study: Any, table: str, columns: Columns) -> Iterator[list[Any]]:
    """One table with its name in the first column; a range is two fields."""
    keys = _fields(study, columns[table])
    yield ["table", *(name for key in keys for name in RANGES.get(key, (key,)))]
    for row in rows(study, table, columns):
        values = [(row[key] or (None, None)) if key in RANGES else (row[key],) for key in keys]
        yield [table, *(value for pair in values for value in pair)]


def header(study: Any) -> Iterator[tuple[str, str]]:
    """What was computed, against what and by what: names and their facts."""
    values = (
        f"{name} = {_value(value)} {_slashed(study.units.get(name, ''))}".rstrip()
        for name, value in study.parameters.items()
    )
    yield study.problem, ", ".join(values)
    for name, fact in (*study.reference.items(), *study.engine.items()):
        yield name, _value(fact)


def _slashed(units: str) -> str:
    """Units with what is divided by behind a slash: m/s^2 of "m s-2"."""
    powers = [re.fullmatch(r"(\D+?)(-?\d+)?", unit).groups() for unit in units.split()]  # type: ignore[union-attr]
    above = [unit + (f"^{power}" if power else "") for unit, power in powers if not (power or "").startswith("-")]
    below = [
        unit + (f"^{power[1:]}" if power != "-1" else "") for unit, power in powers if (power or "").startswith("-")
    ]
    return "/".join([" ".join(above) or "1", *below]) if below else " ".join(above)


def _value(value: object) -> str:
    if isinstance(value, (list, tuple)):
        return ", ".join(f"({_value(item)})" if isinstance(item, (list, tuple)) else _value(item) for item in value)
    if isinstance(value, dict):
        return "; ".join(f"{key}: {_value(item)}" for key, item in value.items())
    return value if isinstance(value, str) else repr(value)
