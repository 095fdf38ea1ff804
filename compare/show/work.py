"""Tables of work and precision, of methods and of solvers: what an error costs, what each tolerance gave."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from compare.show import text_table
from compare.show.digits import NOTES, ROUNDING
from compare.show.text_table import Column, Grid, Table

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from compare.measure.records import AdaptiveCell, Case, Cell, Study

__all__ = ["TARGETS", "against_rtol", "at_tolerances", "brief", "costs", "two_digits", "work_tables"]

TARGETS = tuple(float(f"1e-{k}") for k in range(2, 15, 2))
_LOST = "- means that the march is lost; the last table says why"
_UNREACHED = "- means that none of those measured has so small an error"


def costs(
    title: str,
    points: Sequence[tuple[str, Any]],
    error: str,
    cost: Callable[[Any], Any],
    text: Callable[[Any], str] = str,
    notes: Iterable[str] = (),
) -> Table:
    """The least cost of those points of a name whose ``max_error`` is below each of TARGETS.

    Args:
        title: what is counted, and of what problem.
        points: what was measured, each with the name of its row.
        error: what the error is.
        cost: of a point.
        text: a cost as it is written.
        notes: below the table.
    """

    def least(name: str, target: float) -> str:
        found = [cost(point) for who, point in points if who == name and point.max_error <= target]
        return text(min(found)) if found else "-"

    columns = Column("", left=True), *(Column(f"{target:.0e}") for target in TARGETS)
    rows = tuple((name, *(least(name, t) for t in TARGETS)) for name in dict.fromkeys(name for name, _ in points))
    whole = f"{title}: the least of those measured whose {error} is below"
    return Table(text_table.slug(title.lower()), whole, (Grid(columns, rows),), "\n".join(notes))


def against_rtol(
    name: str,
    title: str,
    cells: Sequence[tuple[str, Any]],
    text: Callable[..., str],
    width: int,
    notes: Sequence[str] = (),
    who: str = "solver",
) -> Table:
    """Names down, tolerances across, over as many grids as the width needs; of cells with ``rtol`` by their names."""
    found = {(one, cell.rtol): text(cell) for one, cell in cells}
    names = list(dict.fromkeys(one for one, _ in cells))

    def build(tolerances: Sequence[float]) -> Grid:
        columns = [Column(who, left=True), *(Column(brief(rtol)) for rtol in tolerances)]
        return Grid(
            tuple(columns), tuple((one, *(found.get((one, rtol), "-") for rtol in tolerances)) for one in names)
        )

    tolerances = list(dict.fromkeys(cell.rtol for _, cell in cells))
    for parts in range(1, len(tolerances) + 1):
        grids = [build(part) for part in _parts(tolerances, parts)]
        if all(text_table.text_width(one) <= width for one in grids):
            break
    return Table(name, title, tuple(grids), "\n".join(notes))


def _parts(tolerances: Sequence[float], count: int) -> list[Sequence[float]]:
    """The tolerances in consecutive parts of about one length."""
    size = -(-len(tolerances) // count)
    return [tolerances[i : i + size] for i in range(0, len(tolerances), size)]


def at_tolerances(at: Iterable[float], asked: Iterable[float]) -> str:
    """Some of the tolerances that were asked for, neighbours as from ... to ..."""
    every = sorted(set(asked), reverse=True)
    runs: list[list[int]] = []
    for place in sorted({every.index(rtol) for rtol in at}):
        if runs and runs[-1][-1] == place - 1:
            runs[-1].append(place)
        else:
            runs.append([place])
    return ", ".join(" to ".join(brief(every[i]) for i in dict.fromkeys((run[0], run[-1]))) for run in runs)


def brief(rtol: float) -> str:
    """The tolerance as people write it, where one digit says it."""
    return f"{rtol:.0e}" if float(f"{rtol:.0e}") == rtol else repr(rtol)


def two_digits(value: float | None) -> str:
    """A number to two digits; - where there is none."""
    return "-" if value is None or not math.isfinite(value) else f"{value:.1e}"


def work_tables(study: Study, case: Case, width: int) -> Iterator[Table]:
    """What an error costs in fixed and in controlled steps, and what the controlled ones gave at each tolerance."""
    fixed = [(cell.method, cell) for cell in study.error_vs_n if cell.case == case]
    free = [(cell.name, cell) for cell in study.adaptive or () if cell.case == case]
    if fixed or free:
        yield _work(case, fixed, free)
    if free:
        yield from _adaptive(case, free, width)


def _work(case: Case, fixed: Sequence[tuple[str, Cell]], free: Sequence[tuple[str, AdaptiveCell]]) -> Table:
    error = f"largest {case.error}{f', in {case.unit},' if case.unit else ''}"
    points: list[tuple[str, Any]] = [*fixed, *free]
    table = costs(f"Work, {case.label}", points, error, lambda cell: cell.evaluations)
    missing = any("-" in row for row in table.grids[0].rows)
    both = "a method alone has fixed steps, one with the name of a controller is a pair with controlled ones"
    notes = [both if free else "", _UNREACHED if missing else ""]
    title = table.title.replace("Work", "Evaluations", 1)
    return Table(table.name, title, table.grids, "\n".join(filter(None, notes)))


def _adaptive(case: Case, cells: Sequence[tuple[str, AdaptiveCell]], width: int) -> Iterator[Table]:
    at, who = case.label, "pair, controller"
    lost = any(cell.failure for _, cell in cells)
    rounding = any(cell.floor for _, cell in cells)
    notes = [note for note, applies in ((NOTES[ROUNDING], rounding), (_LOST, lost)) if applies]
    unit = f", in {case.unit}" if case.unit else ""
    yield against_rtol(
        f"error-vs-rtol-{text_table.slug(at)}",
        f"Error against rtol, {at}: largest {case.error} over the sample {case.samples}{unit}",
        cells,
        _error,
        width,
        notes,
        who,
    )
    yield against_rtol(
        f"attempts-{text_table.slug(at)}",
        f"Steps against rtol, {at}: accepted + rejected",
        cells,
        lambda cell: f"{cell.accepted}+{cell.rejected}",
        width,
        (),
        who,
    )
    yield against_rtol(
        f"evaluations-{text_table.slug(at)}",
        f"Evaluations against rtol, {at}: of the right-hand side",
        cells,
        lambda cell: str(cell.evaluations),
        width,
        (),
        who,
    )
    if lost:
        yield _failures(at, cells, width)


def _error(cell: AdaptiveCell) -> str:
    return f"{cell.max_error:.0e}{ROUNDING}" if cell.floor else two_digits(cell.max_error)


def _failures(at: str, cells: Sequence[tuple[str, AdaptiveCell]], width: int) -> Table:
    rows = [(who, brief(cell.rtol), cell.failure) for who, cell in cells if cell.failure]
    columns = Column("pair, controller", left=True), Column("rtol", left=True), Column("why", left=True)
    return Table(f"lost-{text_table.slug(at)}", f"Lost marches, {at}", (text_table.folded(columns, rows, width),))
