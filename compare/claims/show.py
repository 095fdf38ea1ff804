"""A check as text and as JSON."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any

from compare.show import text_table
from compare.show.text_table import Column, Grid, Section

if TYPE_CHECKING:
    from compare.claims.order import Order
    from compare.claims.record import Check

__all__ = ["json_text", "text"]

NOTE = "* used in the fit; noise is by how much the errors from two starts close by differ"
RUN = {
    "compiled": "compiled",
    "on arrays": "on arrays",
    "lane by lane": "one state at a time",
    "whole": "as a whole integrator",
}


def text(found: Check) -> str:
    """The verdict, and the errors that the order was read from."""
    run = f"{found.name}, run {RUN[found.engine]}, on {found.problem}"
    if found.engine == "compiled":
        run = f"{found.name}, compiled, on {found.problem}"
    tables = [_table("errors", "Errors over one period", found.still)]
    if found.swinging is not None:
        tables.append(_table("swinging", "Errors seen from a swinging frame, where the time enters", found.swinging))
    return "\n".join([f"{found.name}: {found.verdict}.", "", f"{run}.", "", *tables])


def _table(name: str, title: str, order: Order) -> str:
    columns = (Column("N"), Column("h"), Column("error"), Column("noise"), Column("slope"), Column("", left=True))
    rows = tuple(
        (
            str(cell.n),
            f"{cell.h:.3g}",
            f"{cell.error:.2e}",
            f"{cell.noise:.0e}",
            "" if cell.slope is None else f"{cell.slope:.2f}",
            "*" * cell.used,
        )
        for cell in order.cells
    )
    return text_table.text(Section(name, title, (Grid(columns, rows),), NOTE))


def json_text(found: Check) -> str:
    """One object; what was not measured is null, and ``not_applicable`` says why the problem has no such thing."""
    answer: dict[str, Any] = {
        "name": found.name,
        "form": found.form,
        "engine": found.engine,
        "problem": found.problem,
        "claims": {
            "order": found.claims.order,
            "symplectic": found.claims.symplectic,
            "reversible": found.claims.reversible,
        },
        "measured_order": found.measured_order,
        "order_interval": None if found.order_interval is None else list(found.order_interval),
        "advance_of_a_constant_slope": found.advance,
        "order_by_power_series": found.order_by_series,
        "order_holds": found.order_holds,
        "consistent": found.consistent,
        "step_back": found.heading.backward,
        "order_still": found.still.value,
        "order_where_time_enters": None if found.swinging is None else found.swinging.value,
        "symplecticity_defect": _number(found.symplecticity.size),
        "symplectic": None if found.symplecticity.lacks else found.symplecticity.none,
        "reversibility_defect": _number(found.reversibility.size),
        "reversible": None if found.reversibility.lacks else found.reversibility.none,
        "defects_at_h": {"symplecticity": found.symplecticity.h, "reversibility": found.reversibility.h},
        "energy": {
            "behaviour": found.energy.behaviour,
            "largest_error": _number(found.energy.largest),
            "slope_per_second": _number(found.energy.slope),
            "h": found.energy.h,
            "steps": found.energy.steps,
        },
        "verdict": found.verdict,
        "claims_hold": found.claims_hold,
        "errors": [
            {"n": cell.n, "h": cell.h, "error": _number(cell.error), "slope": cell.slope, "used": cell.used}
            for cell in found.still.cells
        ],
    }
    lacks = {
        "symplectic": found.symplecticity.lacks,
        "reversible": found.reversibility.lacks,
        "energy": found.energy.lacks,
    }
    if lacks := {name: why for name, why in lacks.items() if why}:
        answer["not_applicable"] = lacks
    return json.dumps(answer, indent=2, ensure_ascii=False, allow_nan=False) + "\n"


def _number(value: float) -> float | None:
    return value if math.isfinite(value) else None
