"""Writing the file: every dataset chunked and checksummed, filled block by block, its bytes the same every time.

A failed write must reach the caller, and HDF5 must not notice: it keeps a file open, and crashes the process at its
end, when what it has cached cannot be written.  So a write that fails, as on a full disk, is kept in memory, where
reads find it; the first error is raised after the file is closed.  The writer stops at the first error, so only what
HDF5 had cached is ever kept.
"""

from __future__ import annotations

import io
import os
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np
from h5py import h5d, h5p, h5s, h5t

from reference.command.interrupts import held
from reference.dataset.fingerprint import fingerprints
from reference.dataset.schema import (
    ATTRIBUTE_LIMIT,
    FEW,
    LIMB,
    PROVENANCE,
    TAIL_LIMBS,
    arrays,
    chunks,
    exact_texts,
    group_attributes,
    limb_axis,
    root_attributes,
)
from reference.dataset.versions import NEWEST

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping
    from pathlib import Path

    from reference.dataset.plan import Plan
    from reference.dataset.schema import Array
    from reference.layout import Block, Group

__all__ = ["Sink", "Writer", "writing"]


class Sink(io.RawIOBase):
    """A file open for reading and writing whose first failed write is ``error``, and which then only pretends."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.error: OSError | None = None
        self._handle = os.open(path, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW, 0o644)
        self._position = 0
        self._kept: list[tuple[int, bytes]] = []

    def check(self) -> None:
        """Raise the error of the first write that failed.

        Raises:
            OSError: one did.
        """
        if self.error is not None:
            raise self.error

    def readable(self) -> bool:
        return True

    def writable(self) -> bool:
        return True

    def seekable(self) -> bool:
        return True

    def seek(self, offset: int, whence: int = os.SEEK_SET, /) -> int:
        base = {os.SEEK_SET: 0, os.SEEK_CUR: self._position, os.SEEK_END: self._size()}[whence]
        self._position = base + offset
        return self._position

    def _size(self) -> int:
        ends = [start + len(data) for start, data in self._kept]
        return max([os.fstat(self._handle).st_size, *ends])

    def readinto(self, buffer: memoryview) -> int:  # type: ignore[override]
        start, count = self._position, min(len(buffer), max(0, self._size() - self._position))
        found = bytearray(os.pread(self._handle, count, start).ljust(count, b"\0"))
        for at, data in self._kept:
            low, high = max(at, start), min(at + len(data), start + count)
            if low < high:
                found[low - start : high - start] = data[low - at : high - at]
        buffer[:count] = found
        self._position += count
        return count

    def write(self, data: bytes | memoryview, /) -> int:  # type: ignore[override]
        held = memoryview(data).cast("B")
        done = 0
        try:
            while self.error is None and done < len(held):
                done += os.pwrite(self._handle, held[done:], self._position + done)
        except OSError as error:
            self.error = error
        if done < len(held):
            self._kept.append((self._position + done, bytes(held[done:])))
        self._position += len(held)
        return len(held)

    def truncate(self, size: int | None = None, /) -> int:
        length = self._position if size is None else size
        try:
            if self.error is None:
                os.ftruncate(self._handle, length)
        except OSError as error:
            self.error = error
        return length

    def close(self) -> None:
        if not self.closed:
            os.close(self._handle)
        super().close()


VERSION_BOUND = ("v110", "v110")


class Writer:
    """An open file that takes the plan's blocks one by one."""

    def __init__(self, file: h5py.File, plan: Plan, check: Callable[[], None]) -> None:
        self._file, self._check = file, check
        limb = _create(file, limb_axis(), (TAIL_LIMBS,), np.arange(TAIL_LIMBS))
        for group in plan.groups:
            _create_group(file, group, limb)

    def put(self, block: Block, limbs: np.ndarray) -> None:
        """Write a block: float64 (arguments, quantities, 3)."""
        for variable in self._variables(block):
            at = block.selection(variable)
            found = limbs[:, variable.component]
            if block.row.over == "once":
                found = found[0]
            path = f"{block.layout.path}/{variable.quantity.name}"
            self._file[path][at] = found[..., 0]
            self._file[f"{path}_tail"][at] = found[..., 1:]
        self._check()

    @staticmethod
    def _variables(block: Block) -> list[Any]:
        return [variable for variable in block.layout.variables if variable.row.name == block.row.name]

    def describe(self, path: str, attributes: Mapping[str, str | float | int]) -> None:
        """Add attributes to a group or dataset; a text too long for an attribute is left out."""
        _describe(self._file[path], attributes)

    def finish(self, version: str, plan: Plan, provenance: Mapping[str, str]) -> str:
        """Add the root's attributes, where it all came from, and the fingerprint, which is returned."""
        _describe(self._file.create_group(PROVENANCE), provenance)
        marks = fingerprints(self._file, signed_zeros=NEWEST.signed_zeros)
        found = marks.pop("")
        for path, mark in marks.items():
            _describe(self._file[path], {"fingerprint": mark})
        described = root_attributes(NEWEST, version, plan.profile, provenance.get("date", ""), plan.families)
        _describe(self._file, {**described, "fingerprint": found})
        return found


@contextmanager
def writing(path: Path, plan: Plan) -> Iterator[Writer]:
    """Open a file for a plan, laid out and its inputs written; interrupts wait until no write is under way.

    Raises:
        OSError: a write failed; the file is closed and worthless.
    """
    with held() as let_in, Sink(path) as sink:

        def check() -> None:
            sink.check()
            let_in()

        with h5py.File(sink, "w", libver=VERSION_BOUND, track_order=False) as file:
            yield Writer(file, plan, check)
        sink.check()


def _create_group(file: h5py.File, group: Group, limb: h5py.Dataset) -> None:
    layout = group.layout
    target = file.create_group(layout.path)
    _describe(target, group_attributes(layout, group.parameters))
    scales = {LIMB: limb}
    for array in arrays(layout, NEWEST):
        shape = (*group.size(array.dims[:-1]), TAIL_LIMBS) if array.dims[-1] == LIMB else group.size(array.dims)
        data = group.inputs.get(array.name)
        dataset = _create(target, array, shape, data)
        if array.is_scale:
            scales[array.name] = dataset
        else:
            for axis, name in enumerate(array.dims):
                dataset.dims[axis].attach_scale(scales[name])


def _create(parent: h5py.Group, array: Array, shape: tuple[int, ...], data: np.ndarray | None) -> h5py.Dataset:
    """A dataset in chunks of one block, with Fletcher32, allocation and fill times set, and no timestamp."""
    properties = h5p.create(h5p.DATASET_CREATE)
    properties.set_chunk(chunks(array, shape))
    properties.set_fletcher32()
    properties.set_alloc_time(h5d.ALLOC_TIME_INCR)
    properties.set_fill_time(h5d.FILL_TIME_ALLOC)
    properties.set_obj_track_times(False)
    file_type = h5t.py_create(array.dtype)
    h5d.create(parent.id, array.name.encode(), file_type, h5s.create_simple(shape), dcpl=properties)
    dataset = parent[array.name]
    if data is not None:
        dataset[...] = data
    if array.is_scale:
        dataset.make_scale(array.name)
    _describe(dataset, array.attributes)
    if data is not None and array.name != LIMB and array.dtype.kind == "f" and data.size <= FEW:
        _describe(dataset, exact_texts([float(number) for number in data]))
    return dataset


def _describe(target: Any, attributes: Mapping[str, str | float | int | tuple[int, ...]]) -> None:
    """Attributes as fixed-length UTF-8, float64 or int32, or a list of int32."""
    for name, value in attributes.items():
        if isinstance(value, str):
            data = value.encode()
            if len(data) < ATTRIBUTE_LIMIT:
                kind = h5py.string_dtype("utf-8", max(1, len(data)))
                target.attrs.create(name, np.array(data, dtype=kind), dtype=kind)
        else:
            target.attrs.create(name, np.array(value, dtype="<f8" if isinstance(value, float) else "<i4"))
