"""A method's description as a page: its facts and its coefficients."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.methods.order.algebraic import Algebraic
from compare.show.method import Butcher, closed_form, decimal_form, exact_form, latex_form
from compare.show.page import Head, Lines, Page, Sentence, word
from compare.show.text_table import Column, Grid, Table, latex_row, text_width

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from compare.methods.order.algebraic import Coefficient
    from compare.show.method import Description, Rows
    from compare.show.page import Block

__all__ = ["FORMATS", "page"]

FORMATS = ("text", "markdown", "latex", "json")
"""Those of the tables, but for CSV, which has no place for facts."""


def page(description: Description) -> Page:
    """The method in any of FORMATS."""

    def blocks(form: str, width: int) -> Iterator[Block]:
        facts = tuple((label, word(value)) for label, value in description.facts)
        if form == "latex":
            yield Head((description.name, *facts), description.name, needs="")
            yield from map(_displayed, description.tables)
            return
        if form == "text":
            yield Sentence(description.name)
        yield Head(facts, description.name)
        for table in description.tables:
            if not isinstance(table, Butcher):
                yield _coefficients(table)
            elif form == "text":
                yield Table("butcher", table.title, (_butcher(table, width),))
            else:
                yield Table("butcher", table.title or "Butcher array", (_numbered(table),))

    return Page(description.name, blocks, lambda: _data(description), between={"latex": ""}, indent=1)


def _butcher(table: Butcher, width: int) -> Grid:
    """The array as books print it; where that is too wide for a line, an entry to a line."""
    labels, rows = _butcher_cells(table)
    columns = (Column("", bar=True), *[Column("")] * len(rows[-1]))
    grid = Grid(columns, _squared(labels, rows), ruled=len(table.nodes))
    if text_width(grid) <= width:
        return grid
    return Grid((Column("", left=True),), tuple((line,) for line in _entries(labels, rows, len(table.nodes))))


def _numbered(table: Butcher) -> Grid:
    """The array with its columns numbered."""
    labels, rows = _butcher_cells(table)
    return Grid((Column("c"), *(Column(str(j + 1)) for j in range(len(rows[-1])))), _squared(labels, rows))


def _squared(labels: Sequence[str], rows: Sequence[Sequence[str]]) -> tuple[tuple[str, ...], ...]:
    """Rows of one length with their labels before them; what a row does not have is empty."""
    return tuple((label, *row, *[""] * (len(rows[-1]) - len(row))) for label, row in zip(labels, rows, strict=True))


def _butcher_cells(table: Butcher) -> tuple[list[str], list[list[str]]]:
    """Labels and cells of the rows: nodes and a, then the weights; the triangle of zeros is left out."""
    explicit = all(entry == 0 for i, row in enumerate(table.matrix) for entry in row[i:])
    matrix = [row[:i] if explicit else row for i, row in enumerate(table.matrix)]
    labels = [*map(closed_form, table.nodes), *(label for label, _ in table.weights)]
    return labels, [list(map(closed_form, row)) for row in (*matrix, *(b for _, b in table.weights))]


def _entries(labels: Sequence[str], rows: Sequence[Sequence[str]], stages: int) -> Iterator[str]:
    for i, (label, row) in enumerate(zip(labels, rows, strict=True), start=1):
        yield f"c[{i}] = {label}" if i <= stages else label
        name = f"a[{i}," if i <= stages else "b["
        yield from (f"    {name}{j}] = {cell}" for j, cell in enumerate(row, start=1) if cell != "0")


def _coefficients(table: Rows) -> Table:
    """The rows with a decimal beside every closed form that is not rational."""
    heads, columns = list(table.heads), [list(column) for column in zip(*table.rows, strict=True)]
    for head, column in zip(table.heads, zip(*table.rows, strict=True), strict=True):
        if any(isinstance(value, Algebraic) for value in column):
            heads.append(f"{head} as a decimal")
            columns.append([decimal_form(value) for value in column])
    rows = zip(*([_cell(value) for value in column] for column in columns), strict=True)
    grid = Grid(tuple(Column(head, left=True) for head in heads), tuple(rows))
    return Table("coefficients", table.title or "coefficients", (grid,))


def _cell(value: str | Coefficient) -> str:
    return value if isinstance(value, str) else closed_form(value)


def _displayed(table: Butcher | Rows) -> str:
    """The array as displayed mathematics, its title a comment before it."""
    lines = [f"% {table.title}"] if table.title else []
    lines += [r"\[", *(_butcher_latex(table) if isinstance(table, Butcher) else _rows_latex(table)), r"\]"]
    return "\n".join(lines) + "\n"


def _butcher_latex(table: Butcher) -> Iterator[str]:
    yield rf"\begin{{array}}{{c|{'c' * len(table.nodes)}}}"
    for node, row in zip(table.nodes, table.matrix, strict=True):
        yield latex_row([latex_form(node), *("" if entry == 0 else latex_form(entry) for entry in row)])
    yield r"\hline"
    for _, b in table.weights:
        yield latex_row(["", *map(latex_form, b)])
    yield r"\end{array}"


def _rows_latex(table: Rows) -> Iterator[str]:
    yield rf"\begin{{array}}{{{'l' * len(table.heads)}}}"
    yield latex_row(rf"\text{{{head}}}" for head in table.heads) + r" \hline"
    for row in table.rows:
        yield latex_row(rf"\text{{{v}}}" if isinstance(v, str) else latex_form(v) for v in row)
    yield r"\end{array}"


def _data(description: Description) -> Lines:
    """The facts by name, then tables, whose numbers are objects with an exact form and a decimal."""
    facts = {label.lower().replace(" ", "_").replace("-", "_"): value for label, value in description.facts}
    tables = Lines([Lines(_table_data(table)) for table in description.tables], opened=True)
    return Lines({"name": description.name, **facts, "tables": tables})


def _table_data(table: Butcher | Rows) -> dict[str, Any]:
    """The table's fields, a row of coefficients to a line."""
    if not isinstance(table, Butcher):
        rows = [dict(zip(table.heads, map(_number, row), strict=True)) for row in table.rows]
        return {"title": table.title, "rows": Lines(rows)}
    weights = {label.replace(", ", "_").replace(" ", "_"): list(map(_number, b)) for label, b in table.weights}
    matrix = Lines([list(map(_number, row)) for row in table.matrix])
    return {"title": table.title, "c": list(map(_number, table.nodes)), **weights, "a": matrix}


def _number(value: str | int | Coefficient) -> str | int | dict[str, str | None]:
    if isinstance(value, (str, int)):
        return value
    return {"exact": exact_form(value), "decimal": decimal_form(value)}
