"""A study's records for programs: JSON and CSV at full precision, in an order of keys that does not change."""

from __future__ import annotations

import csv
import io
import json
import math
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["COLUMNS", "Columns", "csv_text", "json_text", "rows"]

Columns = dict[str, tuple[str, ...]]
"""The fields of each table of a study, by the table's name."""

COLUMNS: Columns = {
    "error_vs_n": ("method", "n", "h", "theta0", "max_error", "end_error", "local_order", "floor", "evaluations"),
    "order": ("method", "theta0", "declared_order", "fitted_order", "spread", "cells_used", "n_range"),
    "energy_drift": (
        "method",
        "n",
        "h",
        "theta0",
        "max_drift_above_rest",
        "max_drift_relative",
        "slope_per_period",
        "slope_interval",
    ),
}


def rows(study: Any, table: str, columns: Columns = COLUMNS) -> list[dict[str, Any]]:
    """One table of the study as plain rows; a number that is not finite is None."""
    return [{key: _plain(getattr(record, key)) for key in columns[table]} for record in getattr(study, table)]


def json_text(study: Any, columns: Columns = COLUMNS) -> str:
    """One JSON object: problem, parameters, reference, engine, tables; one line a row, floats to the last bit.

    A number that is not finite is null, since JSON has no such numbers.
    """
    heads = [f'  "{name}": {_json(getattr(study, name))},' for name in ("problem", "parameters", "reference", "engine")]
    tables = [f'    "{table}": {_json_rows(rows(study, table, columns))}' for table in columns]
    return "\n".join(["{", *heads, '  "tables": {', ",\n".join(tables), "  }", "}", ""])


def csv_text(study: Any, columns: Columns = COLUMNS) -> dict[str, str]:
    """Each table by name as CSV (RFC 4180 quoting, lines ended by a newline), its first column naming the table.

    A number that is not finite, or not known, is an empty field; a range of N is two fields.
    """
    return {table: _csv(table, rows(study, table, columns), columns[table]) for table in columns}


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
