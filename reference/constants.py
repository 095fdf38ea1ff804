"""A physical constant that a problem's parameters come from: its exact value, and who says so."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from reference.arithmetic.exact import spelled

if TYPE_CHECKING:
    from fractions import Fraction

__all__ = ["Constant"]


@dataclass(frozen=True)
class Constant:
    """A named number in its units, with its source in one line."""

    name: str
    value: Fraction
    units: str
    source: str

    def __str__(self) -> str:
        return f"{self.name} = {spelled(self.value)} {self.units} ({self.source})"

    def as_json(self) -> dict[str, str]:
        """Value, units and source as texts."""
        return {"value": spelled(self.value), "units": self.units, "source": self.source}
