"""A motion as an animated GIF, at a quarter of real time: what lasts a second is over before it is seen.

What stands still is drawn once; only bodies, clock and arrivals are drawn anew, over it.

The frames have one palette, so that nothing that stands still flickers.
"""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from compare.show.plot_style import GREY, inks
from compare.sources.figures.scene import draw_bodies, draw_paths

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from compare.sources.figures.motion import Body, Motion

__all__ = ["FRAMES_PER_SECOND", "HELD", "PACE", "SLOWER", "animated", "gif"]

COLOURS = 256
"""The most that the format has."""


def animated(frames: Sequence[np.ndarray], durations: Sequence[int]) -> bytes:
    """The file, shown for ever: frames uint8 of [height, width, 3], each for its duration in ms.

    Pillow chooses the colours, for all frames at once, so that no colour is far from the nearest of them; its other
    ways leave white grey.
    """
    height = len(frames[0])
    strip = Image.fromarray(np.concatenate(frames))
    strip = strip.quantize(COLOURS, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE)
    tops = range(0, strip.height, height)
    first, *others = (strip.crop((0, top, strip.width, top + height)) for top in tops)
    buffer = io.BytesIO()
    first.save(buffer, "GIF", save_all=True, append_images=others, duration=list(durations), loop=0, optimize=False)
    return buffer.getvalue()


FRAMES_PER_SECOND = 25
"""The format counts hundredths of a second, and a frame is then four."""
SLOWER, PACE = 4, "¼ of real time"
"""A second of the motion lasts so many, as the picture says."""
HELD = 2000
"""Milliseconds for which the end is shown before the motion begins again."""
SIZE, DPI = (6.4, 4.4), 110
PACE_AT = 0.25
"""Where in the axes the pace begins, beside the clock."""
CLOCK, FIRST_ROW, ROW = 0.93, 0.83, 0.075
"""Heights in the axes: of the clock, of the first body's line below it, and from one line to the next."""
ARRIVALS = 0.34
"""Where in the axes the arrivals begin, beside the names."""


def gif(motion: Motion, title: str) -> bytes:
    """The file, in the style in force; nothing in it tells when it was made."""
    frames = list(_frames(motion, title))
    return animated(frames, [1000 // FRAMES_PER_SECOND] * (len(frames) - 1) + [HELD])


def _frames(motion: Motion, title: str) -> Iterator[np.ndarray]:
    """The pixels of each frame: [height, width, 3]."""
    canvas, axes = _still(motion, title)
    still = canvas.copy_from_bbox(axes.figure.bbox)
    times = motion.times(FRAMES_PER_SECOND * SLOWER)
    places = np.stack([body.places(times) for body in motion.bodies], axis=1)
    markers = draw_bodies(axes, motion, places[0])
    style: dict[str, Any] = {"va": "center", "transform": axes.transAxes}
    clock = axes.text(0.02, CLOCK, "", fontsize=13, fontweight="bold", **style)
    arrivals = [axes.text(ARRIVALS, FIRST_ROW - row * ROW, "", **style) for row in range(len(motion.bodies))]
    for time, now in zip(times, places, strict=True):
        clock.set_text(f"t = {time:.2f} s")
        for body, marker, arrival, (x, y) in zip(motion.bodies, markers, arrivals, now, strict=True):
            marker.set_data([x], [y])
            arrival.set_text(_arrived(body, time))
        canvas.restore_region(still)
        for artist in (*markers, clock, *arrivals):
            axes.draw_artist(artist)
        yield np.asarray(canvas.buffer_rgba())[..., :3].copy()


def _still(motion: Motion, title: str) -> tuple[FigureCanvasAgg, Any]:
    """What does not move, drawn: the canvas and its axes."""
    figure = Figure(figsize=SIZE, dpi=DPI, layout="constrained", facecolor="white")
    canvas = FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    draw_paths(axes, motion)
    ink = inks([body.name for body in motion.bodies])
    for row, body in enumerate(motion.bodies):
        own, height = ink[body.name], FIRST_ROW - row * ROW
        axes.plot([0.03], [height], own.marker, color=own.colour, transform=axes.transAxes)
        axes.text(0.06, height, body.name, va="center", transform=axes.transAxes)
    axes.text(PACE_AT, CLOCK, PACE, va="center", color=GREY, transform=axes.transAxes)
    figure.suptitle(title, fontsize=12, fontweight="bold", x=0.01, ha="left")
    figure.supxlabel(motion.note, fontsize=8.5, color=GREY, x=0.01, ha="left")
    canvas.draw()
    return canvas, axes


def _arrived(body: Body, time: float) -> str:
    return f"arrived at {body.arrival:.4f} s" if time >= body.arrival else ""
