"""Slips that the first rows of a file betray: angles and times in other units, and numbers in each other's places."""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import combinations
from statistics import median
from typing import TYPE_CHECKING, Any

from reference.arithmetic.namespaces import BALL

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from flint import arb

    from compare.files.chunk import Row

__all__ = ["FIRST_ROWS", "exchanged", "refuse_other_times", "refuse_other_units"]

FIRST_ROWS = 16
"""Rows that tell degrees from radians: a poor integrator needs some time to be 57 times wrong."""
LEAST_ROWS = 3
"""Rows that tell numbers that are exchanged from ones that happen to be alike."""
ANGLES = (
    ("degrees", 180 / math.pi, "pi/180"),
    ("gradians", 200 / math.pi, "pi/200"),
    ("milliradians", 1e3, "0.001"),
    ("arc minutes", 10800 / math.pi, "pi/10800"),
    ("arc seconds", 648000 / math.pi, "pi/648000"),
)
"""Units of angles, how many of them are a radian, and by what they are to be multiplied."""
TIMES = (
    ("ms", Fraction(1, 1000), "0.001"),
    ("µs", Fraction(1, 10**6), "1e-6"),
    ("ns", Fraction(1, 10**9), "1e-9"),
    ("minutes", Fraction(60), "60"),
    ("hours", Fraction(3600), "3600"),
)
"""Units of time, what they are in s, and how this is written."""
CLOSE = 0.02
"""Relative to such a factor, within which a number is wrong by it."""
FITS = 1 / 100
"""Of a number's size, within which rows fit the truth; an integrator that is worse gets no hint."""
FAILS = 1 / 4
"""Of a number's size, within which some row does not fit as it is."""


def refuse_other_units(
    names: Sequence[str], units: Sequence[str], rows: Sequence[Row], truths: Sequence[Sequence[arb]]
) -> None:
    """Refuse rows whose angles are wrong by the factor that another unit would make them wrong by.

    Raises:
        ValueError: they are.
    """
    given, true = _first(rows, truths)
    for name, unit, ours, theirs in zip(names, units, given, true, strict=True):
        size = max(map(abs, theirs))
        ratios = [a / b for a, b in zip(ours, theirs, strict=True) if abs(b) > size / 8]
        for what, factor, by in ANGLES if unit.startswith("rad") and ratios else ():
            near = abs(median(ratios) / factor - 1)
            if near < CLOSE and (what == "degrees" or _all_near(ratios, factor)):
                raise ValueError(
                    f"{name} is {median(ratios):.1f} times the truth, as an angle in {what} would be; {unit} is "
                    f"accepted, so multiply by {by}."
                )


def _all_near(ratios: Sequence[float], factor: float) -> bool:
    return len(ratios) >= LEAST_ROWS and all(abs(ratio / factor - 1) < FITS for ratio in ratios)


def refuse_other_times(
    time: str,
    units: Sequence[str],
    rows: Sequence[Row],
    truths: Sequence[Sequence[arb]],
    truth: Callable[[list[Fraction]], list[Any]],
) -> None:
    """Refuse rows that are not where the motion is at their times, and are where it is in other units of time;
    ``truth`` gives the states at some times.

    Raises:
        ValueError: they are.
    """
    given, true = _first(rows, truths)
    if len(given[0]) < LEAST_ROWS or max(map(_misfit, given, true)) <= FAILS:
        return
    _refuse_times(time, given, rows, true, truth, "")
    degrees = ANGLES[0][1]
    turned = [
        tuple(number / degrees for number in column) if unit.startswith("rad") else column
        for unit, column in zip(units, given, strict=True)
    ]
    _refuse_times(time, turned, rows, true, truth, " and angles in degrees")


def _refuse_times(
    time: str,
    given: Sequence[tuple[float, ...]],
    rows: Sequence[Row],
    true: Sequence[tuple[float, ...]],
    truth: Callable[[list[Fraction]], list[Any]],
    also: str,
) -> None:
    for what, factor, by in TIMES:
        instants = [row.t.value * factor for row in rows[:FIRST_ROWS]]
        last = _states(truth, instants[-1:])
        if not last or not all(_near(a[-1], b, c) for a, (b,), c in zip(given, last, true, strict=True)):
            continue
        found = _states(truth, instants)
        if found and max(map(_misfit, given, found)) < FITS:
            raise ValueError(
                f"the first {len(instants)} rows fit the truth where {time} is in {what}{also}, and not where it is in "
                f"s, which is accepted, so multiply {time} by {by}{', and angles by pi/180' if also else ''}."
            )


def _states(truth: Callable[[list[Fraction]], list[Any]], instants: list[Fraction]) -> list[tuple[float, ...]]:
    """The truths at some times, as columns; [] where there is no motion then."""
    try:
        return _columns([list(map(float, state)) for state in truth(instants)])
    except ValueError:  # a descent ends
        return []


def _near(given: float, found: float, others: Sequence[float]) -> bool:
    """Whether a number may be another, against the size that it has elsewhere."""
    return abs(given - found) <= FITS * max(abs(found), *map(abs, others))


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
