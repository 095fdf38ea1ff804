"""The thesis' cycloid as a curve: RK4 on dx/dy, figure 6, and its error against the number of steps, figure 7."""

from __future__ import annotations

import math
from fractions import Fraction
from functools import partial

import numpy as np

from compare.march.lanes import Lane
from compare.march.march import march
from compare.march.precision import precision
from compare.methods import find
from compare.sources.figures.drawing import Drawing, curve
from compare.sources.published.curve import simpson_error
from compare.sources.published.entry import reproduce
from compare.sources.published.number import Enclosed
from compare.sources.published.source import tables
from reference.problems.cycloid.arc import CycloidCurve

__all__ = ["figure6", "figure7"]

STEPS = 500
EVERY = 25
"""One of so many points of the march is drawn."""
APART, PLACES = 4, 12
"""Between the numbers of steps at which the error is drawn; its decimal places."""


def figure6() -> Drawing:
    """The march of the listing with N = 500, over the exact curve; the ordinate is -y, from 0 to 2, as it collects."""
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
        "−y [m]",
        (
            curve("exact", exact[:, 0], exact[:, 1], behind=True),
            curve(f"rk4, every {EVERY}th point", points[:, 0], points[:, 1], points=True),
        ),
        equal=True,
        note="The listing marches y from 0 down to −2 and collects −y, the depth below the cusp.",
    )


def figure7() -> Drawing:
    """The error of x after the last step, as the listing computes it at five N, and without rounding at many."""
    (found,) = reproduce(["figure7"])
    entries = [entry for entry in found.entries if entry.column == "error"]
    listed = [int(entry.row) for entry in entries]
    n = range(listed[0], listed[-1] + 1, APART)
    angle, depth = (Fraction(found.table.parameters[name]) for name in ("angle", "depth"))
    errors = [Enclosed(partial(simpson_error, angle, depth, many), f"the error at N = {many}") for many in n]
    return Drawing(
        "thesis figure 7",
        "error of RK4 on dx/dy against the number of steps",
        "number of steps N",
        "error |x − x(y)| [m]",
        (
            curve("without rounding", n, [float(error.fixed(PLACES)) for error in errors], behind=True),
            curve("as listed", listed, [float(entry.reproduced) for entry in entries], points=True),
        ),
        logarithmic=True,
        note=f"Without rounding: at every {APART}th N from {listed[0]} on. Logarithmic axes are our choice.",
    )
