"""A user's code inside of ours: what it raises or returns is told in a sentence, and what never returns is stopped."""

from __future__ import annotations

import sys
from contextlib import contextmanager, redirect_stdout
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.methods.own.deadline import TimeOut, deadline
from reference.names import printable

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

__all__ = [
    "MAX_CALLS",
    "Exhausted",
    "MisuseError",
    "calling",
    "hosted",
    "kind_of",
    "real_numbers",
    "repeatable",
    "told",
]

MAX_CALLS = 10_000
"""Calls of f that one step, or each time of a grid, may take."""
SECONDS = 30.0
"""A step that takes longer is taken for one that never returns."""
MOST_TOLD = 400
"""Characters of what a user's exception says that are repeated."""


class MisuseError(ValueError):
    """A user's function is not what can be used; its text is one sentence."""


class Exhausted(BaseException):
    """A user's function asked for more than it may: no ``except Exception`` of its own keeps it."""


@contextmanager
def calling(name: str) -> Iterator[None]:
    """Call a user's function of this name; its warnings of numbers go nowhere.

    Raises:
        MisuseError: it raised something, which the sentence repeats.
    """
    try:
        with np.errstate(all="ignore"):
            yield
    except MisuseError:
        raise
    except (Exception, SystemExit) as error:
        raise MisuseError(f"{name} raised {told(error)}.") from error


@contextmanager
def hosted(name: str, taken: Callable[[], object] | None = None) -> Iterator[None]:
    """Run steps of a user's function: what it prints goes to stderr, and its warnings of numbers nowhere.

    Args:
        name: of the function.
        taken: what changes as long as steps are taken; the time is that of all that is run here if None.

    Raises:
        MisuseError: a step does not return in SECONDS, or calls f too often.
    """
    try:
        with redirect_stdout(sys.stderr), np.errstate(all="ignore"), deadline(SECONDS, taken):
            yield
    except TimeOut:
        raise MisuseError(
            f"{name} took more than {SECONDS:g} s in one step; a step that returns is accepted."
        ) from None
    except Exhausted as error:
        raise MisuseError(f"{name} {error} in one step; it does not come to an end.") from None


def real_numbers(found: Any, what: str) -> np.ndarray:
    """What a call returned, as an array of doubles.

    Raises:
        MisuseError: it is something else.
    """
    if found is None:
        raise MisuseError(f"{what} returned nothing; the new state is accepted.")
    try:
        array = np.asarray(found)
    except ValueError:
        raise MisuseError(f"{what} returned a ragged sequence; a state as it was given is accepted.") from None
    except MemoryError:
        raise MisuseError(f"{what} returned a sequence that no memory holds; a state is accepted.") from None
    if array.dtype.kind == "c":
        raise MisuseError(f"{what} returned complex numbers; real ones are accepted.")
    if array.dtype.kind not in "fiu":
        raise MisuseError(f"{what} returned {kind_of(found)}; an array of real numbers is accepted.")
    return array.astype(np.float64)


def repeatable(name: str, before: np.ndarray, after: np.ndarray) -> None:
    """Hold two answers to one question against each other.

    Raises:
        MisuseError: they differ.
    """
    if not np.array_equal(before, after, equal_nan=True):
        first, second = (answer.ravel()[-2:].tolist() for answer in (before, after))
        raise MisuseError(
            f"{name} gave {first} and then {second} for the same state and step: it is not deterministic, or keeps "
            "something from call to call; a function of its arguments alone is accepted."
        )


def told(error: BaseException) -> str:
    """The kind of an exception and what it says, in one line of no more than MOST_TOLD characters."""
    kind = type(error).__name__
    try:
        words = printable(" ".join(str(error)[: MOST_TOLD + 1].split()))
    except (Exception, SystemExit):  # noqa: BLE001 - a user's own __str__ may raise anything
        return kind
    shown = f"{words[:MOST_TOLD]}..." if len(words) > MOST_TOLD else words
    return f"{kind}: {shown}" if shown else kind


def kind_of(found: Any) -> str:
    """What something is, in words."""
    return f"an array of {found.dtype}" if isinstance(found, np.ndarray) else f"a {type(found).__name__}"
