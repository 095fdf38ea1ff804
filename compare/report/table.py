"""A report as readable tables: what an error of a given size costs, in evaluations and in seconds."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.report.problems import reported_by
from compare.report.records import WorkPoint
from compare.show import text_table
from compare.show.costs import costs
from compare.show.page import field_names
from compare.show.study_page import study_page
from compare.show.text_table import Column, Table

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from compare.report.records import Report
    from compare.show.page import Page
    from compare.show.study_page import Columns

__all__ = ["case_tables", "cases", "closing", "page", "tables"]

COLUMNS: Columns = {"points": field_names(WorkPoint)}


def tables(report: Report, width: int = 100) -> Iterator[Table]:
    """The readable tables, problem by problem, then what failed and what is missing."""
    for title, points in cases(report):
        yield from case_tables(report, title, points)
    yield from closing(report, width)


def cases(report: Report) -> Iterator[tuple[str, list[WorkPoint]]]:
    """Each problem in words, with its points."""
    for name, amplitude in dict.fromkeys((point.family, point.amplitude) for point in report.points):
        points = [point for point in report.points if (point.family, point.amplitude) == (name, amplitude)]
        yield reported_by(name).label(amplitude), points


def case_tables(report: Report, title: str, points: Sequence[WorkPoint]) -> Iterator[Table]:
    """What an error costs on one problem."""
    names = {point.name for point in points}
    counts = [f"{name}: {what}" for name, what in report.counts.items() if name in names]
    yield _costs(f"Evaluations, {title}", points, lambda point: point.evaluations, str, counts)
    yield _costs(f"Seconds, {title}", points, lambda point: point.seconds, lambda cost: f"{cost:.1e}")


def _costs(
    title: str,
    points: Sequence[WorkPoint],
    cost: Callable[[WorkPoint], Any],
    text: Callable[[Any], str],
    notes: Sequence[str] = (),
) -> Table:
    found = [(point.name, point.max_error, cost(point)) for point in points]
    units = reported_by(points[0].family).error_units
    return costs(text_table.slug(title.lower()), title, f"error, in {units}," if units else "error", found, text, notes)


def closing(report: Report, width: int) -> Iterator[Table]:
    """What failed, what does not fit a problem, and what is not installed."""
    failures: dict[tuple[str, str], list[str]] = {}
    for point in report.points:
        if point.failure:
            label = reported_by(point.family).label(point.amplitude)
            failures.setdefault((point.name, point.failure), []).append(label)
    failed = [(name, "; ".join(dict.fromkeys(where)), why) for (name, why), where in failures.items()]
    left_out = [(label, ", ".join(names)) for label, names in report.left_out.items()]
    for name, title, labels, rows in (
        ("failures", "What failed", ("", "where", "what it said"), failed),
        ("left-out", "Left out: the problem does not have what they need", ("problem", "for"), left_out),
        ("missing-solvers", "Missing", ("package", "what installs it"), list(report.missing.items())),
    ):
        if rows:
            columns = [Column(label, left=True) for label in labels]
            yield Table(name, title, (text_table.folded(columns, rows, width),))


def page(report: Report) -> Page:
    """A report as it is printed."""
    return study_page(report, tables, COLUMNS)
