"""The file under HDF5 while it is written: a failed write must reach the caller, and HDF5 must not notice.

HDF5 keeps a file open, and crashes the process at its end, when what it has cached cannot be written.  So a write
that fails, as on a full disk, is kept in memory, where reads find it; the first error is raised after the file is
closed.  The writer stops at the first error, so only what HDF5 had cached is ever kept.
"""

from __future__ import annotations

import io
import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["Sink"]


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
