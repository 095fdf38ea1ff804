"""The thesis' animations, bodies on paths over time: the race, figure 8, and the tautochrone, figure 13."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from compare.sources.figures.descents import FIELD, FRACTIONS, GRAVITY, QUARTIC, RACE, RELEASED, STARTS_NOTE
from compare.sources.figures.drawing import Curve, curve
from reference import Descent, Tautochrone

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["Body", "Motion", "figure8", "figure13"]

PANELS = np.arange(6) / 5
"""Of the time of the descent on the cycloid, a panel each."""
STARTS = ("3.13", "2.5", "2.0", "1.5")
"""Angles of the four starts in rad, from the bottom."""


@dataclass(frozen=True)
class Body:
    """A body on its way down.

    Attributes:
        name: what is written beside it.
        arrival: when it is at the end of its way, in s.
        end: where that is, (x, y) in m.
        moving: from times in s before the arrival to its proven places, (x, y) in m.
    """

    name: str
    arrival: float
    end: np.ndarray
    moving: Callable[[np.ndarray], np.ndarray]

    def places(self, times: np.ndarray) -> np.ndarray:
        """(x, y) in m at increasing times in s; at the end of its way from the arrival on."""
        before = times[times < self.arrival]
        arrived = np.tile(self.end, (len(times) - len(before), 1))
        return np.vstack([self.moving(before), arrived]) if len(before) else arrived


@dataclass(frozen=True)
class Motion:
    """Bodies that are released together, on their paths, until the last has arrived.

    Attributes:
        item, title, note: as a drawing's.
        paths: the curves that they are on, (x, y) in m; the name of a body's own curve is the body's.
        bodies: the bodies.
        panels: the times in s at which they are shown side by side.
    """

    item: str
    title: str
    note: str
    paths: tuple[Curve, ...]
    bodies: tuple[Body, ...]
    panels: np.ndarray

    @property
    def name(self) -> str:
        """The name of its files."""
        return self.item.replace(" ", "-")

    def times(self, rate: int) -> np.ndarray:
        """The multiples of 1/rate s from the release to the first at which every body has arrived."""
        return np.arange(math.ceil(max(body.arrival for body in self.bodies) * rate) + 1) / rate


def figure8() -> Motion:
    """The race, until the line has lost it."""
    races = [Descent(name, GRAVITY) for name in RACE]
    ways = [race.along("passage", FRACTIONS)[:, 1:3] for race in races]
    return Motion(
        "thesis figure 8",
        "the race of three curves",
        f"{RELEASED}\n{QUARTIC}",
        tuple(curve(name, *way.T) for name, way in zip(RACE, ways, strict=True)),
        tuple(_sliding(name, race) for name, race in zip(RACE, races, strict=True)),
        PANELS * float(Descent("cycloid", GRAVITY).descent_time()),
    )


def _sliding(name: str, race: Descent) -> Body:
    """The body on a curve of the race."""
    (end,) = race.along("passage", [1])[:, 1:3]
    return Body(name, float(race.descent_time()), end, lambda times: race.along("motion", times)[:, :2])


def figure13() -> Motion:
    """Four bodies on the cycloid, until all are at its lowest point, (0, 0)."""
    swings = [Tautochrone(start, 1, GRAVITY) for start in STARTS]
    arrivals = [float(swing.descent_time()) for swing in swings]
    way = swings[0].along("position", np.linspace(0.0, arrivals[0], 97))
    bodies = [
        Body(f"from θ₀ = {start} rad", arrival, np.zeros(2), partial(swing.along, "position"))
        for start, arrival, swing in zip(STARTS, arrivals, swings, strict=True)
    ]
    return Motion(
        "thesis figure 13",
        "four bodies on the cycloid",
        f"R = 1 m, {FIELD} {STARTS_NOTE}",
        (curve("", *way.T, behind=True),),
        tuple(bodies),
        PANELS * arrivals[0],
    )
