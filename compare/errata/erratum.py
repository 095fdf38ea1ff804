"""An erratum: what is printed, what is right, and one test that the right form passes and the printed form fails."""

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
        holds: the test of a form, by a route that uses neither of the two.
    """

    source: str
    place: str
    printed: str
    right: str
    how: str
    touches: str
    forms: tuple[Any, Any]
    holds: Callable[[Any], bool]

    def confirmed(self) -> bool:
        """Whether the right form passes the test and the printed one fails it."""
        printed, right = self.forms
        return self.holds(right) and not self.holds(printed)
