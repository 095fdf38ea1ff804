"""Where a state is: the phase and the amplitude of the orbit through it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple, Protocol

from flint import arb

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction

__all__ = ["NOWHERE", "Orbits", "Place", "apart"]


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


def apart(here: Place, true: Place) -> tuple[float, float]:
    """The errors of phase, in rad from -pi to pi, and of amplitude; NaN where one of the places has none."""
    phase = amplitude = math.nan
    if here.phase is not None and true.phase is not None:
        periods = here.phase - true.phase
        phase = float(2 * arb.pi() * (periods - (periods + arb(0.5)).mid().floor()))
    if here.amplitude is not None and true.amplitude is not None:
        amplitude = float(here.amplitude - true.amplitude)
    return phase, amplitude
