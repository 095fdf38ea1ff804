"""Action–angle variables of a bead on a cycloid by its angle, whose half has an arc length for a sine: harmonic."""

from __future__ import annotations

from typing import TYPE_CHECKING

from reference.orbits import NOWHERE, HarmonicOrbits, Place

if TYPE_CHECKING:
    from collections.abc import Sequence

    from flint import arb

__all__ = ["CycloidOrbits"]


class CycloidOrbits(HarmonicOrbits):
    """The angle theta, by its arc 4 R sin(theta/2): amplitudes are angles."""

    def place(self, y: Sequence[arb]) -> Place:
        """Phase and amplitude of a state that oscillates within the cusps."""
        sine, cosine = (y[0] / 2).sin_cos()
        phase, amplitude = self.polar(sine, cosine * y[1] / (2 * self.w))
        if amplitude is None or not amplitude < 1:
            return NOWHERE
        return Place(phase, 2 * amplitude.asin())
