"""What was found of numbers that were handed in: frozen records, which the formats show and nothing else does."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

from compare.files.scales import Point, Scales, near_zero

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable, Sequence

    from compare.files.conditioned import Resolution

__all__ = ["Bar", "Running", "Score"]

CONDITIONED = 4
"""The place of the errors over what the format must lose among the maxima."""


@dataclass(frozen=True)
class Score:
    """All rows together.

    Attributes:
        problem: the problem, as Python would make it.
        names: the names of the state's numbers; ``units`` their units.
        rows: how many rows there were.
        worst_digits: the fewest correct digits of a row; ``worst_row`` is the number of the first row that has so few.
        worst_scaled_digits: the fewest correct digits on the numbers' scales; ``worst_scaled_row`` is the number of
            the row with the largest error against its scale, or of the first where all have what the input holds.
        scales: the largest |truth| of each number at the start and in the rows, to six digits; 1 where all are zero.
        digits_held: the digits that the input could hold, which no row's correct digits exceed.
        max_error: the largest error of a row; ``max_errors`` the largest of each number of the state.
        max_phase_error: rad; NaN where a row has no phase.
        max_amplitude_error: in the units of the first number of the state; NaN where a row has no amplitude.
        max_energy_error: relative to the energy above rest; NaN where the problem has no invariant.
        max_conditioned_error: the largest error of a row over what the format must lose, of
            ``compare.files.conditioned``; ``max_conditioned_row`` is the number of the first row that has it; NaN and
            None where that is not known.
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
    worst_scaled_digits: float
    worst_scaled_row: int
    scales: tuple[float, ...]
    digits_held: float
    max_error: float
    max_errors: tuple[float, ...]
    max_phase_error: float
    max_amplitude_error: float
    max_energy_error: float
    max_conditioned_error: float
    max_conditioned_row: int | None
    times: str
    notes: tuple[str, ...]
    points: tuple[Point, ...] = field(repr=False)


class Bar(NamedTuple):
    """The extremes so far.

    Attributes:
        maxima: of the errors of a row, of phase, amplitude and energy, over what the format must lose, and of each
            number of the state; a NaN stays.
        worst: the fewest correct digits, and the number of the first row that has so few.
        first_lost: the number of the first known row without a phase; infinite where none is known.
        truths: the sizes of the truths up to which no scale changes.
    """

    maxima: list[float]
    worst: tuple[float, int]
    first_lost: float
    truths: tuple[float, ...]


class Running:
    """The summary of the rows so far, and an even choice of them: memory does not grow with their number.

    Of the rows at most ``keep`` are kept, besides the first of the worst and the last; all if it is None.  A row that
    changes nothing of this may be left out; ``wanted`` says which cannot be.  ``start`` has log10 of the sizes of the
    numbers at the start, from which their scales grow.
    """

    def __init__(self, names: tuple[str, ...], keep: int | None, start: Sequence[float]) -> None:
        self._names, self._keep = names, keep
        self._kept: list[Point] = []
        self._stride = 1
        self._first: Point | None = None
        self._last: Point | None = None
        self._worst: Point | None = None
        self._lost: Point | None = None
        self._maxima = [0.0] * (5 + len(names))
        self._strained: Point | None = None
        self._scales = Scales(start)
        self._farthest: list[Point | None] = [None] * len(names)
        self._zeros: list[Point | None] = [None] * len(names)

    def wanted(self, first: int, last: int) -> list[int]:
        """The numbers of those rows from the first to the last that are kept after the last, and the last."""
        stride = self._stride
        while self._keep is not None and (last - 1) // stride + 1 > self._keep:
            stride *= 2
        kept = range(first + (1 - first) % stride, last + 1, stride)
        return sorted({*kept, last})

    def add(self, points: Sequence[Point]) -> None:
        """Take in the next rows."""
        self._scales = self._scales.raised(points)
        for point in points:
            self._part(point)
            self._first = self._first or point
            self._maxima = self._raised(self._maxima, point)
            if self._worst is None or point.digits < self._worst.digits:
                self._worst = point
            if self._strained is None or point.conditioned > self._strained.conditioned:
                self._strained = point
            if self._lost is None and math.isnan(point.phase_error):
                self._lost = point
            self._choose(point)
            self._last = point

    def _part(self, point: Point) -> None:
        """Keep the row where it is the farthest from the truth in one number, or from one that is exactly zero."""
        for place, (size, digits) in enumerate(zip(point.sizes, point.relative, strict=True)):
            farthest, zero = self._farthest[place], self._zeros[place]
            if farthest is None or size > farthest.sizes[place]:
                self._farthest[place] = point
            if math.isnan(digits) and (zero is None or size > zero.sizes[place]):
                self._zeros[place] = point

    @staticmethod
    def _raised(maxima: Iterable[float], point: Point) -> list[float]:
        orbital = point.phase_error, point.amplitude_error, point.energy_error
        found = point.error, *orbital, point.conditioned, *point.errors
        return [_larger(a, abs(b)) for a, b in zip(maxima, found, strict=True)]

    def _choose(self, point: Point) -> None:
        """Keep every stride-th row, and double the stride where they become too many."""
        while self._keep is not None and (point.number - 1) // self._stride + 1 > self._keep:
            self._stride *= 2
            self._kept = [kept for kept in self._kept if (kept.number - 1) % self._stride == 0]
        if (point.number - 1) % self._stride == 0:
            self._kept.append(point)

    def bar(self, points: Collection[Point]) -> Bar:
        """What a row must pass to change the summary, after these rows besides those so far."""
        maxima, worst = self._maxima, self._worst
        first_lost = math.inf if self._lost is None else self._lost.number
        for point in points:
            maxima = self._raised(maxima, point)
            if math.isnan(point.phase_error):
                first_lost = min(first_lost, point.number)
            if worst is None or (point.digits, point.number) < (worst.digits, worst.number):
                worst = point
        fewest = (math.inf, 0) if worst is None else (worst.digits, worst.number)
        return Bar(maxima, fewest, first_lost, self._scales.raised(points).limits)

    @property
    def lost(self) -> Point | None:
        """The first row without a phase."""
        return self._lost

    def score(
        self,
        problem: str,
        units: tuple[str, ...],
        held: float,
        resolution: Resolution,
        times: str,
        notes: tuple[str, ...],
    ) -> Score:
        """The summary, with every row's digits at most the ``held`` that the input can hold.

        Raises:
            ValueError: there were no rows.
        """
        if self._first is None or self._last is None or self._worst is None:
            raise ValueError("there are no rows; at least one is accepted.")
        held = self._scales.held(held)
        worst, scaled = self._least(self._worst, self._first, held, resolution)
        strained = self._most(held, resolution)
        kept = {point.number: point for point in (*self._kept, worst, scaled, *filter(None, [strained]), self._last)}
        error, phase, amplitude, energy, _, *errors = self._maxima
        remark = near_zero(worst, self._scales, self._names, held)
        return Score(
            problem=problem,
            names=self._names,
            units=units,
            rows=self._last.number,
            worst_digits=worst.digits,
            worst_row=worst.number,
            worst_scaled_digits=scaled.scaled_digits,
            worst_scaled_row=scaled.number,
            scales=self._scales.values,
            digits_held=held,
            max_error=error,
            max_errors=tuple(errors),
            max_phase_error=phase,
            max_amplitude_error=amplitude,
            max_energy_error=energy,
            max_conditioned_error=math.nan if strained is None else strained.conditioned,
            max_conditioned_row=None if strained is None else strained.number,
            times=times,
            notes=(*notes, *([remark] if remark else [])),
            points=tuple(self.resolved(kept[number], held, resolution) for number in sorted(kept)),
        )

    def _most(self, held: float, resolution: Resolution) -> Point | None:
        """The first row with the largest error over what the format must lose; None where one has none."""
        found = [point for point in (self._strained, *self._zeros) if point is not None]
        rows = [self.resolved(point, held, resolution) for point in found]
        if math.isnan(self._maxima[CONDITIONED]) or not rows:
            return None
        return max(rows, key=lambda point: (point.conditioned, -point.number))

    def _least(self, worst: Point, first: Point, held: float, resolution: Resolution) -> tuple[Point, Point]:
        """The rows with the fewest digits and the fewest on the scales; the first where all have all that is held."""
        rows = [self.resolved(point, held, resolution) for point in (worst, *self._zeros) if point is not None]
        least = min(rows, key=lambda point: (point.digits, point.number))
        far = [point for point in self._farthest if point is not None]
        farthest = min(far, key=lambda point: (min(self._scales.digits(point)), point.number))
        start, end = self.resolved(first, held, resolution), self.resolved(farthest, held, resolution)
        return least if least.digits < held else start, end if end.scaled_digits < held else start

    def resolved(self, point: Point, held: float, resolution: Resolution) -> Point:
        """A row with its digits on the scales of the rows so far, and at most the ``held`` that the input can hold."""
        return self._scales.resolved(point, held, resolution)


def _larger(a: float, b: float) -> float:
    """max(a, b), where a NaN wins."""
    return b if b > a or math.isnan(b) else a
