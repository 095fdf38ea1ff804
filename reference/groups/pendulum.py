"""The pendulum's groups."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from reference.plan import Coordinate, Group, Layout
from reference.problems.pendulum import Pendulum
from reference.problems.pendulum.quantities import SERVED

if TYPE_CHECKING:
    from reference.problem import Row

__all__ = ["DIMENSIONLESS", "EARTH", "LAYOUTS", "LIBRATION", "LONG", "UNIT", "core", "full"]

AMPLITUDE = Coordinate("amplitude", "rad", "amplitude theta0, the angle at which the pendulum is released")
TIME = Coordinate("time", "s", "time since the release")
EVENT = Coordinate("event", "1", "number of the event", "0, 1, 2, ...", whole=True)
GRAVITY = Coordinate("g", "m s-2", "acceleration of gravity")
LENGTH = Coordinate("length", "m", "length of the pendulum")
ELLIPTIC = "P. F. Byrd and M. D. Friedman, Handbook of Elliptic Integrals, Springer 1971; DLMF chapter 22"
RELEASED = "theta'' = -(g/l) sin(theta), theta(0) = amplitude, theta'(0) = 0"


def released(amplitude: float, g: float, length: float) -> Pendulum:
    """The pendulum released from rest at ``amplitude`` (rad), g in m/s^2, length in m."""
    return Pendulum(theta0=amplitude, g=g, length=length)


def rows(*names: str) -> tuple[Row, ...]:
    """The pendulum's rows of these names."""
    return tuple(row for row in Pendulum.rows if row.name in names)


def from_rest(path: str, long_name: str, stored: tuple[Row, ...], difficulty: str) -> Layout:
    """A group of pendulums released from rest, one for each amplitude."""
    along: dict[str, Coordinate] = {"time": TIME, "index": EVENT}
    used: set[str] = {row.over for row in stored}
    over = {name: coordinate for name, coordinate in along.items() if name in used}
    return Layout(
        path, long_name, (AMPLITUDE,), over, (GRAVITY, LENGTH), stored, released, ELLIPTIC, RELEASED, difficulty
    )


LIBRATION = from_rest(
    "/pendulum/libration",
    "pendulum released from rest",
    rows(*(name for name in SERVED["release"] if name != "gradient")),
    "lower for small amplitudes; higher near pi, where an error of the start grows a thousandfold in each period",
)
DIMENSIONLESS = from_rest(
    "/pendulum/dimensionless",
    "pendulum with omega0 = 1 and inputs of few bits, exact in narrow formats",
    rows("state", "period"),
    "lower: smooth, no units, and no rounding of the inputs in any binary format",
)
LONG = from_rest(
    "/pendulum/long",
    "pendulum at times 2^j s",
    rows("state"),
    "higher: the error of the phase grows with the time, over up to 5e8 periods",
)
LAYOUTS = (LIBRATION, DIMENSIONLESS, LONG)

EARTH = {"g": 9.81, "length": 1.0}
UNIT = {"g": 1.0, "length": 1.0}
NEAR_PI = (3.1, 3.14, math.pi - 1e-6, math.pi - 1e-9)
LIBRATION_AMPLITUDES = (0.001, 0.301, 0.601, 0.901, 1.0, 1.201, 1.501, 2.0, 2.5, 3.0, *NEAR_PI)
FEW_BIT_AMPLITUDES = (0.125, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0)
LONG_AMPLITUDES = (0.001, 1.0, 2.0, 3.0, 3.14)
EVENTS = 8
LONG_TAYLOR_ELEMENTS = 7
"""Times 2^0 ... 2^6 s are integrated; later ones would take minutes each."""


def core() -> tuple[Group, ...]:
    """The grids of the dataset that ships with the package."""
    return (
        Group(
            LIBRATION,
            EARTH,
            {"amplitude": LIBRATION_AMPLITUDES, "time": np.arange(1001) / 100, "event": np.arange(EVENTS)},
        ),
        Group(DIMENSIONLESS, UNIT, {"amplitude": FEW_BIT_AMPLITUDES, "time": np.arange(1025) / 16}),
        Group(LONG, EARTH, {"amplitude": LONG_AMPLITUDES, "time": 2.0 ** np.arange(31)}, LONG_TAYLOR_ELEMENTS),
    )


def full() -> tuple[Group, ...]:
    """The same groups with finer and larger grids."""
    sixty_fourths = np.arange(1, 202) / 64
    amplitudes = np.unique(np.concatenate([LIBRATION_AMPLITUDES, sixty_fourths]))
    halves = np.array([m * 2.0**j for j in range(31) for m in (1.0, 1.25, 1.5, 1.75)])
    return (
        Group(
            LIBRATION,
            EARTH,
            {"amplitude": amplitudes, "time": np.arange(10_001) / 1000, "event": np.arange(8 * EVENTS)},
        ),
        Group(DIMENSIONLESS, UNIT, {"amplitude": sixty_fourths, "time": np.arange(8193) / 128}),
        Group(LONG, EARTH, {"amplitude": amplitudes, "time": halves}, 4 * LONG_TAYLOR_ELEMENTS - 3),
    )
