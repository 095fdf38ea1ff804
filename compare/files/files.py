"""A submission's file, whatever its format: chunks of rows."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from compare.files.arrays import chunks, npy_columns
from compare.files.exact_rows import Times
from compare.files.hdf5 import hdf5_columns
from compare.files.lines import NOTHING
from compare.files.npz import npz_columns
from compare.files.text import STANDARD_INPUT, TextRows

if TYPE_CHECKING:
    from collections.abc import Iterator

    from compare.files.chunk import Chunk
    from compare.files.columns import Columns
    from compare.files.lines import Passed

__all__ = ["SUFFIXES", "Rows"]

TEXT = (".csv", ".tsv", ".txt", ".dat", ".tab", ".prn", ".lvm", ".json", ".jsonl", ".ndjson")
HDF5 = (".h5", ".hdf5", ".nc", ".mat")
"""HDF5 itself, and what is written in it: netCDF-4, and MATLAB's files since version 7.3."""
SUFFIXES = (*TEXT, ".npy", ".npz", *HDF5)


class Rows:
    """The rows of a file, in chunks; "-" is the standard input, as text.

    Attributes:
        times: how times are read, known after the first chunk: "as written" or "binary64".
        notes: sentences on what did not count, or may be amiss; known after the last chunk.

    Raises:
        FileNotFoundError: there is no such file.
        IsADirectoryError: it is a folder.
        ValueError: its suffix is of no format that is read here, or has no array of all states, which was asked for, or
            no lines that could be passed over.
    """

    def __init__(self, name: str, columns: Columns, passed: Passed = NOTHING, *, as_written: bool) -> None:
        self._path, self._columns = Path(name), columns
        self._suffix = TEXT[0] if name == STANDARD_INPUT else self._path.suffix.lower()
        if self._suffix not in (".npz", *HDF5):
            columns.refuse_packed()
        self._times = Times(as_written=as_written)
        self._text = TextRows(columns, passed, self._times)
        if name == STANDARD_INPUT:
            return
        if self._path.is_dir():
            raise IsADirectoryError(f"'{name}' is a folder; a file is accepted.")
        if not self._path.exists():
            raise FileNotFoundError(f"there is no file '{name}'.")
        if self._suffix not in SUFFIXES:
            raise ValueError(f"'{name}' is of no format that is read here; accepted are {', '.join(SUFFIXES)}.")
        if passed != NOTHING and self._suffix not in TEXT:
            raise ValueError(f"'{name}' has no lines; --skip and --comment are accepted of text.")

    @property
    def times(self) -> str:
        return str(self._times)

    @property
    def notes(self) -> tuple[str, ...]:
        return tuple(self._text.notes)

    def chunks(self, size: int) -> Iterator[Chunk]:
        """Read the file, ``size`` rows at a time.

        Raises:
            ValueError: it is not what its suffix says, or a row cannot be judged.
        """
        if self._suffix in TEXT:
            yield from self._text.chunks(self._path, size)
            return
        opened = {".npy": npy_columns, ".npz": npz_columns}.get(self._suffix, hdf5_columns)
        with opened(self._path, self._columns) as found:
            yield from chunks(self._columns, found, size, self._times)
