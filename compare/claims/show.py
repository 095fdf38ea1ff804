"""A check as a page, in text and JSON."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.claims.record import Check
from compare.show.page import Lines, Page, Sentence, fields_of, in_lines
from compare.show.text_table import Column, Grid, Table

if TYPE_CHECKING:
    from collections.abc import Iterator

    from compare.claims.energy import Energy
    from compare.claims.order import Order
    from compare.claims.verdicts import Judged
    from compare.show.page import Block

__all__ = ["page"]

NOTE = "* used in the fit; noise is by how much the errors from two starts close by differ"
RUN = {
    "compiled": "compiled",
    "on arrays": "on arrays",
    "lane by lane": "one state at a time",
    "whole": "as a whole integrator",
}


def page(found: Judged) -> Page:
    """The verdicts, and of a step the errors that the order was read from."""
    if isinstance(found, Check):
        return Page("check", lambda _form, _width: _blocks(found), lambda: _data(found))
    return Page("check", lambda _form, _width: _verdicts(found), lambda: _alone(found))


def _verdicts(found: Judged) -> Iterator[Block]:
    """A line for each claim."""
    if found.verdicts:
        yield Sentence("\n".join(f"{one}." for one in found.verdicts))
    yield Sentence(f"{found.name} on {found.problem}.")


def _alone(found: Judged) -> Lines:
    """One object of the verdicts."""
    told = {"name": found.name, "problem": found.problem, "claims_hold": found.claims_hold}
    return Lines(in_lines({**told, "verdicts": [fields_of(one) for one in found.verdicts]}).entries)


def _blocks(found: Check) -> Iterator[Block]:
    if found.verdicts:
        yield Sentence("\n".join(f"{one}." for one in found.verdicts))
    yield Sentence(f"{found.name}: {found.verdict}.")
    run = "" if found.engine == "compiled" else "run "
    yield Sentence(f"{found.name}, {run}{RUN[found.engine]}, on {found.problem}.")
    yield _table("errors", f"Errors{_until(found.still)}", found.still)
    if found.swinging is not None:
        yield _table("swinging", "Errors seen from a swinging frame, where the time enters", found.swinging)
    if found.back is not None:
        yield _table("back", "Errors with negative steps", found.back)


def _until(order: Order) -> str:
    """Up to when the errors are: about a period, where the motion has one."""
    return f" up to t = {order.cells[0].n * order.cells[0].h:.3g}" if order.cells else ""


def _table(name: str, title: str, order: Order) -> Table:
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
    return Table(name, title, (Grid(columns, rows),), NOTE)


def _data(found: Check) -> Lines:
    """One object; what was not measured is null, and ``not_applicable`` says why the problem has no such thing."""
    answer: dict[str, Any] = {
        "name": found.name,
        "form": found.form,
        "engine": found.engine,
        "problem": found.problem,
        "claims": fields_of(found.claims),
        "measured_order": found.measured_order,
        "order_interval": found.order_interval,
        "advance_of_a_constant_slope": found.advance,
        "order_by_power_series": found.order_by_series,
        "order_holds": found.order_holds,
        "consistent": found.consistent,
        "step_back": found.heading.backward,
        "order_still": found.still.value,
        "order_of_negative_steps": None if found.back is None else found.back.value,
        "order_where_time_enters": None if found.swinging is None else found.swinging.value,
        "symplecticity_defect": found.symplecticity.size,
        "symplectic": None if found.symplecticity.lacks else found.symplecticity.none,
        "reversibility_defect": found.reversibility.size,
        "reversible": None if found.reversibility.lacks else found.reversibility.none,
        "defects_at_h": {"symplecticity": found.symplecticity.h, "reversibility": found.reversibility.h},
        "energy": _kept(found.energy),
        "other_invariants": {one.invariant: _kept(one) for one in found.others},
        "verdict": found.verdict,
        "claims_hold": found.claims_hold,
        "verdicts": [fields_of(one) for one in found.verdicts],
        "errors": [fields_of(cell, "noise") for cell in found.still.cells],
    }
    lacks = {
        "symplectic": found.symplecticity.lacks,
        "reversible": found.reversibility.lacks,
        "energy": found.energy.lacks,
    }
    if lacks := {name: why for name, why in lacks.items() if why}:
        answer["not_applicable"] = lacks
    return Lines(in_lines(answer).entries)


def _kept(one: Energy) -> dict[str, Any]:
    return {
        "behaviour": one.behaviour,
        "largest_error": one.largest,
        "slope_per_second": one.slope,
        "h": one.h,
        "steps": one.steps,
    }
