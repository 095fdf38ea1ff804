"""What a motion looks like at one time: axes with its paths, a marker for each body."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.show.plot_style import inks

if TYPE_CHECKING:
    import numpy as np

    from compare.show.plot_style import Ink
    from compare.sources.figures.drawing import Curve
    from compare.sources.figures.motion import Motion

__all__ = ["BEHIND", "X_LABEL", "Y_LABEL", "draw_bodies", "draw_curve", "draw_paths"]

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
