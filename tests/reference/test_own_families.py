"""A family that a user defines passes through every command of the reference, and no line of ours names it."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

import h5py
import mpmath
import numpy as np
import oscillator
import pytest
from oscillator import FREE, OSCILLATOR, Oscillator

import reference
from reference.__main__ import main
from reference.dataset.build import build
from reference.dataset.catalogue import LAYOUTS, plan
from reference.dataset.errors import DatasetError
from reference.dataset.grids import plan_from
from reference.dataset.plan import Plan
from reference.dataset.verify import verify
from reference.family import Input
from reference.layout import Coordinate, Group
from reference.problem import Problem, SeparableProblem, UndeclaredError
from reference.problems.families import FAMILIES
from reference.problems.pendulum.family import EARTH, LONG

ROOT = Path(reference.__file__).parents[1]
NAME = "oscillator:OSCILLATOR"
AT = ["at", NAME, "--x0", "0.5", "--w", "1.5", "--t", "10"]
GRID = """
[[group]]
path = "/oscillator/free"
w = 2
x0 = [1.0]
time = { start = 0, stop = 1, count = 3 }
event = 2

[[group]]
path = "/pendulum/long"
g = 9.81
length = 1
amplitude = [1.0]
time = [1.0]
"""


@pytest.fixture(scope="module")
def own(tmp_path_factory):
    """The dataset of the family alone."""
    path = tmp_path_factory.mktemp("own") / "own.h5"
    build(plan("core", [NAME]), path)
    return path


def refused(capsys, *arguments):
    """The one sentence on stderr."""
    assert main([str(argument) for argument in arguments]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert (err[:7], err[-2:], err.count("\n")) == ("error: ", ".\n", 1)
    return err


def limbs(value, count=3):
    """A number of mpmath as correctly rounded limbs."""
    found = []
    for _ in range(count):
        found.append(float(value))
        value -= found[-1]
    return found


def truth(x0, w, t):
    """x0 cos(w t) and its rate, by 200 digits of mpmath's own context."""
    at = mpmath.mpf(w) * mpmath.mpf(t)
    return mpmath.mpf(x0) * mpmath.cos(at), -mpmath.mpf(x0) * mpmath.mpf(w) * mpmath.sin(at)


def test_at_proves_its_values_under_the_options_that_it_declares(capsys):
    assert main([*AT, "--routes", "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    routes = found.pop("routes")
    with mpmath.workdps(80):
        x, v = truth(0.5, 1.5, 10)
        expected = {"x": x, "v": v, "period": 2 * mpmath.pi / 1.5, "energy": mpmath.mpf(9) / 32}
        assert list(found) == list(expected)
        for name, value in expected.items():
            assert abs(mpmath.mpf(found[name]) / value - 1) < mpmath.mpf(10) ** -49
    assert routes["x"] == {"taylor": 60.0, "quadrature": 60.0}
    with pytest.raises(SystemExit):
        main(["at", NAME, "--help"])
    assert "displacement at the start, in m" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["at", "oscillator:OSCILATOR"], "accepted are OSCILLATOR"),
        (["at", "oscillator:"], "MODULE:FAMILY or FILE.py:FAMILY"),
        (["at", "oscillator:FREE"], "a family is accepted"),
        (["at", "osc_illator:FAMILY"], "cannot be imported"),
        (["at", "missing.py:FAMILY"], "there is no file"),
        (AT[:4], "--t"),
        ([*AT, "--g", "1"], "--g"),
        ([*AT, "--w=-1"], "w is -1"),
        (["build", "--family", NAME, "--profile", "full", "--out", "x.h5"], "no groups of the profile full"),
        (["build", "--family", "linear", "--out", "x.h5"], "no groups of the profile core"),
        (["build", "--family", "oscilator", "--out", "x.h5"], "problem 'oscilator' is unknown"),
        (["cite", "--family", "oscillator:FREE"], "a family is accepted"),
    ],
)
def test_what_is_not_there_is_one_sentence(capsys, tmp_path, monkeypatch, arguments, words):
    monkeypatch.chdir(tmp_path)
    assert words in refused(capsys, *arguments)
    assert not list(tmp_path.iterdir())


def test_its_inputs_may_have_any_name_but_that_of_an_option(capsys, monkeypatch):
    def renamed(name):
        inputs = (Input(name, "m", "displacement"), *OSCILLATOR.inputs[1:])
        comparison = replace(OSCILLATOR.comparison, varied=name)
        problem = lambda **given: Oscillator(given[name])  # noqa: E731
        return replace(OSCILLATOR, inputs=inputs, comparison=comparison, problem=problem)

    for name in ("run", "command", "digits"):
        monkeypatch.setattr(oscillator, f"NAMED_{name}", renamed(name), raising=False)
    for name in ("run", "command"):
        assert main(["at", f"oscillator:NAMED_{name}", f"--{name}", "3", "--t", "0"]) == 0
        assert "  x = 3.0" in capsys.readouterr().out
    words = "--digits is an option of its own; an input of another name is accepted"
    assert words in refused(capsys, "at", "oscillator:NAMED_digits", "--digits", "3", "--t", "0")


def test_every_limb_of_its_dataset_is_the_one_correct_rounding(own):
    found = reference.load(own, families=[OSCILLATOR])
    assert list(found.groups) == ["oscillator/free"]
    amplitudes, times = (found[f"oscillator/free/{name}"].value.tolist() for name in ("x0", "time"))
    stored = {name: found[f"oscillator/free/{name}"] for name in ("x", "v", "period", "crossing")}
    with mpmath.workdps(200):
        for i, x0 in enumerate(amplitudes):
            for k, t in enumerate(times):
                for name, value in zip(("x", "v"), truth(x0, 1.5, t), strict=True):
                    here = [stored[name].value[i, k], *stored[name].tail[i, k]]
                    assert here == limbs(value)
            assert [stored["period"].value[i], *stored["period"].tail[i]] == limbs(4 * mpmath.pi / 3)
            for j in range(3):
                here = [stored["crossing"].value[i, j], *stored["crossing"].tail[i, j]]
                assert here == limbs((2 * j + 1) * mpmath.pi / 3)


def test_it_is_verified_and_a_changed_limb_is_found(own, tmp_path):
    assert all(proof.holds for proof in verify(own, families=[NAME]))
    other = tmp_path / "other.h5"
    wrong = replace(FREE, problem=doubled)
    build(Plan("core", (Group(wrong, {"w": 1.5}, {**oscillator.core()[0].inputs}),)), other)
    failed = [proof for proof in verify(other, families=[OSCILLATOR]) if not proof.holds]
    assert {proof.name.rpartition("/")[2] for proof in failed} == {"x", "v", "energy"}


def doubled(x0, w):
    """Another problem than the group says."""
    return Oscillator(2 * x0, w)


def test_show_datasheet_and_cite_read_it_where_the_family_is_named(own, capsys):
    named = "--family", NAME
    assert main(["show", str(own), "oscillator/free/period", *named]) == 0
    assert "[0]: 4.188790204786391 -4.288327065804364e-16 " in capsys.readouterr().out
    assert main(["datasheet", str(own), *named]) == 0
    page = capsys.readouterr().out
    assert "**Problem**: x'' = -w^2 x, x(0) = x0, x'(0) = 0." in page
    assert f"reference.load(\"own.h5\", families=['{NAME}'])" in page
    assert main(["cite", str(own), "--format", "text", *named]) == 0
    assert f"core profile of {NAME}. Fingerprint" in capsys.readouterr().out
    assert main(["verify", str(own), *named, "--jobs", "1"]) == 0
    assert "5 of 5 variables proven." in capsys.readouterr().out
    for command in ("show", "datasheet", "cite", "verify"):
        assert "--family" in refused(capsys, command, own)


def test_reading_it_without_naming_its_family_says_what_is_accepted(own):
    with pytest.raises(DatasetError, match=r"'oscillator' is unknown.*accepted where --family, in Python families="):
        reference.load(own)
    with pytest.raises(TypeError, match="families is of type str; a list of families or names is accepted"):
        reference.load(own, NAME)
    with pytest.raises(TypeError, match="one of the families is of type Layout"):
        reference.load(own, [FREE])
    assert reference.load(own, [OSCILLATOR, NAME, "pendulum"]).fingerprint == reference.load(own, [NAME]).fingerprint


def test_the_core_dataset_is_read_as_ever_where_a_family_is_named(core):
    assert reference.load(families=[OSCILLATOR]).fingerprint == core.fingerprint
    assert core.families == ()


def test_a_grid_file_names_its_groups_beside_ours(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    Path("mine.toml").write_text(GRID)
    assert "accepted where --family" in refused(capsys, "build", "--config", "mine.toml")
    assert main(["build", "--config", "mine.toml", "--family", NAME, "--jobs", "1", "--quiet"]) == 0
    found = reference.load("horologium-mine.h5", [OSCILLATOR])
    assert found.attrs["command"] == f"python -m reference build --config mine.toml --family {NAME}"
    assert found["oscillator/free/x"].value.shape == (1, 3)
    assert found["pendulum/long/theta"].value.shape == (1, 1)
    assert all(proof.holds for proof in verify("horologium-mine.h5", families=[OSCILLATOR]))
    ours = GRID.rpartition("[[group]]")
    Path("mine.toml").write_text("".join(ours[1:]))
    assert plan_from("mine.toml", families=[NAME]) == plan_from("mine.toml")


def test_a_file_may_name_a_family_only_with_a_group_of_one(own, built, tmp_path):
    def altered(path, command):
        copy = Path(shutil.copy(path, tmp_path / "copy.h5"))
        with h5py.File(copy, "r+") as file:
            for name, text in (("command", command), ("history", f"{command} (horologium {reference.__version__})")):
                del file.attrs[name]
                file.attrs.create(name, np.array(text.encode(), dtype=h5py.string_dtype("utf-8", len(text.encode()))))
        return copy

    build_it = "python -m reference build --profile core"
    for path, command, words in (
        (built, f"{build_it} --family {NAME}", "names the family 'oscillator:OSCILLATOR' and holds no group of one"),
        (built, f"{build_it} --family marsian", "attribute 'command'"),
        (built, f"{build_it} --family 'a", "attribute 'command'"),
        (own, f"{build_it} --family  {NAME}", "attribute 'command'"),
        (own, f"{build_it} --family {NAME}\x1b", "attribute 'command'"),
        (own, f"{build_it} --family {NAME}; rm x", "attribute 'command'"),
    ):
        with pytest.raises(DatasetError, match=words):
            reference.load(altered(path, command), [OSCILLATOR])
    assert reference.load(altered(own, build_it), [OSCILLATOR]).families == ()


def test_a_plan_of_one_of_our_families_says_so_and_needs_no_name_to_be_read(tmp_path):
    wanted = Plan("core", (Group(LONG, EARTH, {"amplitude": [1.0], "time": [1.0]}),), ("pendulum",))
    build(wanted, tmp_path / "x.h5")
    found = reference.load(tmp_path / "x.h5")
    assert (found.families, found.attrs["command"][-17:]) == (("pendulum",), "--family pendulum")
    with pytest.raises(ValueError, match="a family of the plan is called 'pendulm'; MODULE:NAME is accepted"):
        build(replace(wanted, families=("pendulm",)), tmp_path / "y.h5")


def test_groups_that_cannot_stand_in_one_file_are_refused():
    for path, words in (
        ("/pendulum/libration", "has the place of /pendulum/libration"),
        ("/pendulum", "has the place of /pendulum/"),
        ("/pendulum/long/mine", "has the place of /pendulum/long"),
        ("/limb", "has the place of /limb"),
    ):
        with pytest.raises(ValueError, match=words):
            plan("core", [replace(OSCILLATOR, layouts=(replace(FREE, path=path),))])
    for path in ("oscillator", "/a/", "/a//b", "/a b", "/../a", "/a.b", ""):
        with pytest.raises(ValueError, match="the group's path is"):
            replace(FREE, path=path)


def test_a_declaration_that_contradicts_itself_is_one_sentence():
    x0 = FREE.instances[0]
    for fault, words in (
        (lambda: replace(FREE, over={}), "has the row state over 'time', and no coordinate for that"),
        (lambda: replace(FREE, instances=(x0, x0)), "has 'x0', 2 times"),
        (lambda: replace(FREE, instances=(Coordinate("x", "m", "x"),)), "has 'x', 2 times"),
        (lambda: replace(FREE, instances=(replace(x0, name="x 0"),)), "has 'x 0', which is no name"),
        (lambda: replace(OSCILLATOR, layouts=(replace(FREE, difficulty=""),)), "does not declare its difficulty"),
        (lambda: replace(OSCILLATOR, inputs=OSCILLATOR.inputs[1:]), "input of the comparison of oscillator, 'x0'"),
        (lambda: replace(OSCILLATOR, inputs=2 * OSCILLATOR.inputs), "has 'x0', 2 times"),
    ):
        with pytest.raises(ValueError, match=words):
            fault()


def test_what_a_problem_does_not_declare_is_named_where_it_is_asked_for():
    class Bare(SeparableProblem):
        name = "bare"

    bare = Bare()
    for asked, lacking in (
        (lambda: bare.space, "space"),
        (lambda: bare.state_names, "space"),
        (lambda: Bare.rows, "rows"),
        (lambda: bare.state(1), "rows"),
        (lambda: bare.invariants, "invariants"),
        (lambda: bare.trial, "trial"),
        (lambda: bare.parameters, "parameters"),
        (lambda: bare.start, "start"),
        (lambda: bare.inputs, "inputs"),
        (lambda: bare.equation, "equation"),
        (lambda: bare.force(None, 0, (), {}), "force"),
        (lambda: bare.closed_form(None), "closed_form"),
        (bare.rate, "space"),
    ):
        with pytest.raises(UndeclaredError, match=rf"^Bare, the problem 'bare', does not declare '{lacking}': .*\.$"):
            asked()
    with pytest.raises(UndeclaredError, match=r"^Problem does not declare 'name': what it is called\.$"):
        _ = Problem().name
    assert not hasattr(bare, "space")


def test_what_is_lacking_is_one_sentence_of_the_command_line(capsys, monkeypatch):
    monkeypatch.delattr(Oscillator, "closed_form")
    said = refused(capsys, *AT)
    assert said == ("error: period of Oscillator(x0=0.5, w=1.5) has no closed form; its state is proven by its flow.\n")


def test_a_row_that_no_route_reaches_is_not_written(tmp_path):
    lacking = (*oscillator.NO_TAYLOR, ("quadrature", "nor this"))
    rows = tuple(replace(row, lacks=lacking) for row in FREE.rows if row.name == "period")
    layout = replace(FREE, rows=rows, over={}, problem=Unreached)
    with pytest.raises(ArithmeticError, match="period of /oscillator/free was compared with no route"):
        build(Plan("core", (Group(layout, {"w": 1}, {"x0": [1.0]}),)), tmp_path / "x.h5")
    assert not (tmp_path / "x.h5").exists()


class Unreached(Oscillator):
    """No route but the enclosure gives its period."""

    rows = tuple(replace(row, lacks=(("taylor", "no"), ("quadrature", "no"))) for row in oscillator.ROWS)


def test_what_other_processes_cannot_be_given_is_refused_before_the_proof(tmp_path):
    local = replace(FREE, problem=lambda x0, w: doubled(x0, w))  # noqa: PLW0108 (it has no name)
    wanted = Plan("core", (Group(local, {"w": 1}, {"x0": [1.0], "time": [1.0], "event": [0]}),))
    with pytest.raises(ValueError, match="/oscillator/free cannot be given to other processes: "):
        build(wanted, tmp_path / "x.h5", jobs=2)
    assert not list(tmp_path.iterdir())
    assert build(wanted, tmp_path / "x.h5")


def test_finished_blocks_are_of_one_state_of_the_users_program(tmp_path, monkeypatch):
    (tmp_path / "mine_now.py").write_text(Path(oscillator.__file__).read_text(encoding="utf-8"))
    monkeypatch.chdir(tmp_path)
    wanted = plan("core", ["mine_now.py:OSCILLATOR"])
    before = wanted.identity("1")
    assert wanted.identity("1") == before
    with (tmp_path / "mine_now.py").open("a") as file:
        file.write("# changed\n")
    assert wanted.identity("1") != before
    local = replace(FREE, problem=type("Nowhere", (Oscillator,), {"__module__": "nowhere"}))
    unnamed = Plan("core", (Group(local, {"w": 1}, {"x0": [1.0], "time": [1.0], "event": [0]}),))
    assert unnamed.identity("1") != unnamed.identity("1")


def program(folder, path, *words):
    done = subprocess.run(
        [sys.executable, "-m", *words],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(path)},
        capture_output=True,
        text=True,
        check=False,
    )
    return done.returncode, done.stdout, done.stderr


def test_a_file_beside_the_user_is_built_by_other_processes_too(tmp_path):
    shutil.copy(oscillator.__file__, tmp_path / "mine.py")
    code, out, err = program(tmp_path, ROOT, "reference", "build", "--family", "mine.py:OSCILLATOR", "--jobs", "2")
    assert (code, err) == (0, "")
    assert out.startswith("horologium-core-oscillator.h5: ")
    named = "horologium-core-oscillator.h5", "--family", "mine:OSCILLATOR", "--jobs", "2"
    code, out, err = program(tmp_path, ROOT, "reference", "verify", *named)
    assert (code, err, out.splitlines()[-1]) == (0, "", "5 of 5 variables proven.")


def test_a_family_of_ours_is_one_file_that_is_added(tmp_path):
    for package in ("reference", "compare"):
        shutil.copytree(ROOT / package, tmp_path / package, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(oscillator.__file__, tmp_path / "reference" / "problems" / "oscillator.py")
    assert "the harmonic oscillator, released from rest" in program(tmp_path, tmp_path, "reference", "at", "--help")[1]
    code, out, _ = program(tmp_path, tmp_path, "reference", "at", "oscillator", "--x0", "1", "--t", "0")
    assert (code, "x = 1.0" in out) == (0, True)
    assert "score them on the harmonic oscillator" in program(tmp_path, tmp_path, "compare", "--help")[1]
    scored = program(tmp_path, tmp_path, "compare", "oscillator", "--n", "64,128", "--methods", "rk4")
    assert (scored[0], scored[2]) == (0, "")
    assert "rk4" in scored[1]
    listed = "from reference.dataset.catalogue import LAYOUTS; print(*(one.path for one in LAYOUTS))"
    (tmp_path / "listed.py").write_text(listed)
    paths = program(tmp_path, tmp_path, "listed")[1].split()
    assert [path for path in paths if path != "/oscillator/free"] == [layout.path for layout in LAYOUTS]
    assert "/oscillator/free" in paths


def test_our_families_stand_in_the_order_of_the_dataset():
    names = ["pendulum", "linear", "cycloid", "tautochrone", "descent", "polar", "tunnel"]
    found = [family.name for family in FAMILIES]
    assert found[: len(names)] == names
    assert len(set(found)) == len(found)


def test_an_oscillator_is_as_exact_as_any_problem():
    assert Oscillator("1/3").certified("energy").digits(20) == "0.055555555555555555556"
    assert Oscillator(Fraction(1)).state(0).tolist() == [1.0, 0.0]
