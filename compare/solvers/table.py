"""A study of solvers as readable tables: errors, evaluations and seconds against tolerance, events, what was said."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from compare.show import text_table
from compare.show.page import field_names
from compare.show.study_page import study_page
from compare.show.text_table import Column, Grid, Table
from compare.show.work import against_rtol, at_tolerances, costs, two_digits
from compare.solvers.records import EventCell, SolverCell, SolverEntry
from compare.solvers.solver import CALLS

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from compare.measure.records import Case
    from compare.show.page import Page
    from compare.show.study_page import Columns
    from compare.solvers.records import SolverStudy

__all__ = ["COLUMNS", "OTHER", "TOLERANCES", "bounded", "page", "tables", "work"]

COLUMNS: Columns = {
    "solvers": field_names(SolverEntry),
    "error_vs_rtol": field_names(SolverCell),
    "events": field_names(EventCell),
}
OTHER = "^"
_NO_STATES = "- means that the solver failed or was stopped; what it said is in the last table"
_OTHER_NOTE = f"{OTHER} means that the solver worked with another tolerance than the one asked for; see the last table"
_EVENTS_NOTE = "n of m means that it found n of the m passages; +k that it found k more, where there are none"
TOLERANCES = {"rtol", "tol"}


def tables(study: SolverStudy, width: int = 100) -> Iterator[Table]:
    """The readable tables: who was asked, then amplitude by amplitude what they answered, then what they said."""
    yield from _who(study, width)
    for case in study.cases:
        cells = [cell for cell in study.error_vs_rtol if cell.case == case and cell.suited]
        if cells:
            yield from _cells(study, cells, case, width)
        events = [event for event in study.events if event.case == case]
        if events:
            yield _events(events, case, width)
    yield from _said(study, width)
    yield from _left_out(study, width)


def _who(study: SolverStudy, width: int) -> Iterator[Table]:
    here = [entry for entry in study.solvers if entry.version is not None]
    if here:
        rows = [(entry.solver, entry.version or "", entry.call) for entry in here]
        columns = Column("solver", left=True), Column("version", left=True), Column("call", left=True)
        yield Table("solvers", "Solvers, and how each is called", (text_table.folded(columns, rows, width),))
        yield bounded(here, width)
    missing = {entry.package: entry.install for entry in study.solvers if entry.version is None}
    if missing:
        labels = Column("package", left=True), Column("what installs it", left=True)
        yield Table("missing-solvers", "Missing", (Grid(labels, tuple(missing.items())),))


def bounded(solvers: Iterable[SolverEntry], width: int) -> Table:
    """What the tolerances bound: a row for all solvers of a package that mean the same by it."""
    same: dict[tuple[str, str], dict[str, None]] = {}
    for entry in solvers:
        same.setdefault((entry.package, entry.tolerance), {})[entry.solver.partition(".")[2]] = None
    rows = [(package, ", ".join(names), what) for (package, what), names in same.items()]
    columns = Column("package", left=True), Column("solvers", left=True), Column("its tolerance bounds", left=True)
    return Table("tolerances", "What a tolerance bounds", (text_table.folded(columns, rows, width),))


def _cells(study: SolverStudy, cells: Sequence[SolverCell], case: Case, width: int) -> Iterator[Table]:
    at = case.label
    dials = {entry.solver: entry.dial for entry in study.solvers}
    other = any(map(_is_other, cells, (dials[cell.solver] for cell in cells)))
    failed = any(cell.failure for cell in cells)
    notes = [note for note, applies in ((_NO_STATES, failed), (_OTHER_NOTE, other)) if applies]
    notes += [f"{dial} stands for rtol with {', '.join(who)}" for dial, who in _other_dials(dials, cells).items()]

    def error(cell: SolverCell) -> str:
        return two_digits(cell.max_error) + (OTHER if _is_other(cell, dials[cell.solver]) else "")

    title = f"Error against rtol, {at}: largest {case.absolute}"
    named = _named(cells)
    yield against_rtol(f"error-vs-rtol-{text_table.slug(at)}", title, named, error, width, notes)
    counts = {entry.solver: entry.counts for entry in study.solvers}
    strange = [f"{name}: {counts[name]}" for name in dict.fromkeys(c.solver for c in cells) if counts[name] != CALLS]
    title = f"Evaluations against rtol, {at}: {CALLS}"
    yield against_rtol(
        f"evaluations-{text_table.slug(at)}", title, named, lambda cell: _count(cell.evaluations), width, strange
    )
    title = f"Seconds against rtol, {at}"
    yield against_rtol(f"seconds-{text_table.slug(at)}", title, named, lambda cell: two_digits(cell.seconds), width)
    yield work(f"work-{text_table.slug(at)}", f"Work and precision, {at}", cells, counts)


def work(name: str, title: str, cells: Sequence[SolverCell], counts: Mapping[str, str]) -> Table:
    """The evaluations that errors took on one problem, of the solvers that gave states and let them be counted."""
    points = [(cell.solver, cell) for cell in cells if not cell.failure and cell.evaluations is not None]
    own = [f"{who}: {counts[who]}" for who in dict.fromkeys(who for who, _ in points) if counts[who] != CALLS]
    error = f"largest {cells[0].case.absolute}"
    table = costs(f"{title}, evaluations", points, f"{error},", lambda cell: cell.evaluations, notes=own)
    return replace(table, name=name)


def _is_other(cell: SolverCell, dial: str) -> bool:
    """Whether the solver worked with a tolerance of its own."""
    return dial in TOLERANCES and math.isfinite(cell.used) and cell.used != cell.rtol


def _other_dials(dials: dict[str, str], cells: Sequence[SolverCell]) -> dict[str, list[str]]:
    found: dict[str, list[str]] = {}
    for name in dict.fromkeys(cell.solver for cell in cells):
        if dials[name] != "rtol":
            found.setdefault(dials[name], []).append(name)
    return found


def _events(events: Sequence[EventCell], case: Case, width: int) -> Table:
    at = case.label

    def entry(event: EventCell) -> str:
        few = f" {event.matched} of {event.expected}" if event.matched < event.expected else ""
        more = f" +{event.spurious}" if event.spurious else ""
        return two_digits(event.max_error) + few + more

    units = f", in {case.step}" if case.step else ""
    title = f"Events, {at}: largest |t - exact| over the {case.events}{units}"
    first = [event.solver for event in events if event.first_only]
    notes = [_EVENTS_NOTE] if any(event.matched < event.expected or event.spurious for event in events) else []
    notes += [f"the first passage only: {', '.join(dict.fromkeys(first))}"] if first else []
    return against_rtol(f"events-{text_table.slug(at)}", title, _named(events), entry, width, notes)


def _said(study: SolverStudy, width: int) -> Iterator[Table]:
    """Failures, warnings and tolerances of their own: one row for all tolerances at which a solver said the same."""
    dials = {entry.solver: entry.dial for entry in study.solvers}
    said: dict[tuple[str, str], list[float]] = {}
    for cell in study.error_vs_rtol:
        own = [f"worked with {dials[cell.solver]} = {cell.used:.1e}"] if _is_other(cell, dials[cell.solver]) else []
        for message in (*own, cell.failure, cell.said):
            if message and cell.suited:
                said.setdefault((cell.solver, message), []).append(cell.rtol)
    for event in study.events:
        if event.failure:
            said.setdefault((event.solver, f"events: {event.failure}"), []).append(event.rtol)
    if not said:
        return
    asked = [cell.rtol for cell in study.error_vs_rtol]
    rows = [(who, at_tolerances(at, asked), what) for (who, what), at in said.items()]
    columns = Column("solver", left=True), Column("rtol", left=True), Column("what it said", left=True)
    yield Table("said", "What the solvers said", (text_table.folded(columns, rows, width),))


def _named(cells: Sequence[SolverCell] | Sequence[EventCell]) -> list[tuple[str, Any]]:
    return [(cell.solver, cell) for cell in cells]


def _left_out(study: SolverStudy, width: int) -> Iterator[Table]:
    """The solvers that a problem does not have what they need for, by name."""
    why: dict[str, dict[str, None]] = {}
    for cell in study.error_vs_rtol:
        if not cell.suited:
            why.setdefault(cell.failure, {})[cell.solver] = None
    if why:
        rows = [(", ".join(solvers), what) for what, solvers in why.items()]
        columns = Column("solver", left=True), Column("why", left=True)
        title = "Left out: the problem does not have what they need"
        yield Table("left-out", title, (text_table.folded(columns, rows, width),))


def _count(value: int | None) -> str:
    return "-" if value is None else str(value)


def page(study: SolverStudy) -> Page:
    """A study of solvers."""
    return study_page(study, tables, COLUMNS, prefix="solvers-")
