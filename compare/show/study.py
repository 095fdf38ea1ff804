"""A study's tables, as text, Markdown, CSV, LaTeX or JSON: error, order, drift; ``study_extras`` has the others.

The readable forms (text, Markdown, LaTeX) round to three digits and say in their notes what a mark means.
The machine forms (CSV, JSON) hold every number at full precision; `compare.show.machine` writes them.
"""

from __future__ import annotations

import math
from operator import attrgetter
from typing import TYPE_CHECKING

from compare.show import machine
from compare.show import render as rendering
from compare.show import study_extras as table_extras
from compare.show import text_table as grid
from compare.show.digits import (
    DOUBT,
    ROUNDING,
    by_steps,
    decided,
    digits,
    is_rounding,
    legend,
    of_steps,
    scientific,
    starred,
)
from compare.show.render import FORMATS, Tables
from compare.show.text_table import Column, Grid, Section

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from compare.measure.records import Case, Cell, Drift, FittedOrder, Study

__all__ = ["FORMATS", "TABLES", "files", "render", "sections"]

_NAN_NOTE = "nan means overflow, stages that do not converge, or no Taylor series at a cusp"
_FAR_NOTE = "! means further from the declared order than the slopes are from each other"


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
    """The readable tables, case by case, with columns grouped by declared order to fit the width."""
    declared = {fit.method: fit.declared_order for fit in study.order}
    for case in study.cases:
        for score in study.scores:
            yield from _SECTIONS[score](study, case, declared, width)


def _error(study: Study, case: Case, declared: dict[str, int], width: int) -> Iterator[Section]:
    """Errors against N, and the orders fitted to them."""
    cells = [cell for cell in study.error_vs_n if cell.case == case]
    if cells:
        yield _error_section(cells, declared, width)
    fits = [fit for fit in study.order if fit.case == case]
    if fits:
        yield _order_section(fits)


def _drift(study: Study, case: Case, declared: dict[str, int], width: int) -> Iterator[Section]:
    """The drift of what is conserved, and its trend."""
    drifts = [drift for drift in study.energy_drift if drift.case == case]
    if drifts:
        yield from _drift_section(drifts, declared, width)
        yield _slope_section(drifts, declared, width)


def _error_section(cells: Sequence[Cell], declared: dict[str, int], width: int) -> Section:
    case = cells[0].case
    what = f"largest {case.error} over the sample {case.samples}{f', in {case.unit},' if case.unit else ''}"
    grids = by_steps(cells, declared, width, _error_cell, (Column("error"), Column("order", left=True)))
    return Section(
        name=f"error-vs-n-{grid.slug(case.label)}",
        title=f"Error against N, {case.label}: {what} and local order",
        grids=grids,
        note=legend(grids, _NAN_NOTE if any(math.isnan(cell.max_error) for cell in cells) else ""),
    )


def _error_cell(cell: Cell) -> tuple[str, str]:
    if cell.floor:
        return digits(cell.max_error, ".0e"), ROUNDING
    return scientific(cell.max_error, cell.rounding), _local_order(cell)


def _order_section(fits: Sequence[FittedOrder]) -> Section:
    at = fits[0].case.label
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
    grids = (Grid(columns, rows),)
    missing = (
        "- means fewer than three cells in the asymptotic range" if any(f.fitted_order is None for f in fits) else ""
    )
    return Section(
        name=f"order-{grid.slug(at)}",
        title=f"Order, {at}: slope of log(error) against log(h) over the asymptotic range, ± spread of local slopes",
        grids=grids,
        note=legend(grids, _FAR_NOTE if any(map(_is_far, fits)) else "", missing),
    )


def _drift_section(drifts: Sequence[Drift], declared: dict[str, int], width: int) -> Iterator[Section]:
    case = drifts[0].case
    name, change = case.drift or ("", "")
    size = f"|{change.partition('/')[0].strip('()')}|/{change.partition('/')[2]}"
    title = f"{name} drift, {case.label}: max {size} over every step"
    numbers = attrgetter("max_drift_above_rest", "rounding")
    yield from table_extras.plain(drifts, "energy-drift", title, numbers, (declared, width))


def _slope_section(drifts: Sequence[Drift], declared: dict[str, int], width: int) -> Section:
    case = drifts[0].case
    name, change = case.drift or ("", "")
    slope = f"slope of {change} per {case.cycle}, 95 % interval"

    def cells(drift: Drift) -> tuple[str, ...]:
        slope = starred(drift.slope_per_period, drift.slope_rounding)
        told = math.isfinite(drift.slope_interval) and not is_rounding(drift.slope_per_period, drift.slope_rounding)
        trend = f"{slope} ± {digits(drift.slope_interval, '.0e')}" if told else slope.replace("nan", "-")
        return (starred(drift.max_drift_relative, drift.relative_rounding), trend) if case.energy else (trend,)

    labels = [*(["relative"] if case.energy else []), f"slope per {case.cycle}"]
    grids = (of_steps(drifts, declared, width, labels, cells),)
    return Section(
        name=f"energy-slope-{grid.slug(case.label)}",
        title=f"{name} trend, {case.label}: {'max |E - E0|/|E0|, and ' if case.energy else ''}{slope}",
        grids=grids,
        note=legend(grids),
    )


def _local_order(cell: Cell) -> str:
    """Four characters: 1.02, -0.5, 12.3; fewer where rounding may change them."""
    order = cell.local_order
    if order is None or not math.isfinite(order):
        return "-"
    return decided(order, cell.order_rounding, (".2f", ".1f", ".0f") if 0 <= order < 9.995 else (".1f", ".0f"))


def _fitted(fit: FittedOrder) -> str:
    """The order, to as many decimals as rounding leaves, and the spread of the slopes, or its most with rounding."""
    if fit.fitted_order is None:
        return "-"
    fitted = decided(fit.fitted_order, fit.rounding, (*_DECIMALS, ".1f")) + "!" * _is_far(fit)
    if fit.spread is None:
        return fitted
    spread = decided(fit.spread, fit.spread_rounding, _DECIMALS if fit.spread >= 5e-5 else (".0e",))
    if DOUBT in spread:
        spread = f"{max(math.ceil(100 * (fit.spread + fit.spread_rounding)), 1) / 100:.2f}"
    return f"{fitted} ± {spread}"


def _is_far(fit: FittedOrder) -> bool:
    """Whether a fitted order is further from the declared one than its slopes from each other, and by a twentieth."""
    if fit.fitted_order is None or fit.spread is None:
        return False
    return abs(fit.fitted_order - fit.declared_order) > max(fit.spread + fit.spread_rounding, 0.05)


_DECIMALS = (".4f", ".3f", ".2f")


_SECTIONS: dict[str, Callable[[Study, Case, dict[str, int], int], Iterator[Section]]] = {
    "error": _error,
    "drift": _drift,
    **table_extras.SECTIONS,
}
"""The tables of each score."""
TABLES = Tables(sections, machine.COLUMNS)
"""How a study of fixed steps is shown."""
