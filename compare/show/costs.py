"""What an error of a given size costs: a row a method or a solver, a column an error."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.show.text_table import Column, Grid, Table

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

__all__ = ["TARGETS", "costs"]

TARGETS = tuple(float(f"1e-{k}") for k in range(2, 15, 2))


def costs(
    name: str,
    title: str,
    error: str,
    points: Sequence[tuple[str, float, Any]],
    text: Callable[[Any], str] = str,
    notes: Sequence[str] = (),
) -> Table:
    """The least cost of those measured whose error is at most each target.

    Args:
        name: of the table.
        title: what costs, and where.
        error: what the error is of, or in.
        points: who was measured, its error and what it cost.
        text: of a cost.
        notes: lines below the table.
    """

    def least(who: str, target: float) -> str:
        found = [cost for name, error, cost in points if name == who and error <= target]
        return text(min(found)) if found else "-"

    columns = Column("", left=True), *(Column(f"{target:.0e}") for target in TARGETS)
    rows = tuple((who, *(least(who, t) for t in TARGETS)) for who in dict.fromkeys(who for who, _, _ in points))
    whole = f"{title}: the least of those measured whose largest {error} is below"
    return Table(name, whole, (Grid(columns, rows),), "\n".join(notes))
