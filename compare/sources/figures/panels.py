"""A motion as panels of successive times, from left to right and downwards."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure

from compare.show.plot_style import GREY
from compare.sources.figures.scene import X_LABEL, Y_LABEL, draw_bodies, draw_paths

if TYPE_CHECKING:
    from compare.sources.figures.motion import Motion

__all__ = ["draw"]

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
