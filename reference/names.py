"""The sentence for a name that is not known: what was given, the nearest valid names, and all that are accepted."""

from __future__ import annotations

from difflib import get_close_matches
from numbers import Number
from reprlib import repr as abridged
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["said", "short", "unknown"]

SHOWN = 12
MANY_BITS = 1000
"""Bits up to which an integer is shown: Python does not write those of more than some 4300 digits."""
SIMPLE = (Number, str, bytes)
LENGTH = 60
"""Characters up to which a text that was given is repeated whole."""


def short(text: str) -> str:
    """The text as a sentence repeats it: whole, or where it is long its beginning and its length.

    What cannot be printed is escaped: it may come from a file, and would command a terminal.
    """
    if len(text) > LENGTH:
        return f"{short(text[:40])}... ({len(text)} characters)"
    return "".join(letter if letter.isprintable() else ascii(letter)[1:-1] for letter in text)


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
