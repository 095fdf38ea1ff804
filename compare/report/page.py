"""A report as one Markdown page that holds its tables and figures, and the files that go with it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from compare.report import plot
from compare.report.table import COLUMNS, case_sections, cases, closing
from compare.show import render, text_table
from compare.show.render import header

if TYPE_CHECKING:
    from compare.report.records import Report

__all__ = ["files", "page"]

TITLE = "Work and precision"
WIDTH = 100


def files(report: Report) -> dict[str, bytes]:
    """The page, its figures, and every number for programs, by file name."""
    tables = render.csv_text(report, COLUMNS)
    return {
        "report.md": page(report).encode(),
        f"{report.problem}.json": render.json_text(report, COLUMNS).encode(),
        **{f"{report.problem}-{name}.csv": text.encode() for name, text in tables.items()},
        **plot.files(report),
    }


def page(report: Report) -> str:
    """The page: what was asked for, then each problem with its figures and tables, then what failed."""
    parts = [
        f"# {TITLE}\n",
        "\n".join(f"- **{name}**: {text_table.markdown_text(fact)}" for name, fact in header(report)),
    ]
    for case, points in cases(report):
        parts.append(f"\n## {text_table.markdown_text(case)}\n")
        parts += [f"![{title}, {case}]({name}.svg)\n" for name, title in plot.names(points[0]).items()]
        parts += [text_table.markdown(section) for section in case_sections(report, case, points)]
    parts += [text_table.markdown(section) for section in closing(report, WIDTH)]
    return "\n".join(parts)
