"""The race of the thesis: the same descent on seven curves."""

from __future__ import annotations

import numpy as np

from reference.family import Coordinate, Group, Layout
from reference.problems.descent import RACE as CURVES
from reference.problems.descent import Descent

__all__ = ["LAYOUTS", "RACE", "core", "full"]

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
ALL = np.arange(len(CURVE.meanings))


def core() -> tuple[Group, ...]:
    """The grids of the dataset that ships with the package."""
    return (Group(RACE, EARTH, {"curve": ALL, "time": np.arange(101) / 100, "fraction": np.arange(65) / 64}),)


def full() -> tuple[Group, ...]:
    """The same group with finer grids, as far as they are proven within hours on two cores."""
    return (Group(RACE, EARTH, {"curve": ALL, "time": np.arange(4001) / 4000, "fraction": np.arange(4097) / 4096}),)
