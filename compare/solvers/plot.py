"""The figures of a study of solvers: error against tolerance, against evaluations and against seconds."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from compare.show.plot import draw_curves, told, wide_figure
from compare.show.plot import label as label_of
from compare.show.plot_style import inks, saved, style
from compare.solvers.records import SolverStudy

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from matplotlib.figure import Figure

    from compare.measure.records import Case
    from compare.solvers.records import SolverCell

__all__ = ["FIGURES", "figures", "files"]

FIGURES: dict[str, tuple[str, str, Callable[[SolverCell], float]]] = {
    "error-vs-rtol": ("Error against tolerance", "tolerance rtol asked for", lambda cell: cell.rtol),
    "work-precision": (
        "Work and precision",
        "evaluations, as each solver counts them",
        lambda cell: cell.evaluations or 0,
    ),
    "time-precision": ("Time and precision", "seconds", lambda cell: cell.seconds or 0.0),
}
"""Each figure's title, the label of its axis, and a cell's place along it."""


def files(studies: SolverStudy | Sequence[SolverStudy]) -> dict[str, bytes]:
    """Every figure of one study or of several, as PNG and as SVG, by file name."""
    several = [studies] if isinstance(studies, SolverStudy) else studies
    drawn: dict[str, bytes] = {}
    with style():
        for study in several:
            apart = f"-t-{study.parameters['t_end']!r}" if _twice(study, several) else ""
            for name, figure in figures(study):
                drawn |= {f"{name}{apart}.{suffix}": image for suffix, image in saved(figure).items()}
    return drawn


def _twice(study: SolverStudy, several: Sequence[SolverStudy]) -> bool:
    """Whether there is another study of the same problem, which an end of its own tells from this one."""
    return sum(other.problem == study.problem for other in several) > 1


def figures(study: SolverStudy) -> Iterator[tuple[str, Figure]]:
    """Every figure with its name; one set an amplitude where the study has several."""
    for case in study.cases:
        suffix = told(case) if len(study.cases) > 1 else ""
        for name in FIGURES:
            yield f"solvers-{study.problem}-{name}{suffix}", _figure(study, name, case)


def _figure(study: SolverStudy, name: str, case: Case) -> Figure:
    title, label, work = FIGURES[name]
    ink = inks(list(dict.fromkeys(cell.solver for cell in study.error_vs_rtol)))
    curves: dict[str, list[SolverCell]] = {}
    looser_first = name != "error-vs-rtol"  # a curve ends at the right, where it is named
    for cell in sorted(study.error_vs_rtol, key=lambda cell: cell.rtol, reverse=looser_first):
        if cell.case == case and math.isfinite(cell.max_error) and cell.max_error > 0:
            curves.setdefault(cell.solver, []).append(cell)
    figure, axes = wide_figure(f"{title}, {label_of(case)}", top=0.92)
    draw_curves(axes, curves, ink, work)
    axes.set_xlabel(label)
    return figure
