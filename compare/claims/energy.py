"""What an integrator does to the energy over many periods: bounded, drifting, or blown up."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from compare.measure.order_fit import slope_with_interval

if TYPE_CHECKING:
    from compare.claims.engine import Marcher

__all__ = ["Energy", "energy"]

ROUNDING = 1e-12
LOST = 0.5
GROWTH = 3.0
"""A largest error beyond so many times that of the first few periods is a drift."""
FEW_PERIODS = 48
"""Steps of a few periods."""


@dataclass(frozen=True)
class Energy:
    """The error of the energy over a long march.

    Attributes:
        behaviour: "rounding", "bounded", "drifting" or "lost", which is by half of it or more.
        largest: the largest |E - E0|/(E0 - Emin).
        slope: of (E - E0)/(E0 - Emin), per second, with the half-width of its 95 % interval.
        h: the step, s; ``steps`` of it were taken.
    """

    behaviour: str
    largest: float
    slope: float
    slope_interval: float
    h: float
    steps: int


def energy(marcher: Marcher, h: float, steps: int) -> Energy:
    """The energy over so many steps of h from the start."""
    start = marcher.scene.start[:, None]
    (states,) = marcher.states(start, np.array([h]), [range(1, steps + 1)])
    with np.errstate(all="ignore"):
        errors = marcher.scene.energy(states)
    if not np.all(np.isfinite(errors)) or np.max(np.abs(errors)) > 1e6:
        return Energy("lost", math.inf, math.nan, math.nan, h, steps)
    sizes = np.abs(errors)
    largest, first = float(np.max(sizes)), float(np.max(sizes[: max(FEW_PERIODS, steps // 32)]))
    slope, half = slope_with_interval(h * np.arange(1, steps + 1), errors)
    behaviour = "drifting" if largest > GROWTH * first else "bounded"
    if largest <= ROUNDING or largest >= LOST:
        behaviour = "rounding" if largest <= ROUNDING else "lost"
    return Energy(behaviour, largest, slope, half, h, steps)
