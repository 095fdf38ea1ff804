"""The manners of a command line: every error one sentence, exit codes 0, 1, 2, 130 and 143, pipes that may close."""

from __future__ import annotations

import argparse
import errno
import io
import os
import re
import sys
import textwrap
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NoReturn

from reference.arithmetic.underflow import require_gradual
from reference.command.interrupts import Terminated, terminable
from reference.names import printable, short, unknown

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

__all__ = ["Parser", "one_of", "progress_bar", "run", "sentence"]

CHOICE = re.compile(r"invalid choice: (.*?) \(choose from (.*)\)$")
SIGNED = re.compile(r"-(\d|\.\d|inf|nan)", re.IGNORECASE)
INTERRUPTED = 130
TERMINATED = 143
STREAMS = 3
"""Standard input, output and error have the numbers below this one."""


class _Whole(argparse.HelpFormatter):
    """Help in whose paragraphs no name is parted at a hyphen."""

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        return textwrap.fill(
            " ".join(text.split()), width, initial_indent=indent, subsequent_indent=indent, break_on_hyphens=False
        )


class Parser(argparse.ArgumentParser):
    """An argument parser whose errors are one sentence with the nearest valid names, without the usage.

    A value such as -1e3, -1/2 or -inf is a value; no option looks like a number.
    """

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **{"allow_abbrev": False, "formatter_class": _Whole, **kwargs})
        self._negative_number_matcher = SIGNED  # argparse's own knows -1 and -1.5 only

    def add_argument(self, *words: Any, **told: Any) -> argparse.Action:
        """Add an option or an argument.

        Raises:
            ValueError: there is one of this name, which an input of a family takes for itself.
        """
        try:
            return super().add_argument(*words, **told)
        except argparse.ArgumentError:
            raise ValueError(f"{words[0]} is an option of its own; an input of another name is accepted.") from None

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Parse the words; an unknown one is an error already here, where the options in its place are known.

        Raises:
            ValueError: a word cannot be read; the sentence says what is accepted.
        """
        words = sys.argv[1:] if args is None else list(args)
        self._refuse_unknown(words)
        found, rest = super().parse_known_args(words, namespace)
        if rest:
            options = [name for name in self._option_string_actions if name.startswith("--") and name != "--help"]
            such = f"options such as {options[0]} are accepted" if options else "nothing more is accepted"
            self.error(f"the argument '{short(rest[0])}' is one too many; {such}.")
        return found, []

    def _refuse_unknown(self, words: Sequence[str]) -> None:
        """Name the first option that is unknown: before a command its words end, after "--" there are none."""
        commands = next((a.choices for a in self._actions if isinstance(a, argparse._SubParsersAction)), None)  # noqa: SLF001 (argparse has no other way to ask)
        for word in words:
            is_option = word.startswith("-") and len(word) > 1 and not SIGNED.match(word)
            if word.startswith("--") and word.partition("=")[2] == "--":
                self.error(f"the value of {word.partition('=')[0]} is '--', which is none; another is accepted.")
            if word == "--" or (commands is not None and not is_option):
                return
            name = word.partition("=")[0]
            if is_option and name not in self._option_string_actions:
                kind = ("option", self._option_string_actions) if commands is None else ("command", commands)
                said = unknown(kind[0], name, [known for known in kind[1] if known not in {"-h", "--help"}])
                single = commands is None and not word.startswith("--")
                self.error(
                    f"{said[:-1]}; a value that begins with a minus is written --OPTION=VALUE." if single else said
                )

    def error(self, message: str) -> NoReturn:
        """Raise ValueError with the sentence; ``run`` prints it."""
        argument, _, rest = message.partition(": ")
        sentence = rest if argument.startswith("argument ") else message
        choice = CHOICE.search(sentence)
        if choice:
            kind = argument.removeprefix("argument ").lower()
            sentence = unknown(kind, choice[1].strip("'"), re.findall(r"[\w:-]+", choice[2]))
        elif argument.startswith("argument ") and rest.startswith(("expected", "ignored", "not allowed")):
            sentence = message.removeprefix("argument ")
        raise ValueError(sentence if sentence.endswith(".") else f"{sentence}.")


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
    with _streams(), terminable():
        try:
            require_gradual("the command line")
            code = command(arguments)
            sys.stdout.flush()
        except BrokenPipeError:
            _silence_output()
            return 0
        except KeyboardInterrupt:
            sys.stderr.write("interrupted.\n")
            return INTERRUPTED
        except Terminated:
            sys.stderr.write("terminated.\n")
            return TERMINATED
        except (OSError, ValueError, ImportError, ArithmeticError, RuntimeError) as error:
            sys.stderr.write(f"error: {sentence(error)}\n")
            _give_up_a_full_output()
            return 2
        return code


class Closed(io.TextIOBase):
    """A stand-in for a standard output that the caller closed: whoever has something to say learns of it."""

    def write(self, _text: str, /) -> int:
        """Refuse.

        Raises:
            OSError: always.
        """
        raise OSError(errno.EBADF, "standard output is closed; nothing could be printed")


@contextmanager
def _streams() -> Iterator[None]:
    """Stand in for closed streams, and keep files from getting their numbers, to which libraries may write."""
    out, err = sys.stdout, sys.stderr
    if out is not None and err is not None:
        yield
        return
    while (handle := os.open(os.devnull, os.O_RDWR)) < STREAMS:
        os.set_inheritable(handle, True)
    os.close(handle)
    sys.stdout, sys.stderr = out or Closed(), err or io.StringIO()
    try:
        yield
    finally:
        sys.stdout, sys.stderr = out, err


def _give_up_a_full_output() -> None:
    """Where stdout cannot take what it still holds, let it go: the sentence has been said."""
    try:
        sys.stdout.flush()
    except OSError:
        _silence_output()


def sentence(error: Exception) -> str:
    """What an error says, in one sentence."""
    if isinstance(error, OSError) and error.strerror:
        where = f" '{error.filename}'" if error.filename else ""
        return printable(f"{error.strerror}{where}.")
    return printable(" ".join(str(error).split()))


def _silence_output() -> None:
    """Nothing more can be written: let the interpreter's own last flush go nowhere."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, sys.stdout.fileno())
    os.close(nowhere)
