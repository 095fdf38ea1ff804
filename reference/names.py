"""Names as sentences repeat them: what was given, nothing in it that a terminal obeys, and the nearest valid names."""

from __future__ import annotations

from contextlib import contextmanager
from difflib import get_close_matches
from numbers import Number
from reprlib import repr as abridged
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

__all__ = ["NAME_LENGTH", "each_once", "in_one_sentence", "is_grid_file", "printable", "said", "short", "unknown"]

SHOWN = 12
MANY_BITS = 1000
"""Bits up to which an integer is shown: Python does not write those of more than some 4300 digits."""
SIMPLE = (Number, str, bytes)
LENGTH = 60
"""Characters up to which a text that was given is repeated whole."""
NAME_LENGTH = 255
"""Characters of the name of a grid file, or of a family."""


def is_grid_file(name: str) -> bool:
    """Whether a profile is the name of a grid file: NAME.toml, of printable characters."""
    return name.endswith(".toml") and name.isprintable() and len(name) <= NAME_LENGTH


def each_once(what: str, names: Sequence[str]) -> None:
    """Refuse names that are none in Python, or that are there twice.

    Raises:
        ValueError: one is such; ``what`` is where they stand, in words.
    """
    for name in names:
        if not name.isidentifier() or names.count(name) > 1:
            wrong = f"{names.count(name)} times" if name.isidentifier() else "which is no name in Python"
            raise ValueError(f"{what} has '{short(name)}', {wrong}; a name once is accepted.")


def printable(text: str) -> str:
    """The text with what cannot be printed escaped: control characters, and those that hide or reverse others.

    Text from a file or a file's name would otherwise command the terminal that shows it.
    """
    if text.isprintable():
        return text
    return "".join(letter if letter.isprintable() else ascii(letter)[1:-1] for letter in text)


def short(text: str | bytes) -> str:
    """The text as a sentence repeats it: printable, and where it is long its beginning and its length."""
    if isinstance(text, bytes):
        text = text.decode("utf-8", "backslashreplace")
    if len(text) > LENGTH:
        return f"{short(text[:40])}... ({len(text)} characters)"
    return printable(text)


def said(value: object) -> str:
    """A value as a sentence repeats it; of what holds others, not more than the outside."""
    if isinstance(value, int) and value.bit_length() > MANY_BITS:
        return f"an integer of {value.bit_length()} bits"
    return short(repr(value) if isinstance(value, SIMPLE) else abridged(value))


def unknown(kind: str, given: str, names: Iterable[str], aliases: Iterable[str] = ()) -> str:
    """Return for example "profile 'cor' is unknown, perhaps core; accepted are core, full."; aliases may be nearest."""
    accepted = list(names)
    near = get_close_matches(given[:LENGTH], [*accepted, *aliases], n=3, cutoff=0.5)
    guess = f", perhaps {' or '.join(near)}" if near else ""
    more = ", ..." if len(accepted) > SHOWN else ""
    return f"{kind} '{short(given)}' is unknown{guess}; accepted are {', '.join(accepted[:SHOWN])}{more}."


@contextmanager
def in_one_sentence(faults: tuple[type[BaseException], ...], sentence: Callable[[str], str]) -> Iterator[None]:
    """What a library raises of a file, as one sentence about what it says.

    Raises:
        ValueError: it raises one of the faults.
    """
    try:
        yield
    except faults as error:
        raise ValueError(sentence(" ".join(str(error).split()) or type(error).__name__)) from error
