"""Single steps from points of the exact motion: what one errs by is its local error."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np

from compare.claims.engine import Lanes, trial_states
from compare.claims.frames import MisuseError

if TYPE_CHECKING:
    from compare.claims.candidate import Candidate
    from compare.claims.frames import Scene

__all__ = ["Points"]


class Points:
    """Points of the exact motion at some times, rounded to doubles.

    Attributes:
        times: [times].
        y: [times, state].
        sizes: of each component.
    """

    def __init__(self, candidate: Candidate, scene: Scene, h: float) -> None:
        self.plain, self.scene = Lanes(candidate, scene), scene
        self.times = trial_states(scene, h)[2]
        self.y = -scene.errors([Fraction(float(t)) for t in self.times], np.zeros((len(self.times), scene.dimension)))
        self.sizes = scene.sizes(self.y.T)

    def after(self, h: float, plain: Lanes | None = None) -> np.ndarray:
        """The states [times, state] that a step of h gives, or another function of the same arguments.

        Raises:
            MisuseError: one is not finite.
        """
        step = (plain or self.plain).one
        found = np.array([step(one, h, float(t)) for t, one in zip(self.times, self.y, strict=True)])
        if not np.all(np.isfinite(found)):
            raise MisuseError(f"a step of h = {h:.4g} gives no finite state; finite numbers are accepted.")
        return found

    def error(self, found: np.ndarray, later: float) -> float:
        """The largest error of states [times, state] so much later, relative to the size of each component."""
        times = [Fraction(float(t)) + Fraction(later) for t in self.times]
        return float(np.max(np.abs(self.scene.errors(times, found)) / self.sizes))
