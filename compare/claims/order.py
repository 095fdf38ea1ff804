"""The order that an integrator shows: the slope of its error against the step, where that is a slope."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from statistics import median
from typing import TYPE_CHECKING

import numpy as np

from compare.claims.frames import nonzero
from compare.measure.order_fit import longest_run, slope_with_interval

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from compare.claims.engine import Marcher

__all__ = ["Cell", "Order", "ladder", "measured"]

SAMPLES = 4
"""Times of comparison, the same for every number of steps."""
FLOOR_FACTOR = 30
"""An error within so many times the rounding noise is rounding."""
EPSILON = 2.0**-52
"""An error up to this for each step is rounding too, where the errors with all numbers of steps are."""
FLAT, RISING = 0.5, 0.2
"""A slope below the first is no order, unless it is beyond the second and heading for more."""
SMALL = 1e-3
"""Relative error below which errors that stop falling have met a tolerance, not a mistake."""
RECOGNISABLE = 0.1
"""The same for a whole integrator that chooses its own steps, perhaps with a loose tolerance."""
TOLERANCES = (0.02, 0.05, 0.1)
"""How far slopes of one range may lie from their middle: the first of these that gives enough of them."""
ENOUGH = 4
FINEST = 3
"""Slopes at the fine end that tell where the errors are going."""
RESOLUTION, ROUGH = 0.01, 0.2
"""The least half-width of an interval, and of one above a plateau."""
UNSETTLED, TREND = 0.1, 3
"""An interval wider than the first has not settled, and goes on to where so many last slopes are heading that go one
way."""
FURTHER = 2, 4
"""Numbers of steps, over the finest, with which an order that has not settled is pursued."""
CLEAR_OF_NOISE = 1e3
"""As long as errors are so many times the noise."""
FIRST_COUNTS = 5


@dataclass(frozen=True)
class Cell:
    """One number of steps: the largest error over the samples, relative to the size of each component.

    Attributes:
        noise: by how much two marches from starts close by differ in their errors: rounding, or an inner tolerance.
        slope: of the error from the number of steps before, or None.
        used: whether it is in the fit.
    """

    n: int
    h: float
    error: float
    noise: float
    slope: float | None = None
    used: bool = False


@dataclass(frozen=True)
class Order:
    """What the errors show.

    Attributes:
        value: the fitted slope, 0 where the errors do not fall, or None where there is none to see.
        half_width: of its interval.
        kind: "slope"; "floor" where every error is rounding; "flat" where errors do not fall; "few" where there are too
            few; "own steps" where they are small and do not depend on the times that were asked for.
        plateau: the relative error at which a slope ends in a tolerance, or None.
    """

    cells: tuple[Cell, ...]
    value: float | None
    half_width: float
    kind: str
    plateau: float | None = None

    @property
    def interval(self) -> tuple[float, float] | None:
        """The ends of the interval."""
        return None if self.value is None else (self.value - self.half_width, self.value + self.half_width)

    @property
    def words(self) -> str:
        """What was measured."""
        if self.value is None:
            return "error at rounding with every step" if self.kind == "floor" else "no order is to be seen"
        if self.kind == "flat":
            return f"does not converge: the error stays at {self.cells[-1].error:.0e}"
        return f"measured {self.value:.2f} ± {self.half_width:.2f}"


def ladder(most: int) -> tuple[int, ...]:
    """8, 12, 16, ..., 32, 40, ..., 64, 96, 128, 192, ... up to ``most``: multiples of the samples.

    They are close where a method of high order shows its slope, before it meets rounding.
    """
    found = {SAMPLES * part << k for k in range(20) for part in (2, 3)} | {SAMPLES * part for part in (5, 7, 10, 14)}
    return tuple(sorted(n for n in found if n <= most))


def measured(marcher: Marcher, t_end: float, counts: Sequence[int], until: float = math.inf) -> Order:
    """The order on one scene from its start to ``t_end`` in these numbers of steps.

    A whole integrator whose errors are small and do not fall at first is not asked for more: it chooses its own steps.
    Where the slopes have not settled at the finest number of steps, and errors are far from rounding, there are more,
    begun before ``until`` on the clock of time.monotonic.
    """
    if marcher.whole:
        first = _measured(marcher, t_end, counts[:FIRST_COUNTS])
        if first.kind in {"flat", "floor"} and first.cells[-1].error <= RECOGNISABLE and not _falls(first.cells):
            return replace(first, value=None, kind="own steps")
    found = _measured(marcher, t_end, counts)
    for factor in FURTHER:
        if _settled(found) or time.monotonic() > until:
            break
        found = _pursued(marcher, t_end, found, factor * counts[-1])
    return found


def _falls(cells: Sequence[Cell]) -> bool:
    """Whether errors fall from the first to the last, though not at each: those of even and odd numbers may differ."""
    usable = [cell for cell in cells if 0 < cell.error < math.inf]
    x, y = (np.log([getattr(cell, name) for cell in usable]) for name in ("n", "error"))
    return len(usable) > FINEST and slope_with_interval(x, -y)[0] >= 1


def _settled(found: Order) -> bool:
    """Whether more steps would tell no more."""
    last = found.cells[-1]
    clear = last.error < math.inf and last.error > CLEAR_OF_NOISE * last.noise
    return found.kind != "slope" or found.plateau is not None or found.half_width <= UNSETTLED or not clear


def _measured(marcher: Marcher, t_end: float, counts: Sequence[int]) -> Order:
    here, there = _errors([marcher, marcher.near], t_end, counts)
    cells: list[Cell] = []
    for n, error, other in zip(counts, here, there, strict=True):
        with np.errstate(over="ignore", invalid="ignore"):
            size, noise = (float(np.max(np.abs(value))) for value in (error, error - other))
        cells.append(_after(cells, n, t_end / n, size, noise))
    return fitted(cells)


def _after(cells: Sequence[Cell], n: int, h: float, size: float, noise: float) -> Cell:
    slope = None
    if cells and 0 < size < math.inf and 0 < cells[-1].error < math.inf:
        slope = math.log(cells[-1].error / size) / math.log(n / cells[-1].n)
    return Cell(n, h, size, noise, slope)


def _pursued(marcher: Marcher, t_end: float, found: Order, n: int) -> Order:
    """The same with a finer cell, from one start alone: its noise is that of the finest before, grown by the steps."""
    last = found.cells[-1]
    (here,) = _errors([marcher], t_end, [n])
    with np.errstate(over="ignore", invalid="ignore"):
        size = float(np.max(np.abs(here[0])))
    finer = _after(found.cells, n, t_end / n, size, last.noise * n / last.n)
    return fitted([replace(cell, used=False) for cell in (*found.cells, finer)])


def _errors(marchers: Sequence[Marcher], t_end: float, counts: Sequence[int]) -> list[list[np.ndarray]]:
    """Of each marcher the relative errors [samples, state] for each number of steps."""
    h = np.array([t_end / n for n in counts])
    wanted = [[n * (j + 1) // SAMPLES for j in range(SAMPLES)] for n in counts]
    errors: list[list[np.ndarray]] = []
    for marcher, marches in zip(marchers, _marched(marchers, h, wanted), strict=True):
        errors.append([])
        for states, steps, size in zip(marches, wanted, map(Fraction, h.tolist()), strict=True):
            error = marcher.scene.errors([step * size for step in steps], states)
            with np.errstate(over="ignore", invalid="ignore"):  # a march that is lost has no error that is a number
                errors[-1].append(error / nonzero(np.max(np.abs(states - error), axis=0)))
    return errors


def _marched(marchers: Sequence[Marcher], h: np.ndarray, wanted: Sequence[Sequence[int]]) -> Iterator[list[np.ndarray]]:
    """The states of each from its start, all at once where they have one right-hand side."""
    starts = [np.tile(marcher.scene.start[:, None], len(h)) for marcher in marchers]
    if not all(marcher.scene.same_equation(marchers[0].scene) for marcher in marchers):
        yield from (marcher.states(start, h, wanted) for marcher, start in zip(marchers, starts, strict=True))
        return
    count = len(marchers)
    found = marchers[0].states(np.hstack(starts), np.tile(h, count), [*wanted] * count)
    yield from (found[i * len(h) : (i + 1) * len(h)] for i in range(count))


def fitted(cells: Sequence[Cell]) -> Order:
    """The slope where there is one: rounding and what lies beyond it, and a plateau at the fine end, are left out."""
    rounding = all(cell.error <= cell.n * EPSILON for cell in cells)
    usable = [] if rounding else _above_the_floor(cells)
    if len(usable) < 2:
        kind = "floor" if cells[0].error <= SMALL else "flat"
        return Order(tuple(cells), None if kind == "floor" else 0.0, 0.0, kind)
    slopes = [_slope(a, b) for a, b in pairwise(usable)]
    steep = len(slopes)
    while steep and slopes[steep - 1] < FLAT:
        steep -= 1
    plateau = usable[-1].error if steep < len(slopes) else None
    if plateau is not None and (plateau > SMALL or steep < 2):
        return _flat(cells, usable, slopes)
    first, last = _range(slopes[:steep], by_the_end=plateau is None)
    return _line(cells, usable[first:last], slopes[first : last - 1], plateau)


def _above_the_floor(cells: Sequence[Cell]) -> list[Cell]:
    """The cells before the first that is rounding, of finite error below the size of the motion."""
    found: list[Cell] = []
    for cell in cells:
        if cell.error <= FLOOR_FACTOR * cell.noise and cell.error < SMALL:
            break
        if 0 < cell.error < 1:
            found.append(cell)
    return found


def _slope(a: Cell, b: Cell) -> float:
    return math.log(a.error / b.error) / math.log(b.n / a.n)


def _flat(cells: Sequence[Cell], usable: Sequence[Cell], slopes: Sequence[float]) -> Order:
    """Errors that do not fall: the slope over the fine half, never below zero."""
    fine = slopes[len(slopes) // 2 :]
    value, half = max(0.0, median(fine)), max(abs(s - median(fine)) for s in fine)
    for end in _heading(usable, slopes):
        if min(end / FLAT, slopes[-1] / RISING) >= 1:
            return Order(tuple(cells), slopes[-1], max(half, end - slopes[-1]), "slope")
    return Order(tuple(cells), value, half, "flat", usable[-1].error)


def _heading(chosen: Sequence[Cell], slopes: Sequence[float]) -> list[float]:
    """Where the last slopes are heading as h goes to zero, in a line with h, if they go one way: one or none."""
    last = slopes[-TREND:]
    steps = [b - a for a, b in pairwise(last)]
    if len(last) < TREND or not (all(step > 0 for step in steps) or all(step < 0 for step in steps)):
        return []
    places = [math.sqrt(a.h * b.h) for a, b in pairwise(chosen)][-TREND:]
    return [last[-1] + (last[-1] - last[0]) * places[-1] / (places[0] - places[-1])]


def _range(slopes: Sequence[float], *, by_the_end: bool) -> tuple[int, int]:
    """The cells [first, last) of the longest run of slopes that agree, the finer of two.

    Where the errors go on falling to the end, one of the finest slopes must be in it, for a term of low order shows
    there; where no run is long enough, the finest are taken as they are.  Where the errors end in a plateau, the last
    slopes are bent, and the longest run speaks for itself.
    """
    targets = [median(slopes[-FINEST:])] if by_the_end else list(slopes)
    least_end = len(slopes) - FINEST if by_the_end else 0
    for tolerance in TOLERANCES:
        runs = [longest_run(slopes, target, tolerance, least_end) for target in reversed(targets)]
        best = max(runs, key=lambda run: run[1] - run[0])
        if best[1] - best[0] >= ENOUGH:
            return best
    return (max(0, least_end), len(slopes) + 1) if by_the_end else best


def _line(cells: Sequence[Cell], chosen: Sequence[Cell], slopes: Sequence[float], plateau: float | None) -> Order:
    """One slope through the chosen cells; its interval is twice as wide as the local slopes lie, for they drift."""
    if len(chosen) < 2:
        return Order(tuple(cells), None, 0.0, "few", plateau)
    if len(chosen) == 2:
        value, half = slopes[0], 0.5
    else:
        x, y = (np.log(column) for column in zip(*((cell.n, 1 / cell.error) for cell in chosen), strict=True))
        value, half = slope_with_interval(x, y)
    half = max(half, RESOLUTION if plateau is None else ROUGH, *(2 * abs(slope - value) for slope in slopes))
    if half > UNSETTLED:
        half = max(half, *(abs(end - value) for end in _heading(chosen, slopes)), 0.0)
    marked = tuple(replace(cell, used=cell in chosen) for cell in cells)
    return Order(marked, value, half, "slope", plateau)
