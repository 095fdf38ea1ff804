"""A grid of finished cells, laid out as plain text, Markdown or LaTeX; it knows nothing of methods or errors."""

from __future__ import annotations

import itertools
import re
import textwrap
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

__all__ = [
    "Column",
    "Grid",
    "Table",
    "folded",
    "latex",
    "latex_row",
    "markdown",
    "markdown_text",
    "slug",
    "text",
    "text_width",
]

_NARROWEST = 30
_SCIENTIFIC = re.compile(r"(-?\d(?:\.\d+)?)e([+-]\d+)")
_LATEX_SPECIAL = {character: rf"\{character}" for character in "_%&#${}"} | {
    "\\": r"\textbackslash{}",
    "^": r"\textasciicircum{}",
    "~": r"\textasciitilde{}",
    "±": r"$\pm$",
    "|": r"$|$",
    "<": r"$<$",
    ">": r"$>$",
}


@dataclass(frozen=True)
class Column:
    """A column's label, and the heading that it shares with its neighbours of the same group ("" for none).

    ``bar`` draws a line behind it, in text.
    """

    label: str
    group: str = ""
    left: bool = False
    bar: bool = False


@dataclass(frozen=True)
class Grid:
    """Columns and rows of finished cells; every row has one string a column.

    In text, columns without labels have no head, and a rule is drawn before the row of the number ``ruled``.
    """

    columns: tuple[Column, ...]
    rows: tuple[tuple[str, ...], ...]
    ruled: int | None = None


@dataclass(frozen=True)
class Table:
    """One titled table; it has several grids where one would be too wide to read.

    Attributes:
        name: a short name, for a label.
        title: one line that says what the numbers are.
        grids: the table, split by columns.
        note: a legend under the table, or "".
    """

    name: str
    title: str
    grids: tuple[Grid, ...]
    note: str = ""


def slug(words: str) -> str:
    """The words as part of a section's name: letters, digits and hyphens."""
    return re.sub(r"[^a-z0-9]+", "-", words)


def folded(columns: Sequence[Column], rows: Sequence[tuple[str, ...]], width: int, room: int | None = None) -> Grid:
    """The rows, the last column folded to a room of its own, or to what the others leave of the width."""
    if room is None:
        others = [max(len(column.label), *(len(row[i]) for row in rows)) + 2 for i, column in enumerate(columns[:-1])]
        room = max(width - sum(others), _NARROWEST)
    lines = []
    for row in rows:
        first, *rest = textwrap.wrap(row[-1], room) or [""]
        lines.append((*row[:-1], first))
        lines += [(*("" for _ in row[:-1]), line) for line in rest]
    return Grid(tuple(columns), tuple(lines))


def text(table: Table) -> str:
    """The table in fixed-width columns, for a terminal."""
    blocks = [table.title] if table.title else []
    blocks += ["\n".join(line.rstrip() for line in _text_lines(grid)) for grid in table.grids]
    blocks += [table.note] if table.note else []
    return "\n\n".join(blocks) + "\n"


def text_width(grid: Grid) -> int:
    """The number of characters in the longest line of the grid as text."""
    widths = _widths(grid)
    return sum(widths) + sum(len(_gap(grid, i)) for i in range(len(widths)))


def markdown(table: Table) -> str:
    """The table as GitHub tables."""
    blocks = [f"### {markdown_text(table.title)}"]
    for grid in table.grids:
        header = [" ".join(filter(None, (column.group, column.label))) for column in grid.columns]
        rule = [":--" if column.left else "--:" for column in grid.columns]
        lines = [[markdown_text(cell) for cell in row] for row in (header, *grid.rows)]
        lines.insert(1, rule)
        blocks.append("\n".join("| " + " | ".join(line) + " |" for line in lines))
    blocks += [markdown_text(table.note)] if table.note else []
    return "\n\n".join(blocks) + "\n"


def latex(table: Table) -> str:
    """The table as one LaTeX table a grid, with booktabs rules and a caption; without a grid a paragraph."""
    caption = _latex_cell(table.title)
    note = f" {_latex_cell(table.note)}" if table.note else ""
    parts = [] if table.grids else [f"{caption}.{note}", ""]
    for number, grid in enumerate(table.grids, start=1):
        of = f" ({number} of {len(table.grids)})" if len(table.grids) > 1 else ""
        suffix = f"-{number}" if len(table.grids) > 1 else ""
        parts += [
            r"\begin{table}[htbp]",
            r"\centering\footnotesize",
            rf"\caption{{{caption}{of}.{note}}}",
            rf"\label{{tab:{table.name}{suffix}}}",
            *_latex_tabular(grid),
            r"\end{table}",
            "",
        ]
    return "\n".join(parts)


def _spans(grid: Grid) -> Iterator[tuple[str, int, int]]:
    """Runs of columns under one heading, as (heading, first, past the last)."""
    start = 0
    for group, run in itertools.groupby(grid.columns, key=lambda column: column.group):
        stop = start + len(list(run))
        yield group, start, stop
        start = stop


def _gap(grid: Grid, index: int) -> str:
    """What stands before a column: less inside a group than between groups."""
    if index == 0:
        return ""
    if grid.columns[index - 1].bar:
        return " | "
    group = grid.columns[index].group
    return " " if group and group == grid.columns[index - 1].group else "  "


def _wrap(label: str, width: int) -> list[str]:
    """The label broken at spaces and after underscores, into lines of at most the width where its words allow."""
    lines = [""]
    for word in re.findall(r"[^ _]+_*|_+", label):
        joint = " " if lines[-1] and not lines[-1].endswith("_") else ""
        if lines[-1] and len(lines[-1] + joint + word) > width:
            lines.append(word)
        else:
            lines[-1] += joint + word
    return lines


def _longest_word(label: str) -> int:
    return max(len(line) for line in _wrap(label, 0))


def _widths(grid: Grid) -> list[int]:
    widths = [
        max([_longest_word(column.label), *(len(row[i]) for row in grid.rows)]) for i, column in enumerate(grid.columns)
    ]
    for group, start, stop in _spans(grid):
        room = sum(widths[start:stop]) + sum(len(_gap(grid, i)) for i in range(start + 1, stop))
        widths[stop - 1] += max(0, _longest_word(group) - room) if group else 0
    return widths


def _text_lines(grid: Grid) -> Iterator[str]:
    widths = _widths(grid)
    if any(column.group for column in grid.columns):
        yield from _group_lines(grid, widths)
    rule = "".join(_gap(grid, i).replace(" ", "-").replace("|", "+") + "-" * width for i, width in enumerate(widths))
    if any(column.label for column in grid.columns):
        labels = [_wrap(column.label, width) for column, width in zip(grid.columns, widths, strict=True)]
        for line in _bottom_aligned(labels):
            yield _text_row(grid, widths, line)
        yield rule
    for number, row in enumerate(grid.rows):
        if number == grid.ruled:
            yield rule
        yield _text_row(grid, widths, row)


def _group_lines(grid: Grid, widths: Sequence[int]) -> Iterator[str]:
    """The shared headings, each over a rule as wide as its columns."""
    runs = [
        (group, _gap(grid, start), sum(widths[start:stop]) + sum(len(_gap(grid, i)) for i in range(start + 1, stop)))
        for group, start, stop in _spans(grid)
    ]
    headings = [_wrap(group, width) for group, _, width in runs]
    headings = [[*lines, "-" * run[2]] if run[0] else lines for lines, run in zip(headings, runs, strict=True)]
    for line in _bottom_aligned(headings):
        yield "".join(gap + piece.ljust(width) for piece, (_, gap, width) in zip(line, runs, strict=True))


def _bottom_aligned(columns: Sequence[list[str]]) -> Iterator[tuple[str, ...]]:
    height = max(len(lines) for lines in columns)
    return zip(*([""] * (height - len(lines)) + lines for lines in columns), strict=True)


def _text_row(grid: Grid, widths: Sequence[int], cells: Sequence[str]) -> str:
    return "".join(
        _gap(grid, i) + (cell.ljust(widths[i]) if grid.columns[i].left else cell.rjust(widths[i]))
        for i, cell in enumerate(cells)
    )


def markdown_text(cell: str) -> str:
    """A cell with the characters escaped that Markdown would read as markup."""
    return re.sub(r"([|*_<>\\])", r"\\\1", cell)


def _latex_cell(cell: str) -> str:
    """The cell with LaTeX's own characters escaped and 1.2e-05 set as 1.2 times a power of ten."""
    pieces = []
    position = 0
    for match in _SCIENTIFIC.finditer(cell):
        pieces.append("".join(_LATEX_SPECIAL.get(character, character) for character in cell[position : match.start()]))
        pieces.append(rf"${match[1]}\times10^{{{int(match[2])}}}$")
        position = match.end()
    pieces.append("".join(_LATEX_SPECIAL.get(character, character) for character in cell[position:]))
    return "".join(pieces)


def _latex_heading(label: str, width: int) -> str:
    """A heading, stacked over several lines where it is wider than its columns."""
    lines = [_latex_cell(line) for line in _wrap(label, width)]
    stack = r"\\".join(f"{{{line}}}" if line.startswith(("[", "*")) else line for line in lines)  # no option of \\
    return stack if len(lines) == 1 else rf"\shortstack{{{stack}}}"


def latex_row(cells: Iterable[str]) -> str:
    """Finished cells as a line of a tabular or an array."""
    return " & ".join(cells) + r" \\"


def _latex_tabular(grid: Grid) -> Iterator[str]:
    widths = _widths(grid)
    yield rf"\begin{{tabular}}{{{''.join('l' if column.left else 'r' for column in grid.columns)}}}"
    yield r"\toprule"
    if any(column.group for column in grid.columns):
        spans = list(_spans(grid))
        yield latex_row(
            rf"\multicolumn{{{stop - start}}}{{c}}{{{_latex_heading(group, sum(widths[start:stop]))}}}"
            for group, start, stop in spans
        )
        yield "".join(rf"\cmidrule(lr){{{start + 1}-{stop}}}" for group, start, stop in spans if group)
    yield latex_row(_latex_heading(column.label, width) for column, width in zip(grid.columns, widths, strict=True))
    yield r"\midrule"
    for row in grid.rows:
        yield latex_row(map(_latex_cell, row))
    yield r"\bottomrule"
    yield r"\end{tabular}"
