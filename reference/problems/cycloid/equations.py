"""The cycloid and what slides on it without friction, each equation written once.

A point of a circle of radius R that rolls below a level line draws x = R (theta - sin theta), y = R (1 - cos theta), y
downward from the cusp theta = 0, theta the angle that the circle has turned.  Then ds = 2 R sin(theta/2) dtheta and

    s = 4 R (1 - cos(theta/2)),     dy/ds = cos(theta/2) = 1 - s/(4 R):

gravity along the curve, g dy/ds, is linear in the arc length s: every descent is harmonic about the bottom s = 4 R.  A
descent from the cusp has the speed sqrt(2 g y) = 2 sqrt(g R) sin(theta/2), hence theta' = sqrt(g/R).

The pendulum of Huygens measures angle and arc from the bottom instead: x = R (theta + sin theta), height
R (1 - cos theta), arc 4 R sin(theta/2).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from reference.arithmetic.protocols import Arithmetic

__all__ = [
    "angular_acceleration",
    "arc_acceleration",
    "arc_energy",
    "arc_frequency",
    "depth",
    "point_below_cusp",
    "point_from_bottom",
    "run",
    "swing_energy",
]


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
