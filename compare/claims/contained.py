"""A check in a process of its own, which can be ended: a user's step may exit, hang, fork, print or close files.

The process has its own session, no standard input, and its output comes back to be passed on to stderr; the answer goes
through a pipe of which the step knows nothing.  When there is an answer, or the time is up, the whole session's group
is ended.
"""

from __future__ import annotations

import contextlib
import json
import os
import select
import signal
import subprocess
import sys
import threading
import time
from typing import IO, TYPE_CHECKING, Any, NamedTuple

from compare.claims.inside import CLOSED, name_of
from compare.claims.limits import SECONDS

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["Answer", "ContainedError", "contained"]

CODE = "import sys; sys.path[:] = {path!r}; from compare.claims.inside import serve; serve({handle}, {told!r})"
GRACE = 0.6
"""Seconds by which the process outlives the time of a check, which it may end by itself with a better sentence."""
GENTLE = 0.3
"""Seconds between the request to end and the end."""
PAUSE = 0.05
SPOILT = "the step wrote into files of its process that it did not open"
LONGEST = 1 << 16
"""Bytes that are read at once."""


class ContainedError(ValueError):
    """No verdict could be made; its text is one sentence."""


class Answer(NamedTuple):
    """What a check says.

    Attributes:
        text: in the form that was asked for.
        code: the exit code: 0, 1 where a claim fails, or 3 where one is not established.
        document: its JSON.
        place: the file and the line where the step is written, None where nobody knows.
    """

    text: str
    code: int
    document: Any
    place: tuple[str, int] | None


def contained(options: dict[str, Any], form: str) -> Answer:
    """Run ``compare.check`` with these options, the step still by name, in a process of its own.

    Args:
        options: as of ``compare.claims.options.options``.
        form: one of ``compare.claims.options.FORMATS``.

    Raises:
        ContainedError: the check cannot be made, takes too long, or the step ended the process.
    """
    seconds, whole = float(options.get("seconds", SECONDS)), options.get("process") or options["step"]
    name = name_of(options)
    with _process({"options": options, "form": form}) as (process, messages):
        stages = (
            (None, ""),
            (seconds, f"{whole} took more than {seconds:g} s to be imported"),
            (max(seconds, SECONDS), f"{whole} keeps the judge from being imported"),
            (seconds + GRACE, f"{name} took more than {seconds:g} s and had to be ended"),
        )
        found: dict[str, Any] = {}
        for limit, late in stages:
            found = messages.next(limit) or {"left": _how_it_ended(process.pid, name, late)}
            if "left" in found:
                raise ContainedError(f"{found['left']}; a step that returns is accepted{_no_verdict(options)}.")
            if "refused" in found:
                raise ContainedError(found["refused"])
        place = None if found["place"] is None else (str(found["place"][0]), int(found["place"][1]))
        return Answer(found["text"], found["code"], found["document"], place)


def _how_it_ended(pid: int, name: str, late: str) -> str:
    """Why there is no answer."""
    ended = _ended(pid)
    if ended is None:
        return late
    if ended.si_code != os.CLD_EXITED:
        return f"{name} had its process ended by {signal.Signals(ended.si_status).name}"
    if ended.si_status == CLOSED:
        return f"{name} closed files of its process that it did not open"
    return f"{name} ended its process with exit code {ended.si_status}"


def _no_verdict(options: dict[str, Any]) -> str:
    """Which claims were being tested."""
    numbers = ("order", "dense", "estimate", "stiff", "tolerance", "events", "gradients")
    claims = [f"{name} {options[name]:g}" for name in numbers if options.get(name) is not None]
    claims += [claim for claim in ("backward", "symplectic", "reversible", "conserves") if options.get(claim)]
    return f", and there is no verdict on the claim {' and '.join(claims)}" if claims else ""


class _Messages:
    """Lines of JSON from a pipe, until it is closed or the process has ended."""

    def __init__(self, handle: int, pid: int) -> None:
        self._handle, self._pid = handle, pid
        self._text = b""

    def next(self, seconds: float | None) -> dict[str, Any] | None:
        """The next one; None where there is none within so many seconds, or will be none."""
        end = None if seconds is None else time.monotonic() + seconds
        while b"\n" not in self._text:
            over = _ended(self._pid) is not None
            if select.select([self._handle], [], [], 0 if over else PAUSE)[0]:
                more = os.read(self._handle, LONGEST)
                self._text += more
                if more:
                    continue
                over = over or _comes_to_an_end(self._pid, end)
            if over or (end is not None and time.monotonic() > end):
                return None
        line, _, self._text = self._text.partition(b"\n")
        try:
            found = json.loads(line)
        except ValueError:
            found = None
        return found if isinstance(found, dict) else {"left": SPOILT}


def _comes_to_an_end(pid: int, end: float | None) -> bool:
    """Wait for a process that can say nothing more, at most until then."""
    while _ended(pid) is None:
        if end is not None and time.monotonic() > end:
            return False
        time.sleep(PAUSE)
    return True


def _ended(pid: int) -> Any:
    """How a process of ours ended; None where it goes on.  It keeps its number."""
    return os.waitid(os.P_PID, pid, os.WEXITED | os.WNOHANG | os.WNOWAIT)


@contextlib.contextmanager
def _process(request: dict[str, Any]) -> Iterator[tuple[subprocess.Popen[bytes], _Messages]]:
    """The process that answers a request, and what it says; it and all of its group have ended afterwards."""
    read, write = os.pipe()
    code = CODE.format(path=sys.path, handle=write, told=json.dumps(request))
    try:
        process = subprocess.Popen(  # noqa: S603 - this interpreter, and code of our own
            [sys.executable, "-u", "-c", code],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            pass_fds=(write,),
            start_new_session=True,
        )
    except BaseException:
        os.close(read)
        raise
    finally:
        os.close(write)
    output: Any = process.stdout
    passing = threading.Thread(target=_pass_on, args=(output,), daemon=True)
    passing.start()
    try:
        yield process, _Messages(read, process.pid)
    finally:
        _end(process)
        os.close(read)
        passing.join(GENTLE)
        if not passing.is_alive():
            output.close()


def _pass_on(output: IO[bytes]) -> None:
    """What the step prints goes to stderr, so that stdout has the answer alone."""
    while printed := os.read(output.fileno(), LONGEST):
        with contextlib.suppress(OSError, ValueError):  # where stderr is closed nobody wants to know
            sys.stderr.write(printed.decode("utf-8", "replace"))


def _end(process: subprocess.Popen[bytes]) -> None:
    """End a process and all of its group, which nothing else has the number of until it is waited for."""
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.killpg(process.pid, signal.SIGTERM)
        _comes_to_an_end(process.pid, time.monotonic() + GENTLE)
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()
