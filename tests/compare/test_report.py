"""The report of work and precision: its groups, how it goes on after an interrupt, its tables and its page."""

from __future__ import annotations

import csv
import io
import json
import math
import re
from contextlib import suppress
from fractions import Fraction

import numpy as np
import pytest

from compare.__main__ import main
from compare.controlled import error_vs_rtol
from compare.march.march import march, march_alone
from compare.march.precision import precision
from compare.measure.truth import Course
from compare.methods import METHODS, find
from compare.report import run as running
from compare.report import table
from compare.report.page import files, page
from compare.report.problems import reported_by
from compare.report.records import Report, WorkPoint
from compare.report.run import Kept, Task, plan, run, work
from compare.show import render
from reference import Descent, Pendulum
from reference.dataset.blocks import BusyError, PlaceError, partial

SMALL = {
    "problems": ["pendulum"],
    "amplitudes": [0.5, 2.0],
    "methods": ["rk4", "verlet"],
    "solvers": ["DOP853", "taylor"],
    "n": [64, 256],
    "rtol": [1e-5, 1e-9],
    "t_end": 3.0,
}


def numbers(points):
    """What does not depend on the clock."""
    return [(p.family, p.amplitude, p.name, p.setting, p.max_error, p.evaluations, p.failure) for p in points]


@pytest.mark.parametrize("name", ["rk4", "verlet", "implicit_midpoint"])
def test_a_march_by_itself_gives_what_it_gives_among_others(name):
    fmt, method = precision("float64"), find(name)
    lanes = [Course(Pendulum(a), n, Fraction(4), fmt).lane for a in (1.0, 2.0) for n in (100, 8192, 12288)]
    together, alone = march(method, lanes, fmt), march_alone(method, lanes, fmt)
    for one, (other, seconds) in zip(together, alone, strict=True):
        assert np.array_equal(one.states, other.states)
        assert one.evaluations == other.evaluations
        assert 0 < seconds < math.inf


def test_a_plan_is_the_product_of_what_is_asked_for():
    wanted = plan(**SMALL)
    assert len(wanted.tasks) == 2 * (2 + 2)
    assert {(t.name, t.kind, t.settings) for t in wanted.tasks} == {
        ("rk4", "method", (64, 256)),
        ("verlet", "method", (64, 256)),
        ("scipy.DOP853", "solver", (1e-5, 1e-9)),
        ("heyoka.taylor", "solver", (1e-5, 1e-9)),
    }
    assert plan(**SMALL).identity == wanted.identity
    assert plan(**{**SMALL, "t_end": 4.0}).identity != wanted.identity


def test_pairs_with_a_controlled_step_stand_beside_methods_and_solvers():
    wanted = plan(**{**SMALL, "amplitudes": [1.0], "adaptive": ["dopri5"], "controllers": ["i", "pi"]})
    tasks = [task for task in wanted.tasks if task.kind == "adaptive"]
    assert [(task.name, task.controller, task.settings) for task in tasks] == [
        ("dormand_prince54", controller, (1e-5, 1e-9)) for controller in ("i", "pi")
    ]
    assert wanted.parameters["controllers"] == ["i", "pi"]
    points = work(tasks[1])
    cells = error_vs_rtol(Pendulum(1.0), ["dopri5"], ["pi"], [1e-5, 1e-9], t_end=3)
    assert {point.name for point in points} == {"dormand_prince54, pi"}
    assert [point.evaluations for point in points] == [cell.evaluations for cell in cells]
    assert [point.max_error for point in points] == [cell.max_error for cell in cells]
    assert all(point.seconds > 0 for point in points)


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"adaptive": ["rk4"]}, "rk4 has no embedded result"),
        ({"adaptive": ["dopri5"], "controllers": ["p"]}, "controller 'p' is unknown"),
        ({"problems": ["pendulm"]}, "problem 'pendulm' is unknown, perhaps pendulum"),
        ({"amplitudes": [4.0]}, "theta0 is 4.0"),
        ({"methods": ["rk5x"]}, "method 'rk5x' is unknown"),
        ({"solvers": ["RK46"]}, "solver 'RK46' is unknown"),
        ({"methods": (), "solvers": ()}, "there is nothing to report on"),
        ({"n": [0]}, "n is 0"),
        ({"n": []}, "n is empty"),
        ({"rtol": [2.0]}, "rtol is 2.0"),
        ({"t_end": -1}, "t_end is -1"),
        ({"max_evaluations": 0}, "max_evaluations is 0"),
    ],
)
def test_a_mistake_is_named_before_anything_is_computed(options, says):
    with pytest.raises(ValueError, match=says):
        plan(**{**SMALL, **options})


def test_one_name_is_no_sequence_of_names():
    with pytest.raises(TypeError, match="methods is 'rk4'"):
        plan(**{**SMALL, "methods": "rk4"})


def test_an_interrupted_report_goes_on_where_it_stopped(tmp_path, monkeypatch):
    wanted, out = plan(**SMALL), tmp_path / "new" / "report"

    def stop(done, _total):
        if done == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(wanted, out, progress=stop)
    assert not out.exists()
    kept = tmp_path / "new" / "report.partial" / wanted.identity
    assert len(list(kept.glob("*.block"))) == 3
    with suppress(KeyboardInterrupt), partial(out, wanted.identity) as unfinished:
        finished = {task: points for task in wanted.tasks if (points := Kept(unfinished).get(task)) is not None}
        raise KeyboardInterrupt
    next(kept.glob("*.block")).write_text("damaged")

    again, steps = [], []
    monkeypatch.setattr(running, "work", lambda task: again.append(task) or work(task))
    report = run(wanted, out, progress=lambda done, total: steps.append((done, total)))
    assert len(again) == 8 - 2
    assert steps == [(done, 8) for done in range(2, 9)]
    for task, points in finished.items():
        if task not in again:
            assert set(points) <= set(report.points)
    assert sorted(path.name for path in out.parent.iterdir()) == ["report"]


def test_groups_of_another_report_are_not_used(tmp_path):
    wanted, other = plan(**SMALL), plan(**{**SMALL, "amplitudes": [1.0]})
    with suppress(KeyboardInterrupt), partial(tmp_path / "report", other.identity) as unfinished:
        Kept(unfinished).put(other.tasks[0], work(other.tasks[0]))
        raise KeyboardInterrupt
    steps = []
    run(wanted, tmp_path / "report", progress=lambda done, _total: steps.append(done))
    assert steps[0] == 0


def test_two_reports_into_one_folder_do_not_mix(tmp_path):
    wanted = plan(**SMALL)
    with partial(tmp_path / "report", wanted.identity), pytest.raises(BusyError, match="report"):
        run(wanted, tmp_path / "report")


@pytest.mark.parametrize("place", ["link", "folder"])
def test_what_a_report_did_not_make_beside_its_folder_is_refused_and_untouched(tmp_path, place):
    theirs = tmp_path / ("theirs" if place == "link" else "report.partial")
    (theirs / ("a" * 64)).mkdir(parents=True)
    (theirs / ("a" * 64) / ("b" * 32 + ".block")).write_text("theirs")
    if place == "link":
        (tmp_path / "report.partial").symlink_to(theirs, target_is_directory=True)
    before = sorted(tmp_path.rglob("*"))
    with pytest.raises(PlaceError, match=rf"report\.partial' is a {place} that this program did not make; move it"):
        run(plan(**SMALL), tmp_path / "report")
    assert sorted(tmp_path.rglob("*")) == before


CURVES = {**SMALL, "problems": ["cycloid-curve", "descent", "polar-z", "polar-psi"], "amplitudes": None}


def test_curves_and_descents_end_where_they_do_and_motions_where_they_are_asked_to():
    wanted = plan(**{**CURVES, "problems": ["pendulum", *CURVES["problems"]]})
    ends = {(task.family, task.amplitude): task.t_end for task in wanted.tasks}
    assert {end for (name, _), end in ends.items() if name == "pendulum"} == {3.0}
    assert ends["cycloid-curve", 1.0] == 2 * 0.99995
    assert ends["polar-z", 0.5] == 1 - 0.50005
    assert ends["polar-psi", 0.1] == 6.25
    assert 0.999 < ends["descent", "quartic"] / float(Descent("quartic").descent_time()) < 1
    assert wanted.parameters["t_end"] == 3.0
    assert wanted.parameters["ends"]["descent, curve = quartic"] == ends["descent", "quartic"]
    assert "t_end" not in plan(**CURVES).parameters
    assert {name for names in wanted.left_out.values() for name in names} == {"verlet"}


def test_numbers_are_for_the_families_that_differ_in_one_and_names_for_those_that_differ_in_a_curve():
    mixed = plan(**{**CURVES, "problems": ["polar-psi", "descent"], "amplitudes": [0.25, "parabola", "cubic"]})
    assert list(dict.fromkeys((task.family, task.amplitude) for task in mixed.tasks)) == [
        ("polar-psi", 0.25),
        ("descent", "parabola"),
        ("descent", "cubic"),
    ]
    numbers_alone = plan(**{**CURVES, "problems": ["polar-psi", "descent"], "amplitudes": [0.25]})
    assert {task.amplitude for task in numbers_alone.tasks} == {0.25, "quartic", "cycloid"}


@pytest.mark.parametrize(
    ("problem", "amplitude", "says"),
    [
        ("pendulum", "quartic", "amplitudes has 'quartic'; of pendulum, numbers are accepted"),
        ("descent", 0.5, "amplitudes has 0.5; of descent, names are accepted: they differ in a curve"),
        ("descent", "quintic", "curve 'quintic' is unknown"),
        ("polar-z", 1.5, "z0 is 1.5"),
        ("cycloid-curve", -1.0, "radius is -1"),
    ],
)
def test_what_no_problem_takes_is_refused(problem, amplitude, says):
    with pytest.raises(ValueError, match=says):
        plan(**{**CURVES, "problems": [problem], "amplitudes": [amplitude]})


def test_a_report_on_curves_is_kept_and_goes_on_and_names_its_figures(tmp_path, monkeypatch):
    wanted = plan(**{**CURVES, "solvers": ["DOP853"]})

    def stop(done, _total):
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(wanted, tmp_path / "report", progress=stop)
    again = []
    monkeypatch.setattr(running, "work", lambda task: again.append(task) or work(task))
    report = run(wanted, tmp_path / "report")
    assert len(again) == len(wanted.tasks) - 2
    assert all(point.failure == "" and point.max_error > 0 for point in report.points)
    assert (tmp_path / "report" / "descent-curve-quartic-evaluations.svg").is_file()
    titles = [found.title for found in table.tables(report)]
    assert any(title.startswith("Evaluations, descent, curve = quartic: ") for title in titles)
    assert any("polar-z, z0 = 0.5" in title and ", in rad, is below" in title for title in titles)


@pytest.mark.parametrize(("name", "amplitude"), [("cycloid-curve", 1.0), ("descent", "cubic"), ("polar-psi", 0.5)])
def test_methods_and_solvers_agree_on_a_curve(name, amplitude):
    one = reported_by(name)
    end = float(one.end.of(one.problem(amplitude), None))
    fixed = work(Task(name, amplitude, "gauss4", "method", (4096,), end, 100_000))
    adaptive = work(Task(name, amplitude, "scipy.DOP853", "solver", (1e-12,), end, 100_000))
    assert (fixed[0].failure, adaptive[0].failure) == ("", "")
    assert fixed[0].max_error < (1e-3 if name == "cycloid-curve" else 1e-11)
    assert adaptive[0].max_error < 1e-9


def test_all_methods_are_those_that_fit_the_problem():
    wanted = plan(**{**SMALL, "problems": ["tautochrone"], "amplitudes": [1.0], "methods": ["all"], "solvers": ()})
    names = [task.name for task in wanted.tasks]
    assert {"euler", "rk4", "gauss6", "avf", "abm4"} < set(names)
    assert "verlet" not in names
    assert sorted([*names, *wanted.left_out["tautochrone, angle = 1.0 rad"]]) == sorted(m.name for m in METHODS)


def test_a_pool_of_processes_finds_what_one_process_does(tmp_path):
    wanted = plan(**{**SMALL, "amplitudes": [1.0]})
    here = run(wanted, tmp_path / "here")
    there = run(wanted, tmp_path / "there", jobs=2)
    assert numbers(here.points) == numbers(there.points)
    assert all(point.seconds > 0 for point in there.points)


def test_methods_and_solvers_are_measured_against_the_same_truth():
    fixed = work(Task("pendulum", 1.0, "rk4", "method", (4096,), 3.0, 100_000))
    adaptive = work(Task("pendulum", 1.0, "heyoka.taylor", "solver", (1e-12,), 3.0, 100_000))
    assert fixed[0].max_error < 1e-10
    assert adaptive[0].max_error < 1e-12
    assert (fixed[0].evaluations, fixed[0].failure, adaptive[0].failure) == (4 * 4096, "", "")


def test_what_does_not_fit_a_problem_is_left_out_and_named():
    wanted = plan(**{**SMALL, "problems": ["tautochrone"], "amplitudes": [1.0]})
    assert [task.name for task in wanted.tasks] == ["rk4", "scipy.DOP853", "heyoka.taylor"]
    assert wanted.left_out == {"tautochrone, angle = 1.0 rad": ["verlet"]}
    assert [point.failure for task in wanted.tasks for point in work(task)] == [""] * 6


def test_a_method_that_cannot_march_a_problem_is_reported_in_a_sentence():
    (failed,) = work(Task("tautochrone", 1.0, "verlet", "method", (256,), 3.0, 100_000))
    assert "is not separable" in failed.failure
    assert failed.evaluations is None


def test_the_error_of_a_solver_is_that_of_a_method():
    fixed = work(Task("polar", 0.5, "rk4", "method", (4096,), 3.0, 100_000))
    adaptive = work(Task("polar", 0.5, "heyoka.taylor", "solver", (1e-4,), 3.0, 100_000))
    truth = reported_by("polar").problem(0.5).state([Fraction(3)])[0]
    assert abs(truth[2]) > 1
    assert 0 < fixed[0].max_error < 1e-9 < adaptive[0].max_error < 1e-2


def point(name, setting, error, evaluations, seconds=1e-3, **options):
    values = {"family": "pendulum", "amplitude": 1.0, "kind": "method", "floor": False, "failure": "", **options}
    return WorkPoint(name=name, setting=setting, max_error=error, evaluations=evaluations, seconds=seconds, **values)


MADE = Report(
    problem="work-precision",
    parameters={"problems": {"pendulum": [1.0]}, "t_end": 10.0},
    units={"t_end": "s"},
    reference={"version": "0.1.0"},
    engine={"precision": "float64"},
    points=(
        point("rk4", 100, 3e-3, 400, 4e-5),
        point("rk4", 200, 2e-4, 800, 5e-5),
        point("rk4", 400, 1e-8, 1600, 6e-5),
        point("rk4", 800, 3e-8, 3200, 7e-5, floor=True),
        point("lazy", 1e-3, 1e-5, 900, 2e-3, kind="solver"),
        point("broken", 1e-3, math.nan, None, None, kind="solver", failure="no convergence"),
        point("broken", 1e-4, math.nan, None, None, kind="solver", failure="no convergence"),
    ),
    missing={"absent": "pip install absent"},
    left_out={"moon, z = 2.0": ["verlet", "yoshida4"]},
    counts={"lazy": "evaluations of something else", "unasked": "nothing"},
)


def rows(title):
    (found,) = (found for found in table.tables(MADE) if found.title.startswith(title))
    return {row[0]: row[1:] for grid in found.grids for row in grid.rows}


def test_a_cost_is_the_least_that_was_measured_below_an_error():
    evaluations = rows("Evaluations")
    assert evaluations["rk4"] == ("400", "1600", "1600", "1600", "-", "-", "-")
    assert evaluations["lazy"] == ("900", "900", "-", "-", "-", "-", "-")
    assert set(evaluations["broken"]) == {"-"}
    assert rows("Seconds")["rk4"][:2] == ("4.0e-05", "6.0e-05")


def test_what_failed_and_what_is_missing_is_said_once():
    assert rows("What failed") == {"broken": ("pendulum, theta0 = 1.0 rad", "no convergence")}
    assert rows("Left out") == {"moon, z = 2.0": ("verlet, yoshida4",)}
    assert rows("Missing") == {"absent": ("pip install absent",)}


def test_the_page_holds_every_table_and_every_figure_that_is_written():
    written = files(MADE)
    text = written["report.md"].decode()
    assert text == page(MADE)
    linked = re.findall(r"!\[[^]]*\]\(([^)]*)\)", text)
    assert linked == ["pendulum-theta0-1.0-evaluations.svg", "pendulum-theta0-1.0-seconds.svg"]
    assert set(linked) < set(written)
    for one in table.tables(MADE):
        assert one.title.split(":")[0].replace("_", r"\_") in text
    assert "lazy: evaluations of something else" in text
    assert "unasked" not in text


def test_programs_get_every_point():
    written = files(MADE)
    found = json.loads(written["work-precision.json"])["tables"]["points"]
    assert [row["max_error"] for row in found][-2:] == [None, None]
    lines = list(csv.DictReader(io.StringIO(written["work-precision-points.csv"].decode())))
    assert [line["evaluations"] for line in lines] == ["400", "800", "1600", "3200", "900", "", ""]
    assert lines[3]["floor"] == "true"


def test_the_command_writes_a_page_and_prints_its_tables(tmp_path, capsys):
    out = tmp_path / "report"
    words = ["--problems", "pendulum", "--amplitudes", "1", "--methods", "verlet", "--solvers", "heyoka", "--jobs", "1"]
    words += ["--n", "128,512", "--rtol", "1e-6", "--t-end", "2", "--out", str(out), "--format", "json"]
    assert main(["report", *words]) == 0
    printed, err = capsys.readouterr()
    assert printed == (out / "work-precision.json").read_text()
    assert err == f"wrote report.md and what goes with it into {out}\n"
    assert len(json.loads(printed)["tables"]["points"]) == 3
    assert (out / "report.md").read_text().startswith("# Work and precision\n")


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--executor", "cloud"], "executor 'cloud' is unknown"),
        (["--jobs", "0"], "--jobs 0 is not a number of processes"),
        (["--amplitudes", "9"], "theta0 is 9"),
        (["--amplitudes", "quarter_ellipse"], "of pendulum, numbers are accepted"),
        (["--methods", "none", "--solvers", "none"], "nothing to report on"),
        (["--problems", "moon"], "problem 'moon' is unknown"),
    ],
)
def test_a_mistake_is_one_sentence_exit_code_2_and_leaves_nothing(words, says, tmp_path, capsys):
    short = ["--problems", "pendulum", "--methods", "verlet", "--solvers", "none", "--n", "64"]
    given = [word for i, word in enumerate(short) if short[i - i % 2] not in words] + words
    assert main(["report", *given, "--out", str(tmp_path / "report")]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert says in err
    assert list(tmp_path.iterdir()) == []


def test_the_tables_fit_a_terminal():
    text = render.render(table.page(MADE), "text", 100)
    assert max(map(len, text.splitlines())) <= 110
