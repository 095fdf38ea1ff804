"""The thesis in the field of a point mass: the family of brachistochrones, figure 14, and four whole paths, figure 15.

Z is the lowest point over the radius of the release; all mass is taken to be in the centre.
"""

from __future__ import annotations

import math

import numpy as np

from compare.sources.figures.drawing import Curve, Drawing, curve
from reference import PolarBrachistochrone

__all__ = ["figure14", "figure15"]

FAMILY = ("0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9")
CONTINUED = ("0.2", "0.4", "0.7", "0.9")
"""Four of them; the thesis names the first and the last."""
CHOICE = "Z = 0.4 and 0.7 are our choice: of the four the thesis names 0.2 and 0.9."
POINTS = 193
NOTE = "Released at r = r₀, φ = 0; Z = r_min/r₀; all mass is taken to be in the centre, r = 0."


def figure14() -> Drawing:
    """Nine descents to their lowest points, psi from 0 to pi."""
    return _drawing("thesis figure 14", "descents to nine lowest points Z", [_path(z0, math.pi) for z0 in FAMILY])


def figure15() -> Drawing:
    """Four paths through their lowest points and up again, psi from 0 to 2 pi: each sweeps twice its half angle."""
    paths = [_path(z0, 2 * math.pi) for z0 in CONTINUED]
    angles = [float(PolarBrachistochrone(z0).certified("half_angle")) for z0 in CONTINUED]
    lowest = curve("lowest points r_min", angles, [float(z0) for z0 in CONTINUED], points=True)
    return _drawing("thesis figure 15", "four paths from I through r_min to F", [*paths, lowest], CHOICE)


def _drawing(item: str, title: str, curves: list[Curve], choice: str = "") -> Drawing:
    note = "\n".join(filter(None, (NOTE, choice)))
    return Drawing(item, title, "angle φ", "r/r₀", tuple(curves), polar=True, note=note)


def _path(z0: str, psi_end: float) -> Curve:
    """phi and z along the curve, named by where it ends."""
    found = PolarBrachistochrone(z0).along("curve", np.linspace(0.0, psi_end, POINTS))
    return curve(f"Z = {z0}, ends at {math.degrees(found[-1, 1]):.2f}°", found[:, 1], found[:, 0])
