"""What of a report counts against an earlier one: errors, evaluations, and who gave any; never seconds."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.baseline import Entry, Gate, Small
from compare.solvers import regression as solvers

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

__all__ = ["ERROR_FACTOR", "EVALUATIONS_FACTOR", "GATE", "ROUNDING_FACTOR"]

ERROR_FACTOR = 2.0
"""By which the error of a method with fixed steps may grow: of one not marked as rounding it is less than half."""
ROUNDING_FACTOR = 10.0
"""By which an error that is rounding may grow at least."""
LEAST = 1e-15
"""Errors up to this are the rounding of one number."""
EVALUATIONS_FACTOR = 1.1
"""By which its number of evaluations may grow: iterations end where a last bit says so."""


def _facts(document: Any) -> Mapping[str, Any]:
    parameters: Mapping[str, Any] = document["parameters"]
    return parameters


def _entries(document: Any, factor: float | None) -> Iterator[Entry]:
    for point in document["tables"]["points"]:
        marched = point["kind"] == "method"
        setting = f"N = {int(point['setting'])}" if marched else f"rtol {point['setting']}"
        of = f"{point['name']}, {setting}, {point['family']}, {point['amplitude']}"
        if marched:
            own = ERROR_FACTOR if factor is None else factor
            error = Small(max(own, ROUNDING_FACTOR) if point["floor"] else own, LEAST)
            work = Small(EVALUATIONS_FACTOR)
        else:
            own = solvers.ERROR_FACTOR if factor is None else factor
            error, work = Small(own, solvers.LEAST), Small(solvers.EVALUATIONS_FACTOR)
        yield Entry(of, "scored", solvers.was_scored(point), solvers.SCORED)
        yield Entry(of, "largest error", point["max_error"], error)
        yield Entry(of, "evaluations", point["evaluations"], work)


GATE = Gate("report", _facts, _entries)
