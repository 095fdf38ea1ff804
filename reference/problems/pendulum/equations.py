"""The pendulum's equation of motion and its energy, each written once.

theta is the angle from the lower rest position in rad, omega its rate in rad/s, g the acceleration of gravity in m/s^2,
l the length in m.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from reference.declaration import StateSpace, Trial

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction

    from reference.arithmetic.protocols import Arithmetic

__all__ = [
    "ABOUT_REST",
    "SWING",
    "angular_acceleration",
    "condition",
    "energy",
    "energy_above_rest",
    "of_the_start",
    "through_the_bottom",
]

SWING = StateSpace(
    positions=("theta",),
    velocities=("omega",),
    angles=("theta",),
    odd=("omega",),
    along=None,
    scale="units",
    independent="s",
)
ABOUT_REST = Trial(
    states=((-3.0, 3.0), (-3.0, 3.0)), parameters={"g": (0.5, 2.0), "length": (0.5, 2.0)}, step=(0.01, 0.1)
)


def of_the_start(theta0: Fraction, omega0: Fraction) -> dict[str, tuple[Any, str]]:
    """What tells pendulums from each other: where they start, and how fast where they are set going."""
    going = {"omega0": (float(omega0), "rad/s")} if omega0 else {}
    return {"theta0": (float(theta0), "rad"), **going}


def angular_acceleration(m: Arithmetic, theta: Any, g: Any, length: Any) -> Any:
    """theta'' = -(g/l) sin theta, in rad/s^2."""
    return -(g / length) * m.sin(theta)


def energy(m: Arithmetic, theta: Any, omega: Any, g: Any, length: Any) -> Any:
    """E = theta'^2/2 - (g/l) cos theta: the energy per m l^2, in 1/s^2."""
    return omega * omega / 2 - g / length * m.cos(theta)


def energy_above_rest(m: Arithmetic, theta: Any, omega: Any, g: Any, length: Any) -> Any:
    """E - Emin = theta'^2/2 + 2 (g/l) sin^2(theta/2), in 1/s^2; without the cancellation of E + g/l."""
    half = m.sin(theta / 2)
    return omega * omega / 2 + 2 * (g / length) * half * half


def through_the_bottom(m: Arithmetic, y: Sequence[Any]) -> Any:
    """sin(theta/2), zero where the pendulum hangs at the bottom, after any whole turns."""
    return m.sin(y[0] / 2)


def condition(m: Arithmetic, w: Any, theta_theta: Any, theta_omega: Any, omega_theta: Any, omega_omega: Any) -> Any:
    """The largest singular value of d(theta, omega/w)/d(theta0, omega0/w), from the slopes of theta, then of omega.

    For a matrix ((a, b), (c, d)) it is (|(a + d, b - c)| + |(a - d, b + c)|)/2: nothing cancels.  A flow that keeps
    areas has the other one as its inverse, so that the value is 1 or above.
    """
    a, b, c, d = theta_theta, theta_omega * w, omega_theta / w, omega_omega
    return (m.sqrt((a + d) ** 2 + (b - c) ** 2) + m.sqrt((a - d) ** 2 + (b + c) ** 2)) / 2
