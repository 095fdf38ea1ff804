"""The figures as PNG and SVG."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from matplotlib.figure import Figure

from compare.figures.catalogue import FIGURES
from compare.figures.snapshots import Snapshots
from compare.ink import GREY, Ink, inks, saved, style

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from compare.figures.drawing import Curve, Drawing

__all__ = ["draw", "files"]

BEHIND = "#C8C8C8"
RAY = 15
"""Degrees from one ray of a polar figure to the next."""
BESIDE: dict[str, Any] = {"loc": "upper left", "bbox_to_anchor": (1.03, 1.0), "frameon": False}


def files(figures: Iterable[Callable[[], Drawing | Snapshots]] = FIGURES) -> dict[str, bytes]:
    """Every figure, computed and drawn, by file name."""
    found: dict[str, bytes] = {}
    with style():
        for compute in figures:
            drawing = compute()
            found |= {f"{drawing.name}.{suffix}": image for suffix, image in saved(draw(drawing)).items()}
    return found


def draw(drawing: Drawing | Snapshots) -> Figure:
    """The figure, in the style in force."""
    figure = _draw_panels(drawing) if isinstance(drawing, Snapshots) else _draw_axes(drawing)
    figure.suptitle(f"{drawing.item.capitalize()}: {drawing.title}", fontsize=13, fontweight="bold", x=0.01, ha="left")
    return figure


def _draw_panels(drawing: Snapshots) -> Figure:
    """A panel a time, from left to right and downwards."""
    figure = Figure(figsize=(10.5, 6.0), layout="constrained")
    panels = figure.subplots(2, -(-len(drawing.times) // 2), sharex=True, sharey=True)
    ink = inks([one.name for one in drawing.bodies])
    for i, (time, axes) in enumerate(zip(drawing.times, panels.flat, strict=True)):
        for path in drawing.paths:
            _draw_curve(axes, path, ink)
        for body in drawing.bodies:
            own = ink[body.name]
            axes.plot(body.x[i], body.y[i], own.marker, color=own.colour, markersize=8, label=body.name, zorder=4)
        axes.set_title(f"t = {time:.3f} s", fontsize=10)
        axes.set_aspect("equal")
        axes.grid(visible=True)
    handles = [handle for handle in panels.flat[0].get_lines() if handle.get_marker() != "None"]
    figure.legend(handles=handles, loc="outside right upper", frameon=False)
    figure.supxlabel(f"x [m];  {drawing.note}", fontsize=10)
    figure.supylabel("height y [m]", fontsize=10)
    return figure


def _draw_axes(drawing: Drawing) -> Figure:
    figure = Figure(figsize=(9.0, 5.4), layout="constrained")
    axes: Any = figure.add_subplot(projection="polar" if drawing.polar else None)
    ink = inks([one.name for one in drawing.curves if not one.behind])
    for one in drawing.curves:
        _draw_curve(axes, one, ink)
    axes.grid(visible=True)
    (_finish_polar if drawing.polar else _finish_plane)(axes, drawing)
    if drawing.note:
        figure.supxlabel(drawing.note, fontsize=9, color=GREY, x=0.01, ha="left")
    if any(one.name for one in drawing.curves):
        axes.legend(**BESIDE)
    return figure


def _draw_curve(axes: Any, one: Curve, ink: dict[str, Ink]) -> None:
    label = one.name or "_nolegend_"
    if one.behind:
        axes.plot(one.x, one.y, color=BEHIND, linewidth=5, solid_capstyle="round", label=label)
    elif one.points:
        own = ink[one.name]
        axes.plot(one.x, one.y, own.marker, linestyle="", color=own.colour, label=label, zorder=4)
    else:
        axes.plot(one.x, one.y, color=ink[one.name].colour, linestyle=ink[one.name].dashes, label=label)


def _finish_plane(axes: Any, drawing: Drawing) -> None:
    axes.set_xlabel(drawing.x_label)
    axes.set_ylabel(drawing.y_label)
    if drawing.equal:
        axes.set_aspect("equal")


def _finish_polar(axes: Any, drawing: Drawing) -> None:
    """The part of the plane that the paths are in, with the centre."""
    sweep = math.degrees(max(float(one.x.max()) for one in drawing.curves))
    last = RAY * math.ceil(sweep / RAY)
    axes.set_thetamin(0)
    axes.set_thetamax(last)
    axes.set_thetagrids(range(0, last + 1, RAY))
    axes.set_rlim(0, 1)
    axes.set_rlabel_position(0)
    axes.set_xlabel(drawing.y_label)
    axes.set_title(drawing.x_label, fontsize=10, fontweight="normal", color=GREY)
