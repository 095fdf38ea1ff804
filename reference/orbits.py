"""Action–angle variables: the amplitude of the orbit through a state, and the phase of the state on it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple, Protocol

from flint import arb

from reference.arithmetic.namespaces import BALL

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction

__all__ = ["NOWHERE", "HarmonicOrbits", "Orbits", "Place", "apart"]


class Place(NamedTuple):
    """Phase (the angle variable) in periods, amplitude in the units of the position; None where the orbit has none."""

    phase: arb | None
    amplitude: arb | None


NOWHERE = Place(None, None)
"""On no orbit of the exact motion's kind."""


class Orbits(Protocol):
    """The exact orbits of a problem, at the precision in force when it is made."""

    def truth(self, t: Fraction) -> Place:
        """Phase and amplitude of the exact motion at t."""

    def place(self, y: Sequence[arb]) -> Place:
        """Phase and amplitude of any state on the orbit through it, if that is of the exact motion's kind."""


def apart(here: Place, true: Place) -> tuple[float, float]:
    """The errors of phase, in rad from -pi to pi, and of amplitude; NaN where one of the two states has none."""
    phase = amplitude = math.nan
    if here.phase is not None and true.phase is not None:
        periods = here.phase - true.phase
        phase = float(2 * arb.pi() * (periods - (periods + arb(0.5)).mid().floor()))
    if here.amplitude is not None and true.amplitude is not None:
        amplitude = float(here.amplitude - true.amplitude)
    return phase, amplitude


class HarmonicOrbits:
    """x'' = -w^2 x with x the first of the state less ``centre``: amplitude sqrt(x^2 + (x'/w)^2)."""

    def __init__(self, start: Sequence[Fraction], w: arb, centre: arb | None = None) -> None:
        self.w, self._centre = w, arb(0) if centre is None else centre
        self._start = self.place([BALL.number(value) for value in start])

    def truth(self, t: Fraction) -> Place:
        """The start's phase, w t/(2 pi) periods later."""
        phase = self._start.phase
        later = None if phase is None else phase + BALL.number(t) * self.w / (2 * arb.pi())
        return Place(later, self._start.amplitude)

    def place(self, y: Sequence[arb]) -> Place:
        """Phases count from the upward passage through the centre."""
        return self.polar(y[0] - self._centre, y[1] / self.w)

    @staticmethod
    def polar(x: arb, rate: arb) -> Place:
        """The angle of (rate, x) in turns, and its distance from the centre."""
        square = x * x + rate * rate
        return Place(arb.atan2(x, rate) / (2 * arb.pi()), square.sqrt()) if square > 0 else Place(None, square.sqrt())
