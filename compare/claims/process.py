"""A step in another process, of any language: a program that reads a line with h and the state, and writes the new one.

    h y1 y2 ...                   reads, decimals with a blank between them;
    h t y1 y2 ...                 with the time of the step's beginning where it is ``timed``;
    y1 y2 ...                     writes, and flushes its output.

It has the equation of the problem built in, which is told it in no other way.
"""

from __future__ import annotations

import inspect
import shlex
import subprocess
import weakref
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.claims.frames import MisuseError
from compare.methods.own.deadline import TimeOut

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["Process"]

AT_ONCE = 64
"""Lines that are written before the answers are read: so many fit into the buffer of any pipe."""
TOLD = 60
"""Characters of an answer that are repeated."""


class Process:
    """A program as a step ``(y, h)``, or ``(t, y, h)``; it is started with the first, and ended with this object.

    Args:
        command: the program and its arguments, as a list or as a shell would split them.
        timed: whether it reads the time.

    Raises:
        ValueError: the command is empty, or has a quotation that does not end.
    """

    def __init__(self, command: str | Sequence[str], *, timed: bool = False) -> None:
        try:
            self._command = shlex.split(command) if isinstance(command, str) else list(command)
        except ValueError as error:
            raise ValueError(
                f"the command {command} has no end ({str(error).rstrip('.').lower()}); words as a shell takes them are "
                "accepted."
            ) from None
        if not self._command:
            raise ValueError("the command is empty; a program and its arguments are accepted.")
        self._timed, self._process = timed, None
        self.__name__ = shlex.join(self._command)
        names = ("t", "y", "h") if timed else ("y", "h")
        kind = inspect.Parameter.POSITIONAL_ONLY
        self.__signature__ = inspect.Signature([inspect.Parameter(name, kind) for name in names])

    _process: subprocess.Popen[str] | None

    def __call__(self, *arguments: Any) -> np.ndarray:
        """The state [state] or states [state, lanes] a step later.

        Raises:
            MisuseError: the program cannot be started, has ended, or wrote no such state.
            TypeError: a number is a symbol.
        """
        t, y, h = arguments if self._timed else (None, *arguments)
        y = np.asarray(y)
        if y.dtype == object:
            raise TypeError("a program takes numbers alone.")
        lanes = y.reshape(len(y), -1).astype(float)
        first = [np.broadcast_to(np.asarray(h, dtype=float), lanes.shape[1:])]
        if t is not None:
            first.append(np.broadcast_to(np.asarray(t, dtype=float), lanes.shape[1:]))
        lines = [" ".join(map(repr, column)) for column in np.vstack([*first, lanes]).T.tolist()]
        answers = [self._answers(lines[i : i + AT_ONCE], len(y)) for i in range(0, len(lines), AT_ONCE)]
        found: np.ndarray = np.array(sum(answers, [])).T.reshape(y.shape)  # noqa: RUF017 - a few lists
        return found

    def _answers(self, lines: Sequence[str], count: int) -> list[list[float]]:
        process = self._started()
        assert process.stdin is not None  # noqa: S101 - both are pipes
        assert process.stdout is not None  # noqa: S101
        try:
            process.stdin.write("".join(f"{line}\n" for line in lines))
            process.stdin.flush()
        except BrokenPipeError:
            raise self._ended(process) from None
        try:
            return [self._answer(line, process.stdout.readline(), count) for line in lines]
        except TimeOut:
            raise MisuseError(
                f"{self.__name__} wrote no line in the time that there was; one that flushes each line that it writes "
                "is accepted."
            ) from None

    def _answer(self, line: str, told: str, count: int) -> list[float]:
        if not told.endswith("\n") and self._process is not None:
            raise self._ended(self._process)
        try:
            found = [float(word) for word in told.split()]
        except ValueError:
            found = []
        if len(found) != count:
            raise MisuseError(
                f"{self.__name__} wrote '{told.strip()[:TOLD]}' for the line '{line[:TOLD]}'; {count} numbers with "
                "blanks between them are accepted."
            )
        return found

    def _ended(self, process: subprocess.Popen[str]) -> MisuseError:
        return MisuseError(
            f"{self.__name__} ended with exit code {process.wait()}; a program that reads line after line is accepted."
        )

    def _started(self) -> subprocess.Popen[str]:
        if self._process is None:
            try:
                self._process = subprocess.Popen(  # noqa: S603 - the user's own program
                    self._command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, encoding="utf-8", errors="replace"
                )
            except OSError as error:
                raise MisuseError(
                    f"'{shlex.join(self._command)}' cannot be started: {error.strerror}; a program is accepted."
                ) from None
            weakref.finalize(self, _end, self._process)
        return self._process


def _end(process: subprocess.Popen[str]) -> None:
    process.kill()
    process.communicate()
