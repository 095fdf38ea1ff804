"""The orbits of a bead on a cycloid by its angle, whose sine is an arc length and so harmonic."""

from __future__ import annotations

from typing import TYPE_CHECKING

from reference.orbits import NOWHERE, Harmonic, Place

if TYPE_CHECKING:
    from collections.abc import Sequence

    from flint import arb

__all__ = ["CycloidAngles"]


class CycloidAngles(Harmonic):
    """The angle theta, by its arc 4 R sin(theta/2): amplitudes are angles."""

    def place(self, y: Sequence[arb]) -> Place:
        """The place of a state that swings within the cusps."""
        sine, cosine = (y[0] / 2).sin_cos()
        phase, amplitude = self.polar(sine, cosine * y[1] / (2 * self.w))
        if amplitude is None or not amplitude < 1:
            return NOWHERE
        return Place(phase, 2 * amplitude.asin())
