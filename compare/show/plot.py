"""A study's figures, as PNG and SVG: error against N, work-precision, energy drift over time, phase portrait."""

from __future__ import annotations

import math
import re
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter

from compare.show.plot_style import GREY, Ink, inks, label_right, saved, style

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from compare.measure.records import AdaptiveCell, Case, Cell, Study, Trace

__all__ = ["FIGURES", "draw_curves", "figures", "files", "label", "told", "wide_figure"]

_PANEL_COLUMNS = 4
_FAINTEST_DRIFT = 1e-17
_BESIDE = 4.0
_ANGLE_ERROR = "largest error |θ − θ_exact|  [rad]"
_SYMBOLS = {"theta0": "θ₀", "omega0": "ω₀", "theta": "θ", "phi": "φ"}


_NAMES = re.compile(rf"\b({'|'.join(_SYMBOLS)})\b")
_SPECIAL = re.compile(r"[^\w.+-]+")


def files(study: Study) -> dict[str, bytes]:
    """Every figure of the study, as PNG and as SVG, by file name."""
    with style():
        return {f"{name}.{suffix}": image for name, figure in figures(study) for suffix, image in saved(figure).items()}


def figures(study: Study) -> Iterator[tuple[str, Figure]]:
    """Every figure with its name; one set an amplitude where the study has several."""
    for case in study.cases:
        suffix = told(case) if len(study.cases) > 1 else ""
        for name, draw in _drawn(case) if study.error_vs_n else [("work-precision", work_figure)]:
            yield f"{study.problem}-{name}{suffix}", draw(study, case)


def told(case: Case) -> str:
    """The end of a figure's name that tells its case from others."""
    return "-" + _SPECIAL.sub("-", "-".join(f"{name}-{value}" for name, value in case.inputs))


def _drawn(case: Case) -> Iterator[tuple[str, Callable[[Study, Case], Figure]]]:
    """The figures that show what the case has: a drift an invariant, a phase portrait where there is a velocity."""
    yield from FIGURES.items()
    for place, invariant in enumerate(case.invariants):
        yield f"{_SPECIAL.sub('-', invariant.name)}-drift", partial(drift_figure, place=place)
    if case.axes:
        yield "phase-portrait", phase_figure


def error_figure(study: Study, case: Case) -> Figure:
    """Largest error against N, with the declared orders as dashed slopes; hollow grey cells are rounding."""
    figure, axes = wide_figure(f"Error against number of steps, {label(case)}", 0.84, _error_label(case))
    curves = _curves(study, case)
    draw_curves(axes, curves, _ink(study), lambda cell: cell.n)
    _draw_slopes(axes, study, curves)
    axes.set_xlabel("number of steps N")
    _add_step_sizes(axes, curves, case.step)
    return figure


def work_figure(study: Study, case: Case) -> Figure:
    """Largest error against evaluations of the right-hand side."""
    figure, axes = wide_figure(f"Work and precision, {label(case)}", 0.92, _error_label(case))
    draw_curves(axes, _curves(study, case) | _adaptive_curves(study, case), _ink(study), lambda cell: cell.evaluations)
    axes.set_xlabel("evaluations of the right-hand side")
    return figure


def drift_figure(study: Study, case: Case, place: int = 0) -> Figure:
    """|Drift| of one invariant over time, a panel a method on one logarithmic scale, with its running maximum."""
    traces = _traces(study, case)
    name, change = case.invariants[place].drift
    figure, panels = _panel_figure(traces, f"{name} drift over time", case)
    ink = _ink(study)
    finite = [abs(d) for trace in traces for d in trace.drifts[place] if math.isfinite(d) and d]
    low = max(min(finite, default=1.0), _FAINTEST_DRIFT)
    for trace, axes in zip(traces, panels, strict=True):
        size = np.abs(np.asarray(trace.drifts[place], dtype=float))
        size[~np.isfinite(size) | (size < low)] = np.nan
        axes.plot(trace.time, size, color=ink[trace.method].colour, linewidth=0.8, alpha=0.6)
        axes.plot(trace.time, np.fmax.accumulate(size), color=ink[trace.method].colour, linewidth=2)
        axes.set_yscale("log")
        axes.grid(visible=True)
    figure.supxlabel(f"time t{f' [{case.step}]' if case.step else ''};  thick: largest so far")
    figure.supylabel("|E − E₀| / (E₀ − E_min)" if name == "Energy" else f"|{change}|")
    return figure


def phase_figure(study: Study, case: Case) -> Figure:
    """The orbit in the plane of place and velocity, a panel a method, over the exact one in grey."""
    traces = _traces(study, case)
    figure, panels = _panel_figure(traces, "Phase portrait", case)
    ink = _ink(study)
    exact = next(orbit for orbit in study.exact if orbit.case == case).states
    q, v = case.pair
    for trace, axes in zip(traces, panels, strict=True):
        axes.plot(exact[:, q], exact[:, v], color="#C8C8C8", linewidth=5, solid_capstyle="round")
        axes.plot(trace.states[:, q], trace.states[:, v], color=ink[trace.method].colour, linewidth=1.1)
        axes.set_xlim(_framed(exact[:, q]))
        axes.set_ylim(_framed(exact[:, v]))
        axes.grid(visible=True)
    figure.supxlabel(f"{case.axes[0]};  thick grey: exact orbit")
    figure.supylabel(case.axes[1])
    return figure


def label(case: Case) -> str:
    """The case's label, with the symbols of its inputs."""
    return _NAMES.sub(lambda found: _SYMBOLS[found[0]], case.label)


def _error_label(case: Case) -> str:
    """What an axis of errors shows."""
    return _ANGLE_ERROR if case.unit == "rad" else f"largest {case.error}"


FIGURES: dict[str, Callable[[Study, Case], Figure]] = {
    "error-vs-n": error_figure,
    "work-precision": work_figure,
}
"""The figures of every case; ``_drawn`` adds those that show what not every case has."""


def _ink(study: Study) -> dict[str, Ink]:
    """The same ink for a method in every figure; methods of one order are neighbours, hence of different colours."""
    declared = {fit.method: fit.declared_order for fit in study.order}
    fixed = sorted(dict.fromkeys(cell.method for cell in study.error_vs_n), key=lambda m: declared.get(m, 0))
    return inks([*fixed, *dict.fromkeys(cell.name for cell in study.adaptive or ())])


def _curves(study: Study, case: Case) -> dict[str, list[Cell]]:
    """The cells of each method that a logarithmic axis can show, by increasing N."""
    curves: dict[str, list[Cell]] = {}
    for cell in sorted(study.error_vs_n, key=lambda cell: cell.n):
        if cell.case == case and math.isfinite(cell.max_error) and cell.max_error > 0:
            curves.setdefault(cell.method, []).append(cell)
    return curves


def _adaptive_curves(study: Study, case: Case) -> dict[str, list[AdaptiveCell]]:
    """The cells of each pair and controller that a logarithmic axis can show, by falling tolerance."""
    curves: dict[str, list[AdaptiveCell]] = {}
    for cell in sorted(study.adaptive or (), key=lambda cell: -cell.rtol):
        if cell.case == case and math.isfinite(cell.max_error) and cell.max_error > 0:
            curves.setdefault(cell.name, []).append(cell)
    return curves


def _traces(study: Study, case: Case) -> list[Trace]:
    order = list(_ink(study))
    found = [trace for trace in study.traces if trace.case == case]
    return sorted(found, key=lambda trace: order.index(trace.method))


def wide_figure(title: str, top: float, error: str = _ANGLE_ERROR) -> tuple[Figure, Any]:
    """One logarithmic pair of axes, as high as `top`, with room at the right for labels."""
    figure = Figure(figsize=(10.5, 6.4))
    axes = figure.add_axes((0.08, 0.095, 0.65, top - 0.095))
    figure.text(0.08, 0.95, title, fontsize=13, fontweight="bold")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.grid(visible=True, which="major")
    axes.set_ylabel(error)
    return figure, axes


def draw_curves(axes: Any, curves: dict[str, list[Any]], ink: dict[str, Ink], work: Callable[[Any], float]) -> None:
    """Curves in their inks as far as they show order, thin and hollow where they are rounding, named at the right.

    A cell of a curve has ``max_error`` and ``floor``; ``work`` is its place along the axis.
    """
    ends = {}
    for method, cells in curves.items():
        own = ink[method]
        order = [cell for cell in cells if not cell.floor]
        x, y = [work(cell) for cell in cells], [cell.max_error for cell in cells]
        axes.plot(x, y, color="#B5B5B5", linewidth=0.7, zorder=1.5)
        axes.plot(
            x, y, own.marker, markerfacecolor="white", markeredgecolor="#A0A0A0", markersize=4, zorder=1.6, linestyle=""
        )
        axes.plot(
            [work(cell) for cell in order],
            [cell.max_error for cell in order],
            color=own.colour,
            marker=own.marker,
            linestyle=own.dashes,
            zorder=3,
        )
        ends[method] = (float(x[-1]), y[-1])
    if curves:
        axes.set_xlim(_decades([work(cell) for cells in curves.values() for cell in cells], 1.6))
        axes.set_ylim(_decades([cell.max_error for cells in curves.values() for cell in cells], 2 * _BESIDE))
    _set_ticks(axes.xaxis)
    _set_ticks(axes.yaxis)
    label_right(axes, ends, ink)
    if any(cell.floor for cells in curves.values() for cell in cells):
        axes.text(0.012, 0.015, "hollow grey: rounding, not order", color=GREY, transform=axes.transAxes)


def _draw_slopes(axes: Any, study: Study, curves: dict[str, list[Cell]]) -> None:
    """A dashed line error = C N^-p beside the curves of each declared order p, where N is large."""
    declared = {fit.method: fit.declared_order for fit in study.order}
    low = axes.get_ylim()[0]
    points = [(cell.n, cell.max_error) for cells in curves.values() for cell in cells]
    for order in sorted(set(declared.values())):
        cells = [cell for method, found in curves.items() if declared.get(method) == order for cell in found]
        ends = _slope_ends([(cell.n, cell.max_error) for cell in cells if not cell.floor], points, order, low)
        if ends:
            _draw_slope(axes, ends, order)


def _slope_ends(
    own: Sequence[tuple[int, float]], others: Sequence[tuple[int, float]], order: int, low: float
) -> tuple[tuple[float, float], tuple[float, float]] | None:
    """A line of slope -order under the lowest of its own points or over the highest, whichever is clearer of others."""
    first, last = min(own, default=(0, 0.0))[0], max(own, default=(0, 0.0))[0]
    if first == last:
        return None
    middle = math.sqrt(first * last)
    constants = [math.log(error) + order * math.log(n) for n, error in own if n >= middle]
    near = [(n, error) for n, error in others if middle <= n <= last]

    def clearance(log_c: float) -> float:
        return min(abs(math.log(error) + order * math.log(n) - log_c) for n, error in near)

    log_c = max(min(constants) - math.log(_BESIDE), max(constants) + math.log(_BESIDE), key=clearance)
    stop = min(last, math.exp((log_c - math.log(low)) / order))
    if stop <= middle:
        return None
    start, end = ((n, math.exp(log_c - order * math.log(n))) for n in (middle, stop))
    return start, end


def _draw_slope(axes: Any, ends: Sequence[tuple[float, float]], order: int) -> None:
    """The line, and its order written across it along its direction."""
    (x0, y0), (x1, y1) = axes.transData.transform(ends)
    middle = axes.transData.inverted().transform(((x0 + x1) / 2, (y0 + y1) / 2))
    axes.plot(*zip(*ends, strict=True), color=GREY, linestyle=(0, (6, 4)), linewidth=1.1, zorder=2)
    axes.text(
        *middle,
        f"order {order}",
        rotation=math.degrees(math.atan2(y1 - y0, x1 - x0)),
        rotation_mode="anchor",
        ha="center",
        va="center",
        color="#555555",
        fontsize=9,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.0},
        zorder=2.1,
    )


def _add_step_sizes(axes: Any, curves: dict[str, list[Cell]], unit: str) -> None:
    """The step size along the top, running down as N runs up."""
    cells = [cell for cells in curves.values() for cell in cells]
    if not cells:
        return
    t_end = float(f"{cells[0].n * cells[0].h:.12g}")
    top = axes.twiny()
    top.set_xscale("log")
    top.set_xlim([t_end / n for n in axes.get_xlim()])
    _set_ticks(top.xaxis)
    top.spines["top"].set_visible(True)
    top.set_xlabel(f"step size h = {t_end:g}/N{f' [{unit}]' if unit else ''}", color=GREY)


def _panel_figure(traces: Sequence[Trace], title: str, case: Case) -> tuple[Figure, list[Any]]:
    """A panel a trace, all on the same axes."""
    columns = max(min(_PANEL_COLUMNS, len(traces)), 1)
    rows = max(math.ceil(len(traces) / columns), 1)
    figure = Figure(figsize=(max(1.2 + 2.5 * columns, 6.2), max(1.3 + 2.0 * rows, 4.0)), layout="constrained")
    grid = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    panels = list(grid.flat)
    for axes in panels[len(traces) :]:
        axes.set_axis_off()
    steps = {trace.n for trace in traces}
    for trace, axes in zip(traces, panels, strict=False):
        axes.set_title(trace.method if len(steps) == 1 else f"{trace.method}, N = {trace.n}", fontsize=10)
    at = f", N = {min(steps)}" if len(steps) == 1 else ""
    figure.suptitle(f"{title}, {label(case)}{at}", fontsize=13, fontweight="bold", x=0.01, ha="left")
    return figure, panels[: len(traces)]


def _set_ticks(axis: Any) -> None:
    """Powers of ten; over a short range 1, 2 and 5 times them, as plain numbers."""
    low, high = sorted(axis.get_view_interval())
    if high < 30 * low:
        axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axis.set_major_formatter(FormatStrFormatter("%g"))
    axis.set_minor_formatter(NullFormatter())


def _decades(values: Sequence[float], margin: float) -> tuple[float, float]:
    """The range of the values with the margin, a factor, on both sides; a decade at least."""
    low, high = min(values) / margin, max(values) * margin
    more = max(math.sqrt(10 * low / high), 1.0)
    return low / more, high * more


def _framed(values: Any) -> tuple[float, float]:
    """The range of the values with room around it, so that an orbit which grows is seen to leave."""
    low, high = float(np.min(values)), float(np.max(values))
    room = max(0.35 * (high - low), 1e-6 * max(abs(low), abs(high)), 1e-200)
    return low - room, high + room
