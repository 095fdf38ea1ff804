"""Where a state is: the phase and the amplitude of the orbit through it."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Protocol

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction

    from flint import arb

__all__ = ["NOWHERE", "Orbits", "Place"]


class Place(NamedTuple):
    """A phase in periods, and an amplitude in the units of the position; None where the orbit has none."""

    phase: arb | None
    amplitude: arb | None


NOWHERE = Place(None, None)
"""On no orbit of the exact motion's kind."""


class Orbits(Protocol):
    """The exact orbits of a problem, at the precision in force when it is made."""

    def truth(self, t: Fraction) -> Place:
        """The place of the exact motion at t."""

    def place(self, y: Sequence[arb]) -> Place:
        """The place of any state on the orbit through it, if that is of the exact motion's kind."""
