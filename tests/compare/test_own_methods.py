"""Functions of the user's own beside the known methods: in every form, traced or not, at the command line."""

from __future__ import annotations

import json
import math
import pickle
import sys
from contextlib import suppress
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from matplotlib.text import Text
from toys import Forced

from compare.__main__ import main
from compare.march.march import march
from compare.march.precision import precision
from compare.measure.truth import Course
from compare.methods import find, own_methods
from compare.methods.own import hosting
from compare.methods.own.step_function import method, method_at
from compare.report.run import Kept, plan, run, work
from compare.show import plot
from compare.study import study
from reference import Pendulum
from reference.dataset.blocks import partial

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

STEPS = """
import random
import numpy as np
import compare


def rk4(f, y, h):
    k1 = f(y)
    k2 = f(y + h / 2 * k1)
    k3 = f(y + h / 2 * k2)
    k4 = f(y + h * k3)
    return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def floats(f, y, h):
    return [float(value) for value in rk4(f, np.array([float(value) for value in y]), h)]


def in_place(f, y, h):
    new = np.empty(len(y))
    new[:] = rk4(f, y, h)
    y[:] = new
    return y


def branch(f, y, h):
    return rk4(f, y, h) if y[0] > 0 else rk4(f, y.copy(), h)


def at_rest(f, y, h):
    return y + h * f(y + h / 2 * f(y)) if y[1] == 0 else y + h * f(y + 0 * f(y))


def my_verlet(q, p, force, h):
    p = p + h / 2 * force(q)
    q = q + h * p
    return q, p + h / 2 * force(q)


def timed(f, t, y, h):
    k1 = f(t, y)
    k2 = f(t + h / 2, y + h / 2 * k1)
    k3 = f(t + h / 2, y + h / 2 * k2)
    k4 = f(t + h, y + h * k3)
    return y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def late(f, t, y, h):
    return timed(lambda _, state: f(t, state), t, y, h)


def timed_floats(f, t, y, h):
    return [float(value) for value in timed(f, float(t), y, h)]


def whole(f, y0, t):
    states = [y0]
    for begin, end in zip(t[:-1], t[1:]):
        states.append(timed(f, begin, states[-1], end - begin))
    return states


def iterated(f, y, h):
    new = y
    for _ in range(100):
        before, new = new, y + h * f((y + new) / 2)
        if np.max(np.abs(new - before)) < 1e-13:
            break
    return new


def halves(f, y, h, weight=0.5):
    return y + h * (weight * f(y) + (1 - weight) * f(y + h * f(y)))


def average(f, y, h):
    return y / 2 + (y + 2 * h * f(y + h / 2 * f(y))) / 2


def made(c):
    def step(f, y, h):
        return y + h * f(y + c * h * f(y))
    return step


closure = made(0.5)
declared = compare.method(order=4)(rk4)
number = 4


def raises(f, y, h):
    raise RuntimeError("no luck")


def ends(f, y, h):
    raise SystemExit(0)


def nothing(f, y, h):
    f(y)


def short(f, y, h):
    return (y + h * f(y))[:1]


def still(f, y, h):
    return y


def nans(f, y, h):
    return y + f(y) * float("nan")


def moody(f, y, h):
    return y + h * f(y) * random.random()


def endless(f, y, h):
    while True:
        f(y)


def hangs(f, y, h):
    f(y)
    while True:
        pass


def two(a, b):
    return a


def hemisphere(f, y, h):
    if float(y[0]) < -0.9:
        raise RuntimeError("beyond the hemisphere")
    return y + h * f(y + h / 2 * f(y))


def talks(f, y, h):
    print("noise")
    return y + h * f(y)
"""
RK4 = ("rk4", "floats", "in_place", "branch", "timed", "timed_floats", "whole", "declared")


@pytest.fixture(scope="module")
def steps(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    path = tmp_path_factory.mktemp("own") / "steps_of_mine.py"
    path.write_text(STEPS)
    yield path
    sys.modules.pop(path.stem, None)
    method_at.cache_clear()


def asked(path: Path, claims: dict[str, int]) -> list[str]:
    words = [word for name in claims for word in ("--method", f"{path}:{name}")]
    return [*words, "--claims", ",".join(map(str, claims.values()))]


@pytest.fixture(scope="module")
def pendulum(steps: Path) -> Any:
    """One study of all of them, and of the known ones."""
    claims = {**dict.fromkeys(RK4, 4), "my_verlet": 2, "iterated": 2, "at_rest": 1, "halves": 2}
    own = own_methods([f"{steps}:{name}" for name in claims], list(claims.values()))
    methods = ["rk4", "verlet", "implicit_midpoint", "heun", *own]
    return study("pendulum", methods=methods, n=[64, 256], t_end=5, scores=["error", "drift", "defects"])


def of(records: Any, name: str) -> list[Any]:
    return [one for one in records if one.method.rpartition(":")[2] == name and (":" in one.method or name != "rk4")]


def known(records: Any, name: str) -> list[Any]:
    return [one for one in records if one.method == name]


@pytest.mark.parametrize("name", RK4)
def test_rk4_of_ones_own_errs_as_the_known_one_does_however_it_is_written(pendulum: Any, name: str) -> None:
    for mine, other in zip(of(pendulum.error_vs_n, name), known(pendulum.error_vs_n, "rk4"), strict=True):
        assert (mine.n, mine.evaluations) == (other.n, 4 * other.n)
        assert mine.max_error == pytest.approx(other.max_error, rel=1e-12, abs=1e-13)
    for mine, other in zip(of(pendulum.energy_drift, name), known(pendulum.energy_drift, "rk4"), strict=True):
        assert mine.max_drift_above_rest == pytest.approx(other.max_drift_above_rest, rel=1e-9, abs=1e-13)
    (fit,) = of(pendulum.order, name)
    assert fit.declared_order == 4


def test_a_separable_step_is_verlet_with_a_force_that_is_evaluated_twice(pendulum: Any) -> None:
    for mine, other in zip(of(pendulum.error_vs_n, "my_verlet"), known(pendulum.error_vs_n, "verlet"), strict=True):
        assert mine.max_error == pytest.approx(other.max_error, rel=1e-12)
        assert mine.evaluations == 2 * mine.n


def test_an_argument_with_a_default_is_left_to_the_function(pendulum: Any) -> None:
    for mine, other in zip(of(pendulum.error_vs_n, "halves"), known(pendulum.error_vs_n, "heun"), strict=True):
        assert mine.max_error == pytest.approx(other.max_error, rel=1e-12)


def test_evaluations_of_a_step_that_iterates_are_counted_as_they_are_made(pendulum: Any, steps: Path) -> None:
    calls = 0

    def rates(y: Any) -> Any:
        nonlocal calls
        calls += 1
        return np.array([y[1], -9.81 * math.sin(y[0])])

    iterated = method_at(f"{steps}:iterated", 2, "iterated").function
    y = np.array([1.0, 0.0])
    for _ in range(256):
        y = iterated(rates, y, 5 / 256)
    mine, exact = of(pendulum.error_vs_n, "iterated")[1], known(pendulum.error_vs_n, "implicit_midpoint")[1]
    assert mine.evaluations == pytest.approx(calls, rel=0.02)
    assert mine.max_error == pytest.approx(exact.max_error, rel=1e-9)


def test_a_branch_at_an_exact_zero_is_taken(pendulum: Any) -> None:
    """The first step, from rest, is the midpoint rule's, and all others are Euler's."""
    y, h = np.array([1.0, 0.0]), 5 / 64
    for step in range(64):
        slope = np.array([y[1], -9.81 * math.sin(y[0])])
        middle = y + h / 2 * slope if step == 0 else y
        y = y + h * np.array([middle[1], -9.81 * math.sin(middle[0])])
    mine = of(pendulum.error_vs_n, "at_rest")[0]
    assert mine.end_error == pytest.approx(abs(y[0] - float(Pendulum(1.0).state([5.0])[0, 0])), rel=1e-9)


def test_what_ran_compiled_and_what_state_by_state_is_told(pendulum: Any) -> None:
    told = {name.rpartition(":")[2]: how for name, how in pendulum.engine["own methods"].items()}
    assert {name for name, how in told.items() if how == "compiled"} == {
        "rk4",
        "timed",
        "declared",
        "my_verlet",
        "halves",
    }
    assert told["iterated"] == "state by state: its evaluations vary from step to step"
    assert "'heyoka._core.expression'" in told["floats"]


def test_defects_by_differences_are_those_of_the_compiled_step(pendulum: Any) -> None:
    exact = known(pendulum.defects, "rk4")
    for name in ("floats", "in_place", "branch"):
        for mine, other in zip(of(pendulum.defects, name), exact, strict=True):
            assert abs(mine.symplecticity - other.symplecticity) <= mine.symplecticity_rounding
            assert mine.reversibility == pytest.approx(other.reversibility, rel=1e-6, abs=1e-12)
    assert all(math.isnan(one.symplecticity) for one in of(pendulum.defects, "whole"))
    assert of(pendulum.defects, "floats")[0].symplecticity == pytest.approx(exact[0].symplecticity, rel=1e-6)


def test_the_time_is_given_where_the_equation_depends_on_it(steps: Path) -> None:
    names = ("rk4", "timed", "timed_floats", "whole", "late")
    own = own_methods([f"{steps}:{name}" for name in names], [4])
    fmt = precision("float64")
    courses = [Course(Forced(), n, Fraction(2), fmt) for n in (64, 128)]
    errors = {}
    for one in (find("rk4"), *own):
        marches = march(one, [course.lane for course in courses], fmt)
        assert all(found.evaluations == 4 * course.n for found, course in zip(marches, courses, strict=True))
        errors[one.name] = [float(np.abs(c.errors(m.states)).max()) for c, m in zip(courses, marches, strict=True)]
    right = errors.pop("rk4")
    wrong = errors.pop("late")
    for found in errors.values():
        assert found == pytest.approx(right, rel=1e-9)
    assert 1.5 < wrong[0] / wrong[1] < 3, "of order one, for its stages are at the wrong time"


def test_the_table_has_the_same_digits_in_every_format(
    steps: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["pendulum", "--methods", "rk4", *asked(steps, {"rk4": 4, "floats": 4}), "--n", "128,256,512"]
    for form in ("text", "markdown", "latex", "csv"):
        assert main([*words, "--format", form, "--scores", "error", "--out", str(tmp_path / form), "--quiet"]) == 0
        printed = capsys.readouterr().out
        assert "3.41" in printed or "0.000341" in printed
        assert "steps_of_mine.py:rk4" in printed.replace("\\", "")
        if form == "text":
            (row,) = [line.split() for line in printed.splitlines() if line.split()[:1] == ["256"]]
            assert row[2:4] == row[4:6] == row[6:8]


def test_figures_name_it(steps: Path) -> None:
    own = own_methods([f"{steps}:rk4"], [4])
    found = study("pendulum", methods=["euler", *own], n=[64], t_end=1, traces=True)
    for draw in (plot.error_figure, plot.work_figure, plot.drift_figure, plot.phase_figure):
        words = {text.get_text() for text in draw(found, found.cases[0]).findobj(Text)}
        assert own[0].name in words


def test_it_stands_beside_the_default_methods(steps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["pendulum", *asked(steps, {"closure": 2, "talks": 1}), "--n", "64", "--t-end", "1"]
    assert main([*words, "--format", "json"]) == 0
    rows = json.loads(capsys.readouterr().out)["tables"]["error_vs_n"]
    found = {row["method"]: row["max_error"] for row in rows}
    assert len(found) == 12 + 2
    assert found["closure"] == pytest.approx(found["midpoint"], rel=1e-12)
    assert found["talks"] == pytest.approx(found["euler"], rel=1e-12)


def test_compensated_sums_are_those_of_the_known_method(steps: Path) -> None:
    own = own_methods([f"{steps}:rk4"], [4])
    found = study("pendulum", methods=["rk4", *own], n=[1024], compensated=True).error_vs_n
    assert found[0].max_error == pytest.approx(found[1].max_error, rel=1e-9)
    for name, why in (("floats", "cannot be traced"), ("average", "unsupported operand")):
        with pytest.raises(ValueError, match=f"{name} cannot have compensated sums: .*{why}"):
            study("pendulum", methods=own_methods([f"{steps}:{name}"], [2]), n=[64], compensated="beside")


def test_another_process_finds_it_where_it_stands(steps: Path) -> None:
    for name in ("closure", "declared", "rk4"):
        (own,) = own_methods([f"{steps}:{name}"], [3])
        assert pickle.loads(pickle.dumps(own)) is own  # noqa: S301 - our own bytes


@pytest.mark.parametrize(
    ("names", "words", "says"),
    [
        (["raises"], [], "raises raised RuntimeError: no luck."),
        (["ends"], [], "ends raised SystemExit: 0."),
        (["nothing"], [], "nothing returned nothing; the new state is accepted."),
        (["short"], [], "short returned an array of shape (1,)"),
        (["still"], [], "still does not call f"),
        (["nans"], [], "nans returned [nan, nan]; finite numbers are accepted."),
        (["moody"], [], "it is not deterministic"),
        (["endless"], [], "endless called f more than 10000 times in one step"),
        (["hangs"], [], "hangs took more than 0.3 s in one step"),
        (["two"], [], "two has an equation of its own; a function that is given f is accepted"),
        (["hemisphere"], [], "raised RuntimeError: beyond the hemisphere."),
        (["number"], [], "number in"),
        (["rk5"], [], "function 'rk5' is unknown, perhaps"),
        (["rk4", "rk4"], [], "steps_of_mine.py:rk4 twice; each is accepted once."),
        (["rk4"], ["--precision", "float32"], "precision float64 is accepted."),
        (["rk4"], ["--claims", "4,4"], "claims has 3 orders for 1 methods"),
        (["rk4"], ["--claims", "0"], "--claims '0' is no order; a positive integer is accepted."),
        (["rk4"], ["--claims", "1.5"], "--claims '1.5' is no order; a positive integer is accepted."),
        ([], ["--claims", "4"], "--method MODULE:STEP says which."),
        ([], ["--method", "no_such.py:rk4", "--claims", "4"], "there is no file 'no_such.py'."),
        ([], ["--method", "rk4", "--claims", "4"], "'rk4' names no function; MODULE:STEP or FILE.py:STEP is accepted."),
    ],
)
def test_what_is_no_method_is_told_in_one_sentence(
    names: list[str],
    words: list[str],
    says: str,
    steps: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(hosting, "SECONDS", 0.3 if names == ["hangs"] else 30)
    own = asked(steps, dict.fromkeys(names, 4)) if names else []
    own = [*own[:-2], "--method", f"{steps}:rk4", *own[-2:]] if len(names) > 1 else own
    assert main(["pendulum", "--methods", "none" if own else "rk4", *own, *words, "--n", "64"]) == 2
    told = capsys.readouterr()
    assert says in told.err
    assert told.err.count("\n") == 1
    assert not told.out


def test_an_order_must_be_claimed_or_declared(steps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["pendulum", "--methods", "none", "--n", "64", "--t-end", "1", "--method"]
    assert main([*words, f"{steps}:declared"]) == 0
    assert "declared         4" in capsys.readouterr().out
    assert main([*words, f"{steps}:closure"]) == 2
    assert "declares no order" in capsys.readouterr().err


def test_a_problem_that_lacks_what_a_step_takes_is_named(steps: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = [*asked(steps, {"my_verlet": 2}), "--n", "256", "--t-end", "1"]
    assert main(["lorenz", "--methods", "none", *words]) == 2
    assert "it needs positions apart from momenta" in capsys.readouterr().err
    (own,) = own_methods([f"{steps}:my_verlet"], [2])
    assert not study("lorenz", methods=["rk4", own], n=[256], t_end=1).engine.get("own methods")


def test_names_are_told_apart_from_those_that_are_known(steps: Path) -> None:
    homes = [f"{steps}:{name}" for name in ("rk4", "my_verlet", "closure")]
    assert [one.name for one in own_methods(homes, [2])] == ["steps_of_mine.py:rk4", "my_verlet", "closure"]


def test_a_whole_number_that_is_no_order_is_refused() -> None:
    with pytest.raises(ValueError, match="order is 41; a positive integer up to 40 is accepted"):
        method(order=41)


def test_a_report_has_it_and_begins_anew_where_its_file_was_changed(tmp_path: Path) -> None:
    path = tmp_path / "changing_steps.py"

    def planned(second: str) -> Any:
        path.write_text(f"def mine(f, y, h):\n    return y + h * f(y + h / 2 * f(y)){second}\n")
        sys.modules.pop(path.stem, None)
        method_at.cache_clear()
        own = own_methods([f"{path}:mine"], [2])
        asked_for = {"problems": ["pendulum"], "amplitudes": [1.0], "solvers": (), "n": [64, 128], "t_end": 3.0}
        return plan(methods=["midpoint", *own], **asked_for)

    before = planned("")
    out = tmp_path / "report"
    with suppress(KeyboardInterrupt), partial(out, before.identity) as unfinished:
        for task in before.tasks:
            Kept(unfinished).put(task, work(task))
        raise KeyboardInterrupt
    after = planned(" * 2")
    assert after.identity != before.identity
    with pytest.raises(ValueError, match=r"changing_steps\.py:mine was changed while the report was made"):
        work(before.tasks[1])
    done: list[int] = []
    found = run(after, out, progress=lambda one, _: done.append(one))
    assert done[0] == 0
    known_one, mine = ([p.max_error for p in found.points if p.name == name] for name in ("midpoint", "mine"))
    assert mine[0] > 10 * known_one[0]
    assert found.engine["own methods"] == {"mine": "compiled"}
    assert "mine" in (out / "report.md").read_text()
    sys.modules.pop(path.stem, None)
    method_at.cache_clear()


def test_a_report_goes_on_where_nothing_was_changed(steps: Path, tmp_path: Path) -> None:
    own = own_methods([f"{steps}:floats"], [4])
    wanted = plan(methods=own, problems=["pendulum"], amplitudes=[1.0], solvers=(), n=[64], t_end=1.0)
    with suppress(KeyboardInterrupt), partial(tmp_path / "report", wanted.identity) as unfinished:
        Kept(unfinished).put(wanted.tasks[0], work(wanted.tasks[0]))
        raise KeyboardInterrupt
    done: list[int] = []
    found = run(wanted, tmp_path / "report", progress=lambda one, _: done.append(one))
    assert done == [1]
    assert [point.evaluations for point in found.points] == [256]


def test_a_method_that_this_process_alone_knows_is_refused_in_a_report() -> None:
    mine = method(order=1, name="mine")(lambda f, y, h: y + h * f(y))
    with pytest.raises(ValueError, match="mine is known in this process alone"):
        plan(methods=[mine], problems=["pendulum"])
