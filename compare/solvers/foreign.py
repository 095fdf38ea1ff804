"""Calling what others wrote: whatever it does, the caller goes on and knows what it said."""

from __future__ import annotations

import contextlib
import ctypes
import os
import sys
import tempfile
import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Generic, TypeVar

from compare.solvers.solver import SolverError, StoppedError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

__all__ = ["Heard", "heard"]

LENGTH = 160
"""Characters of a message that are repeated."""
Value = TypeVar("Value")


@dataclass(frozen=True)
class Heard(Generic[Value]):
    """What came of a foreign call.

    Attributes:
        value: what it returned; None where it failed.
        failure: its own message, or "" where it did not fail.
        said: its warnings, each once.
        stopped: whether it failed because it was stopped.
    """

    value: Value | None
    failure: str
    said: tuple[str, ...]
    stopped: bool = False


def heard(call: Callable[[], Value]) -> Heard[Value]:
    """Make a foreign call; its failures and warnings are an answer, and what it prints stays off the terminal."""
    value, failure, stopped = None, "", False
    with warnings.catch_warnings(record=True) as caught, _printed() as printed:
        warnings.simplefilter("always")
        try:
            value = call()
        except SolverError as error:
            failure, stopped = _brief(str(error)), isinstance(error, StoppedError)
        except Exception as error:  # noqa: BLE001 - a foreign solver may fail in any way; how it does is what is reported
            failure = _brief(f"{type(error).__name__}: {error}")
    if failure and printed:
        failure = _brief(f"{failure}; it printed: {' '.join(printed)}")
    kinds = (DeprecationWarning, PendingDeprecationWarning, ImportWarning, ResourceWarning)
    told = [_brief(str(warning.message)) for warning in caught if not issubclass(warning.category, kinds)]
    return Heard(value, failure, tuple(dict.fromkeys(told)), stopped)


def _brief(text: str) -> str:
    """The text in one line, cut where it is long."""
    line = " ".join(text.split())
    return line if len(line) <= LENGTH else f"{line[: LENGTH - 3].rstrip()}..."


@contextlib.contextmanager
def _printed() -> Iterator[list[str]]:
    """Collect what is written to the standard streams inside, by Python or by compiled code, as a list of lines."""
    lines: list[str] = []
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as noise:
        with _replaced(noise.fileno()), contextlib.redirect_stdout(noise), contextlib.redirect_stderr(noise):
            yield lines
        noise.seek(0)
        lines += [line.strip() for line in noise if line.strip()]


@contextlib.contextmanager
def _replaced(handle: int) -> Iterator[None]:
    """Let the streams of compiled code, which know nothing of Python's, end in another file."""
    _flush()
    kept = [os.dup(stream) for stream in (1, 2)]
    try:
        for stream in (1, 2):
            os.dup2(handle, stream)
        yield
    finally:
        _flush()
        for stream, copy in zip((1, 2), kept, strict=True):
            os.dup2(copy, stream)
            os.close(copy)


def _flush() -> None:
    for stream in (sys.stdout, sys.stderr):
        stream.flush()
    ctypes.CDLL(None).fflush(None)
