"""A method's description as text, Markdown, LaTeX or JSON."""

from __future__ import annotations

import json
import textwrap
from typing import TYPE_CHECKING, Any

from compare.methods.order.algebraic import Algebraic
from compare.show import text_table
from compare.show.method import Butcher, closed_form, decimal_form, exact_form, latex_form
from compare.show.text_table import Column, Grid, Section

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from compare.methods.order.algebraic import Coefficient
    from compare.show.method import Description, Rows

__all__ = ["FORMATS", "render"]

FORMATS = ("text", "markdown", "latex", "json")
WIDTH = 100


def render(description: Description, form: str = "text", width: int = WIDTH) -> str:
    """The method in one of FORMATS; ``width`` is the longest line of the text form."""
    if form == "json":
        return _json(description)
    if form == "latex":
        return _latex(description)
    return _text(description, width) if form == "text" else _markdown(description)


def _text(description: Description, width: int) -> str:
    indent = max(len(label) for label, _ in description.facts) + 2
    lines = [description.name, ""]
    for label, value in description.facts:
        lines += textwrap.wrap(_word(value), width, initial_indent=label.ljust(indent), subsequent_indent=" " * indent)
    blocks = ["\n".join(lines)]
    for table in description.tables:
        if isinstance(table, Butcher):
            blocks += [table.title] if table.title else []
            blocks.append(_butcher_text(table, width))
        else:
            blocks.append(text_table.text(_section(table)).rstrip("\n"))
    return "\n\n".join(blocks) + "\n"


def _word(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, tuple):
        return ", ".join(map(str, value)) or "none"
    return "not known" if value is None else str(value)


def _butcher_text(table: Butcher, width: int) -> str:
    """The array as books print it; where that is too wide for a line, an entry to a line."""
    labels, rows = _butcher_cells(table)
    widths = [max(len(row[j]) for row in rows if j < len(row)) for j in range(max(map(len, rows)))]
    head = max(map(len, labels))
    if head + 1 + sum(column + 2 for column in widths) > width:
        return "\n".join(_entries(labels, rows, len(table.nodes)))
    lines = [
        f"{label.rjust(head)} | " + "  ".join(cell.rjust(widths[j]) for j, cell in enumerate(row))
        for label, row in zip(labels, rows, strict=True)
    ]
    lines.insert(len(table.nodes), "-" * (head + 1) + "+" + "-" * (max(map(len, lines)) - head - 2))
    return "\n".join(line.rstrip() for line in lines)


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


def _section(table: Rows) -> Section:
    """The rows with a decimal beside every closed form that is not rational."""
    heads, columns = list(table.heads), [list(column) for column in zip(*table.rows, strict=True)]
    for head, column in zip(table.heads, zip(*table.rows, strict=True), strict=True):
        if any(isinstance(value, Algebraic) for value in column):
            heads.append(f"{head} as a decimal")
            columns.append([decimal_form(value) for value in column])
    rows = zip(*([_cell(value) for value in column] for column in columns), strict=True)
    return Section("coefficients", table.title or "coefficients", (Grid(_left(heads), tuple(rows)),))


def _left(heads: Sequence[str]) -> tuple[Column, ...]:
    return tuple(Column(head, left=True) for head in heads)


def _cell(value: str | Coefficient) -> str:
    return value if isinstance(value, str) else closed_form(value)


def _markdown(description: Description) -> str:
    facts = [f"- **{label}**: {text_table.markdown_text(_word(value))}" for label, value in description.facts]
    head = f"## {text_table.markdown_text(description.name)}\n\n" + "\n".join(facts) + "\n"
    sections = (
        _butcher_section(table) if isinstance(table, Butcher) else _section(table) for table in description.tables
    )
    return "\n".join([head, *map(text_table.markdown, sections)])


def _butcher_section(table: Butcher) -> Section:
    labels, rows = _butcher_cells(table)
    stages = len(table.nodes)
    cells = tuple((label, *row, *[""] * (stages - len(row))) for label, row in zip(labels, rows, strict=True))
    columns = (Column("c"), *(Column(str(j)) for j in range(1, stages + 1)))
    return Section("butcher", table.title or "Butcher array", (Grid(columns, cells),))


def _latex(description: Description) -> str:
    """The arrays as displayed mathematics, the facts as comments before them."""
    lines = [f"% {description.name}", *(f"% {label}: {_word(value)}" for label, value in description.facts)]
    for table in description.tables:
        lines += [f"% {table.title}"] if table.title else []
        lines += [r"\[", *(_butcher_latex(table) if isinstance(table, Butcher) else _rows_latex(table)), r"\]"]
    return "\n".join(lines) + "\n"


def _butcher_latex(table: Butcher) -> Iterator[str]:
    yield rf"\begin{{array}}{{c|{'c' * len(table.nodes)}}}"
    for node, row in zip(table.nodes, table.matrix, strict=True):
        yield f"{latex_form(node)} & " + " & ".join("" if entry == 0 else latex_form(entry) for entry in row) + r" \\"
    yield r"\hline"
    for _, b in table.weights:
        yield " & " + " & ".join(map(latex_form, b)) + r" \\"
    yield r"\end{array}"


def _rows_latex(table: Rows) -> Iterator[str]:
    yield rf"\begin{{array}}{{{'l' * len(table.heads)}}}"
    yield " & ".join(rf"\text{{{head}}}" for head in table.heads) + r" \\ \hline"
    for row in table.rows:
        yield " & ".join(rf"\text{{{v}}}" if isinstance(v, str) else latex_form(v) for v in row) + r" \\"
    yield r"\end{array}"


def _json(description: Description) -> str:
    """One object: the facts by name, then tables, whose numbers are objects with an exact form and a decimal."""
    facts = {label.lower().replace(" ", "_").replace("-", "_"): value for label, value in description.facts}
    lines = [f" {_dumps(key)}: {_dumps(value)}" for key, value in {"name": description.name, **facts}.items()]
    tables = ",\n".join(f"  {{\n{_table_json(table)}\n  }}" for table in description.tables)
    return "{\n" + ",\n".join([*lines, f' "tables": [\n{tables}\n ]']) + "\n}\n"


def _dumps(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False)


def _table_json(table: Butcher | Rows) -> str:
    """The table's fields, a row of coefficients to a line."""
    fields: dict[str, Any] = {"title": table.title}
    rows: dict[str, list[Any]]
    if isinstance(table, Butcher):
        fields["c"] = [_number(value) for value in table.nodes]
        fields |= {label.replace(", ", "_").replace(" ", "_"): list(map(_number, b)) for label, b in table.weights}
        rows = {"a": [[_number(value) for value in row] for row in table.matrix]}
    else:
        rows = {"rows": [dict(zip(table.heads, map(_number, row), strict=True)) for row in table.rows]}
    lines = [f"   {_dumps(key)}: {_dumps(value)}" for key, value in fields.items()]
    for key, values in rows.items():
        lines.append(f"   {_dumps(key)}: [\n" + ",\n".join(f"    {_dumps(row)}" for row in values) + "\n   ]")
    return ",\n".join(lines)


def _number(value: str | int | Coefficient) -> str | int | dict[str, str | None]:
    if isinstance(value, (str, int)):
        return value
    return {"exact": exact_form(value), "decimal": decimal_form(value)}
