"""The data file: what was printed, as printed, with its page, and by what each column is computed again.

A page that no contents or list of figures prints is inferred, and the file says from what.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache
from pathlib import Path
from typing import Any

from reference.names import unknown

__all__ = ["Column", "Figure", "Table", "figure", "figures", "solutions", "sources", "tables"]

DATA = Path(__file__).with_name("published.toml")
SOLUTIONS = Path(__file__).with_name("solutions.toml")
"""The solutions that the literature prints of its own problems, at one time each."""


@dataclass(frozen=True)
class Column:
    """A column of a table.

    Attributes:
        name: what it is called here.
        by: what computes it; a key of the table's module.
        method, step: of a march, its method and step size.
        form: of a march along a curve, the slope that is marched.
        claims_exact: whether it is given as a solution of the equation, to every digit printed.
        printed: the entries as printed, none where the source does not print them.
        places: decimal places of an entry that is not printed.
        note, notes: what is to be said of all its entries, and of those of single rows.
        skip: rows in which it has no entry.
    """

    name: str
    by: str
    method: str = ""
    step: Fraction = Fraction(0)
    form: str = ""
    claims_exact: bool = False
    printed: tuple[str, ...] = ()
    places: int = 0
    note: str = ""
    notes: dict[str, str] = field(default_factory=dict, hash=False)
    skip: tuple[str, ...] = ()

    @property
    def exactly(self) -> bool:
        """Whether it is computed again exactly, and by no method."""
        return self.by == "solution"


@dataclass(frozen=True)
class Table:
    """A table or figure of a source.

    Attributes:
        name: as the command line spells it.
        source: whose it is, a key of ``sources()``.
        item: what it is called in records, such as "report table 9".
        page: where it is printed; 0 where it has no page.
        inferred: from what that is known, where the source does not print it.
        title: what its numbers are, with their unit.
        row_name, row_units: what tells its rows apart.
        rows: that quantity as printed.
        parameters: of the problem, as printed.
        note: what is to be said of it.
        columns: its columns.

    Raises:
        ValueError: a column has more or fewer entries than there are rows.
    """

    name: str
    source: str
    item: str
    page: int
    title: str
    row_name: str
    row_units: str
    rows: tuple[str, ...]
    parameters: dict[str, str] = field(hash=False)
    note: str
    columns: tuple[Column, ...]
    inferred: str = ""

    @property
    def cited(self) -> str:
        """The item with its page."""
        return _cited(self)

    def __post_init__(self) -> None:
        for column in self.columns:
            if column.printed and len(column.printed) != len(self.rows):
                raise ValueError(
                    f"{self.item}, {column.name}: {len(column.printed)} entries; {len(self.rows)} are accepted."
                )


@dataclass(frozen=True)
class Figure:
    """A figure of a source that is drawn again.

    Attributes:
        item, page, inferred: as a table's.
    """

    item: str
    page: int
    inferred: str = ""

    @property
    def name(self) -> str:
        """The name of its files, and as the command line spells it."""
        return self.item.replace(" ", "-")

    @property
    def cited(self) -> str:
        """The item with its page."""
        return _cited(self)


def _cited(one: Table | Figure) -> str:
    item = one.item[:1].upper() + one.item[1:]
    return f"{item}, page {one.page}{' (inferred)' if one.inferred else ''}" if one.page else item


@lru_cache(maxsize=2)
def _read(data: Path = DATA) -> dict[str, Any]:
    return tomllib.loads(data.read_text(encoding="utf-8"))


def sources() -> dict[str, str]:
    """The documents, by what they are called here."""
    return {**_read()["sources"], **_read(SOLUTIONS)["sources"]}


@lru_cache(maxsize=1)
def tables() -> tuple[Table, ...]:
    """The tables of the two documents, in the order of the file."""
    return tuple(_table(dict(values)) for values in _read()["tables"])


@lru_cache(maxsize=1)
def solutions() -> tuple[Table, ...]:
    """The tables of printed solutions, whose rows are components: some take minutes to be proven."""
    return tuple(_table(dict(values)) for values in _read(SOLUTIONS)["tables"])


@lru_cache(maxsize=1)
def figures() -> tuple[Figure, ...]:
    """The figures in the order of the sources' pages."""
    return tuple(Figure(**values) for values in _read()["figures"])


def figure(name: str) -> Figure:
    """The figure of this name.

    Raises:
        ValueError: there is none.
    """
    known = {one.name: one for one in figures()}
    if name not in known:
        raise ValueError(unknown("figure", name, known))
    return known[name]


def _table(values: dict[str, Any]) -> Table:
    columns = tuple(_column(dict(column)) for column in values.pop("columns"))
    return Table(**{**values, "rows": tuple(values["rows"]), "columns": columns})


def _column(values: dict[str, Any]) -> Column:
    values |= {name: tuple(values[name]) for name in ("printed", "skip") if name in values}
    return Column(**{**values, "step": Fraction(values.get("step", 0))})
