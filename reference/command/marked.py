"""Folders of our own beside an output: made with a mark in them, locked while in use, emptied of our own names only.

A folder is ours where its file ``lock`` begins with the mark, and no link leads to it or to that file.  What is in it
is reached from the open folder, never by its path, and never through a link.
"""

from __future__ import annotations

import errno
import fcntl
import os
import re
import secrets
import stat
from contextlib import ExitStack, suppress
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from types import TracebackType

    Form = Callable[[str], object]
    """Whether a path in the folder, that of a folder with a slash at its end, is one that we give."""

__all__ = ["BusyError", "Marked", "PlaceError", "abandoned", "found", "kind_of", "made", "required"]

LOCK = "lock"
MARK = b"Made by Horologium for work in progress, and removed by it; keep nothing of your own in this folder.\n"
PREFIX = ".horologium-"
HIDDEN = re.compile(re.escape(PREFIX) + r"[0-9a-f]{8}")
FOLDER = os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW
LOCKING = os.O_RDWR | os.O_APPEND | os.O_NOFOLLOW | os.O_NONBLOCK
NOTES = 1 << 22
"""Bytes of notes that are read."""


class BusyError(RuntimeError):
    """Another process is at work on the same output."""


class PlaceError(OSError):
    """The place of an output, or one beside it that is needed, cannot be used; its text is one sentence."""


class Marked:
    """An open folder of ours, locked until it is closed or the process ends, however it ends.

    Attributes:
        path: where it is.
        handle: the open folder.
    """

    def __init__(self, path: Path, handle: int, lock: int) -> None:
        self.path, self.handle, self._lock = path, handle, lock

    def __enter__(self) -> Marked:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        os.close(self._lock)
        os.close(self.handle)

    def note(self, path: str) -> None:
        """Note the path in the folder of what is about to be made there, for whoever has to clear it away."""
        os.write(self._lock, f"{path}\n".encode())

    def noted(self) -> frozenset[str]:
        """The paths that were noted."""
        return frozenset(os.pread(self._lock, NOTES, len(MARK)).decode(errors="replace").split("\n"))

    def paths(self) -> Iterator[str]:
        """The paths of all in it but the lock: that of a folder ends with a slash, of a link or a device with two."""
        for path, names, handle in self._walked(topdown=True):
            yield from (path + _told(name, handle) for name in names if path + name != LOCK)

    def clear(self, form: Form) -> None:
        """Remove what is of this form; whatever else is there, and the folders that hold it, stay."""
        for path, names, handle in self._walked(topdown=False):
            for name in names:
                told = _told(name, handle)
                if path + name == LOCK or not form(path + told):
                    continue
                if told.endswith("/"):
                    with suppress(OSError):  # something else is in it
                        os.rmdir(name, dir_fd=handle)
                else:
                    os.unlink(name, dir_fd=handle)

    def remove(self, form: Form) -> None:
        """Remove what is of this form and then the folder, which stays with its lock where anything else is in it.

        It leaves its place with its lock: nobody ever finds it there without.
        """
        self.clear(form)
        if any(self.paths()) or not _is_still(self.path, self.handle):
            return
        if not HIDDEN.fullmatch(self.path.name):
            self.path = self.path.rename(_hidden(self.path.parent))
        os.unlink(LOCK, dir_fd=self.handle)
        with suppress(OSError):  # something came into it this moment
            self.path.rmdir()

    def take(self, place: Path) -> bool:
        """Move the folder to a place where nothing is; False where something is."""
        if os.path.lexists(place):
            return False
        try:
            self.path = self.path.rename(place)
        except OSError as error:
            if error.errno in {errno.ENOTEMPTY, errno.EEXIST, errno.ENOTDIR}:
                return False
            raise
        return True

    def _walked(self, *, topdown: bool) -> Iterator[tuple[str, list[str], int]]:
        """Itself and each folder in it that is no link: its path, "" or with a slash, its names, its handle."""
        for root, folders, files, handle in os.fwalk(".", topdown=topdown, follow_symlinks=False, dir_fd=self.handle):
            yield "".join(f"{part}/" for part in Path(root).parts), [*folders, *files], handle


def _told(name: str, handle: int) -> str:
    """The name as a form is asked for it: of a folder with a slash, of a link or a device as none has it."""
    mode = os.stat(name, dir_fd=handle, follow_symlinks=False).st_mode
    return f"{name}/" if stat.S_ISDIR(mode) else name if stat.S_ISREG(mode) else f"{name}//"


def _hidden(parent: Path) -> Path:
    return parent / f"{PREFIX}{secrets.token_hex(4)}"


def _is_still(path: Path | str, opened: int, folder: int | None = None) -> bool:
    """Whether the name, in the folder where one is given, is still that of what was opened."""
    try:
        return os.path.samestat(os.stat(path, dir_fd=folder, follow_symlinks=False), os.fstat(opened))
    except FileNotFoundError:
        return False


def made(parent: Path) -> Marked:
    """Make a folder of ours in this one, hidden, of a name of its own.

    Raises:
        OSError: it cannot be made.
    """
    path = _hidden(parent)
    with ExitStack() as undo:
        path.mkdir(0o700)
        undo.callback(path.rmdir)
        handle = os.open(path, FOLDER)
        undo.callback(os.close, handle)
        lock = os.open(LOCK, LOCKING | os.O_CREAT | os.O_EXCL, 0o600, dir_fd=handle)
        undo.callback(os.unlink, path / LOCK)
        undo.callback(os.close, lock)
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        if os.write(lock, MARK) < len(MARK):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        undo.pop_all()
    return Marked(path, handle, lock)


def found(path: Path) -> Marked | None:
    """Open the folder of ours at this path; None where nothing is there.

    Raises:
        PlaceError: what is there was not made by us; it is left as it is.
        BusyError: another process is at work in it.
    """
    while True:
        with ExitStack() as undo:
            try:
                handle = os.open(path, FOLDER)
            except FileNotFoundError:
                return None
            except OSError as error:
                raise _foreign(path, error) from None
            undo.callback(os.close, handle)
            lock = _opened_lock(path, handle)
            undo.callback(os.close, lock)
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise BusyError(f"another process is at work in '{path}'.") from None
            if _is_still(path, handle) and _is_still(LOCK, lock, handle):
                undo.pop_all()
                return Marked(path, handle, lock)


def _opened_lock(path: Path, handle: int) -> int:
    """Open the lock of a folder, nothing in it changed.

    Raises:
        PlaceError: there is none, or it is not ours.
    """
    try:
        if _told(LOCK, handle) != LOCK:
            raise _foreign(path)
        lock = os.open(LOCK, LOCKING, dir_fd=handle)
    except FileNotFoundError:
        raise _foreign(path) from None
    except PlaceError:
        raise
    except OSError as error:
        raise _foreign(path, error) from None
    if os.pread(lock, len(MARK), 0) == MARK:
        return lock
    os.close(lock)
    raise _foreign(path)


def _foreign(path: Path, error: OSError | None = None) -> PlaceError:
    """The refusal of what is at a path, by its kind, or by the reason for which it cannot be opened."""
    if error is not None and error.errno == errno.ENAMETOOLONG:
        return PlaceError(f"'{path}' is too long a name for a file; choose a shorter one for the output.")
    if error is not None and error.errno not in {errno.ELOOP, errno.ENOTDIR}:
        return PlaceError(f"'{path}' cannot be opened ({error.strerror}); make it accessible or move it elsewhere.")
    return PlaceError(f"'{path}' is {kind_of(path)} that this program did not make; move it elsewhere.")


def kind_of(path: Path) -> str:
    """What is at a path, a link as such: "a link", "a folder", "a file", or "something"."""
    try:
        mode = path.lstat().st_mode
    except FileNotFoundError:
        return "something"
    kinds = {stat.S_IFLNK: "a link", stat.S_IFDIR: "a folder", stat.S_IFREG: "a file"}
    return kinds.get(stat.S_IFMT(mode), "something")


def required(path: Path, form: Form) -> Marked:
    """The folder of ours at this path, made where nothing is there.

    Raises:
        PlaceError: what is there was not made by us, or holds what is not of this form; all is left as it is.
        BusyError: another process is at work in it.
        OSError: it cannot be made.
    """
    while True:
        there = found(path)
        if there is None:
            there = made(path.parent)
            with ExitStack() as undo:
                undo.enter_context(there)
                undo.callback(there.remove, _nothing)
                if not there.take(path):
                    continue
                undo.pop_all()
        with ExitStack() as undo:
            undo.enter_context(there)
            other = next((inside for inside in there.paths() if not form(inside)), None)
            if other is not None:
                raise PlaceError(
                    f"'{path}' holds '{other.rstrip('/')}', which this program did not make; move it elsewhere."
                )
            undo.pop_all()
        return there


def _nothing(_path: str) -> bool:
    return False


def abandoned(parent: Path) -> Iterator[Marked]:
    """The hidden folders in this one that ``made`` made for processes that ended without removing them."""
    for path in sorted(parent.iterdir()):
        if HIDDEN.fullmatch(path.name):
            with suppress(PlaceError, BusyError):
                folder = found(path)
                if folder is not None:
                    with folder:
                        yield folder
