"""A study of solvers as readable tables: errors, evaluations and seconds against tolerance, events, what was said."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from compare.show import text_table
from compare.show.costs import costs
from compare.show.page import field_names
from compare.show.study_page import study_page
from compare.show.text_table import Column, Grid, Table
from compare.solvers.records import EventCell, SolverCell, SolverEntry
from compare.solvers.solver import CALLS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

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
        return _digits(cell.max_error) + (OTHER if _is_other(cell, dials[cell.solver]) else "")

    title = f"Error against rtol, {at}: largest {case.absolute}"
    yield _table(f"error-vs-rtol-{text_table.slug(at)}", title, cells, error, width, notes)
    counts = {entry.solver: entry.counts for entry in study.solvers}
    strange = [f"{name}: {counts[name]}" for name in dict.fromkeys(c.solver for c in cells) if counts[name] != CALLS]
    title = f"Evaluations against rtol, {at}: {CALLS}"
    yield _table(
        f"evaluations-{text_table.slug(at)}", title, cells, lambda cell: _count(cell.evaluations), width, strange
    )
    title = f"Seconds against rtol, {at}"
    yield _table(f"seconds-{text_table.slug(at)}", title, cells, lambda cell: _digits(cell.seconds), width)
    yield work(f"work-{text_table.slug(at)}", f"Work and precision, {at}", cells, counts)


def work(name: str, title: str, cells: Sequence[SolverCell], counts: Mapping[str, str]) -> Table:
    """The evaluations that errors took on one problem, of the solvers that gave states."""
    points = [(cell.solver, cell.max_error, cell.evaluations) for cell in cells if not cell.failure]
    own = [f"{who}: {counts[who]}" for who in dict.fromkeys(who for who, _, _ in points) if counts[who] != CALLS]
    return costs(name, f"{title}, evaluations", f"{cells[0].case.absolute},", points, notes=own)


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
        return _digits(event.max_error) + few + more

    units = f", in {case.step}" if case.step else ""
    title = f"Events, {at}: largest |t - exact| over the {case.events}{units}"
    first = [event.solver for event in events if event.first_only]
    notes = [_EVENTS_NOTE] if any(event.matched < event.expected or event.spurious for event in events) else []
    notes += [f"the first passage only: {', '.join(dict.fromkeys(first))}"] if first else []
    return _table(f"events-{text_table.slug(at)}", title, events, entry, width, notes)


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
    asked = sorted({cell.rtol for cell in study.error_vs_rtol}, reverse=True)
    rows = [(who, _runs([asked.index(rtol) for rtol in at], asked), what) for (who, what), at in said.items()]
    columns = Column("solver", left=True), Column("rtol", left=True), Column("what it said", left=True)
    yield Table("said", "What the solvers said", (text_table.folded(columns, rows, width),))


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


def _runs(places: Sequence[int], asked: Sequence[float]) -> str:
    """Tolerances by their places among those asked for, neighbours as from ... to ..."""
    runs: list[list[int]] = []
    for place in sorted(set(places)):
        if runs and runs[-1][-1] == place - 1:
            runs[-1].append(place)
        else:
            runs.append([place])
    return ", ".join(" to ".join(_brief(asked[i]) for i in dict.fromkeys((run[0], run[-1]))) for run in runs)


def _table(
    name: str,
    title: str,
    cells: Sequence[SolverCell] | Sequence[EventCell],
    text: Callable[..., str],
    width: int,
    notes: Sequence[str] = (),
) -> Table:
    """Solvers down, tolerances across, over as many grids as the width needs."""
    found = {(cell.solver, cell.rtol): text(cell) for cell in cells}
    solvers = list(dict.fromkeys(cell.solver for cell in cells))

    def build(tolerances: Sequence[float]) -> Grid:
        columns = [Column("solver", left=True), *(Column(_brief(rtol)) for rtol in tolerances)]
        return Grid(
            tuple(columns), tuple((who, *(found.get((who, rtol), "-") for rtol in tolerances)) for who in solvers)
        )

    tolerances = list(dict.fromkeys(cell.rtol for cell in cells))
    for parts in range(1, len(tolerances) + 1):
        grids = [build(part) for part in _parts(tolerances, parts)]
        if all(text_table.text_width(one) <= width for one in grids):
            break
    return Table(name, title, tuple(grids), "\n".join(notes))


def _parts(tolerances: Sequence[float], count: int) -> list[Sequence[float]]:
    """The tolerances in consecutive parts of about one length."""
    size = -(-len(tolerances) // count)
    return [tolerances[i : i + size] for i in range(0, len(tolerances), size)]


def _brief(rtol: float) -> str:
    """The tolerance as people write it, where one digit says it."""
    return f"{rtol:.0e}" if float(f"{rtol:.0e}") == rtol else repr(rtol)


def _digits(value: float | None) -> str:
    return "-" if value is None or not math.isfinite(value) else f"{value:.1e}"


def _count(value: int | None) -> str:
    return "-" if value is None else str(value)


def page(study: SolverStudy) -> Page:
    """A study of solvers."""
    return study_page(study, tables, COLUMNS, prefix="solvers-")
