"""How figures look: one ink a method, direct labels at the right, and files that are the same every time."""

from __future__ import annotations

import io
import math
import textwrap
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

__all__ = ["GREY", "Ink", "fit", "inks", "label_right", "saved", "spread", "style"]

GREY = "#767676"
_OKABE_ITO = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
_MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", ">", "h", "d", "p", "*")
_DASHES: tuple[Any, ...] = ("-", (0, (5, 1.5)), (0, (1.2, 1.2)), (0, (5, 1.2, 1.2, 1.2)))

MARGIN = 0.01
"""Of a figure's width, at its edge."""
PANEL = 0.8
"""Of the width of a column of panels, for the title of one."""
SMALLEST = 0.75
"""A text in one line is at least so large, over what it would be."""

_STYLE = {
    "font.size": 10,
    "axes.titlesize": 12,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": "#444444",
    "axes.linewidth": 0.8,
    "axes.axisbelow": True,
    "grid.color": "#E4E4E4",
    "grid.linewidth": 0.6,
    "lines.linewidth": 1.6,
    "lines.markersize": 5.5,
    "xtick.color": "#444444",
    "ytick.color": "#444444",
    "savefig.facecolor": "white",
    "svg.hashsalt": "horologium",
    "svg.fonttype": "path",
}


@dataclass(frozen=True)
class Ink:
    """Colour, marker and dashes: each pair of methods differs in two of them at least."""

    colour: str
    marker: str
    dashes: Any


def inks(methods: Sequence[str]) -> dict[str, Ink]:
    """An ink for each method, in their order; the colours are told apart by colour-blind readers as well."""
    return {
        method: Ink(
            _OKABE_ITO[i % len(_OKABE_ITO)],
            _MARKERS[i % len(_MARKERS)],
            _DASHES[i // len(_OKABE_ITO) % len(_DASHES)],
        )
        for i, method in enumerate(methods)
    }


@contextmanager
def style() -> Iterator[None]:
    """Matplotlib with the figures' own settings, whatever the user's are, and the user's again afterwards."""
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(_STYLE)
        yield


def saved(figure: Any) -> dict[str, bytes]:
    """The figure as PNG and SVG, by suffix, with no date and no version inside; every text lies within it."""
    fit(figure)
    images = {}
    for suffix, metadata in (("png", {"Software": None}), ("svg", {"Date": None, "Creator": None})):
        buffer = io.BytesIO()
        figure.savefig(buffer, format=suffix, dpi=160, metadata=metadata)
        images[suffix] = buffer.getvalue()
    return images


def fit(figure: Any) -> None:
    """Write in two lines, or smaller, what would leave the figure: titles, labels, and the names of curves."""
    renderer, across = FigureCanvasAgg(figure).get_renderer(), figure.bbox.width
    for text in figure.texts:
        begins = text.get_window_extent(renderer).x0 if text.get_horizontalalignment() == "left" else 0.0
        _narrow(text, (1 - MARGIN) * across - max(begins, 0.0), renderer, lines=True)
    grids = [axes.get_gridspec() for axes in figure.axes]
    columns = max((grid.ncols for grid in grids if grid is not None), default=1)
    for axes in figure.axes:
        for text in axes.findobj(Text, include_self=False):
            if text in axes.texts:
                _narrow(text, (1 - MARGIN) * across - text.get_window_extent(renderer).x0, renderer)
            elif text in axes.get_children():
                _narrow(text, PANEL * across / columns, renderer)


def _narrow(text: Any, room: float, renderer: Any, *, lines: bool = False) -> None:
    """A text that is wider than the room: in two lines where one would be too small, and then smaller."""
    width = text.get_window_extent(renderer).width
    if lines and width * SMALLEST > room:
        text.set_text(textwrap.fill(text.get_text(), math.ceil(len(text.get_text()) * max(room / width, 0.55))))
        width = text.get_window_extent(renderer).width
    if width > room:
        text.set_fontsize(text.get_fontsize() * room / width)


def label_right(axes: Any, ends: dict[str, tuple[float, float]], ink: dict[str, Ink], gap: float = 0.047) -> None:
    """Name the curves at the right of the axes, each with a thin lead from its end (x, y, in data coordinates)."""
    to_axes = axes.transData + axes.transAxes.inverted()
    points = {name: to_axes.transform(end) for name, end in ends.items()}
    names = sorted(points, key=lambda name: float(points[name][1]))
    heights = spread([float(points[name][1]) for name in names], min(gap, 1 / max(len(names) - 1, 1)))
    for name, height in zip(names, heights, strict=True):
        x, y = points[name]
        own = ink[name]
        shared = {"transform": axes.transAxes, "clip_on": False, "color": own.colour}
        axes.plot([x, 1.0, 1.03], [y, y if x >= 0.97 else height, height], linewidth=0.6, alpha=0.55, **shared)
        axes.plot([1.035, 1.095], [height, height], linestyle=own.dashes, **shared)
        axes.plot([1.065], [height], marker=own.marker, **shared)
        axes.text(1.11, height, name, va="center", color=own.colour, transform=axes.transAxes)


def spread(wanted: Sequence[float], gap: float) -> list[float]:
    """Places in [0, 1] at least the gap apart, in the order given (increasing), nearest to the wanted ones.

    Minimises the sum of squares: with z_i = place_i - i gap, an isotonic regression, done by pooling.
    """
    pools: list[list[float]] = []
    for i, place in enumerate(wanted):
        pools.append([place - i * gap])
        while len(pools) > 1 and _mean(pools[-2]) > _mean(pools[-1]):
            last = pools.pop()
            pools[-1].extend(last)
    levels = [_mean(pool) for pool in pools for _ in pool]
    top = 1 - (len(wanted) - 1) * gap
    return [max(min(level, top), 0.0) + i * gap for i, level in enumerate(levels)]


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values)
