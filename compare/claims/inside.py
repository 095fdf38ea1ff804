"""The inside of a contained check: the process in which a user's module is imported and its step is run."""

from __future__ import annotations

import json
import os
import signal
import sys
import threading
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

__all__ = ["CLOSED", "name_of", "serve"]

CLOSED = 117
"""The exit code where the answer cannot be sent."""

EXIT_CODES = {True: 0, False: 1, None: 3}
"""Of a check whose claims hold, of which one fails, or of which one is not established."""
FOLLOWING = 0.5
"""Seconds between looks whether the process that asked is still there."""


def serve(handle: int, told: str) -> None:
    """Answer a request through the pipe with this number, and end; a copy that the step has forked says nothing."""
    line = _Line(handle)
    threading.Thread(target=_follow, args=(os.getppid(), line), daemon=True).start()
    _first_to_go_where_memory_ends()
    try:
        line.say(_answer(line, json.loads(told)))
        code = 0
    except ClosedError:
        code = CLOSED
    with suppress(OSError, ValueError):
        sys.stdout.flush()
    os._exit(code)  # whatever the step has left to be done at the end


class ClosedError(Exception):
    """The step closed the pipe."""


class _Line:
    """The pipe, as long as it is this process's own."""

    def __init__(self, handle: int) -> None:
        self._handle, self._process, self._pipe = handle, os.getpid(), _identity(handle)

    @property
    def closed(self) -> bool:
        """Whether the step closed the pipe."""
        return _identity(self._handle) != self._pipe

    def say(self, message: dict[str, Any]) -> None:
        """Send a message.

        Raises:
            ClosedError: the pipe is closed, or its number is another file's.
        """
        if os.getpid() != self._process:
            os._exit(0)
        if self.closed:
            raise ClosedError
        left = json.dumps(message).encode() + b"\n"
        while left:
            left = left[os.write(self._handle, left) :]


def _identity(handle: int) -> tuple[int, int] | None:
    """Which file has this number; None if none has."""
    try:
        status = os.fstat(handle)
    except OSError:
        return None
    return status.st_dev, status.st_ino


def _answer(line: _Line, request: dict[str, Any]) -> dict[str, Any]:
    """The check as text with its exit code, as JSON has it, and where the step is written; or why it is refused."""
    from compare.methods.own.forms import loaded
    from reference.command.terminal import sentence

    options = request["options"]
    name = name_of(options)
    line.say({"stage": "begun"})
    try:
        step = _step(options, loaded)
        line.say({"stage": "loaded"})

        from compare.baseline import document_of
        from compare.claims import exchange, show
        from compare.claims.tried import tried
        from compare.show import render

        line.say({"stage": "ready"})
        if options.get("interpolant") is not None:
            options["interpolant"] = loaded(options["interpolant"])
        found = tried(step, {**options, **_problem(options.pop("problem", None))})
    except (OSError, ValueError, ImportError, ArithmeticError, RuntimeError) as error:
        return {"refused": sentence(error)}
    except BaseException as error:
        if isinstance(error, Exception):
            raise  # a fault of the judge's own, of which the traceback says most
        return {"left": f"{name} raised {type(error).__name__}"}
    page = show.page(found)
    document, place = document_of(page), exchange.place_of(step)
    writer = exchange.WRITERS.get(request["form"])
    text = render.render(page, request["form"]) if writer is None else writer(document, place, None)
    return {"text": text, "code": EXIT_CODES[found.claims_hold], "document": document, "place": place}


def _step(options: dict[str, Any], loaded: Any) -> Any:
    """The user's function, or program."""
    name, command = options.pop("step"), options.pop("process", None)
    if command is None:
        return loaded(name)
    from compare.claims.process import Process

    return Process(command, timed=options.get("form") == "own-timed")


def name_of(options: dict[str, Any]) -> str:
    """What is tried, as sentences name it."""
    return str(options.get("process") or options["step"]).rpartition(":")[2]


def _problem(asked: dict[str, Any] | None) -> dict[str, Any]:
    """The problem that is asked for, as an argument of ``check``; none where it is the usual one."""
    if asked is None:
        return {}
    from compare.study import problems_of
    from reference.problems.families import find_family

    return {"problem": problems_of(find_family(asked["family"]), asked["inputs"])[0]}


def _follow(parent: int, line: _Line) -> None:
    """End with the process that asked, however that ends, and where the answer cannot be sent.

    A compiler whose files the step closed with the others may wait for ever.
    """
    while os.getppid() == parent:
        if line.closed:
            os._exit(CLOSED)
        time.sleep(FOLLOWING)
    os.killpg(0, signal.SIGKILL)


def _first_to_go_where_memory_ends() -> None:
    """Where memory runs out it is this process that the kernel ends, and none that did not ask for it."""
    score = Path("/proc/self/oom_score_adj")
    if score.exists():
        with suppress(PermissionError):
            score.write_text("1000", encoding="ascii")
