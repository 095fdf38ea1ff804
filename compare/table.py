"""A study's three tables, as text, Markdown, CSV, LaTeX or JSON.

The readable forms (text, Markdown, LaTeX) round to three digits and say in their notes what a mark means.
The machine forms (CSV, JSON) hold every number at full precision; `compare.machine` writes them.
"""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING

from compare import grid, machine, rendering
from compare.grid import Column, Grid, Section
from compare.rendering import FORMATS, Tables

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

    from compare.records import Cell, Drift, FittedOrder, Study

__all__ = ["FORMATS", "TABLES", "files", "render", "sections"]

_NAN_NOTE = "nan means overflow, or an implicit method whose stages do not converge at this h"
_FLOOR_NOTE = "* means rounding, not order: within ten times the rounding floor of the engine"


def render(study: Study, form: str = "text", width: int = 100) -> str:
    """The study's tables in one of FORMATS; `width` is the longest line of the text form.

    Raises:
        ValueError: the format is not one of FORMATS.
    """
    return rendering.render(study, TABLES, form, width)


def files(study: Study, form: str = "text", width: int = 100) -> dict[str, bytes]:
    """What `render` gives, by file name: one file, or for CSV one file a table."""
    return rendering.files(study, TABLES, form, width)


def sections(study: Study, width: int = 100) -> Iterator[Section]:
    """The readable tables, amplitude by amplitude, with columns grouped by declared order to fit the width."""
    declared = {fit.method: fit.declared_order for fit in study.order}
    for theta0 in dict.fromkeys(cell.theta0 for cell in study.error_vs_n):
        cells = [cell for cell in study.error_vs_n if cell.theta0 == theta0]
        drifts = [drift for drift in study.energy_drift if drift.theta0 == theta0]
        at = f"theta0 = {theta0!r} rad"
        yield _error_section(cells, declared, at, width)
        yield _order_section([fit for fit in study.order if fit.theta0 == theta0], at)
        yield _drift_section(drifts, declared, at, width)
        yield _slope_section(drifts, declared, at, width)


def _error_section(cells: Sequence[Cell], declared: dict[str, int], at: str, width: int) -> Section:
    found = {(cell.method, cell.n): cell for cell in cells}
    steps = _steps(cells)

    def build(methods: Sequence[str]) -> Grid:
        columns = [Column("N"), Column("h [s]")]
        rows = [[str(n), _scientific(h)] for n, h in steps.items()]
        for method in methods:
            columns += [Column("error", method), Column("order", method, left=True)]
            for row, n in zip(rows, steps, strict=True):
                row.extend(_error_cell(found.get((method, n))))
        return Grid(tuple(columns), tuple(map(tuple, rows)))

    return Section(
        name=f"error-vs-n-{grid.slug(at)}",
        title=f"Error against N, {at}: largest |theta - exact| over the sample times, in rad, and local order",
        grids=_split(build, _methods(cells), declared, width),
        note="\n".join(
            note
            for note, applies in (
                (_FLOOR_NOTE, any(cell.floor for cell in cells)),
                (_NAN_NOTE, any(math.isnan(cell.max_error) for cell in cells)),
            )
            if applies
        ),
    )


def _error_cell(cell: Cell | None) -> tuple[str, str]:
    if cell is None:
        return "", ""
    return _scientific(cell.max_error), "*" if cell.floor else _local_order(cell.local_order)


def _order_section(fits: Sequence[FittedOrder], at: str) -> Section:
    columns = (
        Column("method", left=True),
        Column("declared"),
        Column("fitted"),
        Column("cells used"),
        Column("N used", left=True),
    )
    rows = tuple(
        (
            fit.method,
            str(fit.declared_order),
            _fitted(fit),
            str(fit.cells_used),
            "-" if fit.n_range is None else f"{fit.n_range[0]} to {fit.n_range[1]}",
        )
        for fit in sorted(fits, key=lambda fit: fit.declared_order)
    )
    return Section(
        name=f"order-{grid.slug(at)}",
        title=f"Order, {at}: slope of log(error) against log(h) over the asymptotic range, ± spread of local slopes",
        grids=(Grid(columns, rows),),
        note="- means fewer than three cells in the asymptotic range"
        if any(f.fitted_order is None for f in fits)
        else "",
    )


def _drift_section(drifts: Sequence[Drift], declared: dict[str, int], at: str, width: int) -> Section:
    found = {(drift.method, drift.n): drift for drift in drifts}
    steps = _steps(drifts)

    def build(methods: Sequence[str]) -> Grid:
        rows = [[str(n), _scientific(h)] for n, h in steps.items()]
        for row, n in zip(rows, steps, strict=True):
            cells = (found.get((method, n)) for method in methods)
            row.extend("" if cell is None else _scientific(cell.max_drift_above_rest) for cell in cells)
        columns = (Column("N"), Column("h [s]"), *map(Column, methods))
        return Grid(columns, tuple(map(tuple, rows)))

    return Section(
        name=f"energy-drift-{grid.slug(at)}",
        title=f"Energy drift, {at}: max |E - E0|/(E0 - Emin) over every step",
        grids=_split(build, _methods(drifts), declared, width),
    )


def _slope_section(drifts: Sequence[Drift], declared: dict[str, int], at: str, width: int) -> Section:
    found = {(drift.method, drift.n): drift for drift in drifts}
    methods = sorted(_methods(drifts), key=lambda method: declared.get(method, 0))

    def build(chosen: Sequence[int]) -> Grid:
        columns = [Column("method", left=True)]
        rows = [[method] for method in methods]
        for n in chosen:
            columns += [Column("relative", f"N = {n}"), Column("slope per period", f"N = {n}")]
            for row, method in zip(rows, methods, strict=True):
                row.extend(_slope_cells(found.get((method, n))))
        return Grid(tuple(columns), tuple(map(tuple, rows)))

    return Section(
        name=f"energy-slope-{grid.slug(at)}",
        title=f"Energy trend, {at}: max |E - E0|/|E0|, and slope of (E - E0)/(E0 - Emin) per period, 95 % interval",
        grids=(build(_representative(list(_steps(drifts)), lambda ns: grid.text_width(build(ns)) <= width)),),
    )


def _slope_cells(drift: Drift | None) -> tuple[str, str]:
    if drift is None:
        return "", ""
    slope = f"{_scientific(drift.slope_per_period)} ± {_digits(drift.slope_interval, '.0e')}"
    return _scientific(drift.max_drift_relative), slope


def _methods(records: Iterable[Cell | Drift]) -> list[str]:
    return list(dict.fromkeys(record.method for record in records))


def _steps(records: Iterable[Cell | Drift]) -> dict[int, float]:
    """The step size at each N, in increasing N."""
    return dict(sorted({record.n: record.h for record in records}.items()))


def _split(
    build: Callable[[Sequence[str]], Grid], methods: Sequence[str], declared: dict[str, int], width: int
) -> tuple[Grid, ...]:
    """Grids no wider than the width; methods of one order stay together where they fit, and orders share a grid."""

    def fits(names: Sequence[str]) -> bool:
        return len(names) <= 1 or grid.text_width(build(names)) <= width

    groups: list[list[str]] = []
    for order in sorted({declared.get(method, 0) for method in methods}):
        members = [method for method in methods if declared.get(method, 0) == order]
        if groups and fits([*groups[-1], *members]):
            groups[-1].extend(members)
            continue
        parts = next(parts for parts in range(1, len(members) + 1) if all(map(fits, _even(members, parts))))
        groups.extend(_even(members, parts))
    return tuple(map(build, groups))


def _even(names: Sequence[str], parts: int) -> list[list[str]]:
    """The names in consecutive parts whose lengths differ by one at most, longer ones first."""
    size, longer = divmod(len(names), parts)
    starts = [i * size + min(i, longer) for i in range(parts + 1)]
    return [list(names[start:stop]) for start, stop in itertools.pairwise(starts)]


def _representative(steps: Sequence[int], fits: Callable[[Sequence[int]], bool]) -> Sequence[int]:
    """As many values of N, spread evenly over the inside of the range, as fit; at least one, at most three."""
    for count in (3, 2):
        places = [round((i + 1) * (len(steps) - 1) / (count + 1)) for i in range(count)]
        chosen = [steps[place] for place in dict.fromkeys(places)] if steps else []
        if len(chosen) == count and fits(chosen):
            return chosen
    return steps[len(steps) // 2 :][:1]


def _scientific(value: float) -> str:
    return _digits(value, ".2e")


def _digits(value: float, form: str) -> str:
    return format(value, form) if math.isfinite(value) else str(value)


def _local_order(order: float | None) -> str:
    """Four characters: 1.02, -0.5, 12.3."""
    if order is None or not math.isfinite(order):
        return "-"
    return f"{order:.2f}" if 0 <= order < 9.995 else f"{order:.1f}"


def _fitted(fit: FittedOrder) -> str:
    if fit.fitted_order is None:
        return "-"
    if fit.spread is None:
        return f"{fit.fitted_order:.4f}"
    return f"{fit.fitted_order:.4f} ± {fit.spread:{'.4f' if fit.spread >= 5e-5 else '.0e'}}"


TABLES = Tables(sections, machine.COLUMNS)
"""How a study of fixed steps is shown."""
