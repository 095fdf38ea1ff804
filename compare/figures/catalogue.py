"""Which figures there are, in the order of the sources' pages."""

from __future__ import annotations

from typing import TYPE_CHECKING

from compare.figures import curve, descents, pendulum, polar, snapshots

if TYPE_CHECKING:
    from collections.abc import Callable

    from compare.figures.drawing import Drawing
    from compare.figures.snapshots import Snapshots

__all__ = ["FIGURES"]

FIGURES: tuple[Callable[[], Drawing | Snapshots], ...] = (
    pendulum.figure2,
    pendulum.figure3,
    pendulum.figure4,
    pendulum.figure5,
    pendulum.figure6,
    pendulum.figure7,
    pendulum.figure10,
    pendulum.figure11,
    curve.figure6,
    curve.figure7,
    snapshots.figure8,
    descents.figure9,
    descents.figure10,
    descents.figure11,
    descents.figure12,
    snapshots.figure13,
    polar.figure14,
    polar.figure15,
)
"""What computes each."""
