"""The thesis in a uniform field: the race of curves, figures 9 and 10, and the tautochrone, figures 11 and 12.

The thesis gives no coefficients; the curves are those of the race from (pi, 2) down to (0, 0), in m, with R = 1 m and
g = 9.81 m/s^2.
"""

from __future__ import annotations

import numpy as np

from compare.sources.figures.drawing import Drawing, curve
from reference import Descent, Tautochrone

__all__ = ["figure9", "figure10", "figure11", "figure12"]

GRAVITY = "9.81"
FIELD = f"g = {GRAVITY} m/s²."
RELEASED = f"Released at (π, 2) m, down to (0, 0); {FIELD}"
RACE = ("line", "quartic", "cycloid")
"""The curves that the thesis names."""
QUARTIC = "The quartic is y = 2 (x/π)⁴ m, our choice: the thesis gives no coefficients."
STARTS = ("3.13", "2.0", "1.5")
"""Angles of the three starts in rad, from the bottom; the first is that of the thesis' listing."""
STARTS_NOTE = "The start 3.13 rad is the listing's, the others are our choice."
LAST_TIME = 2.1
"""The listing's march ends so many seconds after the release."""
FRACTIONS = (np.arange(129) / 128) ** 2
"""Parts of the way, closer together where the speed grows as their root."""
TIMES = np.linspace(0.0, LAST_TIME, 169)


def figure9() -> Drawing:
    """Speed against the horizontal place; all arrive at x = 0 with sqrt(2 g 2 m)."""
    return _race("thesis figure 9", "speed along the curves of the race", "x [m]", "speed |v| [m/s]", "x", "speed")


def figure10() -> Drawing:
    """Horizontal speed against the height: on the cycloid sqrt(g/R) (2 R - y), linear in y."""
    labels = "height y [m]", "horizontal speed |dx/dt| [m/s]"
    return _race("thesis figure 10", "horizontal speed against height", *labels, "y", "velocity_x")


def _race(item: str, title: str, x_label: str, y_label: str, across: str, upward: str) -> Drawing:
    """Two quantities of the passage through equal parts of the way, for each curve; speeds count as positive."""
    curves = []
    for name in RACE:
        problem = Descent(name, GRAVITY)
        columns = [quantity.name for quantity in problem.row("passage").quantities]
        found = dict(zip(columns, problem.along("passage", FRACTIONS).T, strict=True))
        curves.append(curve(name, found[f"passage_{across}"], np.abs(found[f"passage_{upward}"])))
    return Drawing(item, title, x_label, y_label, tuple(curves), note=f"{RELEASED}\n{QUARTIC}")


def figure11() -> Drawing:
    """x(t) from three starts: all are at x = 0 after pi sqrt(R/g), whatever the start."""
    return _swings("thesis figure 11", "horizontal place of three bodies on the cycloid", "x [m]", 0)


def figure12() -> Drawing:
    """y(t) from three starts: all are at y = 0 after pi sqrt(R/g), whatever the start."""
    return _swings("thesis figure 12", "height of three bodies on the cycloid", "height y [m]", 1)


def _swings(item: str, title: str, label: str, component: int) -> Drawing:
    """A coordinate of each body over time, and where they meet."""
    swings = [Tautochrone(start, 1, GRAVITY) for start in STARTS]
    curves = [
        curve(f"from θ₀ = {start} rad", TIMES, swing.along("position", TIMES)[:, component])
        for start, swing in zip(STARTS, swings, strict=True)
    ]
    arrivals = [float(swing.descent_time()) for swing in swings]
    meeting = curve("at the bottom", arrivals, [0.0] * len(arrivals), points=True)
    return Drawing(item, title, "time t [s]", label, (*curves, meeting), note=f"R = 1 m, {FIELD} {STARTS_NOTE}")
