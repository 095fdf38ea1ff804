"""The thesis' cycloid as a curve: RK4 on dx/dy, figure 6, and its error against the number of steps, figure 7."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np

from compare.figures.drawing import Drawing, curve
from compare.lane import Lane
from compare.march import march
from compare.methods import find
from compare.paths import CycloidCurve
from compare.precision import precision
from compare.published.entry import reproduce
from compare.published.source import tables

__all__ = ["figure6", "figure7"]

STEPS = 500
EVERY = 25
"""One of so many points of the march is drawn."""


def figure6() -> Drawing:
    """The march of the listing with N = 500, over the exact curve; y upwards from the cusp, as in the listing."""
    table = next(table for table in tables() if table.name == "figure7")
    angle, depth = float(table.parameters["angle"]), Fraction(float(table.parameters["depth"]))
    start = Fraction(angle - math.sin(angle)), Fraction(1 - math.cos(angle))
    arc, fmt = CycloidCurve(1), precision("float64")
    lane = Lane(arc, STEPS, fmt.round((depth - start[1]) / STEPS), tuple(range(EVERY, STEPS + 1, EVERY)), start)
    (found,) = march(find("rk4"), [lane], fmt)
    points = np.array([[float(value) for value in start], *found.states.tolist()])
    exact = arc.along("curve", np.linspace(0.0, math.pi, 193))
    return Drawing(
        "thesis figure 6",
        f"cycloid by RK4 on dx/dy, N = {STEPS}",
        "x [m]",
        "y [m]",
        (
            curve("exact", exact[:, 0], -exact[:, 1], behind=True),
            curve(f"rk4, every {EVERY}th point", points[:, 0], -points[:, 1], points=True),
        ),
        equal=True,
    )


def figure7() -> Drawing:
    """The error of x after the last step, as the listing computes it, and without rounding."""
    (found,) = reproduce(["figure7"])
    entries = [entry for entry in found.entries if entry.column == "error"]
    n = [int(entry.row) for entry in entries]
    return Drawing(
        "thesis figure 7",
        "error of RK4 on dx/dy against the number of steps",
        "number of steps N [1]",
        "error |x − x(y)| [m]",
        (
            curve("without rounding", n, [float(entry.exact) for entry in entries], behind=True),
            curve("as listed", n, [float(entry.reproduced) for entry in entries], points=True),
        ),
    )
