"""The equations of a body that slides along a curve without friction, each written once.

The place is the fraction w of the way, w' its rate in 1/s; y is the height in m, upwards, and N = x_w^2 + y_w^2 in m^2
the square of the curve's length for a unit of w.  g is the acceleration of gravity in m/s^2.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from reference.arithmetic.protocols import Arithmetic

__all__ = ["acceleration", "energy", "slowness", "speed"]


def speed(m: Arithmetic, drop: Any, g: Any) -> Any:
    """v = sqrt(2 g drop), in m/s, of a body that was released from rest."""
    return m.sqrt(2 * g * drop)


def slowness(m: Arithmetic, arc_square: Any, drop: Any) -> Any:
    """sqrt(2 g) dt/dw = sqrt(N/drop), from ds = v dt."""
    return m.sqrt(arc_square / drop)


def acceleration(rate: Any, height_slope: Any, arc_square: Any, arc_square_slope: Any, g: Any) -> Any:
    """w'' = -(g y_w + N_w w'^2/2)/N, in 1/s^2: Lagrange's equation of N w'^2/2 - g y."""
    return -(g * height_slope + arc_square_slope * rate * rate / 2) / arc_square


def energy(rate: Any, height: Any, arc_square: Any, g: Any) -> Any:
    """N w'^2/2 + g y in m^2/s^2, the energy for a unit of mass, where y is the height above the end."""
    return arc_square * rate * rate / 2 + g * height
