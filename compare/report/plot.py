"""A report's figures: error against evaluations and against seconds, methods and solvers together."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from compare.report.problems import reported_by
from compare.report.table import cases
from compare.show.plot import draw_curves, wide_figure
from compare.show.plot_style import inks, saved, style

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from matplotlib.figure import Figure

    from compare.report.records import Report, WorkPoint

__all__ = ["FIGURES", "figures", "files", "names"]

FIGURES: dict[str, tuple[str, str, Callable[[WorkPoint], float]]] = {
    "evaluations": ("Work and precision", "evaluations", lambda point: point.evaluations or 0),
    "seconds": ("Time and precision", "seconds", lambda point: point.seconds or 0.0),
}
"""Each figure's title, the label of its axis, and a point's place along it."""


def files(report: Report) -> dict[str, bytes]:
    """Every figure of the report, as PNG and as SVG, by file name."""
    with style():
        return {
            f"{name}.{suffix}": image for name, figure in figures(report) for suffix, image in saved(figure).items()
        }


def names(point: WorkPoint) -> dict[str, str]:
    """The names of the figures of a point's problem, and their titles."""
    amplitude = point.amplitude if isinstance(point.amplitude, str) else repr(point.amplitude)
    kind = reported_by(point.family)
    stem = f"{kind.name}-{kind.symbol}-{amplitude}"
    return {f"{stem}-{kind}": title for kind, (title, _, _) in FIGURES.items()}


def figures(report: Report) -> Iterator[tuple[str, Figure]]:
    """Every figure with its name, two a problem."""
    ink = inks(list(dict.fromkeys(point.name for point in report.points)))
    for case, points in cases(report):
        for (name, title), (_, label, work) in zip(names(points[0]).items(), FIGURES.values(), strict=True):
            curves: dict[str, list[WorkPoint]] = {}
            for point in sorted(points, key=_effort):
                if math.isfinite(point.max_error) and point.max_error > 0:
                    curves.setdefault(point.name, []).append(point)
            units = reported_by(points[0].family).error_units
            error = f"largest error  [{units}]" if units else "largest error"
            figure, axes = wide_figure(f"{title}, {case}", top=0.92, error=error)
            draw_curves(axes, curves, ink, work)
            axes.set_xlabel(label)
            yield name, figure


def _effort(point: WorkPoint) -> float:
    """What orders the points of a curve from the least effort on: the clock alone would tangle it."""
    return point.setting if point.kind == "method" else -point.setting
