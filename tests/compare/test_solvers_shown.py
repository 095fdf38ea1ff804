"""What a study of solvers looks like: tables, figures, the command line."""

from __future__ import annotations

import csv
import io
import json
import math
from dataclasses import replace

import pytest
from made_study import made_case

from compare.__main__ import main
from compare.show import render
from compare.show.text_table import text_width
from compare.solvers import plot
from compare.solvers.records import EventCell, SolverCell, SolverEntry, SolverStudy
from compare.solvers.study import QUICK_LIMIT, QUICK_RTOL
from compare.solvers.table import page, tables

CASE = made_case(1.0)
RTOL = tuple(float(f"1e-{k}") for k in range(3, 14))


def cell(solver, rtol, error=None, failure="", **options):
    nan = error is None
    values = {"used": math.nan if nan else rtol, "said": "", "stopped": False, "suited": True, "case": CASE, **options}
    error = math.nan if nan else error
    work = None if nan else int(rtol**-0.2 * 100)
    return SolverCell(
        solver=solver,
        rtol=rtol,
        max_error=error,
        end_error=error / 2,
        velocity_error=error * 3,
        evaluations=work,
        seconds=None if nan else work * 1e-6,
        failure=failure,
        **values,
    )


def entry(solver, version="1.2.3", **options):
    package = solver.split(".")[0]
    made = SolverEntry(
        solver=solver,
        package=package,
        version=version,
        install=f"pip install {package}",
        call="solve(f, rtol)",
        dial="rtol",
        counts="calls of the right-hand side",
        tolerance="the error of a step",
    )
    return replace(made, **options)


def made_study():
    good = [cell("good.RK", rtol, rtol * 20) for rtol in RTOL]
    bad = [cell("bad.BDF", rtol, failure="no convergence at all") for rtol in RTOL]
    raised = [
        cell("raised.RK", rtol, rtol, used=max(rtol, 1e-7), said="rtol is too small" if rtol < 1e-7 else "")
        for rtol in RTOL
    ]
    steps = [cell("steps.Verlet", rtol, rtol * 3, used=rtol**0.5) for rtol in RTOL]
    events = [EventCell("good.RK", rtol, CASE, 9, 9, 0, rtol / 7, first_only=False, failure="") for rtol in RTOL]
    events += [EventCell("raised.RK", rtol, CASE, 9, 7, 2, rtol / 7, first_only=False, failure="") for rtol in RTOL]
    left_out = [cell("split.BM4", rtol, failure="it solves others", suited=False) for rtol in RTOL]
    events += [EventCell("steps.Verlet", rtol, CASE, 1, 1, 0, rtol / 7, first_only=True, failure="") for rtol in RTOL]
    return SolverStudy(
        problem="pendulum",
        parameters={"theta0": [1.0], "t_end": 10.0},
        units={"theta0": "rad", "t_end": "s"},
        reference={"version": "0.1.0"},
        engine={"precision": "float64"},
        solvers=(
            entry("good.RK"),
            entry("bad.BDF"),
            entry("raised.RK"),
            entry("steps.Verlet", dial="step", counts="evaluations of the force"),
            entry("split.BM4", tolerance="nothing"),
            entry("absent.A", None),
            entry("absent.B", None),
        ),
        error_vs_rtol=(*good, *bad, *raised, *steps, *left_out),
        events=tuple(events),
        cases=(CASE,),
    )


STUDY = made_study()
TEXT = render.render(page(STUDY), "text")


def table(name):
    return next(found for found in tables(STUDY) if found.name.startswith(name))


def row(name, solver):
    return [value for grid in table(name).grids for line in grid.rows if line[0] == solver for value in line[1:]]


def test_every_table_has_a_row_a_solver_and_a_column_a_tolerance():
    for name in ("error-vs-rtol", "evaluations", "seconds"):
        labels = [column.label for grid in table(name).grids for column in grid.columns[1:]]
        assert labels == [f"1e-{k:02}" for k in range(3, 14)]
        assert {line[0] for grid in table(name).grids for line in grid.rows} == {
            "good.RK",
            "bad.BDF",
            "raised.RK",
            "steps.Verlet",
        }
    assert row("error-vs-rtol", "good.RK")[:2] == ["2.0e-02", "2.0e-03"]


def test_a_failure_is_a_dash_and_its_message_stands_once_with_all_its_tolerances():
    assert row("error-vs-rtol", "bad.BDF") == row("evaluations", "bad.BDF") == ["-"] * len(RTOL)
    said = [line for line in table("said").grids[0].rows if line[0] == "bad.BDF"]
    assert [line[1:] for line in said] == [("1e-03 to 1e-13", "no convergence at all")]


def test_a_tolerance_of_the_solvers_own_is_marked_and_a_step_is_none():
    assert any(line[1] == "1e-08 to 1e-13" for line in table("said").grids[0].rows)
    marked = [value.endswith("^") for value in row("error-vs-rtol", "raised.RK")]
    assert marked == [rtol < 1e-7 for rtol in RTOL]
    assert not any(value.endswith("^") for value in row("error-vs-rtol", "steps.Verlet"))
    assert "step stands for rtol with steps.Verlet" in table("error-vs-rtol").note
    assert any(line[2] == "worked with rtol = 1.0e-07" for line in table("said").grids[0].rows)


def test_events_that_were_missed_or_invented_are_counted_beside_the_error():
    assert row("events", "raised.RK")[0] == "1.4e-04 7 of 9 +2"
    assert row("events", "good.RK")[0] == row("events", "steps.Verlet")[0] == "1.4e-04"
    assert "the first passage only: steps.Verlet" in table("events").note
    assert "good.RK" not in table("events").note


def test_missing_packages_stand_once_each_with_what_installs_them():
    assert table("missing").grids[0].rows == (("absent", "pip install absent"),)
    assert "absent.A" not in [line[0] for line in table("solvers").grids[0].rows]


def test_what_tolerances_bound_is_said_of_those_that_are_here():
    assert [line[:3] for line in table("tolerances").grids[0].rows] == [
        ("good", "RK", "the error of a step"),
        ("bad", "BDF", "the error of a step"),
        ("raised", "RK", "the error of a step"),
        ("steps", "Verlet", "the error of a step"),
        ("split", "BM4", "nothing"),
    ]


def test_a_solver_that_a_problem_does_not_fit_is_left_out_by_name():
    assert table("left-out").grids[0].rows == (("split.BM4", "it solves others"),)
    assert "split.BM4" not in [line[0] for name in ("error-vs-rtol", "said") for line in table(name).grids[0].rows]


def test_the_work_of_an_error_is_the_least_of_those_measured():
    found = {line[0]: line[1:] for line in table("work").grids[0].rows}
    assert set(found) == {"good.RK", "raised.RK", "steps.Verlet"}
    assert found["good.RK"][:2] == ("630", "1584")
    assert found["good.RK"][-1] == "-"


@pytest.mark.parametrize("width", [80, 100, 120])
def test_tables_keep_to_the_width_they_are_given(width):
    for found in tables(STUDY, width):
        assert all(text_width(grid) <= width for grid in found.grids)


def test_programs_get_every_number_and_nulls_where_there_is_none():
    found = json.loads(render.render(page(STUDY), "json"))
    first, failed = (
        next(r for r in found["tables"]["error_vs_rtol"] if r["solver"] == s) for s in ("good.RK", "bad.BDF")
    )
    assert (first["max_error"], first["evaluations"]) == (0.02, 398)
    assert (failed["max_error"], failed["used"], failed["failure"]) == (None, None, "no convergence at all")
    assert [r["version"] for r in found["tables"]["solvers"]][-2:] == [None, None]
    files = render.files(page(STUDY), "csv")
    assert set(files) == {f"solvers-pendulum-{name}.csv" for name in ("solvers", "error_vs_rtol", "events")}
    lines = list(csv.DictReader(io.StringIO(files["solvers-pendulum-events.csv"].decode())))
    assert (lines[0]["matched"], lines[0]["first_only"]) == ("9", "false")


@pytest.mark.parametrize("form", ["markdown", "latex"])
def test_documents_have_every_table(form):
    found = render.render(page(STUDY), form)
    for part in tables(STUDY):
        assert part.title.split(",")[0] in found


def test_figures_draw_the_solvers_that_answered_in_three_measures_of_work():
    names = [name for name, _ in plot.figures(STUDY)]
    assert names == [f"solvers-pendulum-{kind}" for kind in ("error-vs-rtol", "work-precision", "time-precision")]
    for _, figure in plot.figures(STUDY):
        (axes,) = figure.axes
        drawn = {text.get_text() for text in axes.texts}
        assert {"good.RK", "raised.RK", "steps.Verlet"} <= drawn
        assert "bad.BDF" not in drawn
        low, high = axes.get_xlim()
        assert all(low <= x <= high for line in axes.lines[:3] for x in line.get_xdata())


def test_the_command_prints_the_tables_and_writes_them_with_figures(tmp_path, capsys):
    words = ["solvers", "--solvers", "DOP853,heyoka", "--rtol", "1e-6", "--rtol", "1e-9", "--t-end", "3"]
    assert main([*words, "--theta0", "2", "--out", str(tmp_path), "--plots", "--format", "json"]) == 0
    out, err = capsys.readouterr()
    found = json.loads(out)
    assert [(r["solver"], r["rtol"]) for r in found["tables"]["error_vs_rtol"]] == [
        (solver, rtol) for solver in ("scipy.DOP853", "heyoka.taylor") for rtol in (1e-6, 1e-9)
    ]
    assert all(0 < r["max_error"] < 100 * r["rtol"] for r in found["tables"]["error_vs_rtol"])
    assert (tmp_path / "solvers-pendulum.json").read_text() == out
    assert len(list(tmp_path.glob("*.png"))) == len(list(tmp_path.glob("*.svg"))) == 3
    assert err.startswith("wrote solvers-pendulum.json, ")


def test_the_help_says_what_is_asked_by_default(capsys):
    with pytest.raises(SystemExit):
        main(["solvers", "--help"])
    said = " ".join(capsys.readouterr().out.split())
    first, second, *_, last = (f"{rtol:.0e}".replace("e-0", "e-") for rtol in QUICK_RTOL)
    assert f"(default {first}, {second}, ... {last})" in said
    assert f"(default {QUICK_LIMIT})" in said


def test_where_no_solver_is_installed_the_tables_say_so_and_the_exit_code_is_1(monkeypatch, capsys):
    monkeypatch.setattr("compare.solvers.solver.find_spec", lambda _: None)
    assert main(["solvers", "--solvers", "RK45,heyoka", "--rtol", "1e-3"]) == 1
    out, err = capsys.readouterr()
    assert "pip install scipy" in out
    assert "pip install heyoka" in out
    assert err == "error: none of these solvers could be scored; the tables say why.\n"


def test_where_every_solver_fails_the_exit_code_is_1_and_where_one_is_scored_0(capsys):
    words = ["solvers", "--rtol", "1e-16", "--t-end", "1", "--solvers"]
    assert main([*words, "odeint"]) == 1
    assert "Illegal input detected" in capsys.readouterr().out
    assert main([*words, "odeint,heyoka"]) == 0
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--solvers", "RK4"], "solver 'RK4' is unknown, perhaps RK45"),
        (["--rtol", "2"], "rtol is 2.0"),
        (["--rtol", "small"], "--rtol 'small' is not a number"),
        (["--rtol", "1e-3,1e-3"], "1e-3 twice"),
        (["--max-evaluations", "0"], "--max-evaluations 0 is not a number of evaluations"),
        (["--theta0", "4"], "theta0"),
        (["--methods", "rk4"], "'--methods' is unknown"),
    ],
)
def test_a_mistake_is_one_sentence_and_exit_code_2(words, says, capsys):
    assert main(["solvers", *words]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert says in err
