"""Files that are whole or absent: where a result may go, and atomic replacement."""

from __future__ import annotations

import fcntl
import hashlib
import os
import re
import stat
import tempfile
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from reference.dataset.errors import DatasetError

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = [
    "destination",
    "regular_file",
    "replacing",
    "sha256",
    "temporaries",
    "write_bytes",
]

PIECE = 1 << 20
TEMPORARY = ".tmp"


def destination(path: str | os.PathLike[str]) -> Path:
    """Return the file that a result is to replace, links resolved.

    Raises:
        FileNotFoundError, IsADirectoryError, OSError: its folder is missing, it is a folder, no regular file, or a link
            that leads nowhere.
        TypeError: the path is bytes, or none.
    """
    path = _name(path)
    if not path:
        raise FileNotFoundError("the output path is empty; the name of a file is accepted.")
    target = Path(os.path.realpath(path))
    if target.is_symlink():
        raise OSError(f"'{path}' is a link that leads to itself; choose another output path.")
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

    The old file or the new one is there at every moment.  The temporary file is locked while it is written; what
    killed runs left of their own, files of its form that nobody has locked, is cleared away.
    """
    _clear_orphans(target)
    handle, temporary = _temporary(target)
    try:
        os.fchmod(handle, 0o644)
        yield temporary
        os.fsync(handle)
        temporary.replace(target)
        _sync(target.parent)
    except BaseException:
        with suppress(OSError):
            temporary.unlink(missing_ok=True)
        raise
    finally:
        os.close(handle)


def _prefix(target: Path) -> str:
    return f".horologium-{hashlib.sha256(os.fsencode(target.name)).hexdigest()[:8]}-"


def _temporary(target: Path) -> tuple[int, Path]:
    """A new file, open and locked."""
    while True:
        handle, name = tempfile.mkstemp(prefix=_prefix(target), suffix=TEMPORARY, dir=target.parent)
        if _is_locked(handle, Path(name)):
            return handle, Path(name)
        os.close(handle)  # another run took it for an orphan before it was locked, and clears it away


def temporaries(target: Path) -> list[str]:
    """The names of the temporary files beside ``target`` that were made to take its place."""
    form = re.compile(re.escape(_prefix(target)) + "[a-z0-9_]{8}" + re.escape(TEMPORARY))
    return sorted(path.name for path in target.parent.iterdir() if form.fullmatch(path.name))


def _clear_orphans(target: Path) -> None:
    for path in [target.parent / name for name in temporaries(target)]:
        with suppress(OSError):  # a link, or gone, or somebody else's
            if not stat.S_ISREG(path.lstat().st_mode):
                continue
            handle = os.open(path, os.O_RDWR | os.O_NOFOLLOW | os.O_NONBLOCK)
            try:
                if _is_locked(handle, path):
                    path.unlink()
            finally:
                os.close(handle)


def _is_locked(handle: int, path: Path) -> bool:
    """Lock an open file, where nobody has, and see that it still has its name."""
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return os.path.samestat(path.lstat(), os.fstat(handle))
    except (BlockingIOError, FileNotFoundError):
        return False


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
