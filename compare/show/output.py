"""Writing results: all the files of a command appear together, or none does."""

from __future__ import annotations

import contextlib
import os
import shutil
from pathlib import Path
from typing import TYPE_CHECKING

from reference.command.interrupts import held
from reference.command.marked import PlaceError, abandoned, kind_of, made

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from reference.command.marked import Marked

__all__ = ["Folder", "OutputError", "folder"]

NEW, OLD = "new", "old"
"""Folders in the stage: of the results, and of the files that they replace until all have."""


class OutputError(OSError):
    """Results could not be written; its text is one sentence for the user."""


class Folder:
    """A folder of results in the making: `write` collects files out of sight, and leaving `folder` shows them."""

    def __init__(self, target: Path, stage: Marked, inside: str) -> None:
        self.target = target
        self._stage = stage
        self._inside = inside
        self._names: list[str] = []

    def write(self, files: Mapping[str, bytes]) -> None:
        """Add files by name, out of sight."""
        for name, content in files.items():
            self._stage.note(f"{self._inside}/{name}")
            with (self._stage.path / self._inside / name).open("xb") as stream:
                stream.write(content)
                stream.flush()
                os.fsync(stream.fileno())
            self._names.append(name)

    @property
    def names(self) -> tuple[str, ...]:
        """The files written so far."""
        return tuple(self._names)

    def show(self) -> None:
        """Move everything to its place: one rename of a new folder, or each file into a folder that stands.

        Interrupts wait until it is done.
        """
        with held():
            if self._stage.path.parent == self.target:
                self._replace_all()
            else:
                (self._stage.path / NEW).rename(_first_missing(self.target))

    def _replace_all(self) -> None:
        """Move the files over those of the same names; if one cannot be moved, put all back as they were.

        At every moment each name has its old file or its new one.
        """
        source, old = self._stage.path / self._inside, self._stage.path / OLD
        _make(self._stage, OLD)
        replaced: list[str] = []
        try:
            for name in self._names:
                place = self.target / name
                if os.path.lexists(place):
                    self._stage.note(f"{OLD}/{name}")
                    _keep(place, old / name)
                (source / name).replace(place)
                replaced.append(name)
        except BaseException:
            for name in replaced:
                if (old / name).exists():
                    (old / name).replace(self.target / name)
                else:
                    (self.target / name).unlink(missing_ok=True)
            raise


def _keep(file: Path, kept: Path) -> None:
    """Give a file a second name, or where the disk has none of these, a copy.

    Raises:
        FileExistsError: it is a link, a folder or a device.
    """
    if file.is_symlink() or not file.is_file():
        raise FileExistsError(None, f"{file.name} in it is {kind_of(file)}")
    try:
        kept.hardlink_to(file)
    except OSError:
        shutil.copy2(file, kept)


@contextlib.contextmanager
def folder(path: str | os.PathLike[str]) -> Iterator[Folder]:
    """A folder of results at the path, made with its parents; on any failure the disk is left as it was.

    That it can be written is found out on entry, before anything is computed.

    Raises:
        OutputError: the path is a file, or cannot be written, or the disk is full, or what is not a regular file has
            the name of a result.
    """
    with contextlib.ExitStack() as kept:
        try:
            target = _target(path)
            with held():  # an interrupt finds the stage either not made or certain to be cleared away
                stage, inside = _make_stage(target)
                kept.enter_context(stage)
                kept.callback(_clear, stage)
        except (OSError, ValueError) as error:
            raise OutputError(_sentence(path, error)) from error
        try:
            results = Folder(target, stage, inside)
            yield results
            results.show()
        except PlaceError:
            raise
        except OSError as error:
            raise OutputError(_sentence(path, error)) from error


def _target(path: str | os.PathLike[str]) -> Path:
    if not os.fspath(path):
        raise ValueError("the name is empty")
    target = Path(path).resolve()
    if target.exists() and not target.is_dir():
        raise NotADirectoryError(None, "it is a file, not a folder")
    return target


def _make_stage(target: Path) -> tuple[Marked, str]:
    """A hidden folder on the target's disk, and the path in it of the folder where files are collected."""
    first = None if target.is_dir() else _first_missing(target)
    parent = target if first is None else first.parent
    for orphan in abandoned(parent):
        _clear(orphan)
    stage = made(parent)
    below = () if first is None else target.relative_to(first).parts
    try:
        for depth in range(len(below) + 1):
            _make(stage, "/".join((NEW, *below[:depth])))
    except BaseException:
        with stage:
            _clear(stage)
        raise
    return stage, "/".join((NEW, *below))


def _make(stage: Marked, path: str) -> None:
    stage.note(f"{path}/")
    (stage.path / path).mkdir()


def _clear(stage: Marked) -> None:
    """Remove what was made in a stage, and the stage."""
    with contextlib.suppress(OSError):  # nobody is waiting for it, and the next run tries again
        stage.remove(stage.noted().__contains__)


def _first_missing(target: Path) -> Path:
    """The outermost folder of the path that does not exist."""
    missing = target
    while not missing.parent.exists():
        missing = missing.parent
    return missing


def _sentence(path: str | os.PathLike[str], error: OSError | ValueError) -> str:
    reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
    return f"cannot write results to {os.fspath(path)!r}: {reason[:1].lower()}{reason[1:]}."
