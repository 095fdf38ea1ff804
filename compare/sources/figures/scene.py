"""What a motion looks like at one time: axes with its paths, a marker for each body.

A motion as panels of successive times, from left to right and downwards.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure

from compare.show.plot_style import GREY, inks

if TYPE_CHECKING:
    from compare.show.plot_style import Ink
    from compare.sources.figures.drawing import Curve
    from compare.sources.figures.motion import Motion

__all__ = ["BEHIND", "X_LABEL", "Y_LABEL", "draw", "draw_bodies", "draw_curve", "draw_paths"]

SIZE, LINE = (10.5, 5.2), 0.25
"""Inches: as high as two rows of panels with equal units take, and what each further line of the note does."""


def draw(motion: Motion) -> Figure:
    """The figure, in the style in force."""
    width, height = SIZE
    figure = Figure(figsize=(width, height + LINE * motion.note.count("\n")), layout="constrained")
    panels = figure.subplots(2, -(-len(motion.panels) // 2), sharex=True, sharey=True)
    places = np.stack([body.places(motion.panels) for body in motion.bodies], axis=1)
    for time, now, axes in zip(motion.panels, places, panels.flat, strict=True):
        draw_paths(axes, motion, labelled=False)
        draw_bodies(axes, motion, now)
        axes.set_title(f"t = {time:.3f} s", fontsize=10)
    handles = [handle for handle in panels.flat[0].get_lines() if handle.get_marker() != "None"]
    figure.legend(handles=handles, loc="outside right upper", frameon=False)
    for axes in panels[-1]:
        axes.set_xlabel(X_LABEL)
    for axes in panels[:, 0]:
        axes.set_ylabel(Y_LABEL)
    figure.supxlabel(motion.note, fontsize=9, color=GREY, x=0.01, ha="left")
    return figure


BEHIND = "#C8C8C8"
MARKER_SIZE = 8
X_LABEL, Y_LABEL = "x [m]", "height y [m]"


def draw_curve(axes: Any, one: Curve, ink: dict[str, Ink]) -> None:
    """A curve: joined, or its points, or thick and grey behind the others."""
    label = one.name or "_nolegend_"
    if one.behind:
        axes.plot(one.x, one.y, color=BEHIND, linewidth=5, solid_capstyle="round", label=label)
    elif one.points:
        own = ink[one.name]
        style: dict[str, Any] = {"linestyle": "", "color": own.colour, "label": label, "zorder": 4}
        if one.ring:
            style |= {"markersize": one.ring, "markerfacecolor": "none", "markeredgewidth": 1.6}
        axes.plot(one.x, one.y, own.marker, **style)
    else:
        axes.plot(one.x, one.y, color=ink[one.name].colour, linestyle=ink[one.name].dashes, label=label)


def draw_paths(axes: Any, motion: Motion, *, labelled: bool = True) -> None:
    """The paths on axes in m, as long in x as in y."""
    ink = inks([body.name for body in motion.bodies])
    for path in motion.paths:
        draw_curve(axes, path, ink)
    axes.set_aspect("equal")
    axes.grid(visible=True)
    if labelled:
        axes.set_xlabel(X_LABEL)
        axes.set_ylabel(Y_LABEL)


def draw_bodies(axes: Any, motion: Motion, places: np.ndarray) -> list[Any]:
    """A marker for each body at its place, (x, y) in m: places of [body, 2]."""
    ink = inks([body.name for body in motion.bodies])
    markers = []
    for body, (x, y) in zip(motion.bodies, places, strict=True):
        own = ink[body.name]
        style = {"color": own.colour, "markersize": MARKER_SIZE, "linestyle": "", "clip_on": False, "zorder": 4}
        markers += axes.plot([x], [y], own.marker, label=body.name, **style)
    return markers
