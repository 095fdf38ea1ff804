"""A report as one Markdown page that holds its tables and figures, and the files that go with it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from compare.report import plot, table
from compare.show import render
from compare.show.page import Head, Page
from compare.show.study_page import header
from compare.show.text_table import markdown_text

if TYPE_CHECKING:
    from collections.abc import Iterator

    from compare.report.records import Report
    from compare.show.page import Block

__all__ = ["files", "page"]

TITLE = "Work and precision"


def files(report: Report) -> dict[str, bytes]:
    """The page, its figures, and every number for programs, by file name."""
    numbers = table.page(report)
    return {
        "report.md": page(report).encode(),
        **render.files(numbers, "json"),
        **render.files(numbers, "csv"),
        **plot.files(report),
    }


def page(report: Report) -> str:
    """The page: what was asked for, then each problem with its figures and tables, then what failed."""

    def blocks(_: str, width: int) -> Iterator[Block]:
        yield Head(tuple(header(report)), TITLE, level=1)
        for number, (case, points) in enumerate(table.cases(report)):
            yield "\n" * bool(number) + f"## {markdown_text(case)}\n"
            yield from (f"![{title}, {case}]({name}.svg)\n" for name, title in plot.names(points[0]).items())
            yield from table.case_tables(report, case, points)
        yield from table.closing(report, width)

    return render.render(Page("report", blocks, dict), "markdown")
