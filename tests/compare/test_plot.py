"""Figures: all are drawn, alike every time, whatever the numbers."""

from __future__ import annotations

import dataclasses
import itertools
import math
import re
import xml.etree.ElementTree as ET
from functools import partial

import matplotlib as mpl
import numpy as np
import pytest
from made_study import METHODS, made_case, made_study
from matplotlib.text import Text

from compare import study as studies
from compare.show import plot
from compare.show.plot_style import fit, inks, saved, spread, style

CASE = made_case(1.0)
FEW = ("euler", "verlet", "suzuki4")
NAMES = ("error-vs-n", "work-precision", "energy-drift", "phase-portrait")


@pytest.fixture(scope="module")
def drawn():
    return plot.files(made_study(methods=FEW))


def test_every_figure_is_a_png_and_an_svg(drawn):
    assert sorted(drawn) == sorted(f"pendulum-{name}.{suffix}" for name in NAMES for suffix in ("png", "svg"))
    for name, image in drawn.items():
        if name.endswith("png"):
            assert image.startswith(b"\x89PNG")
        else:
            assert ET.fromstring(image).tag.endswith("svg")  # noqa: S314 - made here


def test_figures_are_the_same_bytes_every_time(drawn):
    assert plot.files(made_study(methods=FEW)) == drawn
    assert not any(b"<dc:date>" in image for image in drawn.values())


def test_several_amplitudes_have_their_own_figures():
    with style():
        names = [name for name, _ in plot.figures(made_study(theta0=(1.0, 2.5), methods=("verlet",)))]
    assert len(set(names)) == 8
    assert "pendulum-phase-portrait-theta0-2.5" in names


def test_error_figure_labels_axes_methods_and_orders():
    with style():
        figure = plot.error_figure(made_study(methods=FEW), CASE)
    axes = figure.axes[0]
    texts = {text.get_text() for text in axes.texts}
    assert {"euler", "verlet", "suzuki4", "order 1", "order 2", "order 4", "hollow grey: rounding, not order"} <= texts
    assert axes.get_xscale() == axes.get_yscale() == "log"
    assert "[rad]" in axes.get_ylabel()
    assert "[s]" in figure.axes[1].get_xlabel()


@pytest.mark.parametrize("order", [1, 2, 4])
def test_reference_slopes_have_the_slope_of_their_order(order):
    with style():
        axes = plot.error_figure(made_study(methods=FEW), CASE).axes[0]
    slopes = []
    for line in axes.lines:
        if line.get_transform() == axes.transData and len(line.get_xdata()) == 2:
            (x0, x1), (y0, y1) = line.get_data()
            slopes.append(math.log(y1 / y0) / math.log(x1 / x0))
    assert min(abs(slope + order) for slope in slopes) < 1e-9


def test_work_figure_counts_evaluations():
    with style():
        axes = plot.work_figure(made_study(methods=("rk4",)), CASE).axes[0]
    assert max(axes.lines[0].get_xdata()) == 4 * 2**20


def test_numbers_that_a_logarithm_cannot_show_are_left_out():
    study = made_study(methods=("euler",))
    odd = (0.0, math.inf, math.nan)
    cells = [dataclasses.replace(study.error_vs_n[i], max_error=error) for i, error in enumerate(odd)]
    trace = dataclasses.replace(study.traces[0], drifts=np.full((1, 401), math.nan))
    for kept in ((), study.error_vs_n[3:4], study.error_vs_n[3:]):
        sparse = dataclasses.replace(study, error_vs_n=(*cells, *kept), traces=(trace,))
        assert len(plot.files(sparse)) == 8


def test_each_method_has_its_own_ink():
    ink = inks(list(METHODS))
    assert len(set(ink.values())) == len(METHODS)
    for one, other in itertools.combinations(ink.values(), 2):
        assert one.marker != other.marker
        assert one.colour != other.colour or one.dashes != other.dashes


def test_the_users_settings_are_left_alone():
    before = dict(mpl.rcParams)
    plot.files(made_study(methods=("verlet",)))
    assert dict(mpl.rcParams) == before


def test_labels_are_spread_in_order_and_near_their_curves():
    assert spread([0.1, 0.5, 0.9], 0.05) == [0.1, 0.5, 0.9]
    crowded = spread([0.5, 0.5, 0.5], 0.1)
    assert crowded == pytest.approx([0.4, 0.5, 0.6])
    assert spread([-1.0, 2.0], 0.1) == [0.0, 1.0]
    assert spread([], 0.1) == []


def test_an_orbit_that_does_not_move_is_drawn():
    study = made_study(methods=("verlet",))
    still = [
        dataclasses.replace(trace, states=np.repeat([[1.0, 0.0]], 401, axis=0))
        for trace in (study.traces[0], study.exact[0])
    ]
    assert len(plot.files(dataclasses.replace(study, traces=(still[0],), exact=(still[1],)))) == 8


def test_a_case_has_the_figures_of_what_it_has():
    study = made_study(methods=("verlet",))
    bare = dataclasses.replace(CASE, invariants=(), axes=(), step="", unit="", error="|x - exact|/max |x|")
    cells = tuple(dataclasses.replace(cell, case=bare) for cell in study.error_vs_n)
    with style():
        found = dict(plot.figures(dataclasses.replace(study, cases=(bare,), error_vs_n=cells)))
    assert list(found) == ["pendulum-error-vs-n", "pendulum-work-precision"]
    axes = found["pendulum-error-vs-n"].axes
    assert axes[0].get_ylabel() == "largest |x - exact|/max |x|"
    assert axes[1].get_xlabel() == "step size h = 10/N"


def test_a_label_is_drawn_with_the_symbols_of_its_inputs():
    with style():
        figure = plot.work_figure(made_study(methods=("verlet",)), CASE)
    assert "θ₀ = 1.0 rad" in figure.texts[0].get_text()


STUDIES = {
    "pendulum": ("euler", "symplectic_euler_adjoint", "sofroniou_spaletta10"),
    "brachistochrone": ("euler", "rk4_misprinted", "three_eighths"),
    "tautochrone": ("euler", "rk4_misprinted", "three_eighths"),
    "descent": ("euler", "rk4_misprinted", "three_eighths"),
    "polar": ("euler", "rk4_misprinted", "three_eighths"),
}


@pytest.fixture(scope="module", params=STUDIES)
def drawn_study(request):
    study = partial(studies.study, request.param)
    return study(methods=STUDIES[request.param], n=(32, 100), traces=True, compensated=True)


def with_methods(study, count):
    """The same study as if fewer methods had been asked for."""
    names = list(dict.fromkeys(cell.method for cell in study.error_vs_n))[:count]
    kept = {
        table: tuple(record for record in getattr(study, table) if record.method in names)
        for table in ("error_vs_n", "order", "energy_drift", "traces")
    }
    return dataclasses.replace(study, **kept)


def test_every_text_lies_within_its_figure_and_the_n_is_one_that_was_asked_for(drawn_study):
    for count in (1, 2, 3):
        with style():
            for name, figure in plot.figures(with_methods(drawn_study, count)):
                fit(figure)
                figure.set_dpi(160)  # as it is saved
                figure.draw_without_rendering()
                texts = [text for text in shown(figure) if text.get_text()]
                assert len(texts) >= 3
                assert [text.get_text() for text in texts if leaves(text, figure)] == [], (name, count)
                told = {found for text in texts for found in re.findall(r"N = (\d+)", text.get_text())}
                assert told <= {"100"}
                columns = [text.get_window_extent() for axes in figure.axes for text in titles_of(axes)]
                assert not any(a.overlaps(b) for a, b in itertools.combinations(columns, 2)), (name, count)
    assert {trace.n for trace in drawn_study.traces} == {100}


def titles_of(axes):
    return [
        text for text in axes.get_children() if isinstance(text, Text) and text.get_text() and text not in axes.texts
    ]


def shown(figure):
    """Titles, labels and names; a tick outside of the view is there, and not drawn."""
    yield from figure.texts
    for axes in figure.axes:
        yield from (*axes.texts, *titles_of(axes), axes.xaxis.label, axes.yaxis.label)


def leaves(text, figure):
    box = text.get_window_extent()
    return box.x0 < -1 or box.y0 < -1 or box.x1 > figure.bbox.width + 1 or box.y1 > figure.bbox.height + 1


def test_a_long_title_is_written_in_two_lines():
    label = "end_x = 3.141592653589793 m, end_y = 2.718281828459045 m, and more that must be said of the case in it"
    case = dataclasses.replace(CASE, label=label)
    study = made_study(methods=("verlet",))
    traces = tuple(dataclasses.replace(trace, case=case) for trace in study.traces)
    exact = tuple(dataclasses.replace(trace, case=case) for trace in study.exact)
    with style():
        figure = plot.phase_figure(dataclasses.replace(study, cases=(case,), traces=traces, exact=exact), case)
        saved(figure)
    assert not any(leaves(text, figure) for text in shown(figure))
    assert any("\n" in text.get_text() for text in figure.texts)
