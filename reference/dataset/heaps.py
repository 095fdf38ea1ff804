"""The global heaps of an HDF5 file, walked before HDF5 walks them: over one that is damaged it can go round for ever.

Strings of variable length, and the sources of virtual datasets, are objects of global heap collections.  A collection
is "GCOL", the version 1, three zeros and its size; then objects, each a header of an index, a count of references, four
zeros and a size, and the bytes, to a multiple of eight.  The object of index 0 is the free space to the end, and its
size is with its header; what is left may be too small for any (HDF5 File Format Specification, III.E).
"""

from __future__ import annotations

import mmap
import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["damaged_heap"]

MARK = b"GCOL\x01\0\0\0"
ALIGNMENT = 8


def damaged_heap(path: Path, length_bytes: int) -> int | None:
    """The byte at which a global heap of the file begins whose objects do not lie one after the other.

    Args:
        path: the file.
        length_bytes: how many bytes a size takes in the file.
    """
    with path.open("rb") as file:
        if not os.fstat(file.fileno()).st_size:
            return None
        with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
            begin = data.find(MARK)
            while begin >= 0:
                if not _in_order(data, begin, length_bytes):
                    return begin
                begin = data.find(MARK, begin + 1)
    return None


def _in_order(data: mmap.mmap, begin: int, length_bytes: int) -> bool:
    """Whether a collection that lies in the file, without which HDF5 reads nothing of it, is all objects."""

    def number(at: int, size: int) -> int:
        return int.from_bytes(data[at : at + size], "little")

    header = _aligned(len(MARK) + length_bytes)  # of the collection and of an object alike
    end = begin + number(begin + len(MARK), length_bytes)
    if end > len(data):
        return True
    at = begin + header
    while at + header <= end:
        index, size = number(at, 2), number(at + 8, length_bytes)
        step = header + _aligned(size) if index else size
        if not header <= step <= end - at:
            return False
        at += step
    return True


def _aligned(size: int) -> int:
    return -(-size // ALIGNMENT) * ALIGNMENT
