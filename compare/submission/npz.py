"""Columns of an NPZ file: arrays in a zip archive, read as they are unpacked."""

from __future__ import annotations

import zipfile
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.lib import format as npy

from compare.submission.packed import flat, packed, rows_first
from reference.names import short

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from compare.submission.arrays import Column
    from compare.submission.columns import Columns

__all__ = ["NO_NPY", "npz_columns"]

NO_NPY = "which NumPy cannot read as an array of numbers; numpy.save and numpy.savez write one"


class Member:
    """An array in the archive as a column, or every ``step``-th of its numbers from the one at ``first`` on.

    Attributes:
        whole: the shape of the array; ``shape`` is that of the column.
        by_columns: whether the first axis varies fastest in memory (Fortran's order).
    """

    def __init__(self, name: str, stream: Any) -> None:
        version = npy.read_magic(stream)
        header = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
        self.whole, self.by_columns, self.dtype = header(stream)
        if self.dtype.hasobject:
            raise ValueError(f"{short(name)} is an array of Python objects; an array of numbers is accepted.")
        self.shape: tuple[int, ...] = flat(self.whole)
        self._stream, self._step, self._place = stream, 1, 0

    def column(self, place: int, *, rows_first: bool) -> Member:
        """The numbers at ``place`` of every row of a table, of shape [rows, state] or else [state, rows]."""
        rows, width = self.whole if rows_first else self.whole[::-1]
        self.shape = (rows,)
        if rows_first != self.by_columns:
            self._step, self._place = width, place
        else:
            self._stream.seek(place * rows * self.dtype.itemsize, 1)
        return self

    def read(self, count: int) -> Any:
        """The next numbers."""
        data = self._stream.read(count * self._step * self.dtype.itemsize)
        return np.frombuffer(data, self.dtype)[self._place :: self._step]


@contextmanager
def npz_columns(path: Path, columns: Columns) -> Iterator[list[Column]]:
    """The columns of an NPZ file, one array each; or the times in one, and the states in another.

    Raises:
        ValueError: it is no such file, or has no such arrays.
    """
    with ExitStack() as stack:
        try:
            archive = stack.enter_context(zipfile.ZipFile(path))
        except zipfile.BadZipFile as error:
            raise ValueError(f"'{path}' is a file {NO_NPY}.") from error
        files = {file.removesuffix(".npy"): file for file in archive.namelist()}

        def member(name: str) -> Member:
            return Member(files[name], stack.enter_context(archive.open(files[name])))

        shapes = {name: _shape(archive, file) for name, file in files.items()}
        found = packed(columns, shapes, "arrays")
        if found is None:
            names = list(files)
            yield [member(names[place]) for place in columns.among(names, "arrays")]
            return
        time, table = found
        by_rows = rows_first(columns, table, shapes[table], flat(shapes[time]))
        states = [member(table).column(place, rows_first=by_rows) for place in range(len(columns.wanted) - 1)]
        yield [member(time), *states]


def _shape(archive: zipfile.ZipFile, file: str) -> tuple[int, ...]:
    """The shape of an array; () where it holds Python objects, or is no array."""
    with archive.open(file) as stream:
        if stream.read(len(npy.MAGIC_PREFIX)) != npy.MAGIC_PREFIX:
            return ()
    with archive.open(file) as stream:
        version = npy.read_magic(stream)
        header = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
        shape: tuple[int, ...] = header(stream)[0]
        return shape
