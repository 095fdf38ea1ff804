"""Finished groups of an unfinished report, kept beside its folder, so that a long report can go on."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict
from typing import TYPE_CHECKING

from compare.report.records import WorkPoint

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.report.work import Task
    from reference.dataset.partial import Partial

__all__ = ["Kept"]

DIGEST = 64
"""Characters of the SHA-256 in front of a group."""


class Kept:
    """The finished groups of one report, among the finished blocks beside it."""

    def __init__(self, finished: Partial) -> None:
        self._finished = finished

    def put(self, task: Task, points: Sequence[WorkPoint]) -> None:
        """Keep a finished group: it is there as a whole or not at all."""
        text = json.dumps([asdict(point) for point in points])
        self._finished.put(task.key, f"{_digest(text)}{text}".encode())

    def get(self, task: Task) -> tuple[WorkPoint, ...] | None:
        """The finished group, or None where there is none or it is damaged."""
        found = (self._finished.get(task.key) or b"").decode(errors="replace")
        digest, text = found[:DIGEST], found[DIGEST:]
        return tuple(WorkPoint(**fields) for fields in json.loads(text)) if text and digest == _digest(text) else None


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()
