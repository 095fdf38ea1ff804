"""An erratum: what is printed, what is right, and one test that the right form passes and every other form fails."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["REPORT", "THESIS", "Erratum"]

REPORT, THESIS = "report", "thesis"
"""The sources, by their keys in the data file of what they print."""


@dataclass(frozen=True)
class Erratum:
    """One slip of a source.

    Attributes:
        source: REPORT or THESIS.
        place: the number of the equation, table, figure or section.
        printed: what stands there.
        right: what is right.
        how: how it was checked, in a sentence.
        touches: which published numbers it changes, in a sentence.
        forms: the printed form and the right one, as ``holds`` takes them.
        slips: near misses of the right form, such as one coefficient off by one, which show how much the test can see.
        holds: the test of a form, by a route that uses none of them.
    """

    source: str
    place: str
    printed: str
    right: str
    how: str
    touches: str
    forms: tuple[Any, Any]
    slips: tuple[Any, ...]
    holds: Callable[[Any], bool]

    def confirmed(self) -> bool:
        """Whether the right form passes the test, and the printed one and every near miss fail it."""
        printed, right = self.forms
        return self.holds(right) and not any(map(self.holds, (printed, *self.slips)))
