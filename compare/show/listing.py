"""The methods as a table: name, family, order, stages, whether symplectic, source."""

from __future__ import annotations

from typing import TYPE_CHECKING

from compare.show.page import Lines, Page, word
from compare.show.text_table import Column, Grid, Table, folded

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from compare.methods.kinds.protocol import Method

__all__ = ["FIELDS", "page"]

FIELDS = ("name", "family", "order", "stages", "symplectic", "source")
ROOM = 40
"""Characters of a source in one line of the text."""


def page(methods: Iterable[Method]) -> Page:
    """The methods; JSON is an object whose ``methods`` have FIELDS and their aliases."""
    known = list(methods)
    columns = tuple(Column(field, left=field not in {"order", "stages"}) for field in FIELDS)
    cells = tuple(tuple(word(getattr(method, field)) for field in FIELDS) for method in known)

    def blocks(form: str, width: int) -> Iterator[Table]:
        grid = folded(columns, cells, width, ROOM) if form == "text" else Grid(columns, cells)
        yield Table("methods", f"{len(known)} methods", (grid,))

    return Page(
        name="methods",
        blocks=blocks,
        data=lambda: {"methods": Lines([{f: getattr(method, f) for f in (*FIELDS, "aliases")} for method in known])},
        sheets=lambda: {"methods": (FIELDS, *cells)},
    )
