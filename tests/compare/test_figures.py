"""The sources' figures: each shows the property that its source states, and is written the same every time."""

from __future__ import annotations

import io
import math
from contextlib import redirect_stderr, redirect_stdout
from itertools import pairwise

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from compare.__main__ import main
from compare.sources.figures import curve, descents, motion, pendulum, polar
from compare.sources.figures.catalogue import FIGURES
from compare.sources.figures.drawing import Drawing
from compare.sources.figures.motion import Motion
from compare.sources.figures.show import draw, files
from compare.sources.published.source import figures

SPEED_AT_THE_END = math.sqrt(2 * 9.81 * 2)


def curves(drawing):
    return {one.name: one for one in drawing.curves}


@pytest.fixture(scope="module")
def drawings():
    return [compute() for compute in FIGURES.values()]


@pytest.fixture(scope="module")
def commanded(tmp_path_factory):
    """The folder into which the command line writes all figures, its exit code, and what it says."""
    folder = tmp_path_factory.mktemp("figures") / "drawn"
    out, err = io.StringIO(), io.StringIO()
    with redirect_stdout(out), redirect_stderr(err):
        code = main(["published", "figures", "--out", str(folder)])
    return folder, code, out.getvalue(), err.getvalue()


@pytest.fixture(scope="module")
def written(commanded):
    return {path.name: path.read_bytes() for path in commanded[0].iterdir()}


def test_all_curves_of_figure_9_end_with_the_same_speed():
    for one in descents.figure9().curves:
        assert one.x[0] == pytest.approx(math.pi)
        assert one.y[0] == one.x[-1] == 0
        assert one.y[-1] == pytest.approx(SPEED_AT_THE_END, rel=1e-15)


def test_the_cycloid_of_figure_9_is_the_fastest_at_the_start_and_not_later():
    found = curves(descents.figure9())
    speed = {name: np.interp([1.5, 3.1], one.x[::-1], one.y[::-1]) for name, one in found.items()}
    assert max(speed, key=lambda name: speed[name][1]) == "cycloid"
    assert max(speed, key=lambda name: speed[name][0]) == "quartic"


def test_horizontal_speed_in_figure_10_is_linear_in_height_on_the_cycloid_only():
    for name, one in curves(descents.figure10()).items():
        bend = np.max(np.abs(one.y - math.sqrt(9.81) * (2 - one.x)))
        assert bend < 1e-14 if name == "cycloid" else bend > 0.5


@pytest.mark.parametrize("figure", [descents.figure11, descents.figure12])
def test_all_bodies_of_the_tautochrone_arrive_at_the_same_time(figure):
    *bodies, meeting = figure().curves
    assert len(bodies) == 3
    assert len(set(meeting.x)) == 1
    assert meeting.x[0] == pytest.approx(math.pi / math.sqrt(9.81))
    for one in bodies:
        assert abs(np.interp(meeting.x[0], one.x, one.y)) < 1e-3 < one.y[0]
        assert (one.x[0], one.x[-1]) == (0, 2.1)
    assert len({one.y[0] for one in bodies}) == 3


def test_figure_14_goes_from_the_release_to_nine_lowest_points():
    found = polar.figure14().curves
    assert [one.y[-1] for one in found] == [k / 10 for k in range(1, 10)]
    for one in found:
        assert (one.x[0], one.y[0]) == (0, 1)
        assert np.all(np.diff(one.y) < 0)
        assert np.all(np.diff(one.x) > 0)


def test_figure_15_sweeps_twice_the_half_angle_and_is_its_own_mirror():
    family = {one.name.split(",")[0]: one for one in polar.figure14().curves}
    *paths, lowest = polar.figure15().curves
    whole = {one.name.split(",")[0]: one for one in paths}
    assert len(whole) == 4
    for name, one in whole.items():
        assert one.x[-1] == pytest.approx(2 * family[name].x[-1], rel=1e-14)
        assert one.y == pytest.approx(one.y[::-1], rel=1e-13)
        assert one.x == pytest.approx(one.x[-1] - one.x[::-1], abs=1e-13)
    assert list(lowest.y) == [min(one.y) for one in whole.values()]
    assert math.degrees(whole["Z = 0.2"].x[-1]) == pytest.approx(100.90, abs=0.005)


def test_the_points_of_figure_6_lie_on_the_cycloid_until_its_slope_is_infinite():
    exact, points = curve.figure6().curves
    away = np.abs(np.interp(points.y, exact.y, exact.x) - points.x)
    assert np.max(away[:-1]) < 1e-3
    assert away[-1] > 0.03
    assert points.y[-1] == pytest.approx(1.9999, abs=1e-12)


def test_the_ordinate_of_figure_6_is_what_the_listing_collects():
    drawing = curve.figure6()
    assert drawing.y_label == "−y [m]"
    for one in drawing.curves:
        assert np.all(np.diff(one.y) > 0)
        assert 0 <= one.y[0] < 0.01
        assert 1.99 < one.y[-1] <= 2


def test_the_error_of_figure_7_falls_far_more_slowly_than_of_order_4():
    without_rounding, listed = curve.figure7().curves
    assert list(listed.x) == [100, 200, 300, 400, 500]
    assert listed.y == pytest.approx(without_rounding.y[np.isin(without_rounding.x, listed.x)], rel=1e-9)
    assert 1.2 < math.log(listed.y[0] / listed.y[-1]) / math.log(5) < 1.4


def test_the_curve_of_figure_7_is_computed_and_no_line_between_five_points():
    drawing = curve.figure7()
    without_rounding, listed = drawing.curves
    assert len(without_rounding.x) == 101
    between = np.interp(without_rounding.x, listed.x, listed.y)
    assert np.max(between / without_rounding.y) > 1.1
    slopes = -np.diff(np.log(without_rounding.y)) / np.diff(np.log(without_rounding.x))
    assert np.all(np.diff(slopes) > 0)
    assert drawing.logarithmic
    axes = draw(drawing).axes[0]
    assert list(axes.get_xticks()) == list(listed.x)
    assert (axes.get_xscale(), axes.get_yscale()) == ("log", "log")


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("thesis-figure-6", "−y"),
        ("thesis-figure-7", "our choice"),
        *((f"thesis-figure-{n}", "The quartic is y = 2 (x/π)⁴ m, our choice") for n in (8, 9, 10)),
        *((f"thesis-figure-{n}", "3.13 rad is the listing's, the others are our choice") for n in (11, 12, 13)),
        ("thesis-figure-15", "Z = 0.4 and 0.7 are our choice"),
    ],
)
def test_a_note_says_what_the_source_does_not(name, words):
    assert words in FIGURES[name]().note


def test_the_quartic_of_the_race_is_the_one_that_the_notes_name():
    (quartic,) = (one for one in motion.figure8().paths if one.name == "quartic")
    assert quartic.y == pytest.approx(2 * (quartic.x / math.pi) ** 4, abs=1e-15)


def test_what_coincides_in_the_report_s_figure_10_is_drawn_as_rings_within_rings():
    drawn = draw(pendulum.figure10()).axes[0].get_lines()[1:]
    sizes = [line.get_markersize() for line in drawn]
    assert all(after < 0.85 * before for before, after in pairwise(sizes))
    assert {line.get_markerfacecolor() for line in drawn} == {"none"}


def test_panels_and_notes_of_motions_do_not_touch():
    for compute in (motion.figure8, motion.figure13):
        drawn = draw(compute())
        FigureCanvasAgg(drawn).draw()
        below = [axes.xaxis.label.get_window_extent() for axes in drawn.axes[3:]]
        note = next(text for text in drawn.texts if "9.81" in text.get_text()).get_window_extent()
        assert all(box.y0 > note.y1 for box in below)
        upper, lower = (drawn.axes[i].get_window_extent() for i in (0, 3))
        assert upper.y0 - lower.y1 < 0.45 * upper.height
        assert note.x1 < drawn.bbox.x1


def test_the_report_s_figures_2_to_4_show_a_closed_orbit_that_keeps_its_energy():
    exact, found = pendulum.figure2().curves
    assert np.max(np.abs(np.interp(exact.x, found.x, found.y) - exact.y)) < 2e-4
    orbit = pendulum.figure3().curves[1]
    assert np.max(np.abs(orbit.y**2 / 2 + 9.81 * (math.cos(1) - np.cos(orbit.x)))) < 1e-5
    change = pendulum.figure4().curves[1]
    assert 1e-8 < np.max(np.abs(change.y)) < 1e-5
    assert (found.x[0], found.x[-1]) == (0, pytest.approx(10))


def test_the_report_s_figures_5_to_7_show_that_euler_s_method_gains_energy_and_loses_the_period():
    assert np.min(pendulum.figure5().curves[1].y) < -2 * math.pi
    exact, orbit = pendulum.figure6().curves
    assert np.max(np.abs(orbit.y)) > 2 * np.max(np.abs(exact.y))
    level, energy = pendulum.figure7().curves
    assert energy.y[0] == pytest.approx(level.y[0])
    assert np.all(energy.y[1:] > level.y[0])
    assert energy.y[-1] > level.y[0] + 40


def test_the_report_s_figure_10_parts_euler_and_the_linear_period_from_the_exact_one():
    found = curves(pendulum.figure10())
    exact = found.pop("exact")
    away = {name: np.max(np.abs(np.interp(one.x, exact.x, exact.y) - one.y)) for name, one in found.items()}
    assert {name for name, size in away.items() if size > 0.05} == {"Euler", "linear"}
    assert len(found) == 6
    assert len(set(found["linear"].y)) == 1


def test_the_report_s_figure_11_shows_the_linear_solution_leave_and_the_approximation_stay():
    found = curves(pendulum.figure11())
    exact = found.pop("exact")
    away = {name: np.max(np.abs(one.y - exact.y)) for name, one in found.items()}
    assert away["linear equation"] > 1
    assert away["approximation (4.14)"] < 0.06


def test_every_figure_is_called_what_its_files_are_and_stands_in_the_list_of_pages(drawings):
    names = [drawing.name for drawing in drawings]
    assert names == list(FIGURES) == [figure.name for figure in figures()]


def test_every_figure_is_written_as_png_and_svg_and_those_that_move_as_gif_and_html(drawings, written):
    moving = {drawing.name for drawing in drawings if isinstance(drawing, Motion)}
    assert moving == {"thesis-figure-8", "thesis-figure-13"}
    assert set(written) == {f"{one.name}.{suffix}" for one in drawings for suffix in ("png", "svg")} | {
        f"{name}.{suffix}" for name in moving for suffix in ("gif", "html")
    }
    begins = {"png": b"\x89PNG", "svg": b"<?xml", "gif": b"GIF89a", "html": b"<!DOCTYPE html>"}
    for name, content in written.items():
        assert content.startswith(begins[name.split(".")[1]])


def test_every_axis_has_a_quantity_with_units(drawings):
    for drawing in drawings:
        if isinstance(drawing, Drawing) and not drawing.polar:
            units = [label for label in (drawing.x_label, drawing.y_label) if label != "number of steps N"]
            assert all(label.endswith("]") for label in units), drawing.item
            assert not any("[1]" in label for label in units)


def test_the_command_line_writes_the_figures(commanded):
    folder, code, out, err = commanded
    assert code == 0
    assert out == ""
    assert err.startswith("wrote report-figure-2.png, report-figure-2.svg, ")
    assert err.endswith(f"into {folder}\n")


def test_the_figures_are_the_same_bytes_every_time(written):
    """But for figure 8, which is drawn as figure 13 is."""
    again = files([name for name in FIGURES if name != "thesis-figure-8"])
    assert again == {name: content for name, content in written.items() if not name.startswith("thesis-figure-8.")}


def test_one_figure_can_be_drawn_alone_and_beside_a_table(tmp_path, capsys):
    assert main(["published", "thesis-figure-9", "table9", "--out", str(tmp_path), "--quiet"]) == 0
    out, err = capsys.readouterr()
    assert "Report table 9" in out
    assert err == ""
    assert {path.name for path in tmp_path.iterdir()} == {"thesis-figure-9.png", "thesis-figure-9.svg"}


def test_nothing_is_drawn_where_a_name_is_unknown(tmp_path, capsys):
    assert main(["published", "thesis-figure-9", "figure8", "--out", str(tmp_path)]) == 2
    assert capsys.readouterr().err == (
        "error: table or figure 'figure8' is unknown, perhaps figures or figure7 or thesis-figure-8; "
        "accepted are table8, table9, table12, figure7, curves, detest, rksuite, pleiades, arenstorf, "
        "figure-eight, all, figures, and the name of one figure: "
        f"{', '.join(FIGURES)}.\n"
    )
    assert not list(tmp_path.iterdir())


def test_a_folder_without_figures_is_a_mistake(capsys):
    assert main(["published", "table9", "--out", "somewhere"]) == 2
    assert capsys.readouterr().err == (
        "error: --out is the folder of the figures; it is accepted with the name 'figures'.\n"
    )
