"""The header of an array as NumPy saves it, and whether what follows is as long as it declares."""

from __future__ import annotations

import math
import tokenize
import warnings
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np
from numpy.lib import format as npy

from compare.files.packed import sized
from reference.names import short

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

__all__ = ["NO_NPY", "Header", "header_of", "read_header", "table_of"]

NO_NPY = "which NumPy cannot read as an array of numbers; numpy.save and numpy.savez write one"
MOST_HEADER = 10_000
"""Characters of a header, as numpy.load has it too; it is read as a Python literal, whose cost grows with them."""
LONGEST_NUMBER = 16_384
"""Bytes of a number: a string of the most digits that an input may have fits, four bytes a letter."""
UNICODE = (3, 0)
"""The version whose names are in UTF-8; but for that it is read as the one before."""
READERS: dict[tuple[int, int], Any] = {
    (1, 0): npy.read_array_header_1_0,
    (2, 0): npy.read_array_header_2_0,
    UNICODE: npy.read_array_header_2_0,
}
FAULTS = (
    ValueError,  # also a header in another encoding, and what is no literal
    TypeError,  # a descriptor or a key of another type
    SyntaxError,
    tokenize.TokenError,
    IndexError,
    KeyError,
    OverflowError,
    RecursionError,
    MemoryError,  # CPython's parser, of brackets in brackets
    SystemError,
)
"""What NumPy raises of a header that is no header, and Python's literal parser beneath it."""


class Header(NamedTuple):
    """What an array declares of itself.

    Attributes:
        shape: its shape; ``by_columns`` whether the first axis varies fastest (Fortran's order).
        dtype: the kind of its numbers.
        offset: how many bytes come before the first of them.
    """

    shape: tuple[int, ...]
    by_columns: bool
    dtype: np.dtype[Any]
    offset: int

    @property
    def bytes(self) -> int:
        """How many bytes its numbers take."""
        return math.prod(self.shape) * self.dtype.itemsize


class Readable(Protocol):
    """Bytes from the beginning on."""

    def read(self, count: int = ..., /) -> bytes:
        """The next bytes."""

    def tell(self) -> int:
        """How many were read."""


def read_header(stream: Readable, name: str) -> Header:
    """The header at the beginning of a stream, of the file or array ``name``.

    Raises:
        ValueError: there is none, or it declares what is no array of numbers.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of headers by Python 2, and of letters that Python's parser dislikes
            version = npy.read_magic(stream)
            shape, by_columns, dtype = READERS[version](stream, max_header_size=MOST_HEADER)
            if version == UNICODE and dtype.names:
                dtype.names = tuple(field.encode("latin-1").decode() for field in dtype.names)
    except FAULTS as error:
        raise ValueError(f"'{name}' is a file {NO_NPY}.") from error
    if any(isinstance(length, bool) or length < 0 for length in shape):
        raise ValueError(f"'{name}' declares the shape {short(str(shape))}; lengths of 0 and more are accepted.")
    if dtype.hasobject:
        raise ValueError(f"{name} is an array of Python objects; an array of numbers is accepted.")
    if not 0 < dtype.itemsize <= LONGEST_NUMBER:
        raise ValueError(
            f"'{name}' declares numbers of {dtype.itemsize} bytes each; 1 to {LONGEST_NUMBER} bytes are accepted."
        )
    return Header(shape, by_columns, dtype, stream.tell())


def header_of(stream: Readable, name: str, size: int) -> Header:
    """The header of an array that is all of a file of ``size`` bytes.

    Raises:
        ValueError: it is no such file, or holds fewer or more bytes than it declares.
    """
    found = read_header(stream, name)
    if found.bytes != size - found.offset:
        raise ValueError(
            f"'{name}' declares an array of shape {short(str(found.shape))}, which takes {sized(found.bytes)}, and has "
            f"{sized(max(size - found.offset, 0))} of numbers; as many as are declared are accepted."
        )
    return found


@contextmanager
def table_of(path: Path) -> Iterator[np.ndarray]:
    """The array of an NPY file, mapped into memory.

    Raises:
        ValueError: it is no such file.
    """
    with path.open("rb") as stream:
        found = header_of(stream, str(path), path.stat().st_size)
    if not math.prod(found.shape):
        yield np.empty(found.shape, found.dtype)
        return
    order: Any = "F" if found.by_columns else "C"
    yield np.memmap(path, found.dtype, "r", found.offset, found.shape, order)
