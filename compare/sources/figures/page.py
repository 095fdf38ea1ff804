"""A motion as a page for a browser: one file with picture, proven places and the few lines that play them.

The page is ``page.html`` beside this module, with its blanks filled in.
"""

from __future__ import annotations

import html as markup
import io
import json
from pathlib import Path
from string import Template
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import rc_context
from matplotlib.figure import Figure

from compare.show.plot_style import inks
from compare.sources.figures.scene import draw_bodies, draw_paths

if TYPE_CHECKING:
    from compare.sources.figures.motion import Motion

__all__ = ["STEPS_PER_SECOND", "html"]

PAGE = Path(__file__).with_name("page.html")
STEPS_PER_SECOND = 100
"""Places a second: as many as a slow replay shows one by one."""
SIZE = 7.2, 4.5
"""Inches of 72 units of the picture each."""
MARKS = {"o": "●", "s": "■", "^": "▲", "D": "◆", "v": "▼"}
"""The markers in text."""


def html(motion: Motion, title: str) -> bytes:
    """The file, in the style in force; nothing in it tells when it was made."""
    picture, scale = _picture(motion)
    blanks = {
        "title": markup.escape(title),
        "note": markup.escape(motion.note),
        "picture": picture,
        "rows": "\n".join(_rows(motion)),
        "data": json.dumps(_data(motion, scale), ensure_ascii=False, separators=(",", ":")).replace("<", "\\u003c"),
    }
    return Template(PAGE.read_text(encoding="utf-8")).substitute(blanks).encode()


def _picture(motion: Motion) -> tuple[str, tuple[float, float]]:
    """The start as SVG, its bodies in groups ``body-0``, ...; and its units for a metre in x and in y, downwards."""
    places = np.vstack([body.places(np.zeros(1)) for body in motion.bodies])
    with rc_context({"svg.fonttype": "none"}):  # text stays text, for readers that read aloud
        figure = Figure(figsize=SIZE, dpi=72, layout="constrained")
        axes = figure.add_subplot()
        draw_paths(axes, motion)
        for i, marker in enumerate(draw_bodies(axes, motion, places)):
            marker.set_gid(f"body-{i}")
        buffer = io.StringIO()
        figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None, "Format": None, "Type": None})
    text = buffer.getvalue()
    (left, bottom), (right, top) = axes.transData.transform([(0, 0), (1, 1)])
    return text[text.index("<svg") :].strip(), (right - left, bottom - top)


def _rows(motion: Motion) -> list[str]:
    """A line of the page's table for each body."""
    ink = inks([body.name for body in motion.bodies])
    return [
        f'<tr><th scope="row"><span class="mark" style="color:{ink[body.name].colour}" aria-hidden="true">'
        f"{MARKS[ink[body.name].marker]}</span> {markup.escape(body.name)}</th>"
        f'<td id="height-{i}"></td><td id="arrival-{i}"></td></tr>'
        for i, body in enumerate(motion.bodies)
    ]


def _data(motion: Motion, scale: tuple[float, float]) -> dict[str, Any]:
    """What the page plays: places (x, y) in m at every step, at full precision."""
    times = motion.times(STEPS_PER_SECOND)
    return {
        "stepsPerSecond": STEPS_PER_SECOND,
        "unitsPerMetre": [round(value, 6) for value in scale],
        "bodies": [
            {"name": body.name, "arrival": body.arrival, "places": body.places(times).tolist()}
            for body in motion.bodies
        ],
    }
