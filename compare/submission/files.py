"""A submission's file, whatever its format: chunks of rows."""

from __future__ import annotations

from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.submission.arrays import Sliced, chunks, npy_columns
from compare.submission.npz import npz_columns
from compare.submission.packed import packed, rows_first
from compare.submission.text import STANDARD_INPUT, TextRows

if TYPE_CHECKING:
    from collections.abc import Iterator

    from compare.submission.arrays import Column
    from compare.submission.chunk import Chunk
    from compare.submission.columns import Columns
    from reference.store.columns import ForeignColumn

__all__ = ["SUFFIXES", "Rows"]

TEXT = (".csv", ".tsv", ".txt", ".dat")
HDF5 = (".h5", ".hdf5", ".nc", ".mat")
"""HDF5 itself, and what is written in it: netCDF-4, and MATLAB's files since version 7.3."""
SUFFIXES = (*TEXT, ".npy", ".npz", *HDF5)


class Rows:
    """The rows of a file, in chunks; "-" is the standard input, as text.

    Attributes:
        times: how times are read, known after the first chunk: "as written" or "binary64".

    Raises:
        FileNotFoundError: there is no such file.
        IsADirectoryError: it is a folder.
        ValueError: its suffix is of no format that is read here.
    """

    def __init__(self, name: str, columns: Columns, *, as_written: bool) -> None:
        self._path, self._columns = Path(name), columns
        self._suffix = TEXT[0] if name == STANDARD_INPUT else self._path.suffix.lower()
        self._text = TextRows(columns, as_written=as_written)
        if name == STANDARD_INPUT:
            return
        if self._path.is_dir():
            raise IsADirectoryError(f"'{name}' is a folder; a file is accepted.")
        if not self._path.exists():
            raise FileNotFoundError(f"there is no file '{name}'.")
        if self._suffix not in SUFFIXES:
            raise ValueError(f"'{name}' is of no format that is read here; accepted are {', '.join(SUFFIXES)}.")

    @property
    def times(self) -> str:
        return self._text.times

    def chunks(self, size: int) -> Iterator[Chunk]:
        """Read the file, ``size`` rows at a time.

        Raises:
            ValueError: it is not what its suffix says, or a row cannot be judged.
        """
        if self._suffix in TEXT:
            yield from self._text.chunks(self._path, size)
            return
        opened = {".npy": npy_columns, ".npz": npz_columns}.get(self._suffix, _hdf5_columns)
        with opened(self._path, self._columns) as found:
            yield from chunks(self._columns, found, size)


@contextmanager
def _hdf5_columns(path: Path, columns: Columns) -> Iterator[list[Column]]:
    """The columns of an HDF5 file: one dataset each, by its path or by the last part of it; or one of times and
    one of states, where no two are called alike.
    """
    from reference.store.columns import foreign_columns

    with foreign_columns(path) as found:
        paths = list(found)
        last = [path.rpartition("/")[2] for path in paths]
        in_two = None
        if len(set(last)) == len(last):
            in_two = packed(columns, dict(zip(last, (data.shape for data in found.values()), strict=True)))
        if in_two is not None:
            time, table = (found[paths[last.index(name)]] for name in in_two)
            by_rows = rows_first(columns, in_two[1], table.shape, time.shape)
            states = [_of_table(table, place, rows_first=by_rows) for place in range(len(columns.wanted) - 1)]
            yield [_column(time), *states]
            return
        names = paths if set(columns.names) <= set(paths) else last
        places = columns.among(names, "datasets")
        yield [_column(found[paths[place]]) for place in places]


def _column(data: ForeignColumn) -> Column:
    return Sliced(data.shape, _dtype(data), data.__getitem__)


def _of_table(data: ForeignColumn, place: int, *, rows_first: bool) -> Column:
    """The numbers at ``place`` of every row, of a dataset of shape [rows, state] or else [state, rows]."""
    pick: Any = data.__getitem__  # h5py takes a slice for each axis
    if rows_first:
        return Sliced(data.shape[:1], _dtype(data), lambda rows: pick((rows, place)))
    return Sliced(data.shape[1:], _dtype(data), lambda rows: pick((place, rows)))


def _dtype(data: ForeignColumn) -> Any:
    return np.dtype(str) if data.is_text else data.dtype
