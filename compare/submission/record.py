"""What was found of numbers that were handed in: frozen records, which the formats show and nothing else does."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["Bar", "Point", "Running", "Score", "capped"]


@dataclass(frozen=True)
class Point:
    """One row.

    Attributes:
        number: its number among the rows, from 1.
        t: its time as it was handed in, s.
        values: the state as it was handed in.
        digits: correct digits: the least -log10 |error/truth| of the state's numbers, at most what the input can hold.
        error: the largest |number - truth| of the state's numbers, each in its own units.
        errors: number - truth, in the order of the state.
        first_wrong: for each number the place of its first wrong significant digit, from 1; None where all are right.
        phase_error: rad, 2 pi per period, positive where the state is ahead; NaN where it has no phase.
        amplitude_error: in the units of the first number of the state; NaN where it has no amplitude.
        energy_error: (E - E0)/(E0 - Emin), or the invariant itself where it starts at zero.
    """

    number: int
    t: str
    values: tuple[str, ...]
    digits: float
    error: float
    errors: tuple[float, ...]
    first_wrong: tuple[int | None, ...]
    phase_error: float
    amplitude_error: float
    energy_error: float


@dataclass(frozen=True)
class Score:
    """All rows together.

    Attributes:
        problem: the problem, as Python would make it.
        names: the names of the state's numbers; ``units`` their units.
        rows: how many rows there were.
        worst_digits: the fewest correct digits of a row; ``worst_row`` is the number of the first row that has so few.
        digits_held: the digits that the input could hold, which no row's correct digits exceed.
        max_error: the largest error of a row; ``max_errors`` the largest of each number of the state.
        max_phase_error: rad; NaN where a row has no phase.
        max_amplitude_error: in the units of the first number of the state; NaN where a row has no amplitude.
        max_energy_error: relative to the energy above rest; NaN where the problem has no invariant.
        times: how times were read: "as written", or "binary64" where each is the double that it spells.
        notes: sentences on what could not be judged.
        points: the rows themselves, or those that were kept of them.
    """

    problem: str
    names: tuple[str, ...]
    units: tuple[str, ...]
    rows: int
    worst_digits: float
    worst_row: int
    digits_held: float
    max_error: float
    max_errors: tuple[float, ...]
    max_phase_error: float
    max_amplitude_error: float
    max_energy_error: float
    times: str
    notes: tuple[str, ...]
    points: tuple[Point, ...] = field(repr=False)


class Bar(NamedTuple):
    """The extremes so far.

    Attributes:
        maxima: of the errors of a row, of phase, amplitude and energy, and of each number of the state; a NaN stays.
        worst: the fewest correct digits, and the number of the first row that has so few.
        first_lost: the number of the first known row without a phase; infinite where none is known.
    """

    maxima: list[float]
    worst: tuple[float, int]
    first_lost: float


class Running:
    """The summary of the rows so far, and an even choice of them: memory does not grow with their number.

    Of the rows at most ``keep`` are kept, besides the first of the worst and the last; all if it is None.  A row that
    changes nothing of this may be left out; ``wanted`` says which cannot be.
    """

    def __init__(self, names: tuple[str, ...], keep: int | None) -> None:
        self._names, self._keep = names, keep
        self._kept: list[Point] = []
        self._stride = 1
        self._first: Point | None = None
        self._last: Point | None = None
        self._worst: Point | None = None
        self._lost: Point | None = None
        self._maxima = [0.0] * (4 + len(names))

    def wanted(self, first: int, last: int) -> list[int]:
        """The numbers of those rows from the first to the last that are kept after the last, and the last."""
        stride = self._stride
        while self._keep is not None and (last - 1) // stride + 1 > self._keep:
            stride *= 2
        kept = range(first + (1 - first) % stride, last + 1, stride)
        return sorted({*kept, last})

    def add(self, points: Iterable[Point]) -> None:
        """Take in the next rows."""
        for point in points:
            self._first = self._first or point
            self._maxima = self._raised(self._maxima, point)
            if self._worst is None or point.digits < self._worst.digits:
                self._worst = point
            if self._lost is None and math.isnan(point.phase_error):
                self._lost = point
            self._choose(point)
            self._last = point

    @staticmethod
    def _raised(maxima: Iterable[float], point: Point) -> list[float]:
        found = point.error, point.phase_error, point.amplitude_error, point.energy_error, *point.errors
        return [_larger(a, abs(b)) for a, b in zip(maxima, found, strict=True)]

    def _choose(self, point: Point) -> None:
        """Keep every stride-th row, and double the stride where they become too many."""
        while self._keep is not None and (point.number - 1) // self._stride + 1 > self._keep:
            self._stride *= 2
            self._kept = [kept for kept in self._kept if (kept.number - 1) % self._stride == 0]
        if (point.number - 1) % self._stride == 0:
            self._kept.append(point)

    def bar(self, points: Iterable[Point]) -> Bar:
        """What a row must pass to change the summary, after these rows besides those so far."""
        maxima, worst = self._maxima, self._worst
        first_lost = math.inf if self._lost is None else self._lost.number
        for point in points:
            maxima = self._raised(maxima, point)
            if math.isnan(point.phase_error):
                first_lost = min(first_lost, point.number)
            if worst is None or (point.digits, point.number) < (worst.digits, worst.number):
                worst = point
        return Bar(maxima, (math.inf, 0) if worst is None else (worst.digits, worst.number), first_lost)

    @property
    def lost(self) -> Point | None:
        """The first row without a phase."""
        return self._lost

    def score(self, problem: str, units: tuple[str, ...], held: float, times: str, notes: tuple[str, ...]) -> Score:
        """The summary, with every row's digits at most the ``held`` that the input can hold.

        Raises:
            ValueError: there were no rows.
        """
        if self._first is None or self._last is None or self._worst is None:
            raise ValueError("there are no rows; at least one is accepted.")
        worst = self._worst if self._worst.digits < held else self._first  # all have what the input can hold
        kept = {point.number: point for point in (*self._kept, worst, self._last)}
        error, phase, amplitude, energy, *errors = self._maxima
        return Score(
            problem=problem,
            names=self._names,
            units=units,
            rows=self._last.number,
            worst_digits=min(worst.digits, held),
            worst_row=worst.number,
            digits_held=held,
            max_error=error,
            max_errors=tuple(errors),
            max_phase_error=phase,
            max_amplitude_error=amplitude,
            max_energy_error=energy,
            times=times,
            notes=notes,
            points=tuple(capped(kept[number], held) for number in sorted(kept)),
        )


def capped(point: Point, held: float) -> Point:
    """The row with at most ``held`` correct digits."""
    return replace(point, digits=held) if point.digits > held else point


def _larger(a: float, b: float) -> float:
    """max(a, b), where a NaN wins."""
    return b if b > a or math.isnan(b) else a
