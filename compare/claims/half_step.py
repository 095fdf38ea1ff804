"""Whether an integrator of order one has order two once one half of its state is read half a step later.

Leapfrog's velocities belong to times between those of the positions.  With g the shift of one half of the state by half
a step, a step s of such a method is one of order two in the form g s g^-1.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import product
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from compare.claims.order import Order, measured
from reference.arithmetic.namespaces import NUMPY

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.claims.engine import Marcher
    from compare.claims.frames import Scene

__all__ = ["half_step"]

COUNTS = (32, 48, 64, 96, 128)
LEAST = 1.7
"""A slope from which an order is two."""


@dataclass(frozen=True)
class _Shifted:
    """A march that starts with one half of the state shifted by a part of a step, and is read shifted back."""

    marcher: Marcher
    momenta: bool
    part: float
    whole: ClassVar[bool] = False

    @property
    def scene(self) -> Scene:
        return self.marcher.scene

    @property
    def near(self) -> _Shifted:
        return replace(self, marcher=self.marcher.near)

    def states(
        self, starts: np.ndarray, h: np.ndarray, wanted: Sequence[Sequence[int]], before: int = 0
    ) -> list[np.ndarray]:
        found = self.marcher.states(self._moved(starts, self.part * h, -before * h), h, wanted, before)
        return [
            self._moved(states.T, -self.part * size, size * (np.array(steps) - before)).T
            for states, size, steps in zip(found, h, wanted, strict=True)
        ]

    def _moved(self, y: np.ndarray, by: np.ndarray, t: np.ndarray) -> np.ndarray:
        moving = np.zeros((len(y), 1))
        moving[self.scene.rates_places if self.momenta else self.scene.rated] = 1
        with np.errstate(all="ignore"):
            rates = np.array(np.broadcast_arrays(*self.scene.rates(NUMPY, t, tuple(y))))
            moved: np.ndarray = y + by * moving * rates
        return moved


def half_step(marcher: Marcher, t_end: float) -> str | None:
    """Where order two shows: "velocities" or "positions", and which way; None where it does not, or has no halves."""
    if not marcher.scene.rated:
        return None
    for momenta, part in product((True, False), (-0.5, 0.5)):
        found: Order = measured(_Shifted(marcher, momenta, part), t_end, COUNTS)
        if found.value is not None and found.value >= LEAST:
            return f"{'velocities' if momenta else 'positions'} half a step {'before' if part < 0 else 'after'}"
    return None
