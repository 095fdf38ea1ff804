"""The manners of a command line: every error one sentence, exit codes 0, 1, 2 and 130, pipes that may close."""

from __future__ import annotations

import argparse
import os
import re
import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NoReturn

from reference.names import unknown

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

__all__ = ["Parser", "one_of", "progress_bar", "run"]

CHOICE = re.compile(r"invalid choice: (.*?) \(choose from (.*)\)$")
INTERRUPTED = 130


class Parser(argparse.ArgumentParser):
    """An argument parser whose errors are one sentence with the nearest valid names, without the usage."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **{"allow_abbrev": False, **kwargs})

    def error(self, message: str) -> NoReturn:
        """Print the sentence on stderr and exit 2."""
        argument, _, rest = message.partition(": ")
        sentence = rest if argument.startswith("argument ") else message
        choice = CHOICE.search(sentence)
        if choice:
            kind = argument.removeprefix("argument ").lower()
            sentence = unknown(kind, choice[1].strip("'"), re.findall(r"[\w:-]+", choice[2]))
        elif argument.startswith("argument ") and rest.startswith("expected"):
            sentence = message.removeprefix("argument ")
        sys.stderr.write(f"error: {sentence}{'' if sentence.endswith('.') else '.'}\n")
        raise SystemExit(2)


def one_of(kind: str, names: Sequence[str]) -> Callable[[str], str]:
    """An argument type that accepts these names and answers any other with the nearest of them."""

    def chosen(text: str) -> str:
        if text not in names:
            raise argparse.ArgumentTypeError(unknown(kind, text, names))
        return text

    return chosen


@contextmanager
def progress_bar(title: str, *, quiet: bool) -> Iterator[Callable[[int, int], None] | None]:
    """Give a function of (done, all) that moves a bar on stderr; None where that is no terminal or ``quiet``."""
    if quiet or not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn()
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(title, total=None)
        yield lambda done, total: bar.update(task, completed=done, total=total)


def run(command: Callable[[Sequence[str] | None], int], arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit code; what a user can cause ends in one sentence on stderr and code 2."""
    try:
        code = command(arguments)
        sys.stdout.flush()
    except BrokenPipeError:
        _silence_output()
        return 0
    except KeyboardInterrupt:
        sys.stderr.write("interrupted.\n")
        return INTERRUPTED
    except (OSError, ValueError, ImportError, ArithmeticError, RuntimeError) as error:
        sys.stderr.write(f"error: {_sentence(error)}\n")
        _give_up_a_full_output()
        return 2
    return code


def _give_up_a_full_output() -> None:
    """Where stdout cannot take what it still holds, let it go: the sentence has been said."""
    try:
        sys.stdout.flush()
    except OSError:
        _silence_output()


def _sentence(error: Exception) -> str:
    if isinstance(error, OSError) and error.strerror:
        where = f" '{error.filename}'" if error.filename else ""
        return f"{error.strerror}{where}."
    return " ".join(str(error).split())


def _silence_output() -> None:
    """Nothing more can be written: let the interpreter's own last flush go nowhere."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, sys.stdout.fileno())
    os.close(nowhere)
