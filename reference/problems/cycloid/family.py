"""The groups of the cycloid: brachistochrones to end points, and tautochrone swings."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.arithmetic.exact import as_number, exact
from reference.family import Comparison, End, Family, Input, Marched, Reported
from reference.layout import Coordinate, Group, Layout, parts
from reference.problems.cycloid.arc import CycloidCurve
from reference.problems.cycloid.problem import Cycloid
from reference.problems.cycloid.tautochrone import CycloidalPendulum, Tautochrone

if TYPE_CHECKING:
    from reference.declaration import Row
    from reference.problem import Problem

__all__ = [
    "BRACHISTOCHRONE",
    "FAMILY",
    "LAYOUTS",
    "TAUTOCHRONE",
    "TAUTOCHRONE_FAMILY",
    "core",
    "depth_of",
    "full",
]

GRAVITY = Coordinate("g", "m s-2", "acceleration of gravity")
END_X = Coordinate("end_x", "m", "horizontal distance to the end point")
END_Y = Coordinate("end_y", "m", "depth of the end point below the start")
FRACTION = Coordinate("fraction", "1", "fraction of the descent time, and of the angle that the circle turns")
EPSILON = Coordinate("epsilon", "1", "size of the neighbouring curve's deviation")
START_ANGLE = Coordinate("start_angle", "rad", "angle of the start, from the bottom")
TIME = Coordinate("time", "s", "time since the release")
RADIUS = Coordinate("radius", "m", "radius of the rolling circle")


def rows(problem: type[Problem], *names: str) -> tuple[Row, ...]:
    """The problem's rows of these names, in this order."""
    found = {row.name: row for row in problem.rows}
    return tuple(found[name] for name in names)


def swing(start_angle: float, radius: float, g: float) -> Tautochrone:
    """The pendulum on the cycloid, released from rest."""
    return Tautochrone(start_angle, radius, g)


BRACHISTOCHRONE = Layout(
    "/cycloid/brachistochrone",
    "curve of quickest descent from rest to an end point",
    (END_X, END_Y),
    {"fraction": FRACTION, "epsilon": EPSILON},
    (GRAVITY,),
    rows(
        Cycloid,
        "curve",
        "radius",
        "end_angle",
        "descent_time",
        "arc_length",
        "chord_time",
        "chord_gap",
        "neighbour_gap",
    ),
    Cycloid,
    "Johann Bernoulli, Acta Eruditorum, May 1697, 206; C. Huygens, Horologium Oscillatorium, 1673",
    "the least time of a bead that slides from rest at (0, 0) to (end_x, end_y), y downward, ds/dt = sqrt(2 g y)",
    "average for end points of like coordinates; higher where one is a billionth of the other; as an equation dx/dy "
    "singular at the start and at the lowest point",
)
TAUTOCHRONE = Layout(
    "/cycloid/tautochrone",
    "Huygens' pendulum: a bead swinging on an inverted cycloid",
    (START_ANGLE,),
    {"time": TIME},
    (RADIUS, GRAVITY),
    rows(Tautochrone, "state", "position", "descent_time", "period", "energy"),
    swing,
    "C. Huygens, Horologium Oscillatorium, 1673, part II, proposition 25",
    "(1 + cos(theta)) theta'' - sin(theta) theta'^2/2 + (g/(2 R)) sin(theta) = 0, at rest at start_angle",
    "lower in the arc length, whose motion is harmonic; higher in the angle, whose equation is singular at pi",
)
LAYOUTS = (BRACHISTOCHRONE, TAUTOCHRONE)

EARTH = {"g": 9.81}
RATIOS = (1e-9, 1e-6, 1e-3, 0.1, 0.5, 1.0, math.pi / 2, 2.0, 5.0, 10.0, 1e3, 1e6, 1e9)
ANGLES = (0.001, 0.1, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.13, math.pi - 1e-6)


def core() -> tuple[Group, ...]:
    """The grids of the dataset that ships with the package."""
    epsilon = parts([-4, 1, 4], 8)
    return (
        Group(
            BRACHISTOCHRONE,
            EARTH,
            {"end_x": RATIOS, "end_y": [1.0] * len(RATIOS), "fraction": parts(range(65), 64), "epsilon": epsilon},
        ),
        Group(TAUTOCHRONE, {"radius": 1.0, **EARTH}, {"start_angle": ANGLES, "time": parts(range(401), 100)}),
    )


def full() -> tuple[Group, ...]:
    """The same groups with finer and larger grids, as far as they are proven within hours on two cores."""
    ratios = sorted({*RATIOS, *parts(range(1, 129), 16)})
    angles = sorted({*ANGLES, *parts(range(1, 101), 32)})
    epsilon = [k / 16 for k in range(-8, 9) if k]
    return (
        Group(
            BRACHISTOCHRONE,
            EARTH,
            {"end_x": ratios, "end_y": [1.0] * len(ratios), "fraction": parts(range(1025), 1024), "epsilon": epsilon},
        ),
        Group(TAUTOCHRONE, {"radius": 1.0, **EARTH}, {"start_angle": angles, "time": parts(range(4001), 1000)}),
    )


NEAR_THE_BOTTOM = 0.99995
"""Part of the depth of the cycloid at which a march along the curve ends.

J. Šalinović, Problem brahistokrone u nehomogenom gravitacijskom polju, University of Split 2022: its figure 7
integrates dx/dy to almost the lowest point, where dx/dy is infinite.
"""


def depth_of(curve: CycloidCurve, depth: Any, name: str) -> Fraction:
    """Where the march of a curve ends: NEAR_THE_BOTTOM of its depth if it is not said.

    Raises:
        ValueError: it does not go down to there.
    """
    if depth is None:
        return Fraction(float(2 * curve.radius) * NEAR_THE_BOTTOM)
    if not 0 < (end := exact(depth, name)) <= 2 * curve.radius:
        lowest = as_number(2 * curve.radius)
        raise ValueError(
            f"{name} is {as_number(end)}; a positive depth up to that of the cycloid, {lowest}, is accepted."
        )
    return end


DEPTH = End("depth", "end of the curve's march in m (default 0.99995 of the way to the bottom)", None, depth_of)


def to_end(end: tuple[Any, Any], g: Any = 9.81) -> Cycloid:
    """The brachistochrone to the end point (x, y), y downward."""
    return Cycloid(*end, g)


def by_arc(swing: Tautochrone) -> CycloidalPendulum:
    """The same bead by its arc, which starts at 4 R sin(angle/2) rounded to a double."""
    return CycloidalPendulum(4 * float(swing.radius) * math.sin(float(swing.angle) / 2), swing.radius, swing.g)


GRAVITY_INPUT = Input("g", "m s-2", "acceleration of gravity", "9.81")
TIME_INPUT = Input("t", "s", "time", optional=True, over="time")

FAMILY = Family(
    name="cycloid",
    help="the brachistochrone from rest at (0, 0) to an end point, y downward",
    problem=to_end,
    inputs=(
        Input("end", "m", "end point X,Y: horizontal distance and depth", kind="pair"),
        GRAVITY_INPUT,
        TIME_INPUT,
        Input("fraction", "1", "fraction of the descent time, from 0 to 1", optional=True, over="fraction"),
        Input("epsilon", "1", "size of a neighbouring curve's deviation", optional=True, over="epsilon"),
    ),
    rows=(
        "radius",
        "end_angle",
        "descent_time",
        "arc_length",
        "chord_time",
        "chord_gap",
        "curve",
        "state",
        "position",
        "neighbour_gap",
    ),
    comparison=Comparison(
        "brachistochrone",
        "score them on the cycloid of quickest descent: as a motion, and as a curve dx/dy",
        varied="end",
        values=((math.pi, 2.0),),
        what="point",
        inputs=("g",),
        forms=(
            ("motion", Marched()),
            ("curve", Marched(DEPTH, lambda bead: CycloidCurve(float(bead.radius())))),
        ),
    ),
    reported=(
        Reported("cycloid", "arc", "m", "m", (1.0,), CycloidalPendulum),
        Reported("cycloid-curve", "radius", "m", "m", (1.0,), CycloidCurve, DEPTH),
    ),
    layouts=LAYOUTS,
    core=core,
    full=full,
)
TAUTOCHRONE_FAMILY = Family(
    name="tautochrone",
    help="Huygens' pendulum, a bead on an inverted cycloid, released from rest",
    problem=Tautochrone,
    inputs=(
        Input("angle", "rad", "angle of the start, from the bottom"),
        Input("radius", "m", "radius of the rolling circle", "1"),
        GRAVITY_INPUT,
        TIME_INPUT,
    ),
    rows=("state", "position", "descent_time", "period", "energy"),
    comparison=Comparison(
        "tautochrone",
        "score them on Huygens' pendulum: by its angle, and by its arc length",
        varied="angle",
        values=(1.0,),
        what="angle",
        inputs=("radius", "g"),
        forms=(("angle", Marched()), ("arc", Marched(problem=by_arc))),
    ),
    reported=(Reported("tautochrone", "angle", "rad", "rad", (1.0,), Tautochrone),),
)
