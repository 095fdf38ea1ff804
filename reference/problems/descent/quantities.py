"""What can be asked of a descent: names, units and definitions."""

from fractions import Fraction

from reference.declaration import Quantity, Row
from reference.row_domains import FRACTION, ONCE, Reals

__all__ = ["ROWS"]

SQUARES = "N = x_w^2 + y_w^2"
TIME = Reals("time", "t", Fraction(0))
"""To the descent time of each motion."""
ROWS = (
    Row(
        "descent_time",
        (Quantity("descent_time", "s", "time of the descent", f"T = int sqrt(N/(2 g drop)) dw, {SQUARES}"),),
        ONCE,
    ),
    Row(
        "arc_length",
        (Quantity("arc_length", "m", "length of the way", f"int sqrt(N) dw, {SQUARES}"),),
        ONCE,
    ),
    Row(
        "state",
        (
            Quantity(
                "place",
                "1",
                "fraction of the way, of the curve's parameter or of the cycloid's arc",
                f"N w'' = -(g y_w + N_w w'^2/2), {SQUARES}, from rest",
            ),
            Quantity("place_rate", "s-1", "rate of the fraction of the way", "w' = dw/dt = sqrt(2 g drop/N)"),
        ),
        TIME,
    ),
    Row(
        "motion",
        (
            Quantity("x", "m", "horizontal coordinate of the body", "x(w(t))"),
            Quantity("y", "m", "height of the body, upwards, as the curve is written", "y(w(t))"),
            Quantity("speed", "m s-1", "speed of the body", "v = sqrt(2 g drop), drop = y(start) - y"),
            Quantity("velocity_x", "m s-1", "horizontal component of the velocity", "dx/dt = x_w w'"),
            Quantity("velocity_y", "m s-1", "vertical component of the velocity, upwards", "dy/dt = y_w w'"),
        ),
        TIME,
    ),
    Row(
        "passage",
        (
            Quantity("passage_time", "s", "time at which the body passes the place", "t = int sqrt(N/(2 g drop)) dw"),
            Quantity("passage_x", "m", "horizontal coordinate of the place", "x(w)"),
            Quantity("passage_y", "m", "height of the place, upwards, as the curve is written", "y(w)"),
            Quantity("passage_speed", "m s-1", "speed of the body at the place", "v = sqrt(2 g drop)"),
            Quantity("passage_velocity_x", "m s-1", "horizontal component of the velocity there", "v x_w/sqrt(N)"),
        ),
        FRACTION,
    ),
)
