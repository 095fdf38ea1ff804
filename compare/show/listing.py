"""The methods as a table: name, family, order, stages, whether symplectic, source."""

from __future__ import annotations

import csv
import io
import json
import textwrap
from typing import TYPE_CHECKING

from compare.show import text_table
from compare.show.text_table import Column, Grid, Section

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from compare.methods.kinds.protocol import Method

__all__ = ["FIELDS", "render"]

FIELDS = ("name", "family", "order", "stages", "symplectic", "source")


def render(methods: Iterable[Method], form: str = "text") -> str:
    """The methods in one of the table formats; JSON is an object whose ``methods`` have FIELDS and their aliases."""
    known = list(methods)
    rows = [tuple(getattr(method, field) for field in FIELDS) for method in known]
    if form == "json":
        objects = (dict(zip(FIELDS, row, strict=True)) for row in rows)
        lines = [
            json.dumps({**fields, "aliases": method.aliases}, ensure_ascii=False)
            for fields, method in zip(objects, known, strict=True)
        ]
        return '{"methods": [\n  ' + ",\n  ".join(lines) + "\n]}\n"
    cells = [tuple(_word(value) for value in row) for row in rows]
    if form == "csv":
        buffer = io.StringIO()
        csv.writer(buffer, lineterminator="\n").writerows([FIELDS, *cells])
        return buffer.getvalue()
    if form == "text":
        cells = [line for row in cells for line in _folded(row)]
    columns = tuple(Column(field, left=field not in {"order", "stages"}) for field in FIELDS)
    section = Section("methods", f"{len(rows)} methods", (Grid(columns, tuple(cells)),))
    return {"text": text_table.text, "markdown": text_table.markdown, "latex": text_table.latex}[form](section)


def _folded(row: tuple[str, ...]) -> Iterator[tuple[str, ...]]:
    """The row over as many lines as its source needs, which is its last field."""
    for i, line in enumerate(textwrap.wrap(row[-1], 40) or [""]):
        yield (*row[:-1], line) if i == 0 else (*("" for _ in row[:-1]), line)


def _word(value: object) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return str(value)
