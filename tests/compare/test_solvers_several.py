"""Solvers on several problems: one row for each problem, solver and tolerance."""

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
from compare.solvers import plot
from compare.solvers.records import SolverCell, SolverEntry, SolverStudy
from compare.solvers.several import missed, page

ONE, OTHER = made_case(1.0), replace(made_case(1.0), inputs=(("theta0", 2.0),), label="theta0 = 2.0 rad")


def cell(solver, case, rtol, error=math.nan, **options):
    failed = math.isnan(error)
    values = {"used": math.nan if failed else rtol, "failure": "no convergence" if failed else "", "suited": True}
    values |= options
    return SolverCell(
        solver=solver,
        rtol=rtol,
        case=case,
        max_error=error,
        end_error=error / 2,
        velocity_error=2 * error,
        evaluations=None if failed else 100,
        seconds=None if failed else 1.0,
        said="",
        stopped=False,
        **values,
    )


def unsuited(solver, case, rtol):
    return cell(solver, case, rtol, failure="it solves others; this is none of them", suited=False)


def made(problem, cases, t_end):
    cells = [
        found
        for case in cases
        for found in (
            cell("good.RK", case, 1e-9, 3e-7),
            cell("raised.RK", case, 1e-9, 1e-5, used=1e-7),
            cell("bad.RK", case, 1e-9),
            unsuited("split.RK", case, 1e-9),
        )
    ]
    entries = [
        SolverEntry(f"{package}.RK", package, version, f"pip install {package}", "solve()", "rtol", counts, "steps")
        for package, version, counts in (
            ("good", "1.0", "steps"),
            ("raised", "1.0", "calls of the right-hand side"),
            ("bad", "1.0", "calls of the right-hand side"),
            ("split", "1.0", "calls of the right-hand side"),
            ("absent", None, "steps"),
        )
    ]
    facts = {"version": "0.1.0", "definition": f"the equation of {problem}", "truth": "proven"}
    return SolverStudy(
        problem=problem,
        parameters={"t_end": t_end},
        reference=facts,
        engine={"precision": "float64", "tolerance": "rtol"},
        solvers=tuple(entries),
        error_vs_rtol=tuple(cells),
        events=(),
        cases=cases,
    )


STUDIES = [made("short", (ONE,), 5.0), made("long", (ONE, OTHER), [50.0, 60.0])]
TEXT = render.render(page(STUDIES), "text", 100)
LINES = [" ".join(line.split()) for line in TEXT.splitlines()]


def test_every_problem_has_a_row_a_solver_with_its_time():
    found = [(one.problem, one.case, one.t_end, one.solver) for one in missed(STUDIES)]
    assert found == [
        (problem, case.label, t, solver)
        for problem, case, t in (("short", ONE, 5.0), ("long", ONE, 50.0), ("long", OTHER, 60.0))
        for solver in ("good.RK", "raised.RK", "bad.RK", "split.RK")
    ]


def test_the_error_stands_beside_that_many_tolerances():
    assert "short 5 good.RK 1e-09 3.0e-07 1.5e-07 6.0e-07 3.0e+02 100*" in LINES
    assert "long, theta0 = 2.0 rad 60 good.RK 1e-09 3.0e-07 1.5e-07 6.0e-07 3.0e+02 100*" in LINES
    assert "* good.RK: steps" in LINES


def test_what_failed_worked_otherwise_or_is_missing_is_said_once_below():
    assert "short 5 raised.RK 1e-09^ 1.0e-05 5.0e-06 2.0e-05 1.0e+04 100" in LINES
    assert "short 5 bad.RK 1e-09 - - - - -" in LINES
    for line in (
        "^ raised.RK worked with rtol = 1.0e-07",
        "bad.RK on long: no convergence",
        "split.RK on long: it solves others; this is none of them",
        "absent is missing; pip install absent",
    ):
        assert LINES.count(line) == 1


def test_what_a_problem_does_not_fit_has_no_row_but_its_reason():
    assert not [line for line in LINES if line.startswith(("short 5 split", "long, theta0 = 1.0 rad 50 split"))]


def test_the_evaluations_that_an_error_took_stand_problem_by_problem():
    titles = [line for line in LINES if line.startswith("Work and precision")]
    assert [title.partition(", evaluations")[0] for title in titles] == [
        "Work and precision, short, theta0 = 1.0 rad, t = 5",
        "Work and precision, long, theta0 = 1.0 rad, t = 50",
        "Work and precision, long, theta0 = 2.0 rad, t = 60",
    ]
    assert LINES.count("good.RK 100 100 100 - - - -") == LINES.count("raised.RK 100 100 - - - - -") == 3


def test_figures_of_several_problems_have_their_names_and_of_the_same_one_their_ends(monkeypatch):
    monkeypatch.setattr(plot, "saved", lambda _figure: {"png": b""})
    names = {name.rpartition(".")[0] for name in plot.files([made("short", (ONE,), 5.0), made("short", (ONE,), 6.0)])}
    kinds = ("error-vs-rtol", "work-precision", "time-precision")
    assert names == {f"solvers-short-{kind}-t-{end}" for kind in kinds for end in (5.0, 6.0)}
    assert {name.rpartition(".")[0] for name in plot.files(STUDIES[:1])} == {f"solvers-short-{kind}" for kind in kinds}


def test_programs_get_a_row_for_each():
    rows = json.loads(render.render(page(STUDIES), "json"))
    assert len(rows) == 12
    assert (rows[0]["multiple"], rows[0]["evaluations"]) == (pytest.approx(300), 100)
    assert (rows[2]["max_error"], rows[2]["failure"]) == (None, "no convergence")
    table = list(csv.DictReader(io.StringIO(render.render(page(STUDIES), "csv"))))
    assert [row["t_end"] for row in table[::4]] == ["5.0", "50.0", "60.0"]


@pytest.mark.parametrize("form", ["markdown", "latex"])
def test_documents_have_the_table(form):
    assert "What a tolerance misses" in render.render(page(STUDIES), form)


def test_the_command_takes_several_problems_and_a_time_for_each(capsys, tmp_path):
    words = ["solvers", "--problem", "linear", "--problem", "pendulum", "--t-end", "2,3"]
    assert main([*words, "--rtol", "1e-6", "--solvers", "heyoka", "--format", "json", "--out", str(tmp_path)]) == 0
    rows = json.loads(capsys.readouterr().out)
    assert [(row["problem"], row["t_end"]) for row in rows] == [("linear", 2.0), ("pendulum", 3.0)]
    assert all(0 < row["max_error"] < 1e-4 for row in rows)
    assert [path.name for path in tmp_path.iterdir()] == ["solvers.json"]


def test_names_right_behind_the_command_are_problems(capsys):
    for words in (["linear", "lorenz"], ["--problem", "linear", "--problem", "lorenz"]):
        assert main(["solvers", *words, "--t", "1,2", "--rtol", "1e-6", "--solvers", "LSODA", "--format", "json"]) == 0
        rows = json.loads(capsys.readouterr().out)
        assert [(row["problem"], row["t_end"]) for row in rows] == [("linear", 1.0), ("lorenz", 2.0)]


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--t-end", "1,2,3"], "--t-end has 3 times; one, or 2 are accepted."),
        (["--t-end", "1,"], "--t-end '' is not a number"),
        (["--radius", "1"], "option '--radius' is unknown"),
    ],
)
def test_what_has_no_meaning_for_several_problems_is_refused(words, says, capsys):
    assert main(["solvers", "--problem", "linear", "--problem", "pendulum", *words]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert says in err
