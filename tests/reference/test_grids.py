"""Grids of the user's own: a TOML file becomes a plan, or one sentence says why not."""

import os

import numpy as np
import pytest

import reference
from reference.__main__ import main
from reference.dataset.grids import plan_from

GOOD = """
[[group]]
path = "/pendulum/libration"
g = 9.81
length = 1
amplitude = [0.5, "1.0"]
time = { start = 0, stop = 1, count = 11 }
event = 2
taylor_elements = 4

[[group]]
path = "pendulum/long"
g = 1
length = 1
amplitude = 0.25
time = [1, 1e3]
"""


def plan_of(tmp_path, text, name="mine.toml"):
    path = tmp_path / name
    path.write_text(text)
    return plan_from(str(path))


def test_a_grid_file_becomes_the_groups_that_it_names(tmp_path):
    plan = plan_of(tmp_path, GOOD)
    libration, long = plan.groups
    assert plan.profile == "mine.toml"
    assert (libration.layout.path, long.layout.path) == ("/pendulum/libration", "/pendulum/long")
    assert libration.parameters == {"g": 9.81, "length": 1.0}
    assert libration.inputs["amplitude"].tolist() == [0.5, 1.0]
    assert libration.inputs["event"].tolist() == [0, 1]
    assert long.inputs["time"].tolist() == [1.0, 1000.0]
    assert (libration.taylor_elements, long.taylor_elements) == (4, None)


def test_a_range_is_rounded_once(tmp_path):
    times = plan_of(tmp_path, GOOD).groups[0].inputs["time"]
    assert times.tolist() == [k / 10 for k in range(11)]
    assert times.tolist() != np.linspace(0, 1, 11).tolist()


def test_a_dataset_of_ones_own_is_built_and_proven(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    plan_of(tmp_path, GOOD)
    assert main(["build", "--config", "mine.toml", "--jobs", "1", "--quiet"]) == 0
    dataset = reference.load("horologium-mine.h5")
    assert dataset.attrs["command"] == "python -m reference build --config mine.toml"
    assert dataset["pendulum/long/theta"].shape == (1, 2)
    assert main(["verify", "horologium-mine.h5", "--jobs", "1"]) == 0
    assert "15 of 15 variables proven." in capsys.readouterr().out


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('"/pendulum/libration"', '"/pendulum/libation"', "group '/pendulum/libation' is unknown, perhaps"),
        ('"pendulum/long"', '"pendulum/libration"', "/pendulum/libration has no 'event'"),
        ("g = 9.81", "gg = 9.81", "input of /pendulum/libration, 'gg' is unknown"),
        ("g = 9.81", "", "/pendulum/libration has no 'g'; it needs g, length, amplitude, time, event"),
        ("g = 9.81", "g = -9.81", "g is -9.81; a positive number"),
        ("g = 9.81", "g = nan", "g is 'nan', which spells no number"),
        ("g = 9.81", "g = 1e999", "g is 1e999, which is beyond the range of binary64"),
        ("g = 9.81", "g = true", "g is True; a number is accepted"),
        ("[0.5,", "[4.5,", "theta0 is 4.5; an amplitude"),
        ("[0.5,", "[[0.5],", "amplitude is ['0.5']; a number"),
        ('[0.5, "1.0"]', "[]", "amplitude must be a non-empty list"),
        ("count = 11", "count = 0", "time has the count 0; an integer from 1 to"),
        ("count = 11", "count = 99999999", "time has the count 99999999"),
        (", count = 11", "", "time has start, stop; a range has start, stop, count"),
        ("event = 2", "event = -1", "event has the count -1"),
        ("event = 2", 'event = ["first"]', "event 'first' is unknown"),
        ("taylor_elements = 4", 'taylor_elements = "4"', "taylor_elements has the count '4'"),
        ("g = 9.81", 'g = "1/3"', "g is '1/3', a fraction; a stored input is a binary64 number"),
        ("amplitude = [0.5,", 'amplitude = ["1/4",', "amplitude is '1/4', a fraction; a stored input is a binary64"),
        ("stop = 1,", 'stop = "1e400",', "time is from 0 to 1e400, which is beyond the range of binary64"),
        ("event = 2", "event = [0, -1]", "event is -1; an integer from 0"),
        ("event = 2", "event = [99999999999]", "event is 99999999999; an integer from 0"),
        ("event = 2", "event = [[1]]", "event is [1]; an integer from 0"),
        ("event = 2", "event = [true]", "event is True; an integer from 0"),
        ("[[group]]", "[[grop]]", "must hold one table [[group]] or more, and nothing else"),
        (GOOD, "", "must hold one table [[group]]"),
        (GOOD, "[[group]", "is no TOML"),
    ],
)
def test_what_is_wrong_with_a_grid_file_is_one_sentence(tmp_path, capsys, old, new, words):
    path = tmp_path / "mine.toml"
    path.write_text(GOOD.replace(old, new, 1))
    assert main(["build", "--config", str(path), "--out", str(tmp_path / "x.h5")]) == 2
    err = capsys.readouterr().err
    assert words in err
    assert err.startswith("error: ")
    assert err.count("\n") == 1
    assert [found.name for found in tmp_path.iterdir()] == ["mine.toml"]


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ('path = "/pendulum/series"\namplitude = 0.5\norder = [101]', "order is 101; an integer from 0 to 100"),
        ('path = "/descent/race"\ncurve = 1\ntime = 0\nfraction = 1.5', "fraction is 1.5; a fraction of the way"),
        ('path = "/descent/race"\ncurve = 1\ntime = 60\nfraction = 1', "t is 60.0; a time from 0 to the descent time"),
        ('path = "/polar/family"\nz0 = 0.5\npsi = 1\nheight = -0.5\nepsilon = 0', "height is -0.5; a number with 0 <="),
        ('path = "/polar/family"\nz0 = 0.5\npsi = 1\nheight = 0\nepsilon = 2', "epsilon is 2.0; a number with -1 <="),
    ],
)
def test_an_argument_that_a_row_does_not_take_is_told_before_the_proof(tmp_path, table, words):
    fixed = "g = 9.81\nlength = 1\n" if "pendulum" in table else "g = 9.81\n" if "descent" in table else ""
    with pytest.raises(ValueError, match=r"accepted\.$") as caught:
        plan_of(tmp_path, f"[[group]]\n{fixed}{table}\n")
    assert words in str(caught.value)


def test_zeros_of_a_grid_have_no_sign(tmp_path):
    text = GOOD.replace("time = [1, 1e3]", "time = [-0.0, 1e3]").replace("start = 0,", "start = -1e-400,")
    for group in plan_of(tmp_path, text).groups:
        assert not np.signbit(group.inputs["time"]).any()


def test_a_group_that_is_there_twice_is_refused(tmp_path):
    once = GOOD[: GOOD.index("[[group]]", 10)]
    with pytest.raises(ValueError, match=r"^the group /pendulum/libration is there 2 times; once is accepted\.$"):
        plan_of(tmp_path, once + once)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("no.toml", "No such file"),
        ("x.txt", r"ends with \.toml"),
        ("", r"ends with \.toml"),
        ("a\x1b.toml", r"a printable name that ends with"),
    ],
)
def test_a_file_that_cannot_be_read_is_refused(tmp_path, name, words):
    with pytest.raises(ValueError, match=words):
        plan_from(str(tmp_path / name) if name else "")


def test_config_and_profile_exclude_each_other(capsys):
    assert main(["build", "--profile", "full", "--config", "mine.toml"]) == 2
    assert "--config: not allowed with argument --profile" in capsys.readouterr().err


def test_the_output_may_not_be_the_grid_file(tmp_path, capsys):
    path = tmp_path / "mine.toml"
    path.write_text(GOOD)
    link = tmp_path / "x.h5"
    link.symlink_to(path)
    for out in (path, link):
        assert main(["build", "--config", str(path), "--out", str(out)]) == 2
        assert "is the grid file itself; choose another output path.\n" in capsys.readouterr().err
    assert path.read_text() == GOOD


@pytest.mark.parametrize("name", [os.fsdecode(b"\xff.toml"), "a\nb.toml", "\x1b[1m.toml"])
def test_a_name_that_cannot_be_stored_is_told_before_the_proof(tmp_path, capsys, name):
    path = tmp_path / name
    path.write_text(GOOD)
    assert main(["build", "--config", str(path), "--out", str(tmp_path / "x.h5")]) == 2
    assert "a printable name that ends with .toml is accepted.\n" in capsys.readouterr().err
    assert [found.name for found in tmp_path.iterdir()] == [name]
