"""A study of any kind as text, Markdown, CSV, LaTeX or JSON: its header, then its tables.

The readable forms (text, Markdown, LaTeX) take finished sections; CSV and JSON are written by `compare.show.render`.

A study's records for programs: JSON and CSV at full precision, in an order of keys that does not change.
"""

from __future__ import annotations

import csv
import io
import json
import math
import textwrap
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from compare.show import text_table

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from compare.show.text_table import Section

__all__ = ["COLUMNS", "FORMATS", "Columns", "Tables", "csv_text", "files", "header", "json_text", "render", "rows"]

Columns = dict[str, tuple[str, ...]]
"""The fields of each table of a study, by the table's name."""

COLUMNS: Columns = {
    "error_vs_n": (
        "method",
        "n",
        "h",
        "case",
        "max_error",
        "end_error",
        "local_order",
        "floor",
        "evaluations",
        "rms_error",
        "max_velocity_error",
        "end_velocity_error",
        "rms_velocity_error",
        "digits",
        "jacobians",
        "rounding",
    ),
    "order": ("method", "case", "declared_order", "fitted_order", "spread", "cells_used", "n_range", "rounding"),
    "energy_drift": (
        "method",
        "n",
        "h",
        "case",
        "max_drift_above_rest",
        "max_drift_relative",
        "slope_per_period",
        "slope_interval",
        "rounding",
    ),
    "phase": (
        "method",
        "n",
        "h",
        "case",
        "max_phase_error",
        "end_phase_error",
        "max_amplitude_error",
        "end_amplitude_error",
        "lost",
        "phase_rounding",
        "amplitude_rounding",
    ),
    "growth": ("method", "n", "h", "case", "quantity", "exponent", "interval", "law", "windows", "starts", "floor"),
    "period": ("method", "n", "h", "case", "period", "relative_error", "rounding"),
    "defects": (
        "method",
        "n",
        "h",
        "case",
        "symplecticity",
        "reversibility",
        "symplecticity_rounding",
        "reversibility_rounding",
    ),
}


def rows(study: Any, table: str, columns: Columns = COLUMNS) -> list[dict[str, Any]]:
    """One table of the study as plain rows; a number that is not finite is None, and so is an input that has none."""
    keys = _fields(study, columns[table])
    return [{key: _plain(getattr(record, key, None)) for key in keys} for record in getattr(study, table)]


def _fields(study: Any, keys: Iterable[str]) -> tuple[str, ...]:
    """The keys, with the inputs of the study's cases in the place of a "case"."""
    inputs = tuple(dict.fromkeys(name for case in getattr(study, "cases", ()) for name, _ in case.inputs))
    return tuple(name for key in keys for name in (inputs if key == "case" else (key,)))


def _present(study: Any, columns: Columns) -> list[str]:
    """The tables that the study has; one that was not asked for is None."""
    return [table for table in columns if getattr(study, table) is not None]


def json_text(study: Any, columns: Columns = COLUMNS) -> str:
    """One JSON object: problem, parameters, reference, engine, tables; one line a row, floats to the last bit.

    A number that is not finite is null, since JSON has no such numbers.
    """
    heads = [f'  "{name}": {_json(getattr(study, name))},' for name in ("problem", "parameters", "reference", "engine")]
    tables = [f'    "{table}": {_json_rows(rows(study, table, columns))}' for table in _present(study, columns)]
    return "\n".join(["{", *heads, '  "tables": {', ",\n".join(tables), "  }", "}", ""])


def csv_text(study: Any, columns: Columns = COLUMNS) -> dict[str, str]:
    """Each table by name as CSV (RFC 4180 quoting, lines ended by a newline), its first column naming the table.

    A number that is not finite, or not known, is an empty field; a range of N is two fields.
    """
    return {
        table: _csv(table, rows(study, table, columns), _fields(study, columns[table]))
        for table in _present(study, columns)
    }


def _csv(table: str, found: Iterable[dict[str, Any]], keys: tuple[str, ...]) -> str:
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    ranges = {"n_range": ("n_from", "n_to")}
    writer.writerow(["table", *(name for key in keys for name in ranges.get(key, (key,)))])
    for row in found:
        fields = [(row[key] or (None, None)) if key in ranges else (row[key],) for key in keys]
        writer.writerow([table, *(_csv_field(value) for values in fields for value in values)])
    return buffer.getvalue()


def _csv_field(value: object) -> str:
    if value is None:
        return ""
    return str(value).lower() if isinstance(value, bool) else str(value)


def _json(value: object) -> str:
    return json.dumps(_plain(value), ensure_ascii=False, allow_nan=False)


def _json_rows(found: Iterable[dict[str, Any]]) -> str:
    lines = ",\n".join("      " + _json(row) for row in found)
    return f"[\n{lines}\n    ]" if lines else "[]"


def _plain(value: Any) -> Any:
    """The value in JSON's own types; None for a number that is not finite."""
    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if value is None or isinstance(value, (bool, int, str)):
        return value
    number = float(value)
    return number if math.isfinite(number) else None


FORMATS = ("text", "markdown", "csv", "latex", "json")

_SUFFIX = {"text": "txt", "markdown": "md", "latex": "tex", "json": "json"}
_PAGE_WIDTH = {"markdown": 100, "latex": 72}
_UNITS = {
    "theta0": "rad",
    "omega0": "rad/s",
    "angle": "rad",
    "end": "m",
    "radius": "m",
    "g": "m/s^2",
    "length": "m",
    "t_end": "s",
    "depth": "m",
    "psi_end": "rad",
}


@dataclass(frozen=True)
class Tables:
    """How a kind of study is shown.

    Attributes:
        sections: from a study and the width of a line to its readable tables.
        columns: the fields of its tables for programs.
        prefix: what its files' names have before the problem's.
    """

    sections: Callable[[Any, int], Iterable[Section]]
    columns: Columns
    prefix: str = ""


def render(study: Any, tables: Tables, form: str = "text", width: int = 100) -> str:
    """The study's tables in one of FORMATS; `width` is the longest line of the text form.

    Raises:
        ValueError: the format is not one of FORMATS.
    """
    if form == "json":
        return json_text(study, tables.columns)
    if form == "csv":
        return "\n".join(csv_text(study, tables.columns).values())
    if form not in FORMATS:
        raise ValueError(f"the format {form!r} is not one of {', '.join(FORMATS)}")
    parts = tables.sections(study, _PAGE_WIDTH.get(form, width))
    if form == "markdown":
        bullets = "\n".join(f"- **{name}**: {text_table.markdown_text(fact)}" for name, fact in header(study))
        return "\n".join([f"## {study.problem}\n\n{bullets}\n", *map(text_table.markdown, parts)])
    if form == "latex":
        facts = (f"{name}: {fact}" for name, fact in header(study))
        comment = "\n".join(f"% {line}" for line in ("needs \\usepackage{booktabs}", *facts))
        return "\n".join([comment + "\n", *map(text_table.latex, parts)])
    return "\n\n".join([_header_text(study, width) + "\n", *map(text_table.text, parts)])


def files(study: Any, tables: Tables, form: str = "text", width: int = 100) -> dict[str, bytes]:
    """What `render` gives, by file name: one file, or for CSV one file a table."""
    stem = tables.prefix + study.problem
    if form == "csv":
        written = csv_text(study, tables.columns)
        return {f"{stem}-{name}.csv": table.encode() for name, table in written.items()}
    return {f"{stem}.{_SUFFIX[form]}": render(study, tables, form, width).encode()}


def header(study: Any) -> Iterator[tuple[str, str]]:
    """What was computed, against what and by what: names and their facts."""
    values = (f"{name} = {_value(value)} {_UNITS.get(name, '')}".rstrip() for name, value in study.parameters.items())
    yield study.problem, ", ".join(values)
    for name, fact in (*study.reference.items(), *study.engine.items()):
        yield name, _value(fact)


def _header_text(study: Any, width: int) -> str:
    """The header as two columns."""
    facts = list(header(study))
    indent = max(len(name) for name, _ in facts) + 2
    return "\n".join(
        textwrap.fill(fact, width, initial_indent=name.ljust(indent), subsequent_indent=" " * indent)
        for name, fact in facts
    )


def _value(value: object) -> str:
    if isinstance(value, (list, tuple)):
        return ", ".join(f"({_value(item)})" if isinstance(item, (list, tuple)) else _value(item) for item in value)
    if isinstance(value, dict):
        return "; ".join(f"{key}: {_value(item)}" for key, item in value.items())
    return value if isinstance(value, str) else repr(value)
