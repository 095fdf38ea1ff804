"""Finished groups of an unfinished report, as files beside its folder, so that a long report can go on."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict
from typing import TYPE_CHECKING

from compare.report.records import WorkPoint

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from compare.report.work import Task

__all__ = ["Kept"]

DIGEST = 64
"""Characters of the SHA-256 in front of a group."""


class Kept:
    """The folder of the finished groups of one report."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def put(self, task: Task, points: Sequence[WorkPoint]) -> None:
        """Keep a finished group: it is there as a whole or not at all."""
        text = json.dumps([asdict(point) for point in points])
        unfinished = self._path(task).with_suffix(".tmp")
        unfinished.write_text(_digest(text) + text, encoding="utf-8")
        unfinished.replace(self._path(task))

    def get(self, task: Task) -> tuple[WorkPoint, ...] | None:
        """The finished group, or None where there is none or it is damaged."""
        path = self._path(task)
        if not path.exists():
            return None
        found = path.read_text(encoding="utf-8", errors="replace")
        digest, text = found[:DIGEST], found[DIGEST:]
        return tuple(WorkPoint(**fields) for fields in json.loads(text)) if digest == _digest(text) else None

    def _path(self, task: Task) -> Path:
        return self.folder / f"{_digest(task.key)[:32]}.block"


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()
