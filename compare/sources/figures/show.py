"""The figures as PNG and SVG, those that move as GIF and HTML besides."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, LogLocator, NullLocator

from compare.show.plot_style import GREY, inks, saved, style
from compare.sources.figures import moving_image, page, scene
from compare.sources.figures.catalogue import FIGURES
from compare.sources.figures.motion import Motion
from compare.sources.figures.scene import draw_curve
from compare.sources.published.source import figure

if TYPE_CHECKING:
    from collections.abc import Iterable

    from compare.sources.figures.drawing import Drawing

__all__ = ["draw", "files"]

RAY = 15
"""Degrees from one ray of a polar figure to the next."""
BESIDE: dict[str, Any] = {"loc": "upper left", "bbox_to_anchor": (1.03, 1.0), "frameon": False}


def files(names: Iterable[str] = tuple(FIGURES)) -> dict[str, bytes]:
    """The figures of these names, computed and drawn, by file name."""
    found: dict[str, bytes] = {}
    with style():
        for name in names:
            drawing = FIGURES[name]()
            images = saved(draw(drawing))
            if isinstance(drawing, Motion):
                images["gif"] = moving_image.gif(drawing, _title(drawing))
                images["html"] = page.html(drawing, _title(drawing))
            found |= {f"{name}.{suffix}": image for suffix, image in images.items()}
    return found


def draw(drawing: Drawing | Motion) -> Figure:
    """The figure, in the style in force."""
    drawn = scene.draw(drawing) if isinstance(drawing, Motion) else _draw_axes(drawing)
    drawn.suptitle(_title(drawing), fontsize=13, fontweight="bold", x=0.01, ha="left")
    return drawn


def _title(drawing: Drawing | Motion) -> str:
    """Whose figure it is, its page where the source names it, and what it shows."""
    return f"{figure(drawing.name).cited}: {drawing.title}"


def _draw_axes(drawing: Drawing) -> Figure:
    drawn = Figure(figsize=(9.0, 5.4), layout="constrained")
    axes: Any = drawn.add_subplot(projection="polar" if drawing.polar else None)
    ink = inks([one.name for one in drawing.curves if not one.behind])
    for one in drawing.curves:
        draw_curve(axes, one, ink)
    axes.grid(visible=True)
    (_finish_polar if drawing.polar else _finish_plane)(axes, drawing)
    if drawing.note:
        drawn.supxlabel(drawing.note, fontsize=9, color=GREY, x=0.01, ha="left")
    if any(one.name for one in drawing.curves):
        axes.legend(**BESIDE, labelspacing=1.1 if any(one.ring for one in drawing.curves) else None)
    return drawn


def _finish_plane(axes: Any, drawing: Drawing) -> None:
    axes.set_xlabel(drawing.x_label)
    axes.set_ylabel(drawing.y_label)
    if drawing.equal:
        axes.set_aspect("equal")
    if drawing.logarithmic:
        axes.set_xscale("log")
        axes.set_yscale("log")
        marked = sorted({float(x) for one in drawing.curves if one.points for x in one.x})
        axes.xaxis.set_major_locator(FixedLocator(marked))
        axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 3, 5)))
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_minor_locator(NullLocator())
            axis.set_major_formatter("{x:g}")


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
