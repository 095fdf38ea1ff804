"""Which figures there are, by the names of their files, in the order of the sources' pages."""

from __future__ import annotations

from typing import TYPE_CHECKING

from compare.sources.figures import curve, descents, motion, pendulum, polar

if TYPE_CHECKING:
    from collections.abc import Callable

    from compare.sources.figures.drawing import Drawing

__all__ = ["FIGURES"]

FIGURES: dict[str, Callable[[], Drawing | motion.Motion]] = {
    "report-figure-2": pendulum.figure2,
    "report-figure-3": pendulum.figure3,
    "report-figure-4": pendulum.figure4,
    "report-figure-5": pendulum.figure5,
    "report-figure-6": pendulum.figure6,
    "report-figure-7": pendulum.figure7,
    "report-figure-10": pendulum.figure10,
    "report-figure-11": pendulum.figure11,
    "thesis-figure-6": curve.figure6,
    "thesis-figure-7": curve.figure7,
    "thesis-figure-8": motion.figure8,
    "thesis-figure-9": descents.figure9,
    "thesis-figure-10": descents.figure10,
    "thesis-figure-11": descents.figure11,
    "thesis-figure-12": descents.figure12,
    "thesis-figure-13": motion.figure13,
    "thesis-figure-14": polar.figure14,
    "thesis-figure-15": polar.figure15,
}
"""What computes each."""
