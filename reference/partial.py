"""Finished blocks of an unfinished build, in a folder beside the output, so that a long build can go on."""

from __future__ import annotations

import fcntl
import hashlib
import shutil
from contextlib import contextmanager
from typing import TYPE_CHECKING

from reference.blocks import Result

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from reference.plan import Block

__all__ = ["BusyError", "Partial", "partial"]


class BusyError(RuntimeError):
    """Another process is at work on the same output."""


class Partial:
    """The folder of the finished blocks of one plan."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def _path(self, block: Block) -> Path:
        return self.folder / (hashlib.sha256(block.key.encode()).hexdigest()[:32] + ".block")

    def has(self, block: Block) -> bool:
        """Whether the block was finished before; whether it is whole is seen when it is read."""
        return self._path(block).exists()

    def put(self, block: Block, result: Result) -> None:
        """Keep a finished block: it is there as a whole or not at all."""
        path = self._path(block)
        unfinished = path.with_suffix(".tmp")
        unfinished.write_bytes(result.dumped())
        unfinished.replace(path)

    def get(self, block: Block) -> Result | None:
        """The finished block, or None where there is none or it is damaged."""
        path = self._path(block)
        return Result.loaded(path.read_bytes()) if path.exists() else None


@contextmanager
def partial(target: Path, identity: str) -> Iterator[Partial]:
    """Open the folder ``TARGET.partial`` for a plan; blocks of another plan or version in it are thrown away.

    It is removed when the build is finished, when nothing is in it, and when the disk is full or unwritable (OSError);
    whatever else stops the build, such as an interrupt, leaves it for the next one.

    Raises:
        BusyError: another build of the same file is running.
        OSError: the folder cannot be written.
    """
    home = target.with_name(target.name + ".partial")
    try:
        home.mkdir(exist_ok=True)
        with (home / "lock").open("w") as lock:
            _lock(lock.fileno(), target)
            for stale in home.iterdir():
                if stale.is_dir() and stale.name != identity:
                    shutil.rmtree(stale)
            folder = home / identity
            folder.mkdir(exist_ok=True)
            yield Partial(folder)
    except BusyError:
        raise
    except BaseException as error:
        if isinstance(error, OSError) or not any(home.glob("*/*.block")):
            shutil.rmtree(home, ignore_errors=True)
        raise
    shutil.rmtree(home)


def _lock(handle: int, target: Path) -> None:
    """Hold the folder until it is closed or the process ends, however it ends."""
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise BusyError(f"another build is writing '{target}'; wait for it or choose another output path.") from None
