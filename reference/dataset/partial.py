"""Finished blocks of an unfinished build, in a folder beside the output, so that a long build can go on."""

from __future__ import annotations

import hashlib
import os
import re
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING

from reference.command.marked import BusyError, PlaceError, abandoned, required

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from reference.command.marked import Marked

__all__ = ["BusyError", "Partial", "PlaceError", "partial", "place_of"]

IDENTITY = re.compile(r"[0-9a-f]{64}")
FORM = re.compile(IDENTITY.pattern + r"/([0-9a-f]{32}\.(block|tmp))?")
"""The folder of a plan, and a block in it."""
NO_LINK = os.O_NOFOLLOW | os.O_NONBLOCK


class Partial:
    """The finished blocks of one plan, as bytes by their keys, in an open folder."""

    def __init__(self, handle: int) -> None:
        self._handle = handle
        self._finished = {name for name in os.listdir(handle) if name.endswith(".block")}

    def has(self, key: str) -> bool:
        """Whether the block was finished before; whether it is whole is seen when it is read."""
        return _name(key) in self._finished

    def put(self, key: str, data: bytes) -> None:
        """Keep a finished block: it is there as a whole or not at all."""
        name = _name(key)
        unfinished = name.replace(".block", ".tmp")
        with suppress(FileNotFoundError):
            os.unlink(unfinished, dir_fd=self._handle)
        with open(unfinished, "xb", opener=self._opened) as stream:
            stream.write(data)
        os.replace(unfinished, name, src_dir_fd=self._handle, dst_dir_fd=self._handle)
        self._finished.add(name)

    def get(self, key: str) -> bytes | None:
        """The finished block, or None where there is none."""
        try:
            with open(_name(key), "rb", opener=self._opened) as stream:
                return stream.read()
        except FileNotFoundError:
            return None

    def _opened(self, name: str, flags: int) -> int:
        return os.open(name, flags | NO_LINK, 0o600, dir_fd=self._handle)


def _name(key: str) -> str:
    return hashlib.sha256(key.encode()).hexdigest()[:32] + ".block"


def place_of(target: Path) -> Path:
    """The folder of the unfinished blocks of an output."""
    return target.with_name(target.name + ".partial")


@contextmanager
def partial(target: Path, identity: str) -> Iterator[Partial]:
    """Open the folder ``TARGET.partial`` for a plan of this identity, 64 hexadecimal digits.

    Blocks of another plan or version in it are thrown away.  It is removed when the build is finished, when nothing is
    in it, and when the disk is full or unwritable (OSError); whatever else stops the build, such as an interrupt,
    leaves it for the next one.

    Raises:
        BusyError: another build of the same file is running.
        PlaceError: the folder was not made by us, or holds what was not; it is left as it is.
        OSError: the folder cannot be written.
        ValueError: the identity is of another form.
    """
    if not IDENTITY.fullmatch(identity):
        raise ValueError(f"the identity is '{identity}'; 64 hexadecimal digits are accepted.")
    try:
        for orphan in abandoned(target.parent):
            orphan.remove(FORM.fullmatch)
        home = required(place_of(target), FORM.fullmatch)
    except BusyError:
        raise BusyError(f"another build is writing '{target}'; wait for it or choose another output path.") from None
    except (PermissionError, FileNotFoundError) as error:
        raise PlaceError(
            f"'{target}' cannot be written: no file can be made in that folder ({error.strerror})."
        ) from None
    with home:
        try:
            home.clear(lambda path: FORM.fullmatch(path) and not path.startswith(identity))
            with _inside(home, identity) as finished:
                yield finished
        except BaseException as error:
            if isinstance(error, OSError) or not any(path.endswith(".block") for path in home.paths()):
                with suppress(OSError):  # the error that is under way says more
                    home.remove(FORM.fullmatch)
            raise
        home.remove(FORM.fullmatch)


@contextmanager
def _inside(home: Marked, identity: str) -> Iterator[Partial]:
    with suppress(FileExistsError):
        os.mkdir(identity, 0o700, dir_fd=home.handle)
    handle = os.open(identity, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW, dir_fd=home.handle)
    try:
        yield Partial(handle)
    finally:
        os.close(handle)
