"""Columns of an NPZ file: arrays in a zip archive, unpacked whole where they are not too large.

``numpy.load`` would believe the shape that an array declares, take memory for that, and leave what comes after it.
"""

from __future__ import annotations

import io
import struct
import zipfile
import zlib
from collections import Counter
from contextlib import contextmanager
from typing import TYPE_CHECKING

import numpy as np
from numpy.lib import format as npy

from compare.files.arrays import Sliced
from compare.files.npy import MOST_HEADER, NO_NPY, header_of, read_header
from compare.files.packed import flat, packed, rows_first, sized
from reference.names import in_one_sentence, short

if TYPE_CHECKING:
    from collections.abc import Iterator
    from contextlib import AbstractContextManager
    from pathlib import Path

    from compare.files.arrays import Column
    from compare.files.columns import Columns

__all__ = ["npz_columns"]

FAULTS = (
    zipfile.BadZipFile,  # no archive, or a checksum that does not fit
    zlib.error,
    EOFError,
    NotImplementedError,  # a version or a compression that zipfile does not know
    RuntimeError,  # a password is needed
    OSError,  # a place before the beginning of the file
    ValueError,  # a name in no encoding, or a size below zero
    struct.error,
    IndexError,
    KeyError,
    OverflowError,
)
"""What zipfile and zlib raise of an archive that is none, or is damaged."""
MOST_MEMBERS = 10_000
MOST_UNPACKED = 1100
"""Bytes that deflate makes of one at most are 1032 (zlib's documentation): a member that declares more is none."""
MOST_BYTES = 1 << 30
"""Of all arrays that are unpacked."""
ENCRYPTED = 1
LENGTH_ENDS = npy.MAGIC_LEN + 4
"""The last byte at which the length of a header ends."""


class Archive:
    """The arrays of an open archive, by their names; what zipfile raises is one sentence about the file ``path``.

    Attributes:
        shapes: the shape of every array; () where it holds Python objects, or is no array.

    Raises:
        ValueError: two arrays have one name, or one is encrypted, or not as numpy.savez packs it, or damaged.
    """

    def __init__(self, path: Path, opened: zipfile.ZipFile) -> None:
        self._path, self._opened, self._left = path, opened, MOST_BYTES
        self._members = _members(path, opened)
        self.shapes = {name: self._shape(info) for name, info in self._members.items()}

    def _shape(self, info: zipfile.ZipInfo) -> tuple[int, ...]:
        with told(self._path, info.filename), self._opened.open(info) as stream:
            head = stream.read(LENGTH_ENDS + MOST_HEADER)
        try:
            return read_header(io.BytesIO(head), info.filename).shape
        except ValueError:  # it may be an array that nobody asked for
            return ()

    def array(self, name: str) -> np.ndarray:
        """The array of this name.

        Raises:
            ValueError: it is damaged, is no array of numbers, or with those before it is too large.
        """
        info = self._members[name]
        said = short(info.filename)
        self._left -= info.file_size
        if self._left < 0:
            raise ValueError(
                f"'{self._path}' declares {sized(info.file_size)} of {said}, which with the other columns is more than "
                f"the {MOST_BYTES} that are accepted in an NPZ file; an NPY or HDF5 file may have any number."
            )
        with told(self._path, info.filename):
            data = self._opened.read(info)
        found = header_of(io.BytesIO(data), said, info.file_size)
        if len(data) < info.file_size:
            raise ValueError(f"'{self._path}' is truncated: {said} ends before all that it declares.")
        return np.ndarray(found.shape, found.dtype, data, found.offset, order="F" if found.by_columns else "C")


def told(path: Path, name: str = "") -> AbstractContextManager[None]:
    """What goes wrong in an archive, in one sentence.

    Raises:
        ValueError: something does.
    """
    where = f" in its array {short(name)}" if name else ""
    return in_one_sentence(
        FAULTS, lambda said: f"'{path}' is a file {NO_NPY}; zipfile says{where}: {short(said.rstrip('.'))}."
    )


@contextmanager
def npz_columns(path: Path, columns: Columns) -> Iterator[list[Column]]:
    """The columns of an NPZ file, one array each; or the times in one, and the states in another.

    Raises:
        ValueError: it is no such file, or has no such arrays, or they are too large.
    """
    with told(path):
        opened = zipfile.ZipFile(path)
    with opened:
        archive = Archive(path, opened)
        found = packed(columns, archive.shapes, "arrays")
        if found is None:
            names = list(archive.shapes)
            yield [_column(archive.array(names[place])) for place in columns.among(names, "arrays")]
            return
        time, table = found
        by_rows = rows_first(columns, table, archive.shapes[table], flat(archive.shapes[time]))
        states = archive.array(table) if by_rows else archive.array(table).T
        yield [_column(archive.array(time)), *(_column(states[:, place]) for place in range(len(columns.wanted) - 1))]


def _column(array: np.ndarray) -> Column:
    array = array.reshape(flat(array.shape))
    return Sliced(array.shape, array.dtype, array.__getitem__)


def _members(path: Path, archive: zipfile.ZipFile) -> dict[str, zipfile.ZipInfo]:
    """What the archive holds, by the names of arrays.

    Raises:
        ValueError: two have one name, or one is encrypted, or not as numpy.savez packs it.
    """
    infos = archive.infolist()
    if len(infos) > MOST_MEMBERS:
        raise ValueError(f"'{path}' holds {len(infos)} arrays; at most {MOST_MEMBERS} are accepted.")
    count = Counter(info.filename.removesuffix(".npy") for info in infos)
    twice = next((name for name, times in count.items() if times > 1), None)
    if twice is not None:
        raise ValueError(f"'{path}' holds {count[twice]} arrays called {short(twice)}; one of each name is accepted.")
    for info in infos:
        name = short(info.filename)
        if info.flag_bits & ENCRYPTED:
            raise ValueError(f"'{path}' holds {name} encrypted; an archive without a password is accepted.")
        if info.compress_type not in {zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED}:
            raise ValueError(
                f"'{path}' holds {name} packed by method {info.compress_type}; stored and deflated ones are accepted, "
                "as numpy.savez and numpy.savez_compressed write them."
            )
        most = info.compress_size * (1 if info.compress_type == zipfile.ZIP_STORED else MOST_UNPACKED)
        if info.file_size > most:
            raise ValueError(
                f"'{path}' declares {sized(info.file_size)} of {name}, and has {sized(info.compress_size)} packed, of "
                "which so many cannot come."
            )
    return {info.filename.removesuffix(".npy"): info for info in infos}
