"""The manners that both command lines share: options and numbers told apart, closed outputs, orderly ends."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

import reference
from reference.__main__ import main
from reference.command.interrupts import Terminated, held
from reference.command.terminal import Parser, run

ROOT = Path(reference.__file__).parents[1]
AT = ["at", "pendulum", "--theta0", "1"]
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(ROOT)}


def parser():
    made = Parser(prog="x")
    made.add_argument("--t")
    made.add_argument("--format")
    made.add_argument("--exact", action="store_true")
    made.add_argument("file", nargs="?")
    return made


@pytest.mark.parametrize("value", ["-1", "-1e3", "-1/2", "-.5", "-inf", "-Infinity", "-NaN", "-1,2"])
def test_a_value_with_a_sign_is_no_option(value):
    assert parser().parse_args(["--t", value, "--exact"]).t == value
    assert parser().parse_args(["--exact", value]).file == value


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--foo"], "option '--foo' is unknown, perhaps --format"),
        (["--fromat=json"], "option '--fromat' is unknown, perhaps --format"),
        (["--t", "--exactly", "1"], "option '--exactly' is unknown, perhaps --exact"),
        (["-x"], "option '-x' is unknown; accepted are"),
        (["a", "b"], "the argument 'b' is one too many; options such as --t are accepted."),
        (["--t"], "--t: expected one argument."),
        (["--exact=1"], "--exact: ignored explicit argument '1'."),
    ],
)
def test_what_cannot_be_read_is_one_sentence_with_the_nearest_names(words, says):
    with pytest.raises(ValueError, match=r"\.$") as error:
        parser().parse_args(words)
    assert str(error.value).startswith(says)


def test_what_follows_two_dashes_is_no_option():
    assert parser().parse_args(["--", "--foo"]).file == "--foo"


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["at", "pendulum", "--theta", "1", "--t", "1"], "option '--theta' is unknown, perhaps --theta0"),
        ([*AT, "--t", "1", "--foo"], "option '--foo' is unknown, perhaps --format"),
        (["--foo", "build"], "command '--foo' is unknown; accepted are build, verify"),
        (["build", "--job", "2"], "perhaps --jobs"),
        (["show", "a", "b", "c"], "the argument 'c' is one too many"),
        ([*AT, "--t", "-inf"], "t is -inf, which is not finite"),
        ([*AT, "--t", "1", "--length", "-inf"], "length is -inf, which is not finite"),
    ],
)
def test_the_reference_names_the_nearest_option_and_refuses_numbers_by_value(words, says, capsys):
    assert main(words) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("error: ")
    assert err.count("\n") == 1
    assert says in err


@pytest.mark.parametrize("extra", [["--t", "-1e3"], ["--exact", "--t", "-1/2"]])
def test_times_before_the_release_are_numbers_like_others(extra, capsys):
    assert main([*AT, *extra, "--digits", "20", "--format", "json"]) == 0
    assert '"theta"' in capsys.readouterr().out


def shell(command, **kwargs):
    return subprocess.run(
        ["bash", "-c", command], env=ENVIRONMENT, capture_output=True, text=True, check=False, **kwargs
    )


@pytest.mark.parametrize("words", ["reference at pendulum --theta0 1 --t 1", "compare list"])
def test_a_closed_output_is_one_sentence(words):
    done = shell(f"'{sys.executable}' -m {words} >&-")
    assert (done.returncode, done.stderr) == (2, "error: standard output is closed; nothing could be printed.\n")


def test_a_closed_output_is_no_error_where_there_is_nothing_to_say(tmp_path):
    import numpy as np

    from reference.dataset.build import build
    from reference.dataset.plan import Plan
    from reference.layout import Group
    from reference.problems.pendulum import family as groups

    inputs = {"amplitude": [0.5], "time": np.arange(2) / 4}
    build(Plan("core", (Group(groups.DIMENSIONLESS, groups.UNIT, inputs),)), tmp_path / "x.h5")
    done = shell(f"'{sys.executable}' -m reference verify '{tmp_path}/x.h5' --jobs 1 --quiet >&-")
    assert (done.returncode, done.stderr) == (0, "")


def test_closed_errors_keep_the_exit_code():
    assert shell(f"'{sys.executable}' -m reference verify missing.h5 2>&-").returncode == 2
    assert shell(f"'{sys.executable}' -m compare pendlum <&- >&- 2>&-").returncode == 2


def test_no_file_gets_the_number_of_a_closed_output():
    code = (
        "import os; from reference.command.terminal import run; "
        "run(lambda _: os.write(2, b'%d' % os.open('/dev/null', 0)) * 0)"
    )
    assert int(shell(f'"{sys.executable}" -c "{code}" >&-').stderr) > 2


def test_the_signal_to_terminate_ends_a_command_in_good_order(capsys):
    cleared = []

    def command(_):
        try:
            os.kill(os.getpid(), signal.SIGTERM)
            time.sleep(5)
        finally:
            cleared.append(signal.getsignal(signal.SIGTERM))
        return 0

    assert run(command) == 143
    assert capsys.readouterr().err == "terminated.\n"
    assert cleared == [signal.SIG_IGN]  # once is enough: a second signal does not stop the clearing
    assert signal.getsignal(signal.SIGTERM) == signal.SIG_DFL
    assert not issubclass(Terminated, Exception)


@pytest.mark.parametrize(("number", "code"), [(signal.SIGTERM, 143), (signal.SIGINT, 130)])
@pytest.mark.parametrize("call", [1, 5, 40])
def test_a_signal_while_hdf5_writes_ends_the_build_and_leaves_no_file(tmp_path, monkeypatch, number, code, call):
    """HDF5 calls the sink: an exception there would be lost, and a file with a hole would take the old one's place."""
    from plans import TINY

    from reference.dataset.build import build
    from reference.dataset.writer import Sink

    calls = []
    write = Sink.write

    def signalled(self, data):
        calls.append(data)
        if len(calls) == call:
            os.kill(os.getpid(), number)
        return write(self, data)

    monkeypatch.setattr(Sink, "write", signalled)
    before = signal.getsignal(signal.SIGINT)
    assert run(lambda _: build(TINY, tmp_path / "x.h5") and 0) == code
    assert [path.name for path in tmp_path.iterdir()] == ["x.h5.partial"]
    assert signal.getsignal(signal.SIGINT) is before


def test_signals_that_are_held_come_when_they_are_let_in_or_at_the_end():
    come = []
    with pytest.raises(KeyboardInterrupt), held() as let_in:  # noqa: PT012 (the block is what is tested)
        os.kill(os.getpid(), signal.SIGINT)
        come.append("held")
        let_in()
        come.append("never")
    with pytest.raises(KeyboardInterrupt), held():  # noqa: PT012 (the same)
        os.kill(os.getpid(), signal.SIGINT)
        come.append("held")
    assert come == ["held", "held"]


def test_a_command_runs_in_any_thread():
    codes = []
    thread = threading.Thread(target=lambda: codes.append(run(lambda _: 0)))
    thread.start()
    thread.join()
    assert codes == [0]


def terminated(command, folder, until, group=None):
    """Start a command in a folder, send the signal once something that it makes is there; its exit code and stderr.

    With ``group`` it is this signal, sent to all of its processes, as a terminal or a time limit does.
    """
    command = [sys.executable, "-m", *command]
    streams = {"stderr": subprocess.PIPE, "stdout": subprocess.DEVNULL, "start_new_session": True}
    with subprocess.Popen(command, cwd=folder, env=ENVIRONMENT, **streams) as process:
        limit = time.monotonic() + 60
        while not until() and time.monotonic() < limit and process.poll() is None:
            time.sleep(0.02)
        if group is None:
            process.send_signal(signal.SIGTERM)
        else:
            os.killpg(process.pid, group)
        return process.wait(60), process.stderr.read()


def test_a_comparison_that_is_terminated_leaves_nothing(tmp_path):
    words = ["compare", "pendulum", "--n", "4194304", "--methods", "rk4", "--out", "results"]
    code, errors = terminated(words, tmp_path, lambda: any(tmp_path.iterdir()))
    assert (code, errors) == (143, b"terminated.\n")
    assert list(tmp_path.iterdir()) == []


def test_a_build_that_is_terminated_leaves_its_finished_blocks_and_no_temporary_file(tmp_path):
    words = ["reference", "build", "--out", "x.h5", "--jobs", "2"]
    code, errors = terminated(words, tmp_path, lambda: any(tmp_path.glob("x.h5.partial/*/*.block")))
    assert (code, errors) == (143, b"terminated.\n")
    assert [path.name for path in tmp_path.rglob("*") if path.suffix == ".tmp"] == []
    assert [path.name for path in tmp_path.iterdir()] == ["x.h5.partial"]


@pytest.mark.parametrize(
    ("number", "made", "found"),
    [
        (signal.SIGINT, "x.h5.partial", (130, b"interrupted.\n")),
        (signal.SIGTERM, "x.h5.partial/*/*.block", (143, b"terminated.\n")),
    ],
)
def test_a_build_whose_processes_are_all_signalled_says_one_line(tmp_path, number, made, found):
    """While they begin, and while they prove; a traceback of the pool's thread or of a process stood beside it."""
    words = ["reference", "build", "--out", "x.h5", "--jobs", "2"]
    assert terminated(words, tmp_path, lambda: any(tmp_path.glob(made)), number) == found
    assert [path.name for path in tmp_path.iterdir()] in ([], ["x.h5.partial"])
