"""Solvers on several problems in one table: what each tolerance misses of the proven solutions."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from compare.show.page import Head, Lines, Page, field_names, fields_of, plain
from compare.show.text_table import Column, Grid, Table, slug
from compare.solvers.solver import CALLS
from compare.solvers.study import study
from compare.solvers.table import OTHER, TOLERANCES, bounded, work

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence
    from concurrent.futures import Executor

    from compare.measure.records import Case
    from compare.show.page import Block
    from compare.solvers.records import SolverStudy

__all__ = ["Missed", "missed", "page", "studies"]

COUNTED = "*"


@dataclass(frozen=True)
class Missed:
    """What one solver missed of the solution of one problem, at one tolerance.

    Attributes:
        problem: its name.
        case: its inputs in words.
        t_end: the last time.
        solver: the solver's name.
        rtol: the tolerance that was asked for, relative and absolute.
        used: what the solver worked with, on its own dial; NaN where it failed.
        max_error: largest position error over the times, in the units of the state; NaN where it failed.
        end_error: the same at the last time.
        velocity_error: largest error of the velocity over the times, likewise; NaN where there is none.
        multiple: max_error over the tolerance that was asked for.
        evaluations: what it took, in the solver's own count; None where it failed.
        dial: what its tolerance is called, or what stands in its place.
        counts: what its evaluations are.
        failure: the solver's own message where it failed, or "".
        said: the solver's warnings.
        suited: whether the problem has what the solver needs; one that lacks it was not asked.
    """

    problem: str
    case: str
    t_end: float
    solver: str
    rtol: float
    used: float
    max_error: float
    end_error: float
    velocity_error: float
    multiple: float
    evaluations: int | None
    dial: str
    counts: str
    failure: str
    said: str
    suited: bool


def studies(
    asked: Sequence[Mapping[str, Any]],
    progress: Callable[[str], None] | None = None,
    executor: Executor | None = None,
) -> list[SolverStudy]:
    """The study of each problem, from its arguments of ``compare.solvers.study.study``."""
    return [study(**one, progress=progress, executor=executor) for one in asked]


def missed(found: Sequence[SolverStudy]) -> Iterator[Missed]:
    """The cells of the studies, with what tells their problems apart."""
    for one, case, end in _cases(found):
        entries = {entry.solver: entry for entry in one.solvers}
        for cell in (cell for cell in one.error_vs_rtol if cell.case == case):
            yield Missed(
                problem=one.problem,
                case=case.label,
                t_end=end,
                solver=cell.solver,
                rtol=cell.rtol,
                used=cell.used,
                max_error=cell.max_error,
                end_error=cell.end_error,
                velocity_error=cell.velocity_error,
                multiple=cell.max_error / cell.rtol,
                evaluations=cell.evaluations,
                dial=entries[cell.solver].dial,
                counts=entries[cell.solver].counts,
                failure=cell.failure,
                said=cell.said,
                suited=cell.suited,
            )


def _cases(found: Sequence[SolverStudy]) -> Iterator[tuple[SolverStudy, Case, float]]:
    """The problems of the studies, each with its last time."""
    for one in found:
        ends = one.parameters["t_end"]
        for case, end in zip(one.cases, ends if isinstance(ends, list) else [ends] * len(one.cases), strict=True):
            yield one, case, end


def page(found: Sequence[SolverStudy]) -> Page:
    """One table of several studies; JSON is a list of its rows."""
    rows = list(missed(found))

    def blocks(_form: str, width: int) -> Iterator[Block]:
        facts = {**found[0].reference, **found[0].engine}
        told = {name: facts[name] for name in ("version", "truth", "precision", "tolerance")}
        yield Head((*told.items(), *((one.problem, one.reference["definition"]) for one in found)), "Solvers")
        yield _table(found, rows)
        yield from _works(found)
        solvers = {entry.solver: entry for one in found for entry in one.solvers if entry.version is not None}
        yield bounded(solvers.values(), width)

    return Page(
        name="solvers",
        blocks=blocks,
        data=lambda: Lines([{name: plain(value) for name, value in fields_of(row).items()} for row in rows]),
        sheets=lambda: {
            "solvers": [field_names(Missed), *([plain(v) for v in fields_of(row).values()] for row in rows)]
        },
    )


def _works(found: Sequence[SolverStudy]) -> Iterator[Table]:
    """What errors took, problem by problem."""
    counts = {entry.solver: entry.counts for one in found for entry in one.solvers}
    for one, case, end in _cases(found):
        cells = [cell for cell in one.error_vs_rtol if cell.case == case and cell.suited]
        if cells:
            words = f"{one.problem}, {case.label}, t = {end:.8g}"
            yield work(f"work-{slug(words)}", f"Work and precision, {words}", cells, counts)


def _table(found: Sequence[SolverStudy], rows: Sequence[Missed]) -> Table:
    several = {one.problem for one in found if len(one.cases) > 1}
    columns = (
        *(Column("problem", left=True), Column("t"), Column("solver", left=True), Column("rtol")),
        *(Column("largest error"), Column("error at t"), Column("velocity error")),
        *(Column("error/rtol"), Column("evaluations")),
    )
    lines = [
        (
            f"{row.problem}, {row.case}" if row.problem in several else row.problem,
            f"{row.t_end:.8g}",
            row.solver,
            f"{row.rtol:.0e}{OTHER if _is_other(row) else ''}",
            *(_digits(value) for value in (row.max_error, row.end_error, row.velocity_error, row.multiple)),
            "-" if row.evaluations is None else f"{row.evaluations}{COUNTED if row.counts != CALLS else ''}",
        )
        for row in rows
        if row.suited
    ]
    return Table(
        "solvers-several", "What a tolerance misses", (Grid(columns, tuple(lines)),), "\n".join(_notes(found, rows))
    )


def _notes(found: Sequence[SolverStudy], rows: Sequence[Missed]) -> Iterator[str]:
    """What the columns are, and what is to be said of single solvers, each once."""
    yield "largest error: that of the positions, over the times; velocity error: the same of the velocities"
    yield "error/rtol: the largest error over the tolerance"
    yield f"evaluations: {CALLS}"
    yield from dict.fromkeys(f"{COUNTED} {row.solver}: {row.counts}" for row in rows if row.counts != CALLS)
    own = (f"{OTHER} {row.solver} worked with {row.dial} = {row.used:.1e}" for row in rows if _is_other(row))
    yield from dict.fromkeys(own)
    failed: dict[tuple[str, str], dict[str, None]] = {}
    for row in rows:
        if row.failure:
            failed.setdefault((row.problem, row.failure), {})[row.solver] = None
    yield from (f"{', '.join(solvers)} on {problem}: {why}" for (problem, why), solvers in failed.items())
    solvers = [entry for one in found for entry in one.solvers]
    yield from dict.fromkeys(f"{entry.package} is missing; {entry.install}" for entry in solvers if not entry.version)


def _is_other(row: Missed) -> bool:
    """Whether the solver worked with a tolerance of its own."""
    return row.dial in TOLERANCES and math.isfinite(row.used) and row.used != row.rtol


def _digits(value: float) -> str:
    return f"{value:.1e}" if math.isfinite(value) else "-"
