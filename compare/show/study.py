"""The tables of a study of fixed steps: error, order and drift; norms, phase and amplitude, growth, period, defects.

They round to three digits and say in their notes what a mark means.
For programs there are the study's records, whose every number has its full precision.
"""

from __future__ import annotations

import math
from operator import attrgetter
from typing import TYPE_CHECKING, Any

from compare.measure.records import AdaptiveCell, Cell, Defect, Drift, FittedOrder, Growth, OwnPeriod, Phase
from compare.show import text_table
from compare.show.digits import (
    DOUBT,
    NOTES,
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
from compare.show.page import field_names
from compare.show.study_page import study_page
from compare.show.text_table import Column, Grid, Table
from compare.show.work import work_tables

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from compare.measure.records import Case, Study
    from compare.show.page import Page
    from compare.show.study_page import Columns
    from reference.declaration import Invariant

__all__ = ["COLUMNS", "page", "tables"]

COLUMNS: Columns = {
    "error_vs_n": field_names(Cell, "velocity_rounding", "order_rounding"),
    "order": field_names(FittedOrder, "spread_rounding"),
    "energy_drift": field_names(Drift, "slope_rounding", "relative_rounding"),
    "phase": field_names(Phase),
    "growth": field_names(Growth, "rounding"),
    "period": field_names(OwnPeriod),
    "defects": field_names(Defect),
    "adaptive": field_names(AdaptiveCell, "seconds"),
}
"""What programs are given of each table's records."""
_GROWTH_NOTE = (
    "exponent of t ± its 95 % interval; no law where none is clear\n"
    "* means that the error is rounding: the mean of marches from several starts"
)
_GROWTH_NAN = "nan means fewer than 32 periods or 128 steps, or an error that is no number"


def _norms(study: Study, case: Case, declared: dict[str, int], width: int) -> Iterator[Table]:
    cells = [cell for cell in study.error_vs_n if cell.case == case]
    if not cells:
        return
    labels = ["max", "rms", "end", "digits", "evaluations"]
    grids = [of_steps(cells, declared, width, labels, _place_norms)]
    velocity = not all(math.isnan(cell.max_velocity_error) for cell in cells)
    if velocity:
        grids.append(of_steps(cells, declared, width, ["max v", "rms v", "end v"], _velocity_norms))
    unit = f", in {case.unit}" if case.unit else ""
    rate = f"; v: of the velocity{', per second' if case.unit else ', relative to its largest'}" if velocity else ""
    yield Table(
        name=f"norms-{text_table.slug(case.label)}",
        title=f"Norms, {case.label}: {case.error}{unit}, its correct digits, and the work{rate}",
        grids=tuple(grids),
        note=legend(grids),
    )


def _place_norms(cell: Cell) -> list[str]:
    errors = [starred(error, cell.rounding) for error in (cell.max_error, cell.rms_error, cell.end_error)]
    doubt = cell.rounding / (cell.max_error or math.inf) / math.log(10)
    return [*errors, decided(cell.digits, doubt, (".1f", ".0f")), str(cell.evaluations)]


def _velocity_norms(cell: Cell) -> list[str]:
    errors = cell.max_velocity_error, cell.rms_velocity_error, cell.end_velocity_error
    return [starred(error, cell.velocity_rounding) for error in errors]


def _phase(study: Study, case: Case, declared: dict[str, int], width: int) -> Iterator[Table]:
    found = [phase for phase in study.phase or () if phase.case == case]
    if not found:
        return
    grids = by_steps(found, declared, width, _phase_cell)
    yield Table(
        name=f"phase-{text_table.slug(case.label)}",
        title=f"Phase, {case.label}: largest |phase - exact| over the sample times, in rad, 2 pi a period",
        grids=grids,
        note=legend(grids, _LOST_NOTE if any(phase.lost for phase in found) else ""),
    )
    if not all(math.isnan(phase.max_amplitude_error) for phase in found):
        yield from _one_number(
            found,
            "amplitude",
            f"Amplitude, {case.label}: largest |amplitude - exact| over the sample times, in units of the place",
            attrgetter("max_amplitude_error", "amplitude_rounding"),
            (declared, width),
        )


_LOST_NOTE = "! means that some states are on no orbit of the exact kind and have no phase"


def _phase_cell(phase: Phase) -> list[str]:
    return [starred(phase.max_phase_error, phase.phase_rounding) + "!" * bool(phase.lost)]


def _growth(study: Study, case: Case, declared: dict[str, int], width: int) -> Iterator[Table]:
    found = [growth for growth in study.growth or () if growth.case == case]
    if found and all(math.isnan(growth.exponent) for growth in found):
        yield Table(
            name=f"growth-{text_table.slug(case.label)}", title=f"Growth, {case.label}: {_no_law(case)}", grids=()
        )
        return
    for quantity in dict.fromkeys(growth.quantity for growth in found):
        records = [growth for growth in found if growth.quantity == quantity]
        if records:
            found_grid = of_steps(records, declared, width, ["law", "exponent"], _growth_cells)
            doubt = any(DOUBT in cell for row in found_grid.rows for cell in row)
            nan = any(math.isnan(growth.exponent) for growth in records)
            notes = _GROWTH_NOTE, NOTES[DOUBT] if doubt else "", _GROWTH_NAN if nan else ""
            yield Table(
                name=f"growth-{quantity}-{text_table.slug(case.label)}",
                title=f"Growth, {case.label}: law of the {_WORDS.get(quantity, f'change of {quantity}')} over time",
                grids=(found_grid,),
                note="\n".join(filter(None, notes)),
            )


_WORDS = {"place": "error of the place", "phase": "error of the phase", "energy": "change of the conserved quantity"}


def _no_law(case: Case) -> str:
    """What a law takes, where none of a case's has it."""
    end = "--tau-end" if ("form", "time") in case.inputs else "--t-end"
    periods = f"32 periods (a later end of the march: {end}), " if case.cycle == "period" else ""
    return f"no law can be told; one takes at least {periods}128 steps, and errors that are numbers"


def _growth_cells(growth: Growth) -> list[str]:
    if math.isnan(growth.exponent):
        return ["-", "nan"]
    exponent = decided(growth.exponent, growth.rounding, (".2f", ".1f"))
    return [growth.law or "-", f"{exponent} ± {growth.interval:.2f}{ROUNDING * growth.floor}"]


def _period(study: Study, case: Case, declared: dict[str, int], width: int) -> Iterator[Table]:
    yield from _one_number(
        [period for period in study.period or () if period.case == case],
        "period",
        f"Period, {case.label}: own/exact - 1, between two passages through the bottom, each where the phase of the "
        "orbits through the states around it, taken as linear, is whole",
        attrgetter("relative_error", "rounding"),
        (declared, width),
    )


def _defects(study: Study, case: Case, declared: dict[str, int], width: int) -> Iterator[Table]:
    found = [defect for defect in study.defects or () if defect.case == case]
    for what, title in _DEFECTS.items():
        known = [defect for defect in found if not math.isnan(getattr(defect, what))]
        numbers = attrgetter(what, f"{what}_rounding")
        yield from _one_number(
            known, what, title.format(case.label, _FORMS[case.freedom > 1]), numbers, (declared, width)
        )


_FORMS = {
    False: "|det d(y_n+1)/d(y_n) - 1|",
    True: "|S' W S - W|, S = d(y_n+1)/d(y_n) and W the symplectic form,",
}
"""How far a step is from keeping the symplectic form, with one degree of freedom and with more."""
_DEFECTS = {
    "symplecticity": "Symplecticity defect, {}: largest {} in position and momentum",
    "reversibility": "Reversibility defect, {}: distance from the start after N steps, turning round, N steps",
}


def _one_number(
    records: Sequence[Any],
    name: str,
    title: str,
    numbers: Callable[[Any], tuple[float, float]],
    layout: tuple[dict[str, int], int],
) -> Iterator[Table]:
    """One number for each method and N, if there are any; ``numbers`` gives it with rounding's part of it."""
    if records:
        grids = by_steps(records, *layout, lambda record: [starred(*numbers(record))])
        missing = _MISSING.get(name, "") if any(math.isnan(numbers(record)[0]) for record in records) else ""
        yield Table(f"{name}-{text_table.slug(records[0].case.label)}", title, grids, legend(grids, missing))


_MISSING = {"period": "nan means that two passages were not found within the march"}
_NAN_NOTE = "nan means overflow, stages that do not converge, or no Taylor series at a cusp"
_FAR_NOTE = "! means further from the declared order than the slopes are from each other"


def page(study: Study) -> Page:
    """A study of fixed steps."""
    return study_page(study, tables, COLUMNS)


def tables(study: Study, width: int = 100) -> Iterator[Table]:
    """The readable tables, case by case, with columns grouped by declared order to fit the width."""
    declared = {fit.method: fit.declared_order for fit in study.order}
    for case in study.cases:
        lacks = dict(case.lacks)
        for score in study.scores:
            if score in lacks:
                name, title = f"{score}-{text_table.slug(case.label)}", f"{score.capitalize()}, {case.label}"
                yield Table(name=name, title=f"{title}: {lacks[score]}", grids=())
            yield from _TABLES[score](study, case, declared, width)


def _error(study: Study, case: Case, declared: dict[str, int], width: int) -> Iterator[Table]:
    """Errors against N, and the orders fitted to them."""
    cells = [cell for cell in study.error_vs_n if cell.case == case]
    if cells:
        yield _error_table(cells, declared, width)
    fits = [fit for fit in study.order if fit.case == case]
    if fits:
        yield _order_table(fits)


def _drift(study: Study, case: Case, declared: dict[str, int], width: int) -> Iterator[Table]:
    """The drift of what is conserved, and its trend."""
    for invariant in case.invariants:
        drifts = [drift for drift in study.energy_drift if (drift.case, drift.invariant) == (case, invariant.name)]
        if drifts:
            yield from _drift_table(drifts, invariant, declared, width)
            yield _slope_table(drifts, invariant, declared, width)


def _error_table(cells: Sequence[Cell], declared: dict[str, int], width: int) -> Table:
    case = cells[0].case
    what = f"largest {case.error} over the sample {case.samples}{f', in {case.unit},' if case.unit else ''}"
    grids = by_steps(cells, declared, width, _error_cell, (Column("error"), Column("order", left=True)))
    return Table(
        name=f"error-vs-n-{text_table.slug(case.label)}",
        title=f"Error against N, {case.label}: {what} and local order",
        grids=grids,
        note=legend(grids, _NAN_NOTE if any(math.isnan(cell.max_error) for cell in cells) else ""),
    )


def _error_cell(cell: Cell) -> tuple[str, str]:
    if cell.floor:
        return digits(cell.max_error, ".0e"), ROUNDING
    return scientific(cell.max_error, cell.rounding), _local_order(cell)


def _work(study: Study, case: Case, _: dict[str, int], width: int) -> Iterator[Table]:
    yield from work_tables(study, case, width)


def _order_table(fits: Sequence[FittedOrder]) -> Table:
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
    return Table(
        name=f"order-{text_table.slug(at)}",
        title=f"Order, {at}: slope of log(error) against log(h) over the asymptotic range, ± spread of local slopes",
        grids=grids,
        note=legend(grids, _FAR_NOTE if any(map(_is_far, fits)) else "", missing),
    )


def _drift_table(
    drifts: Sequence[Drift], invariant: Invariant, declared: dict[str, int], width: int
) -> Iterator[Table]:
    case, (name, change) = drifts[0].case, invariant.drift
    size = f"|{change.partition('/')[0].strip('()')}|/{change.partition('/')[2]}"
    title = f"{name} drift, {case.label}: max {size} over every step"
    numbers = attrgetter("max_drift_above_rest", "rounding")
    yield from _one_number(drifts, f"{text_table.slug(invariant.name)}-drift", title, numbers, (declared, width))


def _slope_table(drifts: Sequence[Drift], invariant: Invariant, declared: dict[str, int], width: int) -> Table:
    case, (name, change) = drifts[0].case, invariant.drift
    energy = case.energy and invariant == case.invariants[0]
    slope = f"slope of {change} per {case.cycle}, 95 % interval"

    def cells(drift: Drift) -> tuple[str, ...]:
        slope = starred(drift.slope_per_period, drift.slope_rounding)
        told = math.isfinite(drift.slope_interval) and not is_rounding(drift.slope_per_period, drift.slope_rounding)
        trend = f"{slope} ± {digits(drift.slope_interval, '.0e')}" if told else slope.replace("nan", "-")
        return (starred(drift.max_drift_relative, drift.relative_rounding), trend) if energy else (trend,)

    labels = [*(["relative"] if energy else []), f"slope per {case.cycle}"]
    grids = (of_steps(drifts, declared, width, labels, cells),)
    return Table(
        name=f"{text_table.slug(invariant.name)}-slope-{text_table.slug(case.label)}",
        title=f"{name} trend, {case.label}: {'max |E - E0|/|E0|, and ' if energy else ''}{slope}",
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


_TABLES: dict[str, Callable[[Study, Case, dict[str, int], int], Iterator[Table]]] = {
    "error": _error,
    "work": _work,
    "drift": _drift,
    "norms": _norms,
    "phase": _phase,
    "growth": _growth,
    "period": _period,
    "defects": _defects,
}
"""The tables of each score."""
