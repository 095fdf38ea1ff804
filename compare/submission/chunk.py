"""Some consecutive rows of a submission."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from compare.submission.written import Written

__all__ = ["Chunk"]


class Chunk(NamedTuple):
    """Rows' times, their states, and where each stands, such as "line 7"."""

    times: list[Written]
    states: list[tuple[Written, ...]]
    places: list[str]
