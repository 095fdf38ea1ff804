"""Every method on the descent along a curve without friction, by the fraction of the way: it does not split."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from compare.studies.common import SHORTER_N, distinct, made, positive_end
from compare.study import some
from reference import Descent
from reference.arithmetic.exact import as_number

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.measure.records import Study

__all__ = ["last_tick", "study"]

DEFINITION = "N w'' = -(g y_w + N_w w'^2/2), N = x_w^2 + y_w^2, w(0) = w'(0) = 0, w the fraction of the way"
TICK = Fraction(1, 1024)
SPARE = Fraction(4095, 4096)
"""A march ends at the last multiple of so many seconds before this part of the descent: a neighbour may be quicker."""


def study(
    curve: Sequence[str] = ("quartic", "cycloid"),
    g: Any = 9.81,
    start: Any = None,
    end: Any = None,
    t_end: Any = None,
    n: Sequence[int] = SHORTER_N,
    *,
    traces: bool = False,
    **options: Any,
) -> Study:
    """Score methods on the descent from rest along each curve.

    Args:
        curve: names of the race of the thesis, or formulas: y of x, or "x = ...; y = ..." of p.
        g: acceleration of gravity in m/s^2.
        start: where x or p of a formula begins.
        end: where it ends.
        t_end: end of the march in s, at most the time of the descent; almost that time of each if None.
        n: numbers of steps, each a positive integer.
        traces: whether to keep trajectories for plots.
        options: of ``compare.study.score_all``.

    Raises:
        ValueError: an argument is outside its range, a name unknown, or a curve has no start to march from.
    """
    problems = [Descent(name, g, start, end) for name in some(curve, "curve")]
    distinct(problems, "curve", "curve")
    for problem in problems:
        _ = problem.start  # a cusp has none
    ends = [last_tick(problem) if t_end is None else positive_end(t_end, "t_end") for problem in problems]
    parameters = {
        "curve": [problem.curve.name for problem in problems],
        "g": as_number(problems[0].g),
        "t_end": [as_number(value) for value in ends],
    }
    return made("descent", problems, DEFINITION, parameters, traces=traces, n=n, t_end=ends, **options)


def last_tick(problem: Descent) -> Fraction:
    """Where the march of a descent ends, in s: almost at the end of the curve."""
    return TICK * int(SPARE * Fraction(float(problem.descent_time())) / TICK)
