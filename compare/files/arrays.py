"""Rows of numbers from NumPy's files, and from any other columns of numbers; each at its exact value."""

from __future__ import annotations

import math
import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from compare.files.chunk import Chunk, Doubles, Row
from compare.files.exact_rows import as_double
from compare.files.npy import table_of
from compare.files.written import LOG10_2, of_value

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from pathlib import Path

    from compare.files.columns import Columns
    from compare.files.exact_rows import Times

__all__ = ["Column", "Sliced", "chunks", "npy_columns"]

NUMBERS = "fiuUS"
"""NumPy kinds of columns that can be judged: floats, integers, and decimals as strings."""


class Column(Protocol):
    """Numbers in a file, read from the first to the last."""

    shape: tuple[int, ...]
    dtype: Any

    def read(self, count: int) -> Any:
        """The next ``count`` numbers."""


class Sliced:
    """A column of anything that is indexed as arrays are: ``pick`` gives the rows of a slice."""

    def __init__(self, shape: tuple[int, ...], dtype: Any, pick: Callable[[slice], Any]) -> None:
        self.shape, self.dtype, self._pick = shape, dtype, pick
        self._position = 0

    def read(self, count: int) -> Any:
        """The next numbers."""
        begin = self._position
        self._position += count
        return self._pick(slice(begin, begin + count))


def chunks(columns: Columns, found: Sequence[Column], size: int, times: Times) -> Iterator[Chunk]:
    """The rows of columns of one length, the time first; where that is decimals, ``times`` says how they are read.

    Raises:
        ValueError: there are none, the columns are not of one length, or one holds what is no finite number.
    """
    names = columns.wanted
    for name, column in zip(names, found, strict=True):
        if len(column.shape) != 1 or column.shape != found[0].shape:
            shapes = ", ".join(f"{each} {one.shape}" for each, one in zip(names, found, strict=True))
            raise ValueError(f"the columns have the shapes {shapes}; one number for each time is accepted.")
        if column.dtype.kind not in NUMBERS:
            raise ValueError(f"{name} is an array of {column.dtype}; real numbers or decimal strings are accepted.")
    rows = found[0].shape[0]
    if not rows:
        raise ValueError("there are no rows; a row for each time is accepted.")
    for begin in range(0, rows, size):
        count = min(size, rows - begin)
        parts = [np.asarray(column.read(count)) for column in found]
        parts = [_text(name, part) if part.dtype.kind == "S" else part for name, part in zip(names, parts, strict=True)]
        if any(part.shape != (count,) for part in parts):
            raise ValueError(f"there are fewer rows than the {rows} that the file declares; all of them are accepted.")
        for name, part in zip(names, parts, strict=True):
            _refuse_no_letters(name, part)
        exact = Exact(names, parts, begin)
        if not begin and found[0].dtype.kind in "SU":
            times.decide(number for place in range(count) for number in exact(place).state)
        exact.doubles = times.doubles
        yield Chunk(count, exact, _doubles(parts))


def _text(name: str, part: np.ndarray) -> np.ndarray:
    """Strings of bytes as text.

    Raises:
        ValueError: one is no ASCII, as decimals are.
    """
    try:
        return part.astype(np.str_)
    except UnicodeDecodeError:
        raise ValueError(
            f"{name} has a string of bytes that is no text; decimals such as '0.5' are accepted."
        ) from None


def _refuse_no_letters(name: str, part: np.ndarray) -> None:
    """Refuse strings of NumPy's whose numbers are of no letters, which Python cannot take for text.

    Raises:
        ValueError: there is one.
    """
    if part.dtype.kind == "U" and part.size:
        letters = np.ascontiguousarray(part).view(np.dtype(np.uint32).newbyteorder(part.dtype.byteorder))
        if int(letters.max()) > sys.maxunicode:
            raise ValueError(f"{name} has a string that is no text; decimals such as '0.5' are accepted.")


class Exact:
    """The exact rows of columns, which begin after the first ``begin`` rows of a file.

    Attributes:
        doubles: whether times that are decimals are the doubles that they spell.
    """

    def __init__(self, names: Sequence[str], columns: Sequence[np.ndarray], begin: int) -> None:
        self._names, self._columns, self._begin = names, columns, begin
        self.doubles = False

    def __call__(self, place: int) -> Row:
        at = f"row {self._begin + place + 1}"
        t, *state = (
            of_value(_scalar(column[place]), f"{name} in {at}")
            for name, column in zip(self._names, self._columns, strict=True)
        )
        return Row(as_double(t) if self.doubles else t, tuple(state), at)


def _doubles(columns: Sequence[np.ndarray]) -> Doubles | None:
    """The columns as doubles, where all are of floating-point numbers, finite and not beyond the doubles."""
    if any(column.dtype.kind != "f" for column in columns):
        return None
    with np.errstate(over="ignore"):
        numbers = np.column_stack([column.astype(np.float64) for column in columns])
    digits = max((np.finfo(column.dtype).nmant + 1) * LOG10_2 for column in columns[1:])
    return Doubles(numbers, float(digits), -math.inf) if np.isfinite(numbers).all() else None


def _scalar(number: Any) -> Any:
    """A double as Python's float, others as they are."""
    return number.item() if type(number) is np.float64 else number


@contextmanager
def npy_columns(path: Path, columns: Columns) -> Iterator[list[Column]]:
    """The columns of an NPY file: a structured array with these names, or [rows, columns] in their order.

    Raises:
        ValueError: it is no such file.
    """
    with table_of(path) as array:
        if array.dtype.names:
            names = array.dtype.names
            yield [_field(array, names[place]) for place in columns.among(names, "fields")]
            return
        if array.ndim != 2:
            raise ValueError(f"the array has the shape {array.shape}; [rows, columns] is accepted.")
        count = len(columns.wanted)
        hint = f"; the array has the shape {array.shape}, so that its transpose may be meant"
        places = columns.without_header(array.shape[1], hint if array.shape[0] == count else "")
        yield [_of_table(array, place) for place in places]


def _field(array: Any, name: str) -> Column:
    return Sliced(array.shape, array.dtype[name], lambda rows: array[name][rows])


def _of_table(array: Any, place: int) -> Column:
    return Sliced(array.shape[:1], array.dtype, lambda rows: array[rows, place])
