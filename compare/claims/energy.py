"""What an integrator does to each invariant, the energy first, over many periods: bounded, drifting, or blown up."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from compare.measure.order_fit import slope_with_interval

if TYPE_CHECKING:
    from compare.claims.engine import Marcher
    from compare.claims.frames import Scene

__all__ = ["Energy", "kept"]

ROUNDING = 1e-12
LOST = 0.5
GROWTH = 3.0
"""A largest error beyond so many times that of the first few periods is a drift."""
FEW_PERIODS = 48
"""Steps of a few periods."""


@dataclass(frozen=True)
class Energy:
    """The error of an invariant over a long march.

    Attributes:
        behaviour: "rounding", "bounded", "drifting" or "lost", which is by half of it or more; "short" where the motion
            ends before any of these shows, "none" where there is nothing to be kept.
        largest: the largest |E - E0| over the scale of the invariant, E0 - Emin for an energy above rest.
        slope: of that change, per second, with the half-width of its 95 % interval.
        h: the step, s; ``steps`` of it were taken.
        invariant: what it is called.
        per: the unit of time of the slope, in words.
        lacks: why no change can be told; None where it can.
    """

    behaviour: str
    largest: float
    slope: float
    slope_interval: float
    h: float
    steps: int
    invariant: str = "energy"
    per: str = "second"
    lacks: str | None = None

    @property
    def bounded(self) -> bool:
        """Whether it is seen to stay near its start."""
        return self.behaviour in {"rounding", "bounded"}


def kept(marcher: Marcher, h: float, steps: int) -> tuple[Energy, ...]:
    """Each invariant over so many steps of h from the start, no further than the motion goes; the energy first.

    Where none is declared there is one that says so.
    """
    scene = marcher.scene
    if not scene.invariants:
        return (Energy("none", math.nan, math.nan, math.nan, h, 0, lacks=scene.lacks_energy),)
    steps = int(min(steps, scene.end / h))
    start = scene.start[:, None]
    (states,) = marcher.states(start, np.array([h]), [range(1, steps + 1)])
    return tuple(_kept(scene, index, states, h) for index in range(len(scene.invariants)))


def _kept(scene: Scene, index: int, states: np.ndarray, h: float) -> Energy:
    """One invariant along a march."""
    name, steps = scene.invariants[index].name, len(states)
    if lacks := scene.lacks_change(index):
        return Energy("none", math.nan, math.nan, math.nan, h, 0, name, lacks=lacks)
    units = scene.problem.space.independent
    found = partial(Energy, invariant=name, per={"s": "second", "": "unit of time"}.get(units, units))
    with np.errstate(all="ignore"):
        errors = scene.change(index, states)
    if not np.all(np.isfinite(errors)) or np.max(np.abs(errors)) > 1e6:
        return found("lost", math.inf, math.nan, math.nan, h, steps)
    sizes = np.abs(errors)
    largest, first = float(np.max(sizes)), float(np.max(sizes[: max(FEW_PERIODS, steps // 32)]))
    slope, half = slope_with_interval(h * np.arange(1, steps + 1), errors)
    behaviour = "short" if math.isfinite(scene.end) else "drifting" if largest > GROWTH * first else "bounded"
    if largest <= ROUNDING or largest >= LOST:
        behaviour = "rounding" if largest <= ROUNDING else "lost"
    return found(behaviour, largest, slope, half, h, steps)
