"""The cycloid and what slides on it without friction, each equation written once.

A point of a circle of radius R that rolls below a level line draws x = R (theta - sin theta), y = R (1 - cos theta), y
downward from the cusp theta = 0, theta the angle that the circle has turned.  Then ds = 2 R sin(theta/2) dtheta and

    s = 4 R (1 - cos(theta/2)),     dy/ds = cos(theta/2) = 1 - s/(4 R):

gravity along the curve, g dy/ds, is linear in the arc length s: every descent is harmonic about the bottom s = 4 R.  A
descent from the cusp has the speed sqrt(2 g y) = 2 sqrt(g R) sin(theta/2), hence theta' = sqrt(g/R).

The pendulum of Huygens measures angle and arc from the bottom instead: x = R (theta + sin theta), height
R (1 - cos theta), arc 4 R sin(theta/2).

On a curve beside the brachistochrone through the same end points the descent takes longer.  The neighbour epsilon of
the cycloid has the same x and all depths changed by the factor B = 1 + epsilon w,

    x = R (theta - sin theta),   y = R (1 - cos theta) B,   w = sin(pi theta/theta_B),   0 <= theta <= theta_B.

With phi = theta/2, s = sin(phi), c = cos(phi), w' = dw/dtheta: dx = 2 R s^2 dtheta, dy = 2 R s (c B + epsilon s w')
dtheta, and the speed is sqrt(2 g y) = 2 s sqrt(g R B), so that

    dT/dtheta = sqrt(R/g) F,     F^2 = (s^2 + (c B + epsilon s w')^2)/B.

For epsilon = 0 it is sqrt(R/g).  F^2 - 1 = epsilon (L + epsilon Q)/B with L = d(w sin theta)/dtheta, whose integral is
zero because w is at both ends, and Q = (c w + s w')^2.  From F - 1 = (F^2 - 1)/2 - (F - 1)^2/2 follows

    F - 1 - epsilon L/2 = (epsilon^2/2) (s^2 (w^2 + w'^2)/B - ((L + epsilon Q)/(B (1 + F)))^2):

what is lost is of second order, as it must be beside a minimum, and no digit cancels however small epsilon is.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from reference.declaration import StateSpace, Trial

if TYPE_CHECKING:
    from reference.arithmetic.protocols import Arithmetic

__all__ = [
    "ARC_SPACE",
    "ARC_TRIAL",
    "angular_acceleration",
    "arc_acceleration",
    "arc_energy",
    "arc_frequency",
    "depth",
    "excess",
    "point_below_cusp",
    "point_from_bottom",
    "run",
    "slowness",
    "swing_energy",
]


ARC_SPACE = StateSpace(
    positions=("arc",),
    velocities=("arc_rate",),
    angles=(),
    odd=("arc_rate",),
    along=None,
    scale="largest",
    independent="s",
)
ARC_TRIAL = Trial(
    states=((-3.0, 3.0), (-3.0, 3.0)), parameters={"radius": (0.5, 2.0), "g": (0.5, 2.0)}, step=(0.01, 0.1)
)


class Place(NamedTuple):
    """s, c, w and w' at a fraction of the angle."""

    s: Any
    c: Any
    w: Any
    dw: Any


def place(m: Arithmetic, fraction: Any, half: Any, pi: Any) -> Place:
    """Where theta = 2 fraction half; half = theta_B/2."""
    phi, along = half * fraction, pi * fraction
    return Place(m.sin(phi), m.cos(phi), m.sin(along), pi / (2 * half) * m.cos(along))


def slowness(m: Arithmetic, fraction: Any, half: Any, pi: Any, epsilon: Any) -> Any:
    """F = sqrt(g/R) dT/dtheta on the neighbour epsilon."""
    return _slowness(m, place(m, fraction, half, pi), epsilon)


def _slowness(m: Arithmetic, at: Place, epsilon: Any) -> Any:
    depth = 1 + epsilon * at.w
    fall = at.c * depth + epsilon * at.s * at.dw
    return m.sqrt((at.s * at.s + fall * fall) / depth)


def excess(m: Arithmetic, fraction: Any, half: Any, pi: Any, epsilon: Any) -> Any:
    """2 (F - 1 - epsilon L/2)/epsilon^2, whose mean over the angle is 2 (T_epsilon - T)/(epsilon^2 T)."""
    at = place(m, fraction, half, pi)
    s, c, w, dw = at
    depth = 1 + epsilon * w
    first = (c * c - s * s) * w + 2 * s * c * dw
    second = c * w + s * dw
    bent = (first + epsilon * second * second) / (depth * (1 + _slowness(m, at, epsilon)))
    return s * s * (w * w + dw * dw) / depth - bent * bent


def point_below_cusp(m: Arithmetic, angle: Any, radius: Any) -> tuple[Any, Any]:
    """(x, y) = (R (theta - sin theta), R (1 - cos theta)), y downward from the cusp."""
    half = m.sin(angle / 2)
    return radius * (angle - m.sin(angle)), 2 * radius * half * half


def point_from_bottom(m: Arithmetic, angle: Any, radius: Any) -> tuple[Any, Any]:
    """(x, y) = (R (theta + sin theta), R (1 - cos theta)), y upward from the bottom."""
    half = m.sin(angle / 2)
    return radius * (angle + m.sin(angle)), 2 * radius * half * half


def depth(arc: Any, radius: Any) -> Any:
    """y = s - s^2/(8 R), s from the cusp."""
    return arc - arc * arc / (8 * radius)


def run(m: Arithmetic, y: Any, radius: Any) -> Any:
    """dx/dy = sqrt(y/(2 R - y)), the first integral of the brachistochrone's Euler equation, turned over."""
    return m.sqrt(y / (2 * radius - y))


def arc_frequency(m: Arithmetic, radius: Any, g: Any) -> Any:
    """sqrt(g/(4 R)), in rad/s: of the oscillation of the arc length, whatever its amplitude."""
    return m.sqrt(g / radius) / 2


def arc_acceleration(arc: Any, radius: Any, g: Any) -> Any:
    """s'' = -(g/(4 R)) s, s from the bottom, in m/s^2."""
    return -(g / (4 * radius)) * arc


def arc_energy(arc: Any, rate: Any, radius: Any, g: Any) -> Any:
    """E = s'^2/2 + (g/(8 R)) s^2, s from the bottom: kinetic and potential energy per mass, in m^2/s^2."""
    return rate * rate / 2 + g / (8 * radius) * arc * arc


def angular_acceleration(m: Arithmetic, theta: Any, omega: Any, radius: Any, g: Any) -> Any:
    """theta'' = tan(theta/2) (theta'^2/2 - g/(2 R)), in rad/s^2, theta from the bottom.

    From (1 + cos theta) theta'' - (1/2) sin(theta) theta'^2 + (g/(2 R)) sin theta = 0, divided where it is 0/0 at the
    cusps.  (The thesis' (1.46), (1.47) and the line after it have both of the last signs wrong, its (1.48) right:
    J. Šalinović, Problem brahistokrone u nehomogenom gravitacijskom polju, University of Split 2022.)
    """
    return m.sin(theta / 2) / m.cos(theta / 2) * (omega * omega / 2 - g / (2 * radius))


def swing_energy(m: Arithmetic, theta: Any, omega: Any, radius: Any, g: Any) -> Any:
    """The same energy by the angle: E = 2 R^2 cos^2(theta/2) theta'^2 + 2 g R sin^2(theta/2)."""
    rate, height = radius * m.cos(theta / 2) * omega, m.sin(theta / 2)
    return 2 * rate * rate + 2 * g * radius * height * height
