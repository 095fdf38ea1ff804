"""The families that the command line knows by name: what it asks for, and what it prints."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from reference.command.at import Family, Input, pair, text
from reference.problems.cycloid import Cycloid, Tautochrone
from reference.problems.descent import RACE, Descent
from reference.problems.pendulum import LinearPendulum, Pendulum
from reference.problems.polar import PolarBrachistochrone
from reference.problems.polar.bodies import BODIES
from reference.problems.tunnel import Tunnel

if TYPE_CHECKING:
    from fractions import Fraction

__all__ = ["FAMILIES"]

GRAVITY = Input("g", "m s-2", "acceleration of gravity", "9.81")
TIME = Input("t", "s", "time", optional=True, over="time")
IN_A_FIELD = (
    "state",
    "curve",
    "by_z",
    "z0",
    "kappa",
    "half_angle",
    "descent_time",
    "arrival_time",
    "chord_time",
    "chord_gap",
    "time_unit",
    "descent_seconds",
    "arrival_seconds",
    "si_state",
    "si_curve",
    "neighbour_gap",
)


def to_end(end: tuple[Fraction, Fraction], g: Fraction) -> Cycloid:
    """The brachistochrone to the end point (x, y), y downward."""
    return Cycloid(*end, g)


def swing(angle: Fraction, radius: Fraction, g: Fraction) -> Tautochrone:
    """The cycloidal pendulum released at an angle."""
    return Tautochrone(angle, radius, g)


def descent(curve: str, g: Fraction, **ends: Any) -> Descent:
    """The descent on a curve of the race, or on a formula's between ``start`` and ``end``."""
    return Descent(curve, g, **ends)


def in_a_field(strength: Input, unit: str) -> tuple[Input, ...]:
    """What a brachistochrone in a central field asks for, its strength and its unit of time given."""
    return (
        Input("z0", "1", "height of the lowest point, or else --end", optional=True),
        Input("end", "", "end point R,PHI: its radius over r0 and its angle in rad", optional=True, read=pair),
        Input("r0", "m", "radius of the release", optional=True),
        strength,
        Input("body", "", f"instead of {strength.name} a body: {' or '.join(BODIES)}", optional=True, read=text),
        Input("tau", "1", f"time in units of {unit}", optional=True, over="tau"),
        Input("psi", "rad", "parameter of the curve, pi at the lowest point", optional=True, over="psi"),
        Input("z", "1", "height on the way down", optional=True, over="z"),
        Input("t", "s", "time, where r0 is given", optional=True, over="time"),
        Input("epsilon", "1", "size of a neighbouring curve's deviation", optional=True, over="epsilon"),
    )


FAMILIES = (
    Family(
        "pendulum",
        "the mathematical pendulum, released from rest or set going",
        Pendulum,
        (
            Input("theta0", "rad", "angle of the start; released from rest, 0 < theta0 < pi"),
            Input("omega0", "rad s-1", "angular velocity of the start; without it, released from rest", optional=True),
            GRAVITY,
            Input("length", "m", "length", "1"),
            Input("t", "s", "time", over="time"),
        ),
        ("state", "period", "energy"),
    ),
    Family(
        "linear",
        "the linearised pendulum",
        LinearPendulum,
        (
            Input("theta0", "rad", "angle of the start"),
            Input("omega0", "rad s-1", "angular velocity of the start", "0"),
            GRAVITY,
            Input("length", "m", "length", "1"),
            Input("t", "s", "time", over="time"),
        ),
        ("state", "period", "energy"),
    ),
    Family(
        "cycloid",
        "the brachistochrone from rest at (0, 0) to an end point, y downward",
        to_end,
        (
            Input("end", "m", "end point X,Y: horizontal distance and depth", read=pair),
            GRAVITY,
            TIME,
            Input("fraction", "1", "fraction of the descent time, from 0 to 1", optional=True, over="fraction"),
            Input("epsilon", "1", "size of a neighbouring curve's deviation", optional=True, over="epsilon"),
        ),
        (
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
    ),
    Family(
        "tautochrone",
        "Huygens' pendulum, a bead on an inverted cycloid, released from rest",
        swing,
        (
            Input("angle", "rad", "angle of the start, from the bottom"),
            Input("radius", "m", "radius of the rolling circle", "1"),
            GRAVITY,
            TIME,
        ),
        ("state", "position", "descent_time", "period", "energy"),
    ),
    Family(
        "descent",
        "descent from rest without friction on a curve, y upward",
        descent,
        (
            Input(
                "curve",
                "",
                f"one of {', '.join(curve.name for curve in RACE)}; or a formula: y of x, or 'x = ...; y = ...' of p",
                read=text,
            ),
            Input("start", "", "where x or p of a formula begins, such as pi", optional=True, read=text),
            Input("end", "", "where x or p of a formula ends, such as 0", optional=True, read=text),
            GRAVITY,
            TIME,
            Input("fraction", "1", "fraction of the way, from 0 to 1", optional=True, over="fraction"),
        ),
        ("descent_time", "arc_length", "motion", "state", "passage"),
    ),
    Family(
        "polar",
        "the brachistochrone in the field of a point mass, z = r/r0, from rest; inside a real body an idealisation",
        PolarBrachistochrone,
        in_a_field(
            Input("gm", "m3 s-2", "gravitational constant times mass, with r0", optional=True),
            "sqrt(r0^3/(2 G M))",
        ),
        IN_A_FIELD,
    ),
    Family(
        "tunnel",
        "the fastest tunnel through a planet of uniform density, z = r/r0, from rest at its surface",
        Tunnel,
        in_a_field(Input("g", "m s-2", "gravity at the surface, with r0", optional=True), "sqrt(r0/g)"),
        IN_A_FIELD,
    ),
)
