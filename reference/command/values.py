"""The words of an option as values, or one sentence on what is wrong with them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from reference.names import short

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from fractions import Fraction

__all__ = ["as_written", "number", "pair", "positive", "several", "text", "whole"]


def several(name: str, words: Sequence[str], read: Callable[[str, str], Any]) -> tuple[Any, ...]:
    """Comma-separated values of an option that may repeat; each once.

    Raises:
        ValueError: one is empty, or there twice.
    """
    pieces = [piece.strip() for word in words for piece in word.split(",")]
    if not all(pieces):
        raise ValueError(f"--{name} has an empty value; values separated by commas are accepted, such as 'A,B'.")
    values = tuple(read(piece, name) for piece in pieces)
    for place, value in enumerate(values):
        if value in values[:place]:
            raise ValueError(f"--{name} has {pieces[place]} twice; each value is accepted once.")
    return values


def text(piece: str, _: str) -> str:
    """The piece as it is."""
    return piece


def number(piece: str, name: str) -> float:
    """The piece as binary64.

    Raises:
        ValueError: it is no number.
    """
    try:
        return float(piece)
    except ValueError as error:
        raise ValueError(f"--{name} '{short(piece)}' is not a number; one such as 1 or 2.5e-3 is accepted.") from error


def positive(piece: str, name: str) -> float:
    """The piece as binary64 above zero.

    Raises:
        ValueError: it is none, or not finite.
    """
    try:
        value = float(piece)
    except ValueError:
        value = math.nan
    if not 0 < value < math.inf:
        raise ValueError(f"--{name} is '{short(piece)}'; a positive number is accepted.")
    return value


def as_written(piece: str, name: str) -> Fraction:
    """The piece as the rational that it spells.

    Raises:
        ValueError: it spells none.
    """
    from reference.arithmetic.exact import exact

    return exact(piece, f"--{name}")


def pair(piece: str, name: str, read: Callable[[str, str], Any]) -> tuple[Any, Any]:
    """Two values with a comma between them.

    Raises:
        ValueError: there are not two, or one cannot be read.
    """
    parts = piece.split(",")
    if len(parts) != 2:
        raise ValueError(f"--{name} is '{short(piece)}'; two numbers with a comma between them are accepted, as 2,1.")
    return read(parts[0].strip(), name), read(parts[1].strip(), name)


def whole(piece: str, name: str, what: str = "number of steps") -> int:
    """The piece as a positive integer, which is called ``what``.

    Raises:
        ValueError: it is none.
    """
    try:
        value = int(piece)
    except ValueError as error:
        raise ValueError(f"--{name} '{short(piece)}' is not a whole number; one such as 128 is accepted.") from error
    if value < 1:
        raise ValueError(f"--{name} {piece} is not a {what}; 1 or more is accepted.")
    return value
