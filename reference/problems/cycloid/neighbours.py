"""Curves beside the brachistochrone, through the same end points: how much longer the descent takes on them.

The neighbour epsilon of the cycloid has the same x and all depths changed by the factor B = 1 + epsilon w,

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

if TYPE_CHECKING:
    from reference.arithmetic.protocols import Arithmetic

__all__ = ["excess", "slowness"]


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
