"""What of a check counts against an earlier one: its verdicts, the order, and defects that are rounding."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.baseline import Entry, Gate, Large, Rounding, Standing
from compare.claims.defects import ROUNDING

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from compare.baseline import Comparison

__all__ = ["DEFECT_FACTOR", "GATE", "ORDER_MARGIN", "exit_code"]

FAIL, OPEN, PASS = "FAIL", "NOT ESTABLISHED", "PASS"
VERDICT = Standing((FAIL, OPEN, PASS))
ORDER_MARGIN = 0.5
"""An order that is measured may be so much lower: orders are whole numbers."""
DEFECT_FACTOR = 10.0
"""A defect that is rounding may come to so many times the level up to which one is called so."""


def _facts(document: Any) -> Mapping[str, Any]:
    return {"problem": document["problem"]}


def _entries(document: Any, _factor: float | None) -> Iterator[Entry]:
    for one in document["verdicts"]:
        yield Entry(one["words"], "verdict", one["standing"], VERDICT)
    if "measured_order" not in document:  # of events and of derivatives there are verdicts alone
        return
    yield Entry("the step", "measured order", document["measured_order"], Large(ORDER_MARGIN))
    for what in ("symplecticity", "reversibility"):
        defect = document[f"{what}_defect"]
        yield Entry("the step", f"{what} defect", defect, Rounding(ROUNDING, DEFECT_FACTOR))


GATE = Gate("check", _facts, _entries)


def exit_code(document: Any, found: Comparison) -> int:
    """1 where anything is worse, or a claim that the baseline does not have fails; 3 where one is not established."""
    new = {one["standing"] for one in document["verdicts"] if one["words"] in found.new}
    if not found.holds or FAIL in new:
        return 1
    return 3 if OPEN in new else 0
