"""Writing results: all the files of a command appear together, or none does."""

from __future__ import annotations

import contextlib
import os
import secrets
import shutil
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

__all__ = ["Folder", "OutputError", "folder"]


class OutputError(OSError):
    """Results could not be written; its text is one sentence for the user."""


class Folder:
    """A folder of results in the making: `write` collects files out of sight, and leaving `folder` shows them."""

    def __init__(self, target: Path, stage: Path, inside: Path) -> None:
        self.target = target
        self._stage = stage
        self._inside = inside
        self._names: list[str] = []

    def write(self, files: Mapping[str, bytes]) -> None:
        """Add files by name, out of sight."""
        for name, content in files.items():
            with (self._inside / name).open("wb") as stream:
                stream.write(content)
                stream.flush()
                os.fsync(stream.fileno())
            self._names.append(name)

    @property
    def names(self) -> tuple[str, ...]:
        """The files written so far."""
        return tuple(self._names)

    def show(self) -> None:
        """Move everything to its place: one rename of a new folder, or each file into a folder that stands."""
        if self._stage.parent == self.target:
            _replace_all(self._inside, self.target, self._names)
        else:
            self._stage.rename(_first_missing(self.target))


@contextlib.contextmanager
def folder(path: str | os.PathLike[str]) -> Iterator[Folder]:
    """A folder of results at the path, made with its parents; on any failure the disk is left as it was.

    That it can be written is found out on entry, before anything is computed.

    Raises:
        OutputError: the path is a file, or cannot be written, or the disk is full.
    """
    try:
        target = _target(path)
        stage, inside = _make_stage(target)
    except (OSError, ValueError) as error:
        raise OutputError(_sentence(path, error)) from error
    try:
        results = Folder(target, stage, inside)
        yield results
        results.show()
    except OSError as error:
        raise OutputError(_sentence(path, error)) from error
    finally:
        shutil.rmtree(stage, ignore_errors=True)


def _target(path: str | os.PathLike[str]) -> Path:
    if not os.fspath(path):
        raise ValueError("the name is empty")
    target = Path(path).resolve()
    if target.exists() and not target.is_dir():
        raise NotADirectoryError(None, "it is a file, not a folder")
    return target


def _make_stage(target: Path) -> tuple[Path, Path]:
    """A hidden folder on the target's disk, and the folder in it where files are collected."""
    first = None if target.is_dir() else _first_missing(target)
    parent = target if first is None else first.parent
    _clear_orphans(parent)
    stage = parent / f".horologium-{os.getpid()}-{secrets.token_hex(4)}"
    stage.mkdir()
    inside = stage if first is None else stage / target.relative_to(first)
    try:
        inside.mkdir(parents=True, exist_ok=True)
    except OSError:
        shutil.rmtree(stage, ignore_errors=True)
        raise
    return stage, inside


def _clear_orphans(parent: Path) -> None:
    """Remove the stages of processes of ours that were killed before they could."""
    for stage in parent.glob(".horologium-*-*"):
        pid = stage.name.split("-")[1]
        if stage.is_dir() and pid.isdecimal() and not _is_running(int(pid)):
            shutil.rmtree(stage, ignore_errors=True)


def _is_running(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        return True
    return True


def _first_missing(target: Path) -> Path:
    """The outermost folder of the path that does not exist."""
    missing = target
    while not missing.parent.exists():
        missing = missing.parent
    return missing


def _replace_all(source: Path, target: Path, names: list[str]) -> None:
    """Move the files over those of the same names; if one cannot be moved, put all back as they were."""
    kept = source / "replaced"
    kept.mkdir()
    done: list[str] = []
    try:
        for name in names:
            if (target / name).is_dir():
                raise IsADirectoryError(None, f"{name} in it is a folder")
            if (target / name).exists():
                (target / name).rename(kept / name)
            done.append(name)
            (source / name).rename(target / name)
    except OSError:
        for name in done:
            (target / name).unlink(missing_ok=True)
            if (kept / name).exists():
                (kept / name).rename(target / name)
        raise


def _sentence(path: str | os.PathLike[str], error: OSError | ValueError) -> str:
    reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
    return f"cannot write results to {os.fspath(path)!r}: {reason[:1].lower()}{reason[1:]}."
