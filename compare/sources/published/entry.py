"""Every entry of a table: as published, as reproduced, as exact."""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal
from typing import TYPE_CHECKING

from compare.sources.published import curve, forms, pendulum, solution
from compare.sources.published.number import Rounded
from compare.sources.published.source import figures, solutions, tables
from reference.names import unknown

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from compare.sources.published.source import Column, Table

__all__ = ["Entry", "Reproduction", "reproduce"]

REPRODUCED = pendulum.REPRODUCED | curve.REPRODUCED | forms.REPRODUCED
EXACT = pendulum.EXACT | curve.EXACT | forms.EXACT


@dataclass(frozen=True)
class Entry:
    """A number of a table.

    Attributes:
        item: the table, such as "report table 9".
        row: the row's quantity as printed.
        column: the column's name.
        published: the number as printed, None where it is not.
        reproduced: what the method or formula gives, to as many places.
        shown: the same for readers, without digits that rounding may have made.
        exact: what is true, to as many places.
        off_by: reproduced less published, in units of the last printed digit; None where nothing is printed.
        wrong: whether it claims to be exact and is not, to the last digit.
        note: what is to be said of it, or "".
    """

    item: str
    row: str
    column: str
    published: str | None
    reproduced: str
    shown: str
    exact: str
    off_by: int | None
    wrong: bool
    note: str


@dataclass(frozen=True)
class Reproduction:
    """A table with its entries, column by column."""

    table: Table
    entries: tuple[Entry, ...]

    @property
    def summary(self) -> str:
        """One line: entries, those reproduced to the last digit, those published that are wrong."""
        printed = [entry for entry in self.entries if entry.published is not None]
        if not printed:
            return f"{len(self.entries)} entries, none of them printed"
        same = sum(entry.off_by == 0 for entry in printed)
        wrong = sum(entry.wrong for entry in printed)
        claims = any(column.claims_exact for column in self.table.columns)
        verdict = f"{wrong} of those that claim to be exact wrong" if claims else "none claims to be exact"
        if all(column.exactly for column in self.table.columns):
            return f"{len(printed) - same} of {len(printed)} published entries off in their last digit or before"
        return f"{len(printed)} published entries; {same} reproduced to the last digit; {verdict}"


def reproduce(names: Sequence[str] = ()) -> list[Reproduction]:
    """The tables of these names, or all of the two documents, computed again.

    Raises:
        ValueError: a name is unknown.
    """
    known = {table.name: table for table in (*tables(), *solutions())}
    for name in names:
        if name not in known:
            raise ValueError(unknown("table", name, list(known), [figure.name for figure in figures()]))
    return [
        Reproduction(known[name], tuple(_entries(known[name])))
        for name in dict.fromkeys(names or [table.name for table in tables()])
    ]


def _entries(table: Table) -> Iterator[Entry]:
    for column in table.columns:
        for i, row in enumerate(table.rows):
            if row not in column.skip:
                yield _entry(table, column, row, column.printed[i] if column.printed else None)


def _entry(table: Table, column: Column, row: str, published: str | None) -> Entry:
    places = column.places if published is None else _places(published)
    if column.exactly and published is not None:
        number = solution.component(table, row)
        reproduced = exact = solution.as_printed(number, published)
    else:
        number = REPRODUCED[table.name][column.by](table, column, row)
        reproduced, exact = number.fixed(places), EXACT[table.name](table, column, row).fixed(places)
    off_by = None if published is None else _units(reproduced, published)
    return Entry(
        item=table.item,
        row=row,
        column=column.name,
        published=published,
        reproduced=reproduced,
        exact=exact,
        off_by=off_by,
        wrong=column.claims_exact and published != exact,
        note="; ".join(filter(None, (column.note, column.notes.get(row)))),
        shown=number.shown if isinstance(number, Rounded) else reproduced,
    )


def _places(text: str) -> int:
    return len(text.partition(".")[2])


def _units(text: str, printed: str) -> int:
    """The difference in units of the last printed digit."""
    return int((Decimal(text) - Decimal(printed)).scaleb(-int(Decimal(printed).as_tuple().exponent)))
