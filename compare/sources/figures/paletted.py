"""Frames of pixels as an animated GIF with one palette, so that nothing that stands still flickers.

Pillow's own reduction to a palette rounds colours before it compares them, which leaves white grey.
"""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

import numpy as np
from PIL import Image

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["animated"]

COLOURS = 256
"""The most that the format has."""
CHANNELS = (16, 8, 0)
"""Where red, green and blue stand in a colour of 24 bits."""


def animated(frames: Sequence[np.ndarray], durations: Sequence[int]) -> bytes:
    """The file, shown for ever: frames uint8 of [height, width, 3], each for its duration in ms.

    Its colours are the commonest of the first, the middle and the last frame; others become the nearest of them.
    """
    codes = [_codes(frame) for frame in frames]
    colours = _commonest([codes[0], codes[len(codes) // 2], codes[-1]])
    places = _places(codes, colours)
    palette = _channels(colours).astype(np.uint8).tobytes()
    first, *others = (_image(places[code], palette) for code in codes)
    buffer = io.BytesIO()
    first.save(buffer, "GIF", save_all=True, append_images=others, duration=list(durations), loop=0, optimize=False)
    return buffer.getvalue()


def _commonest(codes: Sequence[np.ndarray]) -> np.ndarray:
    """The colours of most pixels, the commonest first."""
    colours, counts = np.unique(np.concatenate([code.ravel() for code in codes]), return_counts=True)
    return colours[np.argsort(-counts, kind="stable")[:COLOURS]]


def _places(codes: Sequence[np.ndarray], colours: np.ndarray) -> np.ndarray:
    """The nearest colour's place in the palette, for every colour of 24 bits that occurs."""
    occurs = np.zeros(1 << 24, dtype=bool)
    for code in codes:
        occurs[code] = True
    (seen,) = np.nonzero(occurs)
    away = ((_channels(seen)[:, None] - _channels(colours)[None]) ** 2).sum(axis=-1)
    places = np.zeros(1 << 24, dtype=np.uint8)
    places[seen] = np.argmin(away, axis=1)
    return places


def _codes(frame: np.ndarray) -> np.ndarray:
    """Each pixel's colour as one number of 24 bits."""
    red, green, blue = (frame[..., i].astype(np.uint32) << np.uint32(shift) for i, shift in enumerate(CHANNELS))
    codes: np.ndarray = red | green | blue
    return codes


def _channels(colours: np.ndarray) -> np.ndarray:
    """Red, green and blue of each: int64 [colours, 3]."""
    return np.stack([colours.astype(np.int64) >> shift & 255 for shift in CHANNELS], axis=-1)


def _image(places: np.ndarray, palette: bytes) -> Image.Image:
    image = Image.fromarray(places)
    image.putpalette(palette)
    return image
