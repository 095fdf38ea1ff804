"""Rows of numbers from NumPy's files, and from any other columns of numbers; each at its exact value."""

from __future__ import annotations

import zipfile
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.lib import format as npy

from compare.submission.chunk import Chunk
from compare.submission.written import of_value

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from pathlib import Path

    from compare.submission.columns import Columns

__all__ = ["Column", "Sliced", "chunks", "npy_columns", "npz_columns"]

NUMBERS = "fiuU"
"""NumPy kinds of columns that can be judged: floats, integers, and decimals as strings."""
NO_NPY = "which NumPy cannot read as an array of numbers; numpy.save and numpy.savez write one"


class Column(Protocol):
    """Numbers in a file, read from the first to the last."""

    shape: tuple[int, ...]
    dtype: Any

    def read(self, count: int) -> Any:
        """The next ``count`` numbers, or those that are left."""


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


class Member:
    """A one-dimensional array in a zip archive: it is read as it is unpacked."""

    def __init__(self, name: str, stream: Any) -> None:
        version = npy.read_magic(stream)
        header = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
        self.shape, _, self.dtype = header(stream)
        if self.dtype.hasobject:
            raise ValueError(f"{name} is an array of Python objects; an array of numbers is accepted.")
        self._stream = stream

    def read(self, count: int) -> Any:
        """The next numbers."""
        return np.frombuffer(self._stream.read(count * self.dtype.itemsize), self.dtype)


def chunks(columns: Columns, found: Sequence[Column], size: int) -> Iterator[Chunk]:
    """The rows of columns of one length, the time first.

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
        places = [f"row {begin + i + 1}" for i in range(count)]
        t, *states = (
            [of_value(value, f"{name} in {at}") for value, at in zip(_scalars(column.read(count)), places, strict=True)]
            for name, column in zip(names, found, strict=True)
        )
        yield Chunk(t, list(zip(*states, strict=True)), places)


def _scalars(numbers: Any) -> list[Any]:
    """Doubles as Python's floats, others as they are."""
    array = np.asarray(numbers)
    return array.tolist() if array.dtype == np.float64 else list(array)


@contextmanager
def npy_columns(path: Path, columns: Columns) -> Iterator[list[Column]]:
    """The columns of an NPY file: a structured array with these names, or [rows, columns] in their order.

    Raises:
        ValueError: it is no such file.
    """
    try:
        array: Any = np.load(path, mmap_mode="r", allow_pickle=False)
    except (ValueError, EOFError) as error:
        raise ValueError(f"'{path}' is a file {NO_NPY}.") from error
    if array.dtype.names:
        names = array.dtype.names
        yield [_field(array, names[place]) for place in columns.among(names, "fields")]
    elif array.ndim != 2:
        raise ValueError(f"the array has the shape {array.shape}; [rows, columns] is accepted.")
    else:
        yield [_of_table(array, place) for place in columns.without_header(array.shape[1])]


def _field(array: Any, name: str) -> Column:
    return Sliced(array.shape, array.dtype[name], lambda rows: array[name][rows])


def _of_table(array: Any, place: int) -> Column:
    return Sliced(array.shape[:1], array.dtype, lambda rows: array[rows, place])


@contextmanager
def npz_columns(path: Path, columns: Columns) -> Iterator[list[Column]]:
    """The columns of an NPZ file, one array each.

    Raises:
        ValueError: it is no such file, or has no such arrays.
    """
    with ExitStack() as stack:
        try:
            archive = stack.enter_context(zipfile.ZipFile(path))
        except zipfile.BadZipFile as error:
            raise ValueError(f"'{path}' is a file {NO_NPY}.") from error
        members = archive.namelist()
        places = columns.among([name.removesuffix(".npy") for name in members], "arrays")
        yield [Member(members[place], stack.enter_context(archive.open(members[place]))) for place in places]
