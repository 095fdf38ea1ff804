"""The command line: what it prints and writes, and one sentence for every mistake."""

from __future__ import annotations

import errno
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from compare import arguments
from compare.__main__ import main
from compare.methods import METHODS
from compare.show import output

SMALL = ["pendulum", "--n", "128,256,512", "--methods", "euler,verlet"]
ROOT = Path(__file__).parents[2]


def _run(*words: str, **options) -> subprocess.CompletedProcess:
    command = [sys.executable, "-m", "compare", *words]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False, timeout=60, **options)


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ([], "no command is given; pendulum, "),
        (["pendlum"], "perhaps pendulum"),
        (["--quiet", "pendulum"], "'--quiet' is unknown"),
        (["pendulum", "again"], "'again' is one too many"),
        (["pendulum", "--fromat", "json"], "perhaps --format"),
        (["pendulum", "--format", "jsn"], "perhaps json"),
        (["pendulum", "--format"], "--format: expected one argument"),
        (["pendulum", "--precision", "float65"], "perhaps float64"),
        (["pendulum", "--methods", "verlot"], "verlet"),
        (["pendulum", "--methods", "euler,,rk4"], "empty value"),
        (["pendulum", "--methods", "rk4", "--methods", "rk4"], "rk4 twice"),
        (["pendulum", "--n", "0"], "--n 0 is not a number of steps"),
        (["pendulum", "--n", "-4,8"], "--n -4 is not a number of steps"),
        (["pendulum", "--n", "12.5"], "not a whole number"),
        (["pendulum", "--n", "9" * 5000], "not a whole number"),
        (["pendulum", "--n", "128,256,128"], "128 twice"),
        (["pendulum", "--theta0", "0"], "theta0"),
        (["pendulum", "--theta0", "3.15"], "theta0"),
        (["pendulum", "--theta0", "-1,2"], "theta0"),
        (["pendulum", "--theta0", "nan"], "theta0"),
        (["pendulum", "--theta0", "-inf"], "theta0"),
        (["pendulum", "--theta0", "one"], "'one' is not a number"),
        (["pendulum", "--g", "-9.81"], "g is -9.81"),
        (["pendulum", "--g", "inf"], "g is inf"),
        (["pendulum", "--length", "0"], "length"),
        (["pendulum", "--t-end", "-1"], "t_end"),
        (["list", "--format", "xml"], "accepted are text, markdown, csv, latex, json"),
        (["show"], "the following arguments are required: NAME"),
        (["show", "rk5"], "method 'rk5' is unknown, perhaps rk45 or rkf45 or rk4"),
        (["show", "rk4", "--format", "csv"], "accepted are text, markdown, latex, json"),
    ],
)
def test_a_mistake_is_one_sentence_and_exit_code_2(words, says, capsys):
    assert main(words) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("error: ")
    assert err.endswith(".\n")
    assert err.count("\n") == 1
    assert len(err) < 300
    assert says in err


def test_the_tables_are_printed_as_json(capsys):
    assert main([*SMALL, "--format", "json"]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    found = json.loads(out)
    assert [(row["method"], row["n"]) for row in found["tables"]["error_vs_n"]] == [
        (method, n) for method in ("euler", "verlet") for n in (128, 256, 512)
    ]
    assert found["parameters"]["theta0"] == [1.0]


def test_the_tables_are_text_by_default(capsys):
    assert main([*SMALL, "--theta0", "0.5,1", "--theta0", "2", "--quiet"]) == 0
    out = capsys.readouterr().out
    assert [f"Error against N, theta0 = {value} rad" in out for value in ("0.5", "1.0", "2.0")] == [True] * 3


def test_numbers_can_be_taken_as_written(capsys):
    words = [*SMALL, "--exact", "--theta0", "1/10", "--g", "9.81", "--format", "json"]
    assert main(words) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["parameters"]["theta0"] == ["0.1"]
    assert found["parameters"]["g"] == "9.81"
    assert main([*SMALL, "--theta0", "0.1", "--format", "json"]) == 0
    rounded = json.loads(capsys.readouterr().out)
    assert rounded["parameters"]["theta0"] == [0.1]
    assert rounded["tables"]["error_vs_n"] != found["tables"]["error_vs_n"]
    assert main(["pendulum", "--theta0", "1/10"]) == 2
    assert "--theta0 '1/10' is not a number" in capsys.readouterr().err


def test_options_given_reach_the_study_and_others_do_not():
    request = arguments.parse(["pendulum", "--g", "9", "--t-end=20", "--theta0", "1e-3,2", "--n", "8", "--plots"])
    assert request.options == {"g": 9.0, "t_end": 20.0, "theta0": (1e-3, 2.0), "n": (8,)}
    assert (request.form, request.out, request.plots, request.quiet) == ("text", None, True, False)


def test_out_writes_what_is_printed(tmp_path, capsys):
    target = tmp_path / "new" / "results"
    assert main([*SMALL, "--format", "markdown", "--out", str(target)]) == 0
    out, err = capsys.readouterr()
    assert (target / "pendulum.md").read_text("utf-8") == out
    assert err == f"wrote pendulum.md into {target}\n"
    assert [path.name for path in tmp_path.rglob("*") if path.name.startswith(".")] == []


def test_quiet_silences_the_notes_and_not_the_tables(tmp_path, capsys):
    assert main([*SMALL, "--quiet", "--out", str(tmp_path)]) == 0
    out, err = capsys.readouterr()
    assert "Energy drift" in out
    assert err == ""


def test_plots_go_to_a_folder_of_their_own_by_default(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["pendulum", "--n", "128,256", "--methods", "verlet", "--plots"]) == 0
    written = sorted(path.name for path in (tmp_path / "horologium-pendulum").iterdir())
    assert len(written) == 9
    assert "pendulum-phase-portrait.svg" in written
    assert "horologium-pendulum" in capsys.readouterr().err


@pytest.mark.parametrize("form", ["text", "json", "markdown", "csv", "latex"])
def test_list_names_every_method(form, capsys):
    assert main(["list", "--format", form]) == 0
    out = capsys.readouterr().out.replace(r"\_", "_")
    for method in METHODS:
        assert method.name in out
    if form == "json":
        found = json.loads(out)["methods"]
        assert [row["order"] for row in found] == [method.order for method in METHODS]
        assert set(found[0]) == {"name", "family", "order", "stages", "source", "symplectic", "aliases"}


def test_an_output_path_that_is_a_file_is_refused_and_kept(tmp_path, capsys):
    taken = tmp_path / "taken"
    taken.write_text("mine")
    for path in (taken, taken / "below", Path("/proc/nowhere")):
        assert main([*SMALL, "--out", str(path)]) == 2
        out, err = capsys.readouterr()
        assert out == ""
        assert err.startswith(f"error: cannot write results to '{path}': ")
    assert taken.read_text() == "mine"
    assert list(tmp_path.iterdir()) == [taken]


def test_a_full_disk_leaves_nothing_behind(tmp_path, capsys, monkeypatch):
    def full(_: int) -> None:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(output.os, "fsync", full)
    assert main([*SMALL, "--out", str(tmp_path / "a" / "b")]) == 2
    assert "no space left on device" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_a_mistake_after_the_folder_is_opened_leaves_nothing_behind(tmp_path):
    assert main(["pendulum", "--theta0", "7", "--out", str(tmp_path / "a")]) == 2
    assert list(tmp_path.iterdir()) == []


def test_files_of_an_older_run_are_replaced_together_or_not_at_all(tmp_path):
    (tmp_path / "one").write_text("old")
    (tmp_path / "two").mkdir()
    with pytest.raises(output.OutputError, match="two in it is a folder"), output.folder(tmp_path) as results:
        results.write({"one": b"new", "two": b"new"})
    assert (tmp_path / "one").read_text() == "old"
    (tmp_path / "two").rmdir()
    with output.folder(tmp_path) as results:
        results.write({"one": b"new", "two": b"new"})
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == {"one": "new", "two": "new"}


KILLED = """
import os, sys
from compare.show import output
calls = iter(range(int(sys.argv[1]), -1, -1))
def mortal(function):
    def called(*args, **kwargs):
        if next(calls) == 0:
            os._exit(9)
        return function(*args, **kwargs)
    return called
for name in ("mkdir", "open", "write", "fsync", "link", "replace", "rename", "unlink", "rmdir"):
    setattr(os, name, mortal(getattr(os, name)))
with output.folder(sys.argv[2]) as results:
    results.write({"one": b"new one", "two": b"new two"})
"""


def test_a_run_that_is_killed_at_any_call_loses_no_file_and_is_cleared_away(tmp_path):
    """At every moment each name has its old file or its new one, and others' folders of like names stay."""
    (tmp_path / ".horologium-1-notes").mkdir()
    (tmp_path / ".horologium-1-notes" / "mine").write_text("mine")
    (tmp_path / ".horologium-01234567").mkdir()
    (tmp_path / ".horologium-01234567" / "mine").write_text("mine")
    others = sorted(path.name for path in tmp_path.iterdir())
    for call in (7, 10, 14, 15, 16, 17, 18, 19, 20, 23, 32):
        for name in ("one", "two"):
            (tmp_path / name).write_text(f"old {name}")
        command = [sys.executable, "-c", KILLED, str(call), str(tmp_path)]
        ended = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
        assert (ended.returncode, ended.stderr) in {(9, ""), (0, "")}
        for name in ("one", "two"):
            assert (tmp_path / name).read_text() in {f"old {name}", f"new {name}"}
        with output.folder(tmp_path) as results:
            results.write({"one": b"new one"})
        left = [path for path in tmp_path.iterdir() if path.is_file() or any(path.iterdir())]  # or unmarked and empty
        assert sorted(path.name for path in left) == sorted([*others, "one", "two"])
        assert (tmp_path / ".horologium-1-notes" / "mine").read_text() == "mine"
    assert ended.returncode == 0


@pytest.mark.parametrize("kind", ["link", "link to nothing", "pipe"])
def test_what_is_no_file_in_place_of_a_result_is_refused_and_stays(tmp_path, kind):
    results_folder, place = tmp_path / "results", tmp_path / "results" / "two"
    results_folder.mkdir()
    (tmp_path / "theirs").write_text("theirs")
    (results_folder / "one").write_text("old")
    if kind == "pipe":
        os.mkfifo(place)
    else:
        place.symlink_to(tmp_path / ("theirs" if kind == "link" else "nowhere"))
    said = "two in it is a link" if "link" in kind else "two in it is something"
    with pytest.raises(output.OutputError, match=said), output.folder(results_folder) as results:
        results.write({"one": b"new", "two": b"new"})
    assert (results_folder / "one").read_text() == "old"
    assert place.is_symlink() == ("link" in kind)
    assert (tmp_path / "theirs").read_text() == "theirs"
    assert sorted(path.name for path in results_folder.iterdir()) == ["one", "two"]


def test_an_interrupt_while_files_are_moved_waits_until_all_are(tmp_path, monkeypatch):
    (tmp_path / "one").write_text("old")
    replace = Path.replace

    def interrupting(self, place):
        os.kill(os.getpid(), signal.SIGINT)
        return replace(self, place)

    monkeypatch.setattr(Path, "replace", interrupting)
    with pytest.raises(KeyboardInterrupt), output.folder(tmp_path) as results:
        results.write({"one": b"new", "two": b"new"})
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == {"one": "new", "two": "new"}


def test_an_interrupt_leaves_nothing_behind_and_exits_130(tmp_path, monkeypatch):
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("compare.__main__._study", interrupted)
    assert main([*SMALL, "--out", str(tmp_path / "a")]) == 130
    assert list(tmp_path.iterdir()) == []


def test_a_stdout_that_is_full_is_one_sentence():
    with Path("/dev/full").open("w") as full:
        command = [sys.executable, "-m", "compare", "list"]
        found = subprocess.run(command, cwd=ROOT, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert found.returncode == 2
    assert found.stderr == "error: No space left on device.\n"


def test_a_closed_pipe_is_quiet():
    read, write = os.pipe()
    os.close(read)
    command = [sys.executable, "-m", "compare", "list"]
    found = subprocess.run(command, cwd=ROOT, stdout=write, stderr=subprocess.PIPE, text=True, check=False)
    os.close(write)
    assert found.stderr == ""
    assert found.returncode == 0


def test_help_needs_no_heavy_imports():
    code = "import sys; from compare.__main__ import main\ntry: main(['--help'])\nexcept SystemExit: pass\n"
    code += "print(sorted({'heyoka', 'matplotlib', 'h5py', 'scipy', 'rich'} & set(sys.modules)))"
    found = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert found.stdout.endswith("[]\n")


def test_tables_show_on_a_terminal_without_unicode():
    found = _run(
        "pendulum", "--n", "128,256,512", "--methods", "verlet", env={**os.environ, "PYTHONIOENCODING": "ascii"}
    )
    assert found.returncode == 0
    assert "Energy trend" in found.stdout
