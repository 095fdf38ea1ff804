"""Which rows of a long file can matter: these are judged exactly, the others are known not to change the summary.

Bounds in doubles tell them apart (``bounds``).  Every number that is shown is the enclosure's, as if all rows had been
judged so; and every row that is judged is held against its bounds.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from compare.files.scales import SLACK
from compare.files.slips import FIRST_ROWS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from compare.files.chunk import Chunk, Row
    from compare.files.crew import Crew
    from compare.files.judge import Judge
    from compare.files.record import Bar, Running
    from compare.files.scales import Point
    from reference.state_bounds import Bounds, StateBounds

__all__ = ["BoundError", "Sift"]

ROUNDING = 2.0**-53
"""What a decimal loses as a double, relative to it."""
WORTH_BOUNDS = 256
"""Rows of a file from which bounds take less time than they save."""
PART = 1 / 2
"""Of a chunk, from which all its rows are judged together: they share what costs most."""


class BoundError(RuntimeError):
    """The enclosure found what the bounds in doubles exclude: one of both is wrong."""


class Sift:
    """Judges the chunks of a file, as far as they change the summary in ``running``."""

    def __init__(self, judge: Judge, running: Running, crew: Crew) -> None:
        self._judge, self._running, self._crew = judge, running, crew
        self._bounder: StateBounds | None = None

    def points(self, chunk: Chunk) -> Callable[[], list[Point]]:
        """Judge the rows of the next chunk that can matter; the first of a file always do, and all of a short one.

        What is found may have to be waited for, in the order of the chunks.

        Raises:
            ValueError: the times do not increase, or a number is not finite.
            BoundError: a row is not within its bounds.
        """
        bounds = self._bounds(chunk) if self._judge.rows or len(chunk) >= WORTH_BOUNDS else None
        if bounds is None or chunk.doubles is None:
            return self._crew.points(chunk)
        judge, before, count = self._judge, self._judge.rows, len(chunk)
        rows: dict[int, Row] = {}
        points: dict[int, Point] = {}

        def look(places: Iterable[int]) -> None:
            new = sorted(set(places) - set(points))
            rows.update(zip(new, chunk.rows(new), strict=True))
            points.update(zip(new, judge.some(new, [rows[place] for place in new]), strict=True) if new else ())

        conditioned = _conditioned(judge, bounds, chunk.doubles.numbers)
        wanted = (number - before - 1 for number in self._running.wanted(before + 1, before + count))
        look([*wanted, *_extremes(bounds, conditioned), *(range(FIRST_ROWS) if not before else ())])
        doubtful = self._doubtful(bounds, conditioned, self._running.bar(points.values()), chunk)
        if len(doubtful) > PART * count:
            return self._crew.points(chunk)
        look(doubtful)
        for place, point in points.items():
            _hold(point, bounds, conditioned[place], place)
        judge.pass_over(count, rows[count - 1].t)
        return lambda: self._counted(points, bounds)

    def _counted(self, points: Mapping[int, Point], bounds: Bounds) -> list[Point]:
        errors = bounds.about.copy()
        for place, point in points.items():
            errors[place] = point.errors
        self._judge.turns.add(errors)
        return [points[place] for place in sorted(points)]

    def _bounds(self, chunk: Chunk) -> Bounds | None:
        """The bounds of a chunk, where there are any, and its times increase even as doubles."""
        if chunk.doubles is None:
            return None
        if self._bounder is None:
            self._bounder = self._judge.problem.state_bounds()
        if self._bounder is None:
            return None
        if not chunk.increases_from(self._judge.last):
            return None
        self._judge.expect(chunk.doubles.digits, chunk.doubles.last)
        return self._bounder.bounds(chunk.doubles.numbers, ROUNDING)

    def _doubtful(self, bounds: Bounds, conditioned: np.ndarray, bar: Bar, chunk: Chunk) -> list[int]:
        """The places of the rows that may pass the bar."""
        phase, amplitude, energy, lost = bounds.found
        may = np.zeros(len(chunk), dtype=bool)
        measures = (bounds.errors.max(axis=1), phase, amplitude, energy, conditioned, *bounds.errors.T)
        for measure, most in zip(measures, bar.maxima, strict=True):
            if not math.isnan(most):  # a maximum that is not a number stays
                may |= ~(measure <= most)
        numbers = np.arange(len(chunk)) + self._judge.rows + 1
        may |= ~(bounds.truths <= np.array(bar.truths)).all(axis=1)  # a scale may change
        may |= lost & (numbers < bar.first_lost)  # the first of them is named
        may |= self._judge.turns.unsure(bounds.about, bounds.errors - np.abs(bounds.about))
        fewest, first = bar.worst
        few = bounds.digits.min(axis=1)
        fewer = ~((few > fewest) | ((few == fewest) & (numbers >= first)))
        unsure = [
            place for place in np.flatnonzero(fewer & ~may).tolist() if not self._has(chunk, bounds, place, fewest)
        ]
        return sorted({*np.flatnonzero(may).tolist(), *unsure})

    @staticmethod
    def _has(chunk: Chunk, bounds: Bounds, place: int, digits: float) -> bool:
        """Whether a row has more correct digits than these, because decimals are right to their last."""
        (row,) = chunk.rows([place])
        for given, error, least in zip(row.state, bounds.errors[place], bounds.digits[place], strict=True):
            right = given.last is not None and error < 0.49 * 10.0 ** max(given.last, -300)
            if max(least, given.digits if right else 0.0) <= digits:
                return False
        return True


def _conditioned(judge: Judge, bounds: Bounds, numbers: np.ndarray) -> np.ndarray:
    """At least the errors over what the format must lose of rows of these numbers; NaN where nothing is known of it."""
    if judge.condition is None:
        return np.full(len(numbers), np.nan)
    with np.errstate(all="ignore"):
        within = bounds.errors - np.abs(bounds.about)
        least = np.maximum(np.abs(numbers[:, 1:] - bounds.about) - within, 0.0)
        losses = judge.resolution.losses(least, judge.condition.led(numbers[:, 0])) * (1 - SLACK)
        found: np.ndarray = (bounds.errors / losses).max(axis=1)
    return found


def _extremes(bounds: Bounds, conditioned: np.ndarray) -> set[int]:
    """The places at which a bound is largest: the rows behind them settle most of the others."""
    measures = (bounds.errors.max(axis=1), *bounds.found[:3], -bounds.digits.min(axis=1), conditioned)
    return {int(np.argmax(measure)) for measure in (*measures, *bounds.truths.T)}


def _hold(point: Point, bounds: Bounds, conditioned: float, place: int) -> None:
    """Hold an exact row against its bounds.

    Raises:
        BoundError: it is not within them.
    """
    phase, amplitude, energy, lost = (bound[place] for bound in bounds.found)
    pairs = [
        *zip(map(abs, point.errors), bounds.errors[place], strict=True),
        *zip((10.0**truth * (1 - SLACK) for truth in point.truths), bounds.truths[place], strict=True),
        (abs(point.phase_error), phase),
        (abs(point.amplitude_error), amplitude),
        (abs(point.energy_error), energy),
        (point.conditioned, conditioned),
        (bounds.digits[place].min(), point.digits),
    ]
    if any(found > bound for found, bound in pairs) or (math.isnan(point.phase_error) and not lost):
        raise BoundError(f"row {point.number}, t = {point.t}, was found outside its bounds; please report this.")
