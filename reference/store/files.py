"""Files that are whole or absent: atomic replacement, and the checksums beside them."""

from __future__ import annotations

import hashlib
import os
import re
import stat
import tempfile
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from reference.store.errors import DatasetError

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = [
    "CHECKSUMS",
    "check_checksum",
    "checksums",
    "destination",
    "note_checksum",
    "regular_file",
    "replacing",
    "sha256",
    "write_bytes",
]

CHECKSUMS = "SHA256SUMS"
PIECE = 1 << 20
LINE = re.compile(r"([0-9a-f]{64}) [ *](.+)")


def destination(path: str | os.PathLike[str]) -> Path:
    """Return the file that a result is to replace, links resolved.

    Raises:
        FileNotFoundError, IsADirectoryError, OSError: its folder is missing, it is a folder, or it is no regular file.
        TypeError: the path is bytes, or none.
    """
    path = _name(path)
    if not path:
        raise FileNotFoundError("the output path is empty; the name of a file is accepted.")
    target = Path(os.path.realpath(path))
    if target.is_dir():
        raise IsADirectoryError(f"'{path}' is a folder; the name of a file is accepted.")
    if not target.parent.is_dir():
        raise FileNotFoundError(
            f"the folder '{target.parent}' does not exist; create it or choose another output path."
        )
    if target.exists() and not target.is_file():
        raise OSError(f"'{path}' is not a regular file; choose another output path.")
    return target


def _name(path: str | os.PathLike[str]) -> str:
    """A path as text.

    Raises:
        TypeError: it is bytes, or no path.
    """
    name = os.fspath(path) if isinstance(path, (str, os.PathLike)) else path
    if not isinstance(name, str):
        raise TypeError(f"the path is of type {type(path).__name__}; text or a pathlib.Path is accepted.")
    return name


def regular_file(path: str | os.PathLike[str]) -> Path:
    """Return ``path`` where it is a file with something in it.

    Raises:
        FileNotFoundError: there is nothing of this name, or the name is empty.
        DatasetError: it is a folder, a device, empty or unreadable.
        TypeError: the path is bytes, or none.
    """
    path = _name(path)
    if not path:
        raise FileNotFoundError("the path is empty; the path of a dataset is accepted.")
    found = Path(path)
    try:
        status = found.stat()
    except FileNotFoundError:
        raise FileNotFoundError(f"'{path}' does not exist; the path of a dataset is accepted.") from None
    except (OSError, ValueError) as error:
        raise DatasetError(f"'{path}' cannot be read: {getattr(error, 'strerror', None) or error}.") from None
    if not stat.S_ISREG(status.st_mode):
        kind = "a folder" if stat.S_ISDIR(status.st_mode) else "not a regular file"
        raise DatasetError(f"'{path}' is {kind}; the path of a dataset is accepted.")
    if not status.st_size:
        raise DatasetError(f"'{path}' is empty; it is not a dataset.")
    return found


@contextmanager
def replacing(target: Path) -> Iterator[Path]:
    """Give a temporary path beside ``target`` that takes its place when the block ends without an error.

    The old file or the new one is there at every moment; what an earlier run left of its own is cleared away.
    """
    for orphan in target.parent.glob(f".{target.name}.*.tmp"):
        orphan.unlink(missing_ok=True)
    handle, name = tempfile.mkstemp(prefix=f".{target.name}.", suffix=".tmp", dir=target.parent)
    temporary = Path(name)
    try:
        os.fchmod(handle, 0o644)
        os.close(handle)
        yield temporary
        _sync(temporary)
        temporary.replace(target)
        _sync(target.parent)
    except BaseException:
        with suppress(OSError):
            temporary.unlink(missing_ok=True)
        raise


def _sync(path: Path) -> None:
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def write_bytes(target: Path, data: bytes) -> None:
    """Replace ``target`` by these bytes, atomically."""
    with replacing(target) as temporary:
        temporary.write_bytes(data)


def sha256(path: Path) -> str:
    """The SHA-256 of a file, read piece by piece."""
    digest = hashlib.sha256()
    with path.open("rb") as file:
        while piece := file.read(PIECE):
            digest.update(piece)
    return digest.hexdigest()


def checksums(folder: Path) -> dict[str, str]:
    """The checksums noted in a folder, by file name.

    Raises:
        DatasetError: the list is damaged.
    """
    listing = folder / CHECKSUMS
    if not listing.exists():
        return {}
    noted = {}
    try:
        lines = listing.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise DatasetError(f"'{listing}' cannot be read ({error}); restore it or remove it.") from None
    for line in filter(None, lines):
        match = LINE.fullmatch(line)
        if match is None:
            raise DatasetError(f"'{listing}' has a line that is no checksum; restore it or remove it.")
        noted[match[2]] = match[1]
    return noted


def note_checksum(target: Path, digest: str | None) -> None:
    """Write, or with None remove, the checksum of ``target`` in the list beside it, in the format of coreutils."""
    noted = checksums(target.parent)
    if noted.get(target.name) == digest:
        return
    noted.pop(target.name, None)
    if digest is not None:
        noted[target.name] = digest
    listing = target.parent / CHECKSUMS
    text = "".join(f"{noted[name]}  {name}\n" for name in sorted(noted))
    if text:
        write_bytes(listing, text.encode())
    else:
        listing.unlink(missing_ok=True)


def check_checksum(path: Path) -> None:
    """Compare a file with the checksum noted beside it, where one is.

    Raises:
        DatasetError: they differ, or the list is damaged.
    """
    noted = checksums(path.parent).get(path.name)
    if noted is not None and sha256(path) != noted:
        raise DatasetError(f"'{path}' differs from its checksum in {CHECKSUMS}: it is truncated or altered.")
