"""The reproduced tables as a page."""

from __future__ import annotations

import itertools
import textwrap
from typing import TYPE_CHECKING

from compare.show.digits import NOTES, ROUNDING
from compare.show.page import Head, Lines, Page, field_names, fields_of
from compare.show.text_table import Column, Grid, Table, text_width
from compare.sources.published.entry import Entry
from compare.sources.published.source import sources

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from compare.show.page import Block
    from compare.sources.published.entry import Reproduction

__all__ = ["page"]

LABELS = ("published", "reproduced", "exact", "off by")
EXACTLY = ("published", "exact", "off by")
"""The same of a column that no method computes."""
NOT_PRINTED = ("reproduced", "exact")
"""What is shown of a column that the source does not print."""
LEGEND = (
    "[ ] marks the digits from the first that is not the published one, or where none is published the reproduced one; "
    "off by: reproduced, or exact where no method is, less published, in units of the last printed digit; ! marks a "
    "published digit that is wrong."
)


def page(found: Sequence[Reproduction]) -> Page:
    """The tables; JSON is a list of their entries."""
    entries = [fields_of(entry, "wrong") for one in found for entry in one.entries]

    def blocks(form: str, width: int) -> Iterator[Block]:
        cited = {one.table.source: sources()[one.table.source] for one in found}
        yield Head((*(f"{name}: {text}" for name, text in cited.items()), LEGEND), "Published")
        yield from (_table(one, form, width) for one in found)

    return Page(
        name="published",
        blocks=blocks,
        data=lambda: Lines(entries),
        sheets=lambda: {"published": [field_names(Entry, "wrong"), *(entry.values() for entry in entries)]},
        widths={},
    )


def _table(one: Reproduction, form: str, width: int) -> Table:
    table = one.table
    page = [f"The page is inferred: {table.inferred}."] if table.inferred else []
    rounding = [f"{NOTES[ROUNDING]}."] if any(entry.shown != entry.reproduced for entry in one.entries) else []
    notes = [f"{one.summary}.", *([f"{table.note}."] if table.note else []), *_notes(one), *rounding, *page]
    return Table(
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
        if chosen and text_width(_grid(one, [*chosen, name])) > width:
            grids.append(_grid(one, chosen))
            chosen = []
        chosen.append(name)
    return [*grids, _grid(one, chosen)]


def _grid(one: Reproduction, names: Sequence[str]) -> Grid:
    table = one.table
    entries = {(entry.column, entry.row): entry for entry in one.entries}
    kinds = {one.name: (EXACTLY if one.exactly else LABELS) if one.printed else NOT_PRINTED for one in table.columns}
    head = Column(f"{table.row_name} [{table.row_units}]" if table.row_units else table.row_name)
    columns = (head, *(Column(label, name) for name in names for label in kinds[name]))
    rows = tuple(
        (row, *(cell for name in names for cell in _cells(entries.get((name, row)), kinds[name]))) for row in table.rows
    )
    return Grid(columns, rows)


def _cells(entry: Entry | None, labels: Sequence[str]) -> tuple[str, ...]:
    """The cells of an entry, with the digits marked that differ."""
    if entry is None:
        return ("",) * len(labels)
    if entry.published is None:
        # beside a number that tells itself which of its digits are rounding the exact one needs no mark
        decided = entry.shown == entry.reproduced
        return entry.shown, _marked(entry.exact, entry.reproduced) if decided else entry.exact
    return (
        entry.published + ("!" if entry.wrong else ""),
        *([_marked(entry.reproduced, entry.published)] if "reproduced" in labels else []),
        _marked(entry.exact, entry.published),
        f"{entry.off_by:+d}" if entry.off_by else "0",
    )


def _marked(text: str, other: str) -> str:
    """The text with brackets around it from the first character in which it differs from the other."""
    same = sum(1 for _ in itertools.takewhile(lambda pair: pair[0] == pair[1], zip(text, other, strict=False)))
    return text if text == other else f"{text[:same]}[{text[same:]}]"
