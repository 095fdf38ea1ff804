"""The race of the thesis: the same descent on seven curves."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from reference.family import Comparison, End, Family, Input, Marched, Reported, positive_end
from reference.layout import Coordinate, Group, Layout, parts
from reference.problems.descent.curves import RACE as CURVES
from reference.problems.descent.problem import Descent

__all__ = ["FAMILY", "LAYOUTS", "RACE", "core", "full", "last_tick"]

CURVE = Coordinate(
    "curve", "1", "curve of the race", "flag_meanings in order", meanings=tuple(curve.name for curve in CURVES)
)
TIME = Coordinate("time", "s", "time since the release, before the first arrival")
FRACTION = Coordinate("fraction", "1", "fraction of the way: of the horizontal, of the ellipse's or the cycloid's arc")
GRAVITY = Coordinate("g", "m s-2", "acceleration of gravity")
STORED = ("motion", "descent_time", "arc_length", "passage")


def racer(curve: int, g: float) -> Descent:
    """The descent on the race's curve of this number."""
    return Descent(CURVE.meanings[curve], g)


RACE = Layout(
    "/descent/race",
    "descent from rest without friction on seven curves from (pi, 2) to (0, 0)",
    (CURVE,),
    {"time": TIME, "fraction": FRACTION},
    (GRAVITY,),
    tuple(row for row in Descent.rows if row.name in STORED),
    racer,
    "C. Huygens, Horologium Oscillatorium, 1673, for the cycloid; the others are integrals",
    "ds/dt = sqrt(2 g drop) from rest, drop = 2 - y: line y = 2 s, parabola 2 s^2, cubic 2 s^3, quartic 2 s^4 "
    "with s = x/pi, circular arc and quarter ellipse level at (0, 0), cycloid from its cusp",
    "average; the ellipse and the cycloid start vertically, where an equation dy/dx is singular",
)
LAYOUTS = (RACE,)

EARTH = {"g": 9.81}
ALL = range(len(CURVE.meanings))


def core() -> tuple[Group, ...]:
    """The grids of the dataset that ships with the package."""
    return (Group(RACE, EARTH, {"curve": ALL, "time": parts(range(101), 100), "fraction": parts(range(65), 64)}),)


def full() -> tuple[Group, ...]:
    """The same group with finer grids, as far as they are proven within hours on two cores."""
    return (Group(RACE, EARTH, {"curve": ALL, "time": parts(range(4001), 4000), "fraction": parts(range(4097), 4096)}),)


TICK = Fraction(1, 1024)
SPARE = Fraction(4095, 4096)
"""A march ends at the last multiple of so many seconds before this part of the descent: a neighbour may be quicker."""


def last_tick(problem: Descent, end: Any, name: str) -> Fraction:
    """Where the march of a descent ends, in s: almost at the end of the curve if it is not said.

    Raises:
        ValueError: the end is not positive, or the curve has no start to march from.
    """
    _ = problem.start  # a cusp has none
    if end is not None:
        return positive_end(problem, end, name)
    return TICK * int(SPARE * Fraction(float(problem.descent_time())) / TICK)


T_END = End("t_end", "end of the march in s (default: almost the end of the curve)", None, last_tick)

FAMILY = Family(
    name="descent",
    help="descent from rest without friction on a curve, y upward",
    problem=Descent,
    inputs=(
        Input(
            "curve",
            "",
            f"one of {', '.join(curve.name for curve in CURVES)}; or a formula: y of x, or 'x = ...; y = ...' of p",
            kind="text",
        ),
        Input("start", "", "where x or p of a formula begins, such as pi", optional=True, kind="text"),
        Input("end", "", "where x or p of a formula ends, such as 0", optional=True, kind="text"),
        Input("g", "m s-2", "acceleration of gravity", "9.81"),
        Input("t", "s", "time", optional=True, over="time"),
        Input("fraction", "1", "fraction of the way, from 0 to 1", optional=True, over="fraction"),
    ),
    rows=("descent_time", "arc_length", "motion", "state", "passage"),
    comparison=Comparison(
        "descent",
        "score them on the descent along a curve without friction",
        varied="curve",
        values=("quartic", "cycloid"),
        what="curve",
        inputs=("start", "end", "g"),
        forms=(("", Marched(T_END)),),
    ),
    reported=(Reported("descent", "curve", "", "", ("quartic", "cycloid"), Descent, T_END),),
    layouts=LAYOUTS,
    core=core,
    full=full,
)
