"""Columns of numbers in any HDF5 file, read a slice at a time: what others wrote, not a dataset of ours."""

from __future__ import annotations

import math
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np

from reference.dataset.foreign import MOST_ATTRIBUTES, Said, attribute_bytes, said_of
from reference.dataset.heaps import damaged_heap
from reference.names import LENGTH, in_one_sentence, short
from reference.once import cached_property

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from contextlib import AbstractContextManager
    from pathlib import Path

__all__ = ["ForeignColumn", "foreign_columns"]

FAULTS = (
    OSError,  # bytes that cannot be read or unpacked
    RuntimeError,  # what HDF5 itself says, of objects that it visits
    ValueError,  # a name or a string in no encoding, or a shape that is none
    KeyError,
    TypeError,  # a type without an equivalent in NumPy
    OverflowError,
    MemoryError,  # a chunk or a string that is larger than memory
    NotImplementedError,
    SystemError,
)
"""What h5py raises of a file that is damaged."""
MOST_BYTES = 1 << 26
"""Bytes that a chunk of a dataset may take unpacked: HDF5 reads no part of one."""
MOST_SAID = 180
"""Characters of what HDF5 says that are repeated."""
LONGEST_NUMBER = 16_384
"""Bytes of a number: a string of the most digits that an input may have fits."""


class ForeignColumn:
    """A dataset, or one field of a compound dataset; a matrix of one row or one column is a column.

    Attributes:
        is_text: whether it holds strings, which are read as ``str``.
    """

    def __init__(self, path: Path, name: str, data: Any, field: str | None = None) -> None:
        self._path, self._name, self._data, self._field = path, name, data, field
        self._one_row = len(data.shape) == 2 and data.shape[0] == 1
        self._one_column = not self._one_row and len(data.shape) == 2 and data.shape[1] == 1
        self.is_text = field is None and h5py.check_string_dtype(data.dtype) is not None
        self.shape: tuple[int, ...] = (data.size,) if self._one_row or self._one_column else data.shape
        self.dtype: Any = data.dtype if field is None else data.dtype[field]

    def __getitem__(self, rows: slice) -> Any:
        """Some consecutive rows.

        Raises:
            ValueError: they cannot be read, or are of numbers or chunks that are too large to be any.
        """
        self._refuse_wrong_size()
        self._refuse_other_numbers()
        with told(self._path, self._name):
            data = self._data.asstr() if self.is_text else self._data
            if self._field is not None:
                data = data.fields(self._field)
            found = data[0, rows] if self._one_row else data[rows, 0] if self._one_column else data[rows]
        self._refuse_missing(found)
        return found

    @property
    def units(self) -> str:
        """What the dataset says of its units; "" where it says nothing."""
        return "" if self._field is not None else self._said.units

    @cached_property
    def _said(self) -> Said:
        """What the dataset says of its numbers.

        Raises:
            ValueError: its attributes are too large, or damaged.
        """
        with told(self._path, self._name):
            size = attribute_bytes(self._data)
        if size > MOST_ATTRIBUTES:
            raise ValueError(f"{self._where} has attributes of {size} bytes; {MOST_ATTRIBUTES} are accepted.")
        with told(self._path, self._name):
            return said_of(self._data)

    @property
    def _where(self) -> str:
        return f"the dataset {short(self._name)} of '{self._path}'"

    def _refuse_other_numbers(self) -> None:
        """Refuse numbers that are not in the dataset as they are meant."""
        if self._said.elsewhere:
            raise ValueError(f"{self._where} has its numbers in another file; numbers in the file itself are accepted.")
        if self._said.packed_by:
            raise ValueError(
                f"{self._where} is packed, with the attribute {self._said.packed_by}; numbers as they are meant are "
                "accepted."
            )

    def _refuse_missing(self, found: Any) -> None:
        for number in () if self.is_text or self._field is not None else self._said.missing:
            if np.any(found == number):
                raise ValueError(
                    f"{self._where} has {number:g}, which stands there for a missing number; a number for each time is "
                    "accepted."
                )

    def _refuse_wrong_size(self) -> None:
        with told(self._path, self._name):
            item, held = self._data.id.get_type().get_size(), self._data.id.get_storage_size()
            chunks, declared = self._data.chunks, item * self._data.size
        where = self._where
        written = {0, declared}  # what was never written takes nothing
        if chunks is None and held not in written and not self._data.dtype.hasobject:
            raise ValueError(
                f"{where} declares {short(str(declared))} bytes of numbers and holds {short(str(held))}; as many as "
                "are declared are accepted."
            )
        size = item * math.prod(chunks or ())
        if item > LONGEST_NUMBER or size > MOST_BYTES:
            raise ValueError(
                f"{where} has numbers of {item} bytes in chunks of {short(str(size))}; {LONGEST_NUMBER} and "
                f"{MOST_BYTES} are accepted."
            )


def told(path: Path, name: str = "") -> AbstractContextManager[None]:
    """What goes wrong in a file, in one sentence.

    Raises:
        ValueError: something does.
    """
    where = f" in its dataset {short(name)}" if name else ""
    return in_one_sentence(FAULTS, lambda said: f"'{path}' cannot be read: HDF5 says{where}: {_first(said)}.")


def _first(said: str) -> str:
    """The beginning of what a library says, which may be of any length and hold names of the file's."""
    parts = [said[begin : begin + LENGTH] for begin in range(0, min(len(said), MOST_SAID), LENGTH)]
    return "".join(map(short, parts)).rstrip(".") + ("..." if len(said) > MOST_SAID else "")


@contextmanager
def foreign_columns(path: Path) -> Iterator[Mapping[str, ForeignColumn]]:
    """The datasets of a file by their paths, and the fields of compound datasets by their names too.

    Raises:
        ValueError: it is no HDF5 file, or damaged.
    """
    try:
        file = h5py.File(path, "r")
    except FAULTS as error:
        raise ValueError(f"'{path}' is no HDF5 file, or it is truncated.") from error
    with file:
        heap = damaged_heap(path, file.id.get_create_plist().get_sizes()[1])
        if heap is not None:
            raise ValueError(
                f"'{path}' has a damaged global heap at its byte {heap}; a file that h5repack has copied is accepted."
            )
        found: dict[str, ForeignColumn] = {}

        def keep(path_inside: str | bytes, item: Any) -> None:
            if not isinstance(item, h5py.Dataset) or item.shape is None:
                return
            try:
                dtype = item.dtype
            except TypeError:  # NumPy has no such type, so that it is no column
                return
            name = path_inside if isinstance(path_inside, str) else path_inside.decode("utf-8", "backslashreplace")
            found[name] = ForeignColumn(path, name, item)
            for field in dtype.names or ():
                found[field] = ForeignColumn(path, name, item, field)

        with told(path):
            file.visititems(keep)
        yield found
