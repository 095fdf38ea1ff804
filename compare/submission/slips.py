"""Slips that the first rows of a file betray: angles in degrees, and numbers in each other's places."""

from __future__ import annotations

import math
from itertools import combinations
from statistics import median
from typing import TYPE_CHECKING

from reference.arithmetic import BALL

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from flint import arb

    from compare.submission.chunk import Row

__all__ = ["FIRST_ROWS", "exchanged", "refuse_degrees"]

FIRST_ROWS = 16
"""Rows that tell degrees from radians: a poor integrator needs some time to be 57 times wrong."""
LEAST_ROWS = 3
"""Rows that tell numbers that are exchanged from ones that happen to be alike."""
DEGREES = 180 / math.pi
FITS = 1 / 100
"""Of a number's size, within which rows fit the truth; an integrator that is worse gets no hint."""
FAILS = 1 / 4
"""Of a number's size, within which some row does not fit as it is."""


def refuse_degrees(
    names: Sequence[str], units: Sequence[str], rows: Sequence[Row], truths: Sequence[Sequence[arb]]
) -> None:
    """Refuse rows whose numbers in radians are wrong by the factor that degrees would make them wrong by.

    Raises:
        ValueError: they are.
    """
    given, true = _first(rows, truths)
    for name, unit, ours, theirs in zip(names, units, given, true, strict=True):
        size = max(map(abs, theirs))
        ratios = [a / b for a, b in zip(ours, theirs, strict=True) if abs(b) > size / 8]
        if unit.startswith("rad") and ratios and abs(median(ratios) / DEGREES - 1) < 0.02:
            raise ValueError(
                f"{name} is {median(ratios):.1f} times the truth, as an angle in degrees would be; {unit} is "
                "accepted, so multiply by pi/180."
            )


def exchanged(names: Sequence[str], rows: Sequence[Row], truths: Sequence[Sequence[arb]]) -> str:
    """A sentence where two numbers of the state fit each other's truth, and not their own; "" else."""
    given, true = _first(rows, truths)
    count = len(given[0])
    for i, j in combinations(range(len(names)), 2):
        other = max(_misfit(given[j], true[i]), _misfit(given[i], true[j]))
        own = max(_misfit(given[i], true[i]), _misfit(given[j], true[j]))
        if count >= LEAST_ROWS and other < FITS and own > FAILS:
            return (
                f"The first {count} rows fit the truth where {names[i]} and {names[j]} are exchanged, and not as they "
                "are: each may be in the other's place."
            )
    return ""


def _first(
    rows: Sequence[Row], truths: Sequence[Sequence[arb]]
) -> tuple[list[tuple[float, ...]], list[tuple[float, ...]]]:
    """The numbers of the first rows and their truths, each as columns."""
    given = [[float(BALL.number(number.value)) for number in row.state] for row in rows[:FIRST_ROWS]]
    true = [list(map(float, truth)) for truth in truths[:FIRST_ROWS]]
    return _columns(given), _columns(true)


def _columns(rows: Iterable[Sequence[float]]) -> list[tuple[float, ...]]:
    return list(zip(*rows, strict=True))


def _misfit(given: Sequence[float], true: Sequence[float]) -> float:
    """The largest difference, of the truth's largest size; infinite where that is zero."""
    size = max(map(abs, true))
    return max(abs(a - b) for a, b in zip(given, true, strict=True)) / size if size else math.inf
