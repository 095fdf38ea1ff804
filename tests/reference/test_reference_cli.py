"""The command line: what it prints, and one sentence and exit code 2 for whatever a user can get wrong."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from decimal import Decimal
from pathlib import Path

import numpy as np
import pytest

import reference
from reference import Pendulum
from reference.__main__ import CITATIONS, main
from reference.command.terminal import run
from reference.dataset import catalogue
from reference.dataset.build import build
from reference.dataset.plan import Plan
from reference.dataset.reader import core_path
from reference.layout import Group
from reference.problems.pendulum import family as groups

ROOT = Path(reference.__file__).parents[1]
AT = ["at", "pendulum", "--theta0", "1", "--t", "10"]


@pytest.fixture(scope="module")
def tiny(tmp_path_factory):
    path = tmp_path_factory.mktemp("cli") / "tiny.h5"
    inputs = {"amplitude": [0.5], "time": np.arange(3) / 4}
    build(Plan("core", (Group(groups.DIMENSIONLESS, groups.UNIT, inputs),)), path)
    return path


def called(*arguments):
    """Exit code of the command line in this process."""
    try:
        return main([str(argument) for argument in arguments])
    except SystemExit as stop:
        return stop.code


def refused(capsys, *arguments):
    """The one sentence on stderr."""
    assert called(*arguments) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("error: ")
    assert err.endswith(".\n")
    assert err.count("\n") == 1
    return err


def test_a_pendulum_set_going_is_served(capsys):
    assert main(["at", "pendulum", "--theta0", "0", "--omega0", "7", "--t", "1", "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert list(found) == ["theta", "omega", "period", "energy"]
    assert float(found["energy"]) == 7**2 / 2 - 9.81
    assert main(["at", "pendulum", "--theta0=0", "--omega0=-2", "--g=1", "--t=1", "--format=json"]) == 0
    assert list(json.loads(capsys.readouterr().out)) == ["theta", "omega", "energy"]
    assert main(["at", "pendulum", "--theta0", "-3", "--t", "1"]) == 2
    assert "0 < theta0 < pi" in capsys.readouterr().err


def test_json_is_one_object_of_proven_decimals(capsys):
    assert called(*AT, "--digits", "50", "--format", "json") == 0
    found = json.loads(capsys.readouterr().out)
    problem = Pendulum(1.0)
    assert list(found) == ["theta", "omega", "period", "energy"]
    assert found["period"] == problem.period().digits(50)
    assert all(len(Decimal(text).as_tuple().digits) == 50 for text in found.values())
    assert float(found["theta"]) == problem.state(10.0)[0]


def test_text_repeats_the_inputs_exactly(capsys):
    assert called(*AT, "--digits", "20") == 0
    out = capsys.readouterr().out
    assert "g = 9.81 (exactly 9.8100000000000004973799150320701301097869873046875, 0x1.39eb851eb851fp+3) m s-2" in out
    assert "theta0 = 1.0 (0x1.0000000000000p+0) rad" in out
    assert f"period = {Pendulum(1.0).period().digits(20)} s" in out


def test_a_number_is_binary64_and_with_exact_as_written(capsys):
    found = {}
    for flags in ((), ("--exact",)):
        called("at", "pendulum", "--theta0", "0.1", "--t", "0.3", "--format", "json", *flags)
        found[flags] = json.loads(capsys.readouterr().out)["theta"]
    assert found[()] == Pendulum(0.1).certified("state", *_time(0.3)).digits(50)
    assert found["--exact",] == Pendulum("0.1", "9.81").certified("state", *_time("0.3")).digits(50)
    assert found[()] != found["--exact",]


def _time(value):
    from reference.arithmetic.exact import exact

    return (exact(value),)


def test_exact_takes_fractions_and_repeats_them(capsys):
    assert called("at", "pendulum", "--theta0", "1/3", "--t", "1/7", "--exact", "--digits", "5") == 0
    out = capsys.readouterr().out
    assert "theta0 = 1/3 rad" in out
    assert "t = 1/7 s" in out


def test_routes_are_shown_when_asked(capsys):
    assert called(*AT, "--routes", "--format", "json") == 0
    routes = json.loads(capsys.readouterr().out)["routes"]
    assert min(min(digits.values()) for digits in routes.values()) >= 45


@pytest.mark.parametrize(
    ("option", "value", "words"),
    [
        ("--theta0", "0", "0 < theta0 < pi"),
        ("--theta0", "3.1415926535897936", "0 < theta0 < pi"),
        ("--theta0", "4", "0 < theta0 < pi"),
        ("--theta0", "-1", "0 < theta0 < pi"),
        ("--theta0", "nan", "not finite"),
        ("--theta0", "inf", "not finite"),
        ("--theta0", "1e999", "not finite"),
        ("--theta0", "abc", "spells no number"),
        ("--theta0", "1/3", "--exact"),
        ("--theta0", "", "spells no number"),
        ("--g", "-9.81", "g is -9.81"),
        ("--g", "0", "positive"),
        ("--length", "0", "length is 0.0"),
        ("--length", "-1", "positive"),
        ("--t", "", "t is ''"),
        ("--t", "nan", "t is nan"),
        ("--t", "inf", "t is inf"),
        ("--digits", "0", "1 to 30000"),
        ("--digits", "-1", "1 to 30000"),
        ("--digits", "1.5", "1 to 30000"),
        ("--digits", "30001", "1 to 30000"),
        ("--digits", "9" * 5000, "1 to 30000"),
        ("--format", "jsn", "perhaps json"),
    ],
)
def test_a_bad_input_is_one_sentence(capsys, option, value, words):
    assert words in refused(capsys, *AT, f"{option}={value}")


def test_a_proof_beyond_the_bound_on_its_work_is_refused(capsys):
    assert "working precision" in refused(
        capsys, "at", "pendulum", "--theta0", "1e-3900", "--t", "1e3999", "--exact", "--digits", "30000"
    )


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((), "COMMAND"),
        (("bild",), "perhaps build"),
        (("at", "pendulm"), "perhaps pendulum"),
        (("at", "pendulum", "--theta0", "1"), "--t"),
        (("at", "pendulum", "--theta0"), "--theta0: expected one argument"),
        ((*AT, "--digts", "3"), "--digts"),
        (("build", "--profile", "ful"), "perhaps full"),
        (("build", "--jobs", "0"), "jobs is '0'"),
        (("build", "--jobs", "two"), "jobs is 'two'"),
        (("build", "--out", "."), "folder"),
        (("build", "--out", ""), "empty"),
        (("build", "--out", "missing/x.h5"), "does not exist"),
        (("build", "--out", "/proc/x.h5"), "cannot be written"),
        (("build", "--out", "x.h5", "--executor", "dsk:1"), "executor 'dsk:1' is unknown"),
        (("verify", "missing.h5"), "does not exist"),
        (("verify", "."), "folder"),
        (("verify", "/dev/null"), "not a regular file"),
        (("cite", "--format", "bibtx"), "perhaps bibtex"),
    ],
)
def test_a_wrong_command_is_one_sentence_and_leaves_nothing(capsys, tmp_path, monkeypatch, arguments, words):
    monkeypatch.chdir(tmp_path)
    assert words in refused(capsys, *arguments)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("content", [b"", b"text\n"])
def test_commands_on_what_is_no_dataset_are_refused(capsys, tmp_path, content):
    path = tmp_path / "x.h5"
    path.write_bytes(content)
    for command in ("verify", "show", "cite"):
        assert str(path) in refused(capsys, command, path)


def test_verify_prints_a_line_a_variable(capsys, tiny):
    assert called("verify", tiny, "--jobs", 1) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 4
    assert lines[-1] == "3 of 3 variables proven."
    assert called("verify", tiny, "--jobs", 1, "--quiet") == 0
    assert capsys.readouterr().out == ""


def test_a_failed_proof_is_exit_code_1(capsys, tiny, monkeypatch):
    import reference.dataset.verify

    failed = [reference.dataset.verify.Proof("x", Pendulum.rows[0], 1, 1, "differs")]
    monkeypatch.setattr(reference.dataset.verify, "verify", lambda *_, **__: failed)
    assert called("verify", tiny) == 1
    assert capsys.readouterr().out == "FAILED  x: differs\n0 of 1 variables proven.\n"


def test_an_altered_file_is_refused_by_verify(capsys, tiny, tmp_path):
    for name in ("tiny.h5", "SHA256SUMS"):
        shutil.copy(tiny.parent / name, tmp_path)
    data = bytearray((tmp_path / "tiny.h5").read_bytes())
    data[-1] ^= 1
    (tmp_path / "tiny.h5").write_bytes(data)
    assert "SHA256SUMS" in refused(capsys, "verify", tmp_path / "tiny.h5")


def test_show_prints_the_tree_a_group_and_a_variable(capsys, tiny):
    assert called("show", tiny) == 0
    tree = capsys.readouterr().out
    assert "/pendulum/dimensionless" in tree
    assert "  theta [amplitude 1, time 3] rad" in tree
    assert called("show", tiny, "/pendulum/dimensionless/theta") == 0
    value, *tail = Pendulum(0.5, g=1.0).state(0.5, limbs=3)[0].tolist()
    assert f"[0, 2]: {value!r} {tail[0]!r} {tail[1]!r}" in capsys.readouterr().out
    assert called("show", tiny, "pendulum/dimensionless/period", "--format", "json") == 0
    found = json.loads(capsys.readouterr().out)
    assert found["value"] == [float(Pendulum(0.5, g=1.0).period())]
    assert called("show", tiny, "--format", "json") == 0
    assert "pendulum/dimensionless/time" in json.loads(capsys.readouterr().out)["variables"]
    assert "pendulum/dimensionless/theta" in refused(capsys, "show", tiny, "pendulum/dimensionless/thta")


def test_cite_gives_version_and_fingerprint(capsys, tiny):
    for form in CITATIONS:
        assert called("cite", tiny, "--format", form) == 0
        out = capsys.readouterr().out
        assert reference.__version__ in out
        assert reference.load(tiny).fingerprint in out


def test_build_writes_where_it_is_told(capsys, tmp_path, monkeypatch):
    monkeypatch.setattr(catalogue, "plan", lambda *_: Plan("core", (Group(groups.LONG, groups.EARTH, GRID),)))
    out = tmp_path / "x.h5"
    assert called("build", "--out", out, "--jobs", 1) == 0
    assert f"fingerprint sha256:{reference.load(out).fingerprint}" in capsys.readouterr().out
    assert called("build", "--out", out, "--jobs", 1, "--quiet") == 0
    assert capsys.readouterr().out == ""


GRID = {"amplitude": [1.0], "time": [1.0]}


def test_an_interrupt_is_one_line_and_exit_code_130(capsys):
    def interrupted(_arguments):
        raise KeyboardInterrupt

    assert run(interrupted) == 130
    assert capsys.readouterr().err == "interrupted.\n"


def program(arguments, **kwargs):
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    return subprocess.run(arguments, env=environment, capture_output=True, text=True, check=False, **kwargs)


def test_a_pipe_that_closes_early_is_no_error():
    command = (
        f"set -o pipefail; '{sys.executable}' -m reference show '{core_path()}' pendulum/libration/theta | head -1"
    )
    done = program(["bash", "-c", command])
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.startswith("/pendulum/libration/theta")


def test_a_full_output_is_one_sentence():
    done = program(["bash", "-c", f"'{sys.executable}' -m reference {' '.join(AT)} > /dev/full"])
    assert (done.returncode, done.stderr) == (2, "error: No space left on device.\n")


def test_at_needs_neither_heyoka_nor_hdf5():
    heavy = "print({'heyoka', 'h5py', 'rich'} & set(sys.modules))"
    code = f"import sys; from reference.__main__ import main; main({AT!r}); {heavy}"
    assert program([sys.executable, "-c", code]).stdout.endswith("set()\n")


def test_the_version_is_the_one_of_the_package():
    import tomllib

    assert tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]["version"] == reference.__version__


def test_at_says_where_no_other_route_reaches(capsys):
    assert main(["at", "polar", "--end", "0.5,1e-90", "--digits", "5", "--routes"]) == 0
    printed = capsys.readouterr().out
    assert "    no other route reaches it\n" in printed
    assert "agreed by \n" not in printed
