"""The pendulum's equation of motion and its energy, each written once.

theta is the angle from the lower rest position in rad, omega its rate in rad/s, g the acceleration of gravity in m/s^2,
l the length in m.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from reference.arithmetic.protocols import Arithmetic

__all__ = ["angular_acceleration", "condition", "energy", "energy_above_rest"]


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


def condition(m: Arithmetic, w: Any, theta_theta: Any, theta_omega: Any, omega_theta: Any, omega_omega: Any) -> Any:
    """The largest singular value of d(theta, omega/w)/d(theta0, omega0/w), from the slopes of theta, then of omega.

    For a matrix ((a, b), (c, d)) it is (|(a + d, b - c)| + |(a - d, b + c)|)/2: nothing cancels.  A flow that keeps
    areas has the other one as its inverse, so that the value is 1 or above.
    """
    a, b, c, d = theta_theta, theta_omega * w, omega_theta / w, omega_omega
    return (m.sqrt((a + d) ** 2 + (b - c) ** 2) + m.sqrt((a - d) ** 2 + (b + c) ** 2)) / 2
