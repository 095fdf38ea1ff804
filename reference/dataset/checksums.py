"""The list of checksums beside the files, SHA256SUMS in the format of coreutils: read, and changed by one line."""

from __future__ import annotations

import fcntl
import os
import re
import stat
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, BinaryIO

from reference.dataset.errors import DatasetError
from reference.dataset.files import sha256, write_bytes

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

__all__ = ["CHECKSUMS", "check_checksum", "checksums", "note_checksum", "require_notable"]

CHECKSUMS = "SHA256SUMS"
LINE = re.compile(r"(\\?)([0-9a-fA-F]{64}) [ *](.+)", re.DOTALL)
ESCAPED = {"\\": "\\\\", "\n": "\\n", "\r": "\\r"}
"""In a name; such a line begins with a backslash."""
UNESCAPED = {escape: letter for letter, escape in ESCAPED.items()}
ESCAPES = re.compile(r"\\[\\nr]")
LONGEST = 1 << 24
"""Bytes of a list that are read: the lines of more than 50,000 files with the longest names."""


@dataclass(frozen=True)
class Line:
    """A line as it stands, with the name and the checksum that it gives; both empty for a comment or an empty line."""

    text: str
    name: str = ""
    digest: str = ""


def _read(stream: BinaryIO, listing: Path) -> bytes:
    """The bytes of a list.

    Raises:
        DatasetError: they are more than a list of checksums has, which would only cost memory.
    """
    data = stream.read(LONGEST + 1)
    if len(data) > LONGEST:
        raise DatasetError(f"'{listing}' is longer than {LONGEST >> 20} MiB, no list of checksums; move it elsewhere.")
    return data


def _lines(data: bytes, listing: Path) -> list[Line]:
    """The lines of a list, each as it stands.

    Raises:
        DatasetError: one is neither a checksum nor a comment nor empty.
    """
    found = []
    texts = data.decode("utf-8", "surrogateescape").split("\n")
    for number, text in enumerate(texts[:-1] if texts[-1] == "" else texts, 1):
        line = text.removesuffix("\r")
        match = LINE.fullmatch(line)
        if match is not None:
            name = ESCAPES.sub(lambda escape: UNESCAPED[escape[0]], match[3]) if match[1] else match[3]
            found.append(Line(text, name, match[2].lower()))
        elif not line.strip() or line.startswith("#"):
            found.append(Line(text))
        else:
            raise DatasetError(f"'{listing}' has a line that is no checksum, line {number}; restore it or remove it.")
    return found


def _written(name: str, digest: str) -> Line:
    escaped = "".join(ESCAPED.get(letter, letter) for letter in name)
    return Line(f"{'' if escaped == name else chr(92)}{digest}  {escaped}", name, digest)


def checksums(folder: Path) -> dict[str, str]:
    """The checksums noted in a folder, by file name.

    Raises:
        DatasetError: the list is damaged or no file.
    """
    listing = folder / CHECKSUMS
    try:
        if not listing.exists():
            return {}
        if not listing.is_file():
            raise DatasetError(f"'{listing}' is not a regular file; remove it.")
        with listing.open("rb") as stream:
            data = _read(stream, listing)
    except OSError as error:
        raise DatasetError(f"'{listing}' cannot be read ({error.strerror}); restore it or remove it.") from None
    return {line.name: line.digest for line in _lines(data, listing) if line.digest}


def check_checksum(path: Path) -> None:
    """Compare a file with the checksum noted beside it, where one is.

    Raises:
        DatasetError: they differ, or the list is damaged.
    """
    noted = checksums(path.parent).get(path.name)
    if noted is not None and sha256(path) != noted:
        raise DatasetError(f"'{path}' differs from its checksum in {CHECKSUMS}: it is truncated or altered.")


def require_notable(folder: Path) -> None:
    """Make sure that a checksum can be noted in a folder.

    Raises:
        DatasetError: its list is damaged, a link, no file, or cannot be written.
    """
    listing = folder / CHECKSUMS
    if os.path.lexists(listing):
        with _held(listing) as data:
            _lines(data, listing)


def note_checksum(target: Path, digest: str | None) -> None:
    """Write, or with None remove, the checksum of ``target`` in the list beside it; all other lines stay as they are.

    Raises:
        DatasetError: the list is damaged, a link, no file, or cannot be written.
        OSError: it could not be written.
    """
    listing = target.parent / CHECKSUMS
    if digest is None and not os.path.lexists(listing):
        return
    with _held(listing) as data:
        lines = _lines(data, listing)
        places = [i for i, line in enumerate(lines) if line.name == target.name and line.digest]
        if [lines[i].digest for i in places] == ([] if digest is None else [digest]):
            return
        kept = [line for i, line in enumerate(lines) if i not in places]
        if digest is not None:
            kept.insert(places[0] if places else len(kept), _written(target.name, digest))
        if kept:
            write_bytes(listing, "".join(f"{line.text}\n" for line in kept).encode("utf-8", "surrogateescape"))
        else:
            listing.unlink()


@contextmanager
def _held(listing: Path) -> Iterator[bytes]:
    """The bytes of the list, made where there is none; while they are changed no other process of ours changes them.

    Raises:
        DatasetError: it is a link, no file, or cannot be written.
    """
    made = not os.path.lexists(listing)
    while True:
        handle = _opened(listing)
        try:
            fcntl.flock(handle, fcntl.LOCK_EX)
            status = os.fstat(handle)
            if not listing.exists() or not os.path.samestat(listing.lstat(), status):
                continue  # replaced while it was waited for
            with os.fdopen(os.dup(handle), "rb") as stream:
                data = _read(stream, listing)
            try:
                yield data
            except BaseException:
                if made and not data and os.path.samestat(listing.lstat(), status):
                    listing.unlink()
                raise
            return
        finally:
            os.close(handle)


def _opened(listing: Path) -> int:
    if os.path.lexists(listing) and not stat.S_ISREG(listing.lstat().st_mode):
        raise DatasetError(f"'{listing}' is not a regular file, so that no checksum can be noted; move it elsewhere.")
    try:
        return os.open(listing, os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK, 0o644)
    except OSError as error:
        raise DatasetError(f"'{listing}' cannot be written ({error.strerror}); make it writable or move it.") from None
