"""The pendulum's groups."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from reference.family import Comparison, Family, Input, Reported
from reference.layout import Coordinate, Group, Layout, parts
from reference.problems.pendulum.approximations import PendulumSeries
from reference.problems.pendulum.linear import LinearPendulum
from reference.problems.pendulum.problem import Pendulum
from reference.problems.pendulum.quantities import SERVED

if TYPE_CHECKING:
    from reference.declaration import Row
    from reference.problem import Problem

__all__ = [
    "DIMENSIONLESS",
    "EARTH",
    "FAMILY",
    "LAYOUTS",
    "LIBRATION",
    "LINEAR",
    "LINEAR_FAMILY",
    "LONG",
    "ROTATION",
    "SEPARATRIX",
    "SERIES",
    "UNIT",
    "core",
    "full",
]

AMPLITUDE = Coordinate("amplitude", "rad", "amplitude theta0, the angle at which the pendulum is released")
TIME = Coordinate("time", "s", "time since the release")
EVENT = Coordinate("event", "1", "number of the event", "0, 1, 2, ...", whole=True)
ORDER = Coordinate("order", "1", "order n of the expansion, up to amplitude^(2 n)", "0, 1, 2, ...", whole=True)
INITIAL_OMEGA = Coordinate("initial_omega", "rad s-1", "angular velocity at the start, at the bottom")
GRAVITY = Coordinate("g", "m s-2", "acceleration of gravity")
LENGTH = Coordinate("length", "m", "length of the pendulum")
ELLIPTIC = "P. F. Byrd and M. D. Friedman, Handbook of Elliptic Integrals, Springer 1971; DLMF chapter 22"
RELEASED = "theta'' = -(g/length) sin(theta), theta(0) = amplitude, theta'(0) = 0"
SET_GOING = "theta'' = -(g/length) sin(theta), theta(0) = 0, theta'(0) = initial_omega"


def released(amplitude: float, g: float, length: float) -> Pendulum:
    """The pendulum released from rest at ``amplitude`` (rad), g in m/s^2, length in m."""
    return Pendulum(theta0=amplitude, g=g, length=length)


def set_going(initial_omega: float, g: float, length: float) -> Pendulum:
    """The pendulum that passes the bottom at ``initial_omega`` (rad/s) at t = 0."""
    return Pendulum(theta0=0, omega0=initial_omega, g=g, length=length)


def linear(amplitude: float, g: float, length: float) -> LinearPendulum:
    """The linearised pendulum released from rest."""
    return LinearPendulum(amplitude, g, length)


def expanded(amplitude: float, g: float, length: float) -> PendulumSeries:
    """The expansions in the amplitude of the pendulum released from rest."""
    return PendulumSeries(amplitude, g, length)


def rows(*names: str, of: type[Problem] = Pendulum) -> tuple[Row, ...]:
    """The rows of these names."""
    return tuple(row for row in of.rows if row.name in names)


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
    rows(*(name for name in SERVED["release"] if name not in {"gradient", "curvature"})),
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
ROTATION = Layout(
    "/pendulum/rotation",
    "pendulum that goes over the top, set going at the bottom",
    (INITIAL_OMEGA,),
    {"time": TIME, "index": EVENT},
    (GRAVITY, LENGTH),
    rows("state", "gradient", "condition", "period", "energy", "modulus", "zero_crossing"),
    set_going,
    ELLIPTIC,
    SET_GOING,
    "average; higher just above the separatrix, where an error of the start grows a millionfold in one turn",
)
SEPARATRIX = Layout(
    "/pendulum/separatrix",
    "pendulum with just the energy to reach the top, which it never does",
    (),
    {"time": TIME},
    (INITIAL_OMEGA, GRAVITY, LENGTH),
    rows("state", "gradient", "condition"),
    set_going,
    ELLIPTIC,
    f"{SET_GOING}, initial_omega^2 = 4 g/length",
    "higher: an error of the start grows like exp(t), and any integrator falls to one side in the end",
)
LINEAR = Layout(
    "/pendulum/linear",
    "linearised pendulum released from rest",
    (AMPLITUDE,),
    {"time": TIME},
    (GRAVITY, LENGTH),
    LinearPendulum.rows,
    linear,
    "any textbook of mechanics",
    "theta'' = -(g/length) theta, theta(0) = amplitude, theta'(0) = 0",
    "lower: harmonic",
)
SERIES = Layout(
    "/pendulum/series",
    "errors of the expansions in powers of the amplitude, by their order",
    (AMPLITUDE,),
    {"index": ORDER},
    (GRAVITY, LENGTH),
    PendulumSeries.rows,
    expanded,
    "A. H. Nayfeh, Perturbation Methods, Wiley 1973, section 3.1",
    f"{RELEASED}, by the series of its period and by the solution of Lindstedt and Poincare",
    "no integration: how good a formula is",
)
LAYOUTS = (LIBRATION, DIMENSIONLESS, LONG, ROTATION, SEPARATRIX, LINEAR, SERIES)

EARTH = {"g": 9.81, "length": 1.0}
UNIT = {"g": 1.0, "length": 1.0}
NEAR_PI = (3.1, 3.14, math.pi - 1e-6, math.pi - 1e-9)
LIBRATION_AMPLITUDES = (0.001, 0.301, 0.601, 0.901, 1.0, 1.201, 1.501, 2.0, 2.5, 3.0, *NEAR_PI)
FEW_BIT_AMPLITUDES = (0.125, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 2.5, 3.0)
LONG_AMPLITUDES = (0.001, 1.0, 2.0, 3.0, 3.14)
EVENTS = 4
LONG_TAYLOR_ELEMENTS = 7
"""Times 2^0 ... 2^6 s are integrated; later ones would take minutes each."""
TO_THE_TOP = math.sqrt(4 * EARTH["g"])
ROTATION_OMEGAS = (TO_THE_TOP * (1 + 1e-12), TO_THE_TOP * (1 + 1e-6), 6.3, 6.5, 7.0, 8.0, 12.0, 40.0)
SERIES_AMPLITUDES = (0.01, 0.1, 0.5, 1.0, 1.5, 2.0)


def core() -> tuple[Group, ...]:
    """The grids of the dataset that ships with the package."""
    return (
        Group(
            LIBRATION,
            EARTH,
            {"amplitude": LIBRATION_AMPLITUDES, "time": parts(range(1001), 100), "event": range(EVENTS)},
        ),
        Group(DIMENSIONLESS, UNIT, {"amplitude": FEW_BIT_AMPLITUDES, "time": parts(range(1025), 16)}),
        Group(LONG, EARTH, {"amplitude": LONG_AMPLITUDES, "time": [2.0**k for k in range(31)]}, LONG_TAYLOR_ELEMENTS),
        Group(
            ROTATION,
            EARTH,
            {"initial_omega": ROTATION_OMEGAS, "time": parts(range(251), 50), "event": range(EVENTS)},
        ),
        Group(SEPARATRIX, {"initial_omega": 2.0, **UNIT}, {"time": parts(range(1025), 32)}),
        Group(LINEAR, EARTH, {"amplitude": LIBRATION_AMPLITUDES[:7], "time": parts(range(1001), 100)}),
        Group(SERIES, EARTH, {"amplitude": SERIES_AMPLITUDES, "order": range(6)}),
    )


def full() -> tuple[Group, ...]:
    """The same groups with finer and larger grids, as far as they are proven within hours on two cores."""
    sixty_fourths = parts(range(1, 202), 64)
    amplitudes = sorted({*LIBRATION_AMPLITUDES, *sixty_fourths})
    expanded_at = sorted({*SERIES_AMPLITUDES, *parts(range(1, 33), 16)})
    halves = [m * 2.0**j for j in range(31) for m in (1.0, 1.25, 1.5, 1.75)]
    return (
        Group(
            LIBRATION,
            EARTH,
            {"amplitude": amplitudes, "time": parts(range(4001), 400), "event": range(4 * EVENTS)},
        ),
        Group(DIMENSIONLESS, UNIT, {"amplitude": sixty_fourths, "time": parts(range(4097), 64)}),
        Group(LONG, EARTH, {"amplitude": amplitudes, "time": halves}, 4 * LONG_TAYLOR_ELEMENTS - 3),
        Group(
            ROTATION,
            EARTH,
            {
                "initial_omega": sorted({*ROTATION_OMEGAS, *parts(range(101, 129), 16)}),
                "time": parts(range(2501), 500),
                "event": range(4 * EVENTS),
            },
        ),
        Group(SEPARATRIX, {"initial_omega": 2.0, **UNIT}, {"time": parts(range(8193), 256)}),
        Group(LINEAR, EARTH, {"amplitude": LIBRATION_AMPLITUDES, "time": parts(range(4001), 400)}),
        Group(SERIES, EARTH, {"amplitude": expanded_at, "order": range(11)}),
    )


GRAVITY_INPUT = Input("g", "m s-2", "acceleration of gravity", "9.81")
TIME_INPUT = Input("t", "s", "time", over="time")
LENGTH_INPUT = Input("length", "m", "length", "1")
STATED = ("state", "period", "energy")

FAMILY = Family(
    name="pendulum",
    help="the mathematical pendulum, released from rest or set going",
    problem=Pendulum,
    inputs=(
        Input("theta0", "rad", "angle of the start; released from rest, 0 < theta0 < pi"),
        Input("omega0", "rad s-1", "angular velocity of the start; without it, released from rest", optional=True),
        GRAVITY_INPUT,
        LENGTH_INPUT,
        TIME_INPUT,
    ),
    rows=STATED,
    comparison=Comparison(
        "pendulum",
        "score integrators on the pendulum: error against N, observed order, energy drift",
        varied="theta0",
        values=(1.0,),
        what="amplitude",
        inputs=("omega0", "g", "length"),
        largest=1 << 20,
    ),
    reported=(Reported("pendulum", "theta0", "rad", "rad", (0.1, 1.0, 3.0), Pendulum),),
    layouts=LAYOUTS,
    core=core,
    full=full,
)
LINEAR_FAMILY = Family(
    name="linear",
    help="the linearised pendulum",
    problem=LinearPendulum,
    inputs=(
        Input("theta0", "rad", "angle of the start"),
        Input("omega0", "rad s-1", "angular velocity of the start", "0"),
        GRAVITY_INPUT,
        LENGTH_INPUT,
        TIME_INPUT,
    ),
    rows=STATED,
    comparison=Comparison(
        "linear",
        "score them on the linearised pendulum, which is harmonic",
        varied="theta0",
        values=(1.0,),
        what="amplitude",
        inputs=("omega0", "g", "length"),
    ),
    reported=(Reported("linear", "theta0", "rad", "rad", (1.0,), LinearPendulum),),
)
