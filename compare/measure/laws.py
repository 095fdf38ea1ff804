"""The exponent of an error that grows as a power of time, read off its samples.

Time is cut into windows, each twice as long as the one before it, and the mean square of the error is taken in each:
half the slope of its logarithm against that of time is the exponent.  The first windows may not know yet how it will go
on, so that the longest run of last windows is taken whose slope has the least interval.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from compare.measure.order_fit import slope_with_interval, student_95

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["LAWS", "Exponent", "enough", "exponent_of"]

LEAST_SAMPLES, LEAST_WINDOWS = 8, 4
"""A window has so many samples at least, and an exponent so many windows."""
LAWS = {0.0: "bounded", 0.5: "sqrt t", 1.0: "t", 1.5: "t^3/2", 2.0: "t^2"}
SURE, NEAR = 0.25, 0.1
"""An exponent is of a law if its interval is less than half the way to the next law, and it is as near as this."""


class Exponent(NamedTuple):
    """The exponent of t, the half-width of its 95 % interval, how many windows it was read off, and rounding's part.

    NaN, of no windows, where there are too few, or an error is not a number, or all are zero.
    """

    value: float
    interval: float
    windows: int
    rounding: float

    @property
    def law(self) -> str:
        """The law of the exponent, or "" where it is not clear."""
        if not self.interval < SURE:
            return ""
        nearest = min(LAWS, key=lambda law: abs(law - self.value))
        return LAWS[nearest] if abs(nearest - self.value) <= max(self.interval, NEAR) else ""


NONE = Exponent(math.nan, math.nan, 0, 0.0)


def enough(times: np.ndarray, shortest: float) -> bool:
    """Whether there are enough windows, none of them shorter than ``shortest``."""
    return len(list(_windows(times, shortest))) >= LEAST_WINDOWS


def exponent_of(times: np.ndarray, errors: np.ndarray, shortest: float, rounding: float = 0.0) -> Exponent:
    """The exponent of errors [samples], or of their mean over marches [marches, samples].

    ``rounding`` bounds rounding's part of the last error; of the others it is less by the root of time at least.

    Of several marches the interval covers besides what one of them more or less would change (the jackknife).
    """
    errors = np.atleast_2d(errors)
    largest = float(np.max(np.abs(errors)))
    if not enough(times, shortest) or not 0 < largest < math.inf:
        return NONE
    windows = list(_windows(times, shortest))[::-1]
    squares = np.array([np.mean((errors[:, inside] / largest) ** 2, axis=1) for _, inside in windows])
    ends = np.log([end for end, _ in windows])
    with np.errstate(divide="ignore"):
        sizes = np.log(np.mean(squares, axis=1)) / 2
    if not np.all(np.isfinite(sizes)):
        return NONE
    value, interval, first = min(
        ((*slope_with_interval(ends[i:], sizes[i:]), i) for i in range(len(ends) - LEAST_WINDOWS + 1)),
        key=lambda fit: fit[1],
    )
    ends, squares, sizes = ends[first:], squares[first:], sizes[first:]
    parts = rounding / largest * np.exp((ends - ends[-1]) / 2 - sizes)
    centred = ends - ends.mean()
    doubt = float(np.abs(centred) @ parts / (centred @ centred))
    return Exponent(value, max(interval, _jackknife(ends, squares)), len(ends), doubt)


def _windows(times: np.ndarray, shortest: float) -> Iterator[tuple[float, np.ndarray]]:
    """The end of each window and what lies inside, the last first."""
    end = float(times[-1])
    while True:
        inside = (times > end / 2) & (times <= end)
        if end / 2 < shortest or np.count_nonzero(inside) < LEAST_SAMPLES:
            return
        yield end, inside
        end /= 2


def _jackknife(ends: np.ndarray, squares: np.ndarray) -> float:
    """The half-width of the 95 % interval of the exponent from leaving out each march in turn; 0 of one alone."""
    marches = squares.shape[1]
    if marches == 1:
        return 0.0
    rest = (np.sum(squares, axis=1, keepdims=True) - squares) / (marches - 1)
    found = np.array([slope_with_interval(ends, np.log(one) / 2)[0] for one in rest.T])
    return student_95(marches - 1) * math.sqrt((marches - 1) * float(np.var(found)))
