"""Columns of an NPZ file: arrays in a zip archive, read as they are unpacked."""

from __future__ import annotations

import struct
import zipfile
import zlib
from collections import Counter
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.lib import format as npy

from compare.files.npy import NO_NPY, header_of, read_header
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
ENCRYPTED = 1
BLOCK = 1 << 20
"""Bytes that are read at once where they are only passed by."""


class Member:
    """An array in the archive as a column, or every ``step``-th of its numbers from the one at ``first`` on.

    Attributes:
        whole: the shape of the array; ``shape`` is that of the column.
        by_columns: whether the first axis varies fastest in memory (Fortran's order).
    """

    def __init__(self, name: str, size: int, stream: Unpacked) -> None:
        found = header_of(stream, short(name), size)
        self.whole, self.by_columns, self.dtype = found.shape, found.by_columns, found.dtype
        self.shape: tuple[int, ...] = flat(self.whole)
        self._stream, self._step, self._place = stream, 1, 0

    def column(self, place: int, *, rows_first: bool) -> Member:
        """The numbers at ``place`` of every row of a table, of shape [rows, state] or else [state, rows]."""
        rows, width = self.whole if rows_first else self.whole[::-1]
        self.shape = (rows,)
        if rows_first != self.by_columns:
            self._step, self._place = width, place
        else:
            self._stream.skip(place * rows * self.dtype.itemsize)
        return self

    def read(self, count: int) -> Any:
        """The next numbers."""
        data = self._stream.read(count * self._step * self.dtype.itemsize)
        return np.frombuffer(data, self.dtype)[self._place :: self._step]

    def finish(self) -> None:
        """Read on to the end, where zipfile holds the checksum against what was unpacked."""
        while self._stream.read(BLOCK, short_of=False):
            pass


class Unpacked:
    """The bytes of a member as they are unpacked; what zipfile raises is one sentence about the file ``path``."""

    def __init__(self, path: Path, name: str, stream: Any) -> None:
        self._path, self._name, self._stream = path, name, stream

    def read(self, count: int = 0, *, short_of: bool = True) -> bytes:
        """The next bytes: as many, or where ``short_of`` is not set those that are left.

        Raises:
            ValueError: they are fewer, or the archive is damaged.
        """
        with told(self._path, self._name):
            data: bytes = self._stream.read(count)
        if short_of and len(data) < count:
            raise ValueError(f"'{self._path}' is truncated: {short(self._name)} ends before all that it declares.")
        return data

    def tell(self) -> int:
        """How many bytes were unpacked."""
        place: int = self._stream.tell()
        return place

    def skip(self, count: int) -> None:
        """Pass by the next bytes."""
        while count > 0:
            count -= len(self.read(min(count, BLOCK)))


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
        ValueError: it is no such file, or has no such arrays.
    """
    with ExitStack() as stack:
        with told(path):
            archive = stack.enter_context(zipfile.ZipFile(path))
        members = _members(path, archive)

        def member(name: str) -> Member:
            info = members[name]
            with told(path, name):
                stream = stack.enter_context(archive.open(info))
            return Member(info.filename, info.file_size, Unpacked(path, name, stream))

        shapes = {name: _shape(path, archive, info) for name, info in members.items()}
        found = packed(columns, shapes, "arrays")
        if found is None:
            names = list(members)
            yield [member(names[place]) for place in columns.among(names, "arrays")]
            return
        time, table = found
        by_rows = rows_first(columns, table, shapes[table], flat(shapes[time]))
        states = [member(table).column(place, rows_first=by_rows) for place in range(len(columns.wanted) - 1)]
        yield [member(time), *states]


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


def _shape(path: Path, archive: zipfile.ZipFile, info: zipfile.ZipInfo) -> tuple[int, ...]:
    """The shape of an array; () where it holds Python objects, or is no array."""
    with told(path, info.filename):
        first, second = archive.open(info), archive.open(info)
    with first, second:
        begin = Unpacked(path, info.filename, first)
        if begin.read(len(npy.MAGIC_PREFIX), short_of=False) != npy.MAGIC_PREFIX:
            return ()
        try:
            return read_header(Unpacked(path, info.filename, second), info.filename).shape
        except ValueError:  # it may be an array that nobody asked for
            return ()
