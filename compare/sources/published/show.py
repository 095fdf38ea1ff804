"""The reproduced tables as text, Markdown, CSV, LaTeX or JSON."""

from __future__ import annotations

import csv
import io
import itertools
import json
import textwrap
from typing import TYPE_CHECKING, Any

from compare.show import text_table
from compare.show.digits import NOTES, ROUNDING
from compare.show.render import FORMATS
from compare.show.text_table import Column, Grid, Section
from compare.sources.published.source import sources

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.sources.published.entry import Entry, Reproduction

__all__ = ["FIELDS", "render"]

FIELDS = ("item", "row", "column", "published", "reproduced", "shown", "exact", "off_by", "note")
LABELS = ("published", "reproduced", "exact", "off by")
NOT_PRINTED = ("reproduced", "exact")
"""What is shown of a column that the source does not print."""
LEGEND = (
    "[ ] marks the digits from the first that is not the published one, or where none is published the reproduced one; "
    "off by: reproduced less published, in units of the last printed digit; ! marks a published digit that is wrong."
)


def render(found: Sequence[Reproduction], form: str = "text", width: int = 100) -> str:
    """The tables in one of FORMATS; JSON is a list of objects with FIELDS; ``width`` is the longest line of the text.

    Raises:
        ValueError: the format is not one of FORMATS.
    """
    if form not in FORMATS:
        raise ValueError(f"the format {form!r} is not one of {', '.join(FORMATS)}")
    rows = [{name: getattr(entry, name) for name in FIELDS} for one in found for entry in one.entries]
    if form == "json":
        return "[\n" + ",\n".join(f"  {json.dumps(row, ensure_ascii=False)}" for row in rows) + "\n]\n"
    if form == "csv":
        return _csv(rows)
    write = {"text": text_table.text, "markdown": text_table.markdown, "latex": text_table.latex}[form]
    parts = [write(_section(one, form, width)) for one in found]
    return "\n".join([_heading(found, form, width), *parts])


def _csv(rows: Sequence[dict[str, Any]]) -> str:
    buffer = io.StringIO()
    writer = csv.DictWriter(buffer, FIELDS, lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return buffer.getvalue()


def _heading(found: Sequence[Reproduction], form: str, width: int) -> str:
    """The documents, and what the marks mean."""
    cited = {one.table.source: sources()[one.table.source] for one in found}
    facts = [f"{name}: {text}" for name, text in cited.items()] + [LEGEND]
    if form == "markdown":
        return "## Published\n\n" + "\n".join(f"- {text_table.markdown_text(fact)}" for fact in facts) + "\n"
    if form == "latex":
        return "\n".join(f"% {fact}" for fact in (r"needs \usepackage{booktabs}", *facts)) + "\n"
    return "\n".join(textwrap.fill(fact, width, subsequent_indent="  ") for fact in facts) + "\n"


def _section(one: Reproduction, form: str, width: int) -> Section:
    table = one.table
    page = [f"The page is inferred: {table.inferred}."] if table.inferred else []
    rounding = [f"{NOTES[ROUNDING]}."] if any(entry.shown != entry.reproduced for entry in one.entries) else []
    notes = [f"{one.summary}.", *([f"{table.note}."] if table.note else []), *_notes(one), *rounding, *page]
    return Section(
        name=f"published-{table.name}",
        title=f"{table.cited}: {table.title}",
        grids=tuple(_grids(one, width)),
        note="\n".join(textwrap.fill(note, width, subsequent_indent="  ") for note in notes)
        if form == "text"
        else {"markdown": "  \n", "latex": " "}[form].join(notes),
    )


def _notes(one: Reproduction) -> list[str]:
    """What is said of whole columns, and of single entries."""
    table = one.table
    return [
        f"{column.name}{where}: {note}."
        for column in table.columns
        for where, note in [
            ("", column.note),
            *((f", {table.row_name} = {row}", text) for row, text in column.notes.items()),
        ]
        if note
    ]


def _grids(one: Reproduction, width: int) -> list[Grid]:
    """As many columns of the table beside each other as the width takes."""
    names = [column.name for column in one.table.columns]
    grids: list[Grid] = []
    chosen: list[str] = []
    for name in names:
        if chosen and text_table.text_width(_grid(one, [*chosen, name])) > width:
            grids.append(_grid(one, chosen))
            chosen = []
        chosen.append(name)
    return [*grids, _grid(one, chosen)]


def _grid(one: Reproduction, names: Sequence[str]) -> Grid:
    table = one.table
    entries = {(entry.column, entry.row): entry for entry in one.entries}
    printed = {column.name: bool(column.printed) for column in table.columns}
    head = Column(f"{table.row_name} [{table.row_units}]" if table.row_units else table.row_name)
    labels = {name: LABELS if printed[name] else NOT_PRINTED for name in names}
    columns = (head, *(Column(label, name) for name in names for label in labels[name]))
    rows = tuple(
        (row, *(cell for name in names for cell in _cells(entries.get((name, row)), len(labels[name]))))
        for row in table.rows
    )
    return Grid(columns, rows)


def _cells(entry: Entry | None, count: int) -> tuple[str, ...]:
    """The cells of an entry, with the digits marked that differ."""
    if entry is None:
        return ("",) * count
    if entry.published is None:
        # beside a number that tells itself which of its digits are rounding the exact one needs no mark
        decided = entry.shown == entry.reproduced
        return entry.shown, _marked(entry.exact, entry.reproduced) if decided else entry.exact
    return (
        entry.published + ("!" if entry.wrong else ""),
        _marked(entry.reproduced, entry.published),
        _marked(entry.exact, entry.published),
        f"{entry.off_by:+d}" if entry.off_by else "0",
    )


def _marked(text: str, other: str) -> str:
    """The text with brackets around it from the first character in which it differs from the other."""
    same = sum(1 for _ in itertools.takewhile(lambda pair: pair[0] == pair[1], zip(text, other, strict=False)))
    return text if text == other else f"{text[:same]}[{text[same:]}]"
