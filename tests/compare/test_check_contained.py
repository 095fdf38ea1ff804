"""``python -m compare check`` runs a step in a process that it can end, and keeps stdout for the answer."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from compare.__main__ import main

ROOT = Path(__file__).parents[2]
STEPS = """
import contextlib, ctypes, locale, os, signal, sys, time, warnings
from pathlib import Path

HERE = Path(__file__).parent

def euler(f, y, h):
    return y + h * f(y)

def exits(f, y, h):
    os._exit(0)

def exits_with_five(f, y, h):
    os._exit(5)

def crashes(f, y, h):
    ctypes.string_at(0)

def is_killed(f, y, h):
    os.kill(os.getpid(), signal.SIGKILL)

def interrupts(f, y, h):
    raise KeyboardInterrupt

def wants_too_much(f, y, h):
    return bytearray(1 << 60)

def closes(f, y, h):
    os.closerange(3, 256)
    return euler(f, y, h)

def writes_everywhere(f, y, h):
    for number in range(3, 256):
        with contextlib.suppress(OSError):
            os.write(number, b"3\\n")
    return euler(f, y, h)

class Own(BaseException):
    pass

class Speechless(Exception):
    def __str__(self):
        raise RuntimeError

class Endless:
    def __len__(self):
        return 10**18

    def __getitem__(self, i):
        return 0.0

def raises_its_own(f, y, h):
    raise Own("red")

def is_speechless(f, y, h):
    raise Speechless

def talks_for_ever(f, y, h):
    raise ValueError("\\x1b[31m" + "x" * 1000000)

def returns_no_end(f, y, h):
    return Endless()

def keeps_every_exception(f, y, h):
    while True:
        try:
            time.sleep(0.05)
        except BaseException:
            pass

def changes_its_alarm(f, y, h):
    signal.signal(signal.SIGALRM, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    while True:
        time.sleep(0.05)

def prints(f, y, h):
    print("said with print")
    os.write(1, b"said to the file\\n")
    return euler(f, y, h)

def closes_its_output(f, y, h):
    os.close(1) if Path("/proc/self/fd/1").exists() else None
    return euler(f, y, h)

def reads(f, y, h):
    return euler(f, y, h) if sys.stdin.read() == "" and os.read(0, 1) == b"" else y

def moves(f, y, h):
    os.chdir("/")
    locale.setlocale(locale.LC_ALL, "C")
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    warnings.simplefilter("error")
    os.environ.clear()
    return euler(f, y, h)

def forks(f, y, h):
    if not (HERE / "forked").exists():
        (HERE / "forked").touch()
        child = os.fork()
        if not child:
            (HERE / "child").write_text(str(os.getpid()))
    return euler(f, y, h)

def leaves_a_process(f, y, h):
    if not (HERE / "child").exists():
        child = os.fork()
        if not child:
            time.sleep(60)
            os._exit(0)
        (HERE / "child").write_text(str(child))
    return euler(f, y, h)

def waits(f, y, h):
    (HERE / "child").write_text(str(os.getpid()))
    time.sleep(60)
"""


AS_FROM_A_TERMINAL = """
import signal, sys
from compare.__main__ import main
signal.signal(signal.SIGINT, signal.default_int_handler)
sys.exit(main(sys.argv[1:]))
"""


@pytest.fixture
def steps(tmp_path):
    (tmp_path / "own.py").write_text(STEPS)
    return tmp_path / "own.py"


@pytest.mark.parametrize(
    ("step", "says"),
    [
        ("exits", "exits ended its process with exit code 0; "),
        ("exits_with_five", "exits_with_five ended its process with exit code 5; "),
        ("crashes", "crashes had its process ended by SIGSEGV; "),
        ("is_killed", "is_killed had its process ended by SIGKILL; "),
        ("interrupts", "interrupts raised KeyboardInterrupt; "),
        ("closes", "closes closed files of its process that it did not open; "),
        ("writes_everywhere", "the step wrote into files of its process that it did not open; "),
        ("raises_its_own", "raises_its_own raised Own; "),
        ("keeps_every_exception", "keeps_every_exception took more than 1 s and had to be ended; "),
        ("changes_its_alarm", "changes_its_alarm took more than 1 s and had to be ended; "),
    ],
)
def test_a_step_that_takes_its_process_along_is_one_sentence_with_the_claim(step, says, steps, capsys):
    words = ["--order", "4", "--symplectic", "--seconds", "1" if "1 s" in says else "30"]
    assert main(["check", f"{steps}:{step}", *words]) == 2
    out, err = capsys.readouterr()
    verdict = "a step that returns is accepted, and there is no verdict on the claim order 4 and symplectic.\n"
    assert (out, err) == ("", f"error: {says}{verdict}")


@pytest.mark.parametrize(
    ("step", "says"),
    [
        ("is_speechless", "is_speechless raised Speechless."),
        ("talks_for_ever", f"talks_for_ever raised ValueError: \\x1b[31m{'x' * 392}...."),
        ("returns_no_end", "returns_no_end returned a sequence that no memory holds; a state is accepted."),
    ],
)
def test_what_a_step_raises_or_returns_is_told_in_one_short_line(step, says, steps, capsys):
    assert main(["check", f"{steps}:{step}", "--order", "4"]) == 2
    out, err = capsys.readouterr()
    assert (out, err) == ("", f"error: {says}\n")


def test_more_memory_than_there_is_is_one_sentence(steps, capsys):
    assert main(["check", f"{steps}:wants_too_much"]) == 2
    assert capsys.readouterr() == ("", "error: wants_too_much raised MemoryError.\n")


@pytest.mark.parametrize(
    ("step", "said"),
    [
        ("prints", {"said with print", "said to the file"}),
        ("closes_its_output", set()),
        ("reads", set()),
        ("moves", set()),
        ("forks", set()),
        ("leaves_a_process", set()),
    ],
)
def test_whatever_else_a_step_does_stdout_has_its_answer_alone(step, said, steps, capsys):
    assert main(["check", f"{steps}:{step}", "--order", "1", "--format", "json"]) == 0
    out, err = capsys.readouterr()
    assert json.loads(out)["measured_order"] == pytest.approx(1, abs=0.1)
    assert set(err.splitlines()) == said
    left = steps.parent / "child"
    assert not left.exists() or gone(int(left.read_text()))


@pytest.mark.parametrize(
    ("body", "says"),
    [
        ("import os; os._exit(0)", "step ended its process with exit code 0; "),
        ("raise KeyboardInterrupt", "step raised KeyboardInterrupt; "),
        ("while True: pass", "took more than 0.5 s to be imported; "),
        ("import sys; sys.exit(0)", "cannot be imported: SystemExit: 0"),
    ],
)
def test_a_module_that_does_so_when_it_is_imported_is_one_sentence(body, says, tmp_path, capsys):
    (tmp_path / "own.py").write_text(f"{body}\ndef step(f, y, h): return y\n")
    assert main(["check", f"{tmp_path / 'own.py'}:step", "--order", "4", "--seconds", "0.5"]) == 2
    out, err = capsys.readouterr()
    assert (out, err.count("\n")) == ("", 1)
    assert says in err


@pytest.mark.parametrize(
    ("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGKILL, -signal.SIGKILL)]
)
def test_the_step_ends_with_the_command_that_tries_it(number, code, steps):
    command = [sys.executable, "-c", AS_FROM_A_TERMINAL, "check", f"{steps}:waits"]
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        left = steps.parent / "child"
        wait_for(lambda: left.exists() and left.read_text())
        os.kill(process.pid, number)
        assert process.wait(60) == code
    assert gone(int(left.read_text()))


def wait_for(happens) -> bool:
    end = time.monotonic() + 60
    while not (found := happens()) and time.monotonic() < end:
        time.sleep(0.02)
    return bool(found)


def gone(process: int) -> bool:
    """Whether a process ends: one that has, and is not waited for by anybody yet, is a zombie."""
    status = Path(f"/proc/{process}/stat")

    def ended() -> bool:
        if Path("/proc/self").exists():
            try:
                return status.read_text().rpartition(")")[2].split()[0] == "Z"
            except (FileNotFoundError, ProcessLookupError):
                return True
        try:
            os.kill(process, 0)
        except ProcessLookupError:
            return True
        return False

    return wait_for(ended)
