"""The tables of the scores that are asked for: norms, phase and amplitude, growth, period, defects."""

from __future__ import annotations

import math
from operator import attrgetter
from typing import TYPE_CHECKING, Any

from compare.show import text_table as grid
from compare.show.digits import DOUBT, NOTES, ROUNDING, by_steps, decided, legend, of_steps, starred
from compare.show.text_table import Section

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from compare.measure.records import Case, Cell, Growth, Phase, Study

__all__ = ["SECTIONS", "plain"]

QUANTITIES = ("place", "phase", "energy")
_GROWTH_NOTE = (
    "exponent of t ± its 95 % interval; no law where none is clear\n"
    "* means that the error is rounding: the mean of marches from several starts"
)
_GROWTH_NAN = "nan means fewer than 32 periods, or an error that is no number"


def _norms(study: Study, case: Case, declared: dict[str, int], width: int) -> Iterator[Section]:
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
    yield Section(
        name=f"norms-{grid.slug(case.label)}",
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


def _phase(study: Study, case: Case, declared: dict[str, int], width: int) -> Iterator[Section]:
    found = [phase for phase in study.phase or () if phase.case == case]
    if not found:
        return
    grids = by_steps(found, declared, width, _phase_cell)
    yield Section(
        name=f"phase-{grid.slug(case.label)}",
        title=f"Phase, {case.label}: largest |phase - exact| over the sample times, in rad, 2 pi a period",
        grids=grids,
        note=legend(grids, _LOST_NOTE if any(phase.lost for phase in found) else ""),
    )
    if not all(math.isnan(phase.max_amplitude_error) for phase in found):
        yield from plain(
            found,
            "amplitude",
            f"Amplitude, {case.label}: largest |amplitude - exact| over the sample times, in units of the place",
            attrgetter("max_amplitude_error", "amplitude_rounding"),
            (declared, width),
        )


_LOST_NOTE = "! means that some states are on no orbit of the exact kind and have no phase"


def _phase_cell(phase: Phase) -> list[str]:
    return [starred(phase.max_phase_error, phase.phase_rounding) + "!" * bool(phase.lost)]


def _growth(study: Study, case: Case, declared: dict[str, int], width: int) -> Iterator[Section]:
    found = [growth for growth in study.growth or () if growth.case == case]
    if found and all(math.isnan(growth.exponent) for growth in found):
        yield Section(name=f"growth-{grid.slug(case.label)}", title=f"Growth, {case.label}: {_no_law(case)}", grids=())
        return
    for quantity in QUANTITIES:
        records = [growth for growth in found if growth.quantity == quantity]
        if records:
            found_grid = of_steps(records, declared, width, ["law", "exponent"], _growth_cells)
            doubt = any(DOUBT in cell for row in found_grid.rows for cell in row)
            nan = any(math.isnan(growth.exponent) for growth in records)
            notes = _GROWTH_NOTE, NOTES[DOUBT] if doubt else "", _GROWTH_NAN if nan else ""
            yield Section(
                name=f"growth-{quantity}-{grid.slug(case.label)}",
                title=f"Growth, {case.label}: law of the {_WORDS[quantity]} over time",
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


def _period(study: Study, case: Case, declared: dict[str, int], width: int) -> Iterator[Section]:
    yield from plain(
        [period for period in study.period or () if period.case == case],
        "period",
        f"Period, {case.label}: own/exact - 1, between two passages through the bottom, each where the phase of the "
        "orbits through the states around it, taken as linear, is whole",
        attrgetter("relative_error", "rounding"),
        (declared, width),
    )


def _defects(study: Study, case: Case, declared: dict[str, int], width: int) -> Iterator[Section]:
    found = [defect for defect in study.defects or () if defect.case == case]
    for what, title in _DEFECTS.items():
        known = [defect for defect in found if not math.isnan(getattr(defect, what))]
        numbers = attrgetter(what, f"{what}_rounding")
        yield from plain(known, what, title.format(case.label), numbers, (declared, width))


_DEFECTS = {
    "symplecticity": "Symplecticity defect, {}: largest |det d(y_n+1)/d(y_n) - 1| in position and momentum",
    "reversibility": "Reversibility defect, {}: distance from the start after N steps, turning round, N steps",
}


def plain(
    records: Sequence[Any],
    name: str,
    title: str,
    numbers: Callable[[Any], tuple[float, float]],
    layout: tuple[dict[str, int], int],
) -> Iterator[Section]:
    """One number for each method and N, if there are any; ``numbers`` gives it with rounding's part of it."""
    if records:
        grids = by_steps(records, *layout, lambda record: [starred(*numbers(record))])
        missing = _MISSING.get(name, "") if any(math.isnan(numbers(record)[0]) for record in records) else ""
        yield Section(f"{name}-{grid.slug(records[0].case.label)}", title, grids, legend(grids, missing))


_MISSING = {"period": "nan means that two passages were not found within the march"}


SECTIONS: dict[str, Callable[[Study, Case, dict[str, int], int], Iterator[Section]]] = {
    "norms": _norms,
    "phase": _phase,
    "growth": _growth,
    "period": _period,
    "defects": _defects,
}
"""The tables of each score."""
