"""Which figures there are, in the order of the sources' pages."""

from __future__ import annotations

from typing import TYPE_CHECKING

from compare.figures import descents, polar

if TYPE_CHECKING:
    from collections.abc import Callable

    from compare.figures.drawing import Drawing

__all__ = ["FIGURES"]

FIGURES: tuple[Callable[[], Drawing], ...] = (
    descents.figure9,
    descents.figure10,
    descents.figure11,
    descents.figure12,
    polar.figure14,
    polar.figure15,
)
"""What computes each."""
