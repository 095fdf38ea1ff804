"""What can be asked of the cycloid's problems: names, units and definitions."""

from __future__ import annotations

from fractions import Fraction

from reference.arithmetic.exact import as_number
from reference.declaration import Quantity, Row
from reference.row_domains import ANGLE, FRACTION, ONCE, TIME, Reals

__all__ = ["CURVE_ROWS", "DESCENT_ROWS", "HEIGHT", "PENDULUM_ROWS", "SWING_ROWS", "exponent", "positive_number"]

INTEGRAL_BITS = 1 << 12
"""An integral to this precision takes some seconds, and each doubling six times as long."""
THETA = "theta = fraction end_angle"
ARC_FRACTION = Reals("arc_fraction", "arc_fraction", Fraction(0), Fraction(1))
EPSILON = Reals("epsilon", "epsilon", Fraction(-1, 2), Fraction(1, 2))
HEIGHT = Reals("height", "height", Fraction(0))
"""To the lowest point, 2 R, of each curve."""


def once(name: str, units: str, long_name: str, definition: str) -> Row:
    """A row of one quantity of the same name, the same for the whole motion."""
    return Row(name, (Quantity(name, units, long_name, definition),), ONCE)


DESCENT_ROWS = (
    Row(
        "state",
        (
            Quantity("arc", "m", "arc length from the start", "s = 4 R (1 - cos(theta/2)), theta = sqrt(g/R) t"),
            Quantity("arc_rate", "m s-1", "rate of the arc length", "ds/dt = 2 sqrt(g R) sin(theta/2)"),
        ),
        TIME,
    ),
    Row(
        "position",
        (
            Quantity("x_by_time", "m", "horizontal distance from the start", "x = R (theta - sin(theta)) at s(t)"),
            Quantity("y_by_time", "m", "depth below the start", "y = R (1 - cos(theta)) at s(t)"),
        ),
        TIME,
    ),
    Row(
        "curve",
        (
            Quantity("x", "m", "horizontal distance from the start", f"x = R (theta - sin(theta)), {THETA}"),
            Quantity("y", "m", "depth below the start", f"y = R (1 - cos(theta)), {THETA}"),
        ),
        FRACTION,
    ),
    Row(
        "arc",
        (
            Quantity("x_by_arc", "m", "horizontal distance from the start", "x where s = arc_fraction arc_length"),
            Quantity("y_by_arc", "m", "depth below the start", "y where s = arc_fraction arc_length"),
        ),
        ARC_FRACTION,
    ),
    once("radius", "m", "radius of the rolling circle", "R = end_y/(1 - cos(end_angle))"),
    once(
        "end_angle",
        "rad",
        "angle that the circle has turned at the end point",
        "(theta - sin(theta))/(1 - cos(theta)) = end_x/end_y, 0 < theta < 2 pi",
    ),
    once("descent_time", "s", "time of the descent, the shortest on any curve", "T = end_angle sqrt(R/g)"),
    once("arc_length", "m", "arc length from start to end point", "s = 4 R (1 - cos(end_angle/2))"),
    once("chord_time", "s", "time of the descent on the straight chord", "sqrt(2 (end_x^2 + end_y^2)/(g end_y))"),
    once("chord_gap", "s", "time lost on the straight chord", "chord_time - descent_time"),
    Row(
        "neighbour_gap",
        (
            Quantity(
                "neighbour_gap",
                "s",
                "time lost on a neighbouring curve through the same end points",
                "time with y replaced by y (1 + epsilon sin(pi theta/end_angle)) at the same x, less descent_time",
            ),
        ),
        EPSILON,
        max_bits=INTEGRAL_BITS,
    ),
)
"""Of the brachistochrone to an end point."""

CURVE_ROWS = (
    Row(
        "state",
        (
            Quantity("x", "m", "horizontal distance from the cusp", "x = R acos(1 - y/R) - sqrt(y (2 R - y))"),
            Quantity("y", "m", "depth below the cusp", "y"),
        ),
        HEIGHT,
    ),
    Row(
        "curve",
        (
            Quantity("x_by_angle", "m", "horizontal distance from the cusp", "x = R (theta - sin(theta))"),
            Quantity("y_by_angle", "m", "depth below the cusp", "y = R (1 - cos(theta))"),
        ),
        ANGLE,
    ),
)
"""Of the curve itself."""

_TIMES = (
    once("descent_time", "s", "time from the start to the bottom", "pi sqrt(R/g), from every start"),
    once("period", "s", "period", "4 pi sqrt(R/g), for every amplitude"),
)
_ARC = (
    Quantity("arc", "m", "arc length from the bottom", "s = 4 R sin(angle/2) = s(0) cos(sqrt(g/(4 R)) t)"),
    Quantity("arc_rate", "m s-1", "rate of the arc length", "ds/dt"),
)
_ENERGY = once("energy", "m2 s-2", "energy per mass above rest", "E = (ds/dt)^2/2 + g s^2/(8 R)")

SWING_ROWS = (
    Row(
        "state",
        (
            Quantity("angle", "rad", "angle from the bottom", "theta = 2 asin(sin(theta(0)/2) cos(sqrt(g/(4 R)) t))"),
            Quantity("angular_velocity", "rad s-1", "angular velocity", "dtheta/dt"),
        ),
        TIME,
    ),
    Row(
        "position",
        (
            Quantity("x", "m", "horizontal distance from the bottom", "x = R (theta + sin(theta))"),
            Quantity("y", "m", "height above the bottom", "y = R (1 - cos(theta))"),
        ),
        TIME,
    ),
    Row("arc", _ARC, TIME),
    *_TIMES,
    _ENERGY,
)
"""Of the tautochrone by its angle."""

PENDULUM_ROWS = (Row("state", _ARC, TIME), *_TIMES, _ENERGY)
"""Of the same pendulum by its arc length."""


def positive_number(name: str, value: Fraction) -> None:
    """Refuse a length or an acceleration that is not positive.

    Raises:
        ValueError: it is zero or negative.
    """
    if value <= 0:
        raise ValueError(f"{name} is {as_number(value)}; a positive number is accepted.")


def exponent(value: Fraction) -> int:
    """log2 of a positive number, within 1."""
    return value.numerator.bit_length() - value.denominator.bit_length()
