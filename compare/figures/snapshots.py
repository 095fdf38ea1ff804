"""The thesis' animations as panels of successive times: the race, figure 8, and the tautochrone, figure 13."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from compare.figures.descents import FIELD, FRACTIONS, GRAVITY, RACE
from compare.figures.drawing import Curve, curve
from reference import Descent, Tautochrone

__all__ = ["Snapshots", "figure8", "figure13"]

PARTS = np.arange(6) / 5
"""Of the time of the descent on the cycloid, a panel each."""
STARTS = ("3.13", "2.5", "2.0", "1.5")
"""Angles of the four starts in rad, from the bottom."""


@dataclass(frozen=True)
class Snapshots:
    """Bodies on their paths at successive times, in m and s.

    Attributes:
        item, title, note: as a drawing's.
        paths: the curves that they are on, drawn in every panel.
        times: of the panels.
        bodies: of each body its name and its places at these times.
    """

    item: str
    title: str
    note: str
    paths: tuple[Curve, ...]
    times: np.ndarray
    bodies: tuple[Curve, ...]

    @property
    def name(self) -> str:
        """The name of its files."""
        return self.item.replace(" ", "-")


def figure8() -> Snapshots:
    """The race until the cycloid has won it."""
    races = [Descent(name, GRAVITY) for name in RACE]
    times = PARTS * float(Descent("cycloid", GRAVITY).descent_time())
    ways = [race.along("passage", FRACTIONS)[:, 1:3] for race in races]
    return Snapshots(
        "thesis figure 8",
        "the race of three curves",
        f"Released at (π, 2) m, down to (0, 0); {FIELD}",
        tuple(curve(name, *way.T) for name, way in zip(RACE, ways, strict=True)),
        times,
        tuple(curve(name, *_places(race, times).T) for name, race in zip(RACE, races, strict=True)),
    )


def _places(race: Descent, times: np.ndarray) -> np.ndarray:
    """(x, y) at the times, at the end of the curve from the arrival on."""
    sliding = times[times < float(race.descent_time())]
    (end,) = race.along("passage", [1])[:, 1:3]
    return np.vstack([race.along("motion", sliding)[:, :2], *[end] * (len(times) - len(sliding))])


def figure13() -> Snapshots:
    """Four bodies on the cycloid, until all are at its lowest point."""
    swings = [Tautochrone(start, 1, GRAVITY) for start in STARTS]
    last = float(swings[0].descent_time())
    times = PARTS * last
    way = swings[0].along("position", np.linspace(0.0, last, 97))
    return Snapshots(
        "thesis figure 13",
        "four bodies on the cycloid",
        f"R = 1 m, {FIELD}",
        (curve("", *way.T, behind=True),),
        times,
        tuple(
            curve(f"from θ₀ = {start} rad", *swing.along("position", times).T)
            for start, swing in zip(STARTS, swings, strict=True)
        ),
    )
