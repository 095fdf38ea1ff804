"""How an error grows with time: bounded, as a root of t, as t, ..., read off the samples of a long march.

Time is cut into windows, each twice as long as the one before it, and the root mean square of the error is taken in
each: the slope of its logarithm against that of time is the exponent.  The first windows may not know yet how it will
go on, so that the longest run of last windows is taken whose slope has the least interval.

For the laws of rounding see D. Brouwer, Astron. J. 46 (1937), 149: where roundings are random, the energy of a
symplectic method walks as sqrt(t), and the phase, which sums it up, as t^(3/2).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from compare.aspects import conserves, period_of
from compare.fit import slope_with_interval
from compare.records import Growth

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from compare.run import Run

__all__ = ["GROWTH_SAMPLES", "LAWS", "growth_of", "growths"]

GROWTH_SAMPLES = 1024
LEAST_SAMPLES, LEAST_WINDOWS, LEAST_PERIODS = 8, 4, 2
"""A window has so many samples and periods, and a law so many windows."""
LAWS = {0.0: "bounded", 0.5: "sqrt t", 1.0: "t", 1.5: "t^3/2", 2.0: "t^2"}
SURE, NEAR = 0.25, 0.1
"""An exponent is of a law if its interval is less than half the way to the next law, and it is as near as this."""


def growths(runs: Sequence[Run]) -> list[Growth]:
    """For each run the growth of its place's error, and where there are such, of its phase's and of its drift."""
    return [found for run in runs for found in _of(run)]


def _of(run: Run) -> Iterator[Growth]:
    quantities = {"place": run.place}
    if run.orbital_known:
        quantities["phase"] = run.orbital[:, 0]
    if conserves(run.course.problem):
        quantities["energy"] = run.drift
    times = np.array([float(time) for time in run.course.times])
    period = period_of(run.course.problem)
    for name, errors in quantities.items():
        exponent, interval, windows = growth_of(times, errors, LEAST_PERIODS * period if math.isfinite(period) else 0.0)
        yield Growth(
            method=run.method.name,
            n=run.course.n,
            h=float(run.course.h),
            case=run.course.case,
            quantity=name,
            exponent=exponent,
            interval=interval,
            law=_law(exponent, interval),
            windows=windows,
            floor=run.cell.floor,
        )


def growth_of(times: np.ndarray, errors: np.ndarray, shortest: float) -> tuple[float, float, int]:
    """The exponent of t, the half-width of its 95 % interval, and how many windows, none shorter than ``shortest``.

    NaN where there are fewer than LEAST_WINDOWS windows, or an error is not a number, or all are zero.
    """
    points = list(_windows(times, errors, shortest))
    if len(points) < LEAST_WINDOWS or not np.all(np.isfinite(points)):
        return math.nan, math.nan, 0
    x, y = np.array(points[::-1]).T
    fits = [(*slope_with_interval(x[i:], y[i:]), len(x) - i) for i in range(len(x) - LEAST_WINDOWS + 1)]
    return min(fits, key=lambda fit: fit[1])


def _windows(times: np.ndarray, errors: np.ndarray, shortest: float) -> Iterator[tuple[float, float]]:
    """(log of time, log of the root mean square) of each window, the last first."""
    end = float(times[-1])
    while True:
        inside = (times > end / 2) & (times <= end)
        if end / 2 < shortest or np.count_nonzero(inside) < LEAST_SAMPLES:
            return
        size = float(np.max(np.abs(errors[inside])))
        yield math.log(end), (math.log(size) + _log_mean_square(errors[inside] / size) / 2 if size > 0 else -math.inf)
        end /= 2


def _log_mean_square(errors: np.ndarray) -> float:
    return math.log(float(np.mean(errors**2)))


def _law(exponent: float, interval: float) -> str:
    """The law of an exponent, or "" where it is not clear."""
    if not interval < SURE:
        return ""
    nearest = min(LAWS, key=lambda law: abs(law - exponent))
    return LAWS[nearest] if abs(nearest - exponent) <= max(interval, NEAR) else ""
