"""The tables of the two sources: which digits the package gives again, and which it does not, and why."""

from __future__ import annotations

import argparse
import csv
import io
import json
import math
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from compare.__main__ import main
from compare.march.lanes import Lane
from compare.march.march import march
from compare.march.precision import precision
from compare.methods import find
from compare.sources.published.entry import reproduce
from compare.sources.published.options import options
from compare.sources.published.pendulum import dense
from compare.sources.published.source import figure, figures, solutions, sources, tables
from reference import Pendulum
from reference.arithmetic.namespaces import NUMPY
from reference.arithmetic.precision import mp
from reference.problems.cycloid.arc import CycloidCurve
from reference.problems.pendulum.equations import energy

FLOAT64 = precision("float64")
STEP = Fraction("0.01548364")
REPORT = Pendulum("1", "9.81", "1")
FIGURES = ", ".join(one.name for one in figures())
FIGURE7 = {
    100: "0.318698995372",
    200: "0.134832663068",
    300: "0.078905933348",
    400: "0.052952176888",
    500: "0.038372914532",
}
"""What the listing of the thesis computes in doubles, run as it is printed but for a blank in a name."""


@pytest.fixture(scope="module")
def found():
    return {one.table.name: one for one in reproduce()}


def column(one, name):
    return {entry.row: entry for entry in one.entries if entry.column == name}


def energies(step, times):
    marched = dense(REPORT, "suzuki4", step, Fraction(10))
    states = [marched.at(t) for t in times]
    return [f"{energy(NUMPY, theta, omega, 9.81, 1.0):.9f}" for theta, omega in states]


def test_the_tables_have_all_their_entries(found):
    assert {name: sum(entry.published is not None for entry in one.entries) for name, one in found.items()} == {
        "table8": 33,
        "table9": 36,
        "table12": 60,
        "figure7": 0,
        "curves": 0,
    }


@pytest.mark.parametrize(
    "name", ["SymplecticRungeKutta", "Euler", "approximation", "direct integration", "linear", "NDSolve"]
)
def test_table_9_is_reproduced_to_the_last_digit_but_for_one_entry_of_an_adaptive_solver(found, name):
    off = {row: entry.off_by for row, entry in column(found["table9"], name).items() if entry.off_by}
    assert off == ({"0.001": 2} if name == "NDSolve" else {})


def test_the_note_on_the_adaptive_column_of_table_8_says_how_its_trend_differs(found):
    exact = Fraction("-5.300365621")
    above = {
        field: [t for t, entry in column(found["table8"], "NDSolve").items() if Fraction(getattr(entry, field)) > exact]
        for field in ("published", "reproduced")
    }
    assert above["published"] == [str(t) for t in range(1, 7)]
    assert above["reproduced"] == [str(t) for t in range(1, 11)]
    note = next(one for one in found["table8"].table.columns if one.name == "NDSolve").note
    assert "only the size is the same" in note


def test_the_odd_entry_of_table_9_is_an_error_of_the_size_of_a_tolerance():
    slope = 0.001 * math.sqrt(9.81)
    least, most = (abs(period - float(Pendulum("0.001").period())) / 4 * slope for period in (2.006055, 2.006045))
    assert least < 1e-8 < most < 2e-8


def test_table_12_is_reproduced_in_all_of_its_sixty_entries(found):
    assert [entry.off_by for entry in found["table12"].entries] == [0] * 60


def test_the_published_entries_that_are_wrong_are_named(found):
    wrong = [(name, entry.column, entry.row) for name, one in found.items() for entry in one.entries if entry.wrong]
    assert wrong == [("table9", "NDSolve", "0.001"), ("table12", "SymplecticRungeKutta", "8.01")]


def test_the_exact_columns_are_what_the_pendulum_does(found):
    for entry in found["table12"].entries:
        theta = REPORT.certified("state", Fraction(entry.row)).digits(20)
        assert abs(float(theta) - float(entry.exact)) <= 0.5000001 * 10 ** -len(entry.exact.partition(".")[2])
    for entry in found["table9"].entries:
        k = mp.sin(mp.mpf(entry.row) / 2)
        assert entry.exact == f"{float(4 * mp.ellipk(k**2) / mp.sqrt(mp.mpf('9.81'))):.5f}"
    assert {entry.exact for entry in found["table8"].entries} == {f"{-9.81 * math.cos(1):.9f}"}


@pytest.mark.parametrize("other", ["symplectic_euler", "symplectic_euler_adjoint", "heun"])
def test_no_other_simple_method_gives_a_number_of_the_euler_column(found, other):
    for row, entry in column(found["table9"], "Euler").items():
        passage = dense(Pendulum(row, "9.81", "1"), other, Fraction(1, 10), Fraction(1)).first_passage()
        assert f"{4 * passage:.5f}" != entry.published


def test_the_symplectic_column_of_table_8_is_reproduced_to_nine_decimals_up_to_the_last_time(found):
    off = {row: entry.off_by for row, entry in column(found["table8"], "SymplecticRungeKutta").items()}
    assert off == {**{str(t): 0 for t in range(10)}, "10": -21}


def test_the_step_of_table_8_is_known_to_eight_places(found):
    published = [entry.published for entry in column(found["table8"], "SymplecticRungeKutta").values()][:10]
    for step, same in (("0.015483625", True), ("0.015483654", True), ("0.01548361", False), ("0.01548367", False)):
        assert (energies(Fraction(step), range(10)) == published) == same


def test_a_shortened_last_step_is_not_what_table_8_shows_either():
    before = 645
    theta, omega = dense(REPORT, "suzuki4", STEP, Fraction(10)).states[before]
    rest = FLOAT64.round(10 - before * STEP)
    lane = Lane(REPORT, 1, rest, (1,), start=(Fraction(theta), Fraction(omega)))
    (last,) = march(find("suzuki4"), [lane], FLOAT64)
    assert f"{energy(NUMPY, *last.states[0], 9.81, 1.0):.9f}" == "-5.300365551"


def test_what_stands_in_for_an_adaptive_column_errs_as_much(found):
    for name, least, most in (("NDSolve", 1e-7, 1e-6), ("Projection", 1e-5, 1e-4)):
        entries = column(found["table8"], name).values()
        for field in ("published", "reproduced"):
            largest = max(abs(float(getattr(entry, field)) - float(entry.exact)) for entry in entries)
            assert least < largest < most


def test_a_true_projection_keeps_the_energy_and_leaves_the_phase(found):
    entries = column(found["table8"], "projection on H = E0").values()
    assert {entry.reproduced for entry in entries} == {"-5.300365621"}
    theta, omega = dense(REPORT, "projected_rk4", Fraction(1, 64), Fraction(10)).at(10.0)
    assert abs(energy(NUMPY, theta, omega, 9.81, 1.0) + 9.81 * math.cos(1)) < 1e-13
    assert 1e-8 < abs(theta - REPORT.state(10)[0]) < 1e-5


def test_figure_7_is_given_to_twelve_digits(found):
    assert {int(row): entry.reproduced for row, entry in column(found["figure7"], "error").items()} == FIGURE7


@pytest.mark.parametrize("n", FIGURE7)
def test_figure_7_without_rounding_is_simpsons_rule_on_the_slope(found, n):
    with mp.workdps(40):
        top, end = 1 - mp.cos(mp.mpf("0.1")), mp.mpf("1.9999")
        h = (end - top) / n

        def slope(y):
            return mp.sqrt(y / (2 - y))

        rule = mp.fsum(
            h / 6 * (slope(top + i * h) + 4 * slope(top + (i + mp.mpf(1) / 2) * h) + slope(top + (i + 1) * h))
            for i in range(n)
        )
        error = rule - mp.quad(slope, mp.linspace(top, end, 9)[:-1] + [end - mp.mpf(10) ** -k for k in (2, 3)] + [end])
    assert abs(error - mp.mpf(column(found["figure7"], "error")[str(n)].exact)) < 1e-11


@pytest.mark.parametrize("n", FIGURE7)
def test_figure_7_is_what_the_packages_own_march_gives(n):
    x, y = 0.1 - math.sin(0.1), 1 - math.cos(0.1)
    lane = Lane(CycloidCurve(1), n, Fraction((1.9999 - y) / n), (n,), start=(Fraction(x), Fraction(y)))
    (last,) = march(find("rk4"), [lane], FLOAT64)
    end_x, end_y = last.states[0]
    exact = math.acos(1 - end_y) - math.sqrt(end_y * (2 - end_y))
    assert abs(end_x - exact) == pytest.approx(float(FIGURE7[n]), abs=2e-11)


def test_figure_7_shows_a_low_order_and_order_4_returns_below_the_distance_of_the_singularity(found):
    orders = [float(entry.reproduced) for entry in column(found["figure7"], "observed order").values()]
    assert len(orders) == 4
    assert (f"{orders[0]:.2f}", f"{orders[-1]:.2f}") == ("1.24", "1.44")
    assert "from 1.24 to 1.44" in found["figure7"].table.note
    assert orders == sorted(orders)
    errors = [simpson(n) for n in (1 << 17, 1 << 18)]
    assert 2 / (1 << 18) < 1e-5
    assert 3.8 < math.log2(errors[0] / errors[1]) < 4.1


def simpson(n):
    """The error of figure 7 at many steps."""
    top = 1 - math.cos(0.1)
    y = np.linspace(top, 1.9999, 2 * n + 1)
    slopes = np.sqrt(y / (2 - y))
    rule = math.fsum(slopes[:-1:2]) + 4 * math.fsum(slopes[1::2]) + math.fsum(slopes[2::2])
    between = math.acos(1 - 1.9999) - math.sqrt(1.9999 * 0.0001) - (0.1 - math.sin(0.1))
    return abs((1.9999 - top) / n / 6 * rule - between)


def test_a_column_must_have_an_entry_for_every_row():
    table = tables()[0]
    cut = replace(table.columns[0], printed=table.columns[0].printed[1:])
    with pytest.raises(ValueError, match=r"report table 8, NDSolve: 10 entries; 11 are accepted\."):
        replace(table, columns=(cut,))


def test_every_table_and_figure_names_its_page_and_a_known_source():
    assert {table.source for table in (*tables(), *solutions())} == set(sources())
    assert [(table.item, table.page) for table in tables()] == [
        ("report table 8", 6),
        ("report table 9", 6),
        ("report table 12", 8),
        ("thesis figure 7", 14),
        ("thesis figure 7, continued", 14),
    ]
    assert all(figure.item.split()[0] in sources() for figure in figures())


def test_the_thesis_prints_the_pages_of_its_figures_and_the_report_has_them_inferred():
    for one in (*tables(), *figures()):
        assert bool(one.inferred) == one.item.startswith("report")
        assert one.cited == f"{one.item.capitalize()}, page {one.page}" + (" (inferred)" if one.inferred else "")
    pages = [figure.page for figure in figures() if not figure.inferred]
    assert pages == [14, 14, 15, 16, 16, 17, 17, 18, 20, 21]  # the thesis' list of figures, from figure 6 to 15


def test_an_unknown_figure_has_no_page():
    with pytest.raises(ValueError, match="figure 'thesis-figure-5' is unknown, perhaps thesis-figure-"):
        figure("thesis-figure-5")


def test_json_is_a_list_of_objects(capsys):
    assert main(["published", "table9", "figure7", "--format", "json"]) == 0
    rows = json.loads(capsys.readouterr().out)
    assert len(rows) == 36 + 9
    assert all(
        list(row) == ["item", "row", "column", "published", "reproduced", "shown", "exact", "off_by", "note"]
        for row in rows
    )
    assert {name: rows[0][name] for name in ("item", "row", "column", "published", "reproduced", "off_by")} == {
        "item": "report table 9",
        "row": "0.001",
        "column": "NDSolve",
        "published": "2.00605",
        "reproduced": "2.00607",
        "off_by": 2,
    }
    assert (rows[-1]["item"], rows[-1]["published"], rows[-1]["off_by"]) == ("thesis figure 7", None, None)


def test_csv_has_the_same_fields(capsys):
    assert main(["published", "table12", "--format", "csv"]) == 0
    rows = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    assert len(rows) == 60
    assert {row["off_by"] for row in rows} == {"0"}
    assert rows[0]["published"] == "0.99951"


@pytest.mark.parametrize("form", ["text", "markdown", "latex"])
def test_the_readable_forms_mark_what_differs_and_sum_up(form, capsys):
    assert main(["published", "--format", form]) == 0
    out = capsys.readouterr().out.replace("\\", "")
    assert "2.00605!" in out
    assert "2.0060[7]" in out
    for line in (
        "33 published entries; 12 reproduced to the last digit; none claims to be exact",
        "36 published entries; 35 reproduced to the last digit; 1 of those that claim to be exact wrong",
        "60 published entries; 60 reproduced to the last digit; 1 of those that claim to be exact wrong",
        "9 entries, none of them printed",
        "95 entries, none of them printed",
        "page 8 (inferred)",
    ):
        assert line in out
    if form == "text":
        assert max(map(len, out.splitlines())) <= 120


def test_an_unknown_table_is_one_sentence(capsys):
    assert main(["published", "table10"]) == 2
    assert capsys.readouterr().err == (
        "error: table or figure 'table10' is unknown, perhaps table12 or table9 or table8; "
        "accepted are table8, table9, table12, figure7, curves, detest, rksuite, pleiades, arenstorf, figure-eight, "
        f"all, figures, and the name of one figure: {FIGURES}.\n"
    )


def test_an_unknown_figure_is_called_unknown_whatever_the_folder_is(capsys):
    assert main(["published", "thesis-figure-5", "--out", "somewhere"]) == 2
    assert capsys.readouterr().err.startswith(
        "error: table or figure 'thesis-figure-5' is unknown, perhaps thesis-figure-"
    )


@pytest.mark.parametrize("name", ["Table 9", "table 9", "TABLE9", "report table 9", " table-9 "])
def test_a_table_is_known_by_its_letters_and_digits(name, capsys):
    assert main(["published", name, "--format", "csv"]) == 0
    rows = list(csv.DictReader(io.StringIO(capsys.readouterr().out)))
    assert {row["item"] for row in rows} == {"report table 9"}


def test_a_figure_is_known_by_its_letters_and_digits():
    for given in ("Thesis Figure 8", "thesis-figure-8", "thesisfigure8"):
        known = argparse.Namespace(names=[given], out=None, format="text")
        assert options(known)["drawn"] == ("thesis-figure-8",)


def test_all_are_the_tables_that_no_name_gives(capsys):
    assert main(["published", "all", "--format", "csv"]) == 0
    every = capsys.readouterr().out
    assert main(["published", "--format", "csv"]) == 0
    assert capsys.readouterr().out == every


@pytest.mark.parametrize("form", ["json", "csv", "markdown", "latex"])
def test_a_format_without_a_table_is_refused(form, tmp_path, capsys):
    assert main(["published", "figures", "--format", form, "--out", str(tmp_path)]) == 2
    assert capsys.readouterr().err == (
        "error: --format is that of the tables; figures names figures alone, so that it is accepted with the name of a "
        "table besides.\n"
    )
    assert not list(tmp_path.iterdir())


def test_the_settings_that_were_found_stand_in_the_documents():
    page = (Path(__file__).parents[2] / "docs" / "index.md").read_text(encoding="utf-8")
    for table in tables()[:3]:
        for one in table.columns:
            if one.method:
                step = {STEP: "0.01548364", Fraction(1, 100): "0.01", Fraction(1, 10): "0.1"}.get(
                    one.step, str(one.step)
                )
                assert f"`{one.method}`, h = {step} s" in page


def test_the_help_names_every_table(capsys):
    with pytest.raises(SystemExit):
        main(["published", "--help"])
    assert ", ".join(table.name for table in tables()) in " ".join(capsys.readouterr().out.split())
