"""What of a study of solvers counts against an earlier one: errors, evaluations, and who gave states; never seconds.

Last bits decide which steps an adaptive solver takes.  With those of every slope changed, the errors of LSODA at a
tolerance of 1e-13 became up to four times as large, or as small, and the evaluations of BDF 0.7 times as many.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.baseline import Entry, Gate, Small, Standing

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

__all__ = ["ERROR_FACTOR", "EVALUATIONS_FACTOR", "GATE", "LEAST", "SCORED", "SEVERAL", "was_scored"]

ERROR_FACTOR = 10.0
"""By which an error may grow."""
EVALUATIONS_FACTOR = 2.0
"""By which the number of evaluations may grow."""
LEAST = 1e-12
"""Errors up to this, in the units of the state, are rounding."""
SCORED = Standing(("no", "yes"))


def was_scored(cell: Any) -> str:
    """Whether there is an error at all, as one of SCORED."""
    return SCORED.words[not cell["failure"] and cell["max_error"] is not None]


def _of_cell(of: str, cell: Any, factor: float | None) -> Iterator[Entry]:
    yield Entry(of, "scored", was_scored(cell), SCORED)
    error = Small(ERROR_FACTOR if factor is None else factor, LEAST)
    yield Entry(of, "largest error", cell["max_error"], error)
    yield Entry(of, "evaluations", cell["evaluations"], Small(EVALUATIONS_FACTOR))


def _facts(document: Any) -> Mapping[str, Any]:
    return {
        "problem": document["problem"],
        **document["parameters"],
        "definition": document["reference"]["definition"],
    }


def _entries(document: Any, factor: float | None) -> Iterator[Entry]:
    for cell in document["tables"]["error_vs_rtol"]:
        inputs = [f"{name} = {cell[name]}" for name in document["parameters"] if name in cell and name != "rtol"]
        yield from _of_cell(", ".join([cell["solver"], f"rtol {cell['rtol']}", *inputs]), cell, factor)


GATE = Gate("solvers", _facts, _entries)


def _facts_of_several(rows: Any) -> Mapping[str, Any]:
    return {f"t_end of {row['problem']}, {row['case']}": row["t_end"] for row in rows}


def _entries_of_several(rows: Any, factor: float | None) -> Iterator[Entry]:
    for row in rows:
        of = f"{row['solver']}, rtol {row['rtol']}, {row['problem']}, {row['case']}"
        yield from _of_cell(of, row, factor)


SEVERAL = Gate("solvers --problem A --problem B", _facts_of_several, _entries_of_several)
"""Of several problems in one table."""
