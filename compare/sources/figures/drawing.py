"""A figure as data: its curves by name, and what stands on its axes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["Curve", "Drawing", "curve"]


@dataclass(frozen=True)
class Curve:
    """One curve.

    Attributes:
        name: what is written beside it, or "".
        x, y: its points in the units of the axes; angle in rad and radius where the figure is polar.
        points: whether its points are marked and not joined.
        ring: the size of its open markers in points, where others may lie on them; 0 for full ones.
        behind: whether it is the thick grey curve that the others are to be seen against.
    """

    name: str
    x: np.ndarray
    y: np.ndarray
    points: bool = False
    behind: bool = False
    ring: float = 0.0


@dataclass(frozen=True)
class Drawing:
    """One figure.

    Attributes:
        item: the source's figure, such as "thesis figure 9".
        title: what it shows, in one line.
        x_label, y_label: quantities with their units; of a polar figure what its angle and its radius are.
        curves: those behind first.
        polar: whether the curves are angle and radius.
        equal: whether a unit is as long on both axes.
        logarithmic: whether both axes are; the marked points are then the ticks of x.
        note: what is to be said of it, or "".
    """

    item: str
    title: str
    x_label: str
    y_label: str
    curves: tuple[Curve, ...]
    polar: bool = False
    equal: bool = False
    logarithmic: bool = False
    note: str = ""

    @property
    def name(self) -> str:
        """The name of its files."""
        return self.item.replace(" ", "-")


def curve(name: str, x: Sequence[Any] | np.ndarray, y: Sequence[Any] | np.ndarray, **options: Any) -> Curve:
    """A curve of any numbers."""
    return Curve(name, np.asarray(x, dtype=float), np.asarray(y, dtype=float), **options)
