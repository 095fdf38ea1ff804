"""Whether a step goes where the slope points, forwards and backwards, and which known slip explains it if it does not.

Of a method of order one or more, (step(y, h) - y)/h tends to f(y) as h tends to zero from either side.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from compare.claims.consistency import uses
from compare.claims.frames import Exhausted, MisuseError, nonzero
from compare.claims.points import Points
from reference.arithmetic.namespaces import NUMPY

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.claims.candidate import Candidate
    from compare.claims.frames import Scene

__all__ = ["UNTRIED", "Heading", "heading", "units_of_a_step"]

SHORT, SHORTER, SHORTEST = 8, 64, 1 << 16
"""Steps, as parts of h, with which the slope of a step is compared with f; the last with a known mistake of a large
factor."""
NEAR, FALLING = 1e-3, 0.5
"""It is f if it is so near to it, or if its distance with the shorter step is so much less than with the other."""
MATCH = 0.05
"""Relative distance up to which a wrong slope is said to be a known one."""
LEAST_FACTOR = 1.5
"""A slope is said to be f times a number from this one on, or from its inverse down."""
WORSE, MATTERS = 1e3, 1e-9
"""A step back is wrong if its error is so many times that of a step forward, and beyond the second."""

Backward = Literal["right", "wrong", "refused", "untried"]


@dataclass(frozen=True)
class Heading:
    """Where a step goes.

    Attributes:
        consistent: whether a step forward goes along f.
        backward: whether a step with h < 0 goes back along f as well: "refused" where it raises or gives no finite
            state, "untried" where there is no such step.
        uses: whether what f gives makes a difference to it.
        cause: what explains a step that does not go along f, where that is known.
    """

    consistent: bool
    backward: Backward
    uses: bool = True
    cause: str | None = None


UNTRIED = Heading(consistent=True, backward="untried")
"""Of a whole integrator."""


def heading(candidate: Candidate, scene: Scene, h: float) -> Heading:
    """Try short steps from some states of the motion itself, and longer ones back and forth.

    Raises:
        MisuseError: a step forward fails.
    """
    trial = _Trial(candidate, scene, h)
    slopes = trial.slope(h / SHORTER)
    used = candidate.form.own or uses(candidate, scene, h)
    least = trial.slope(h / SHORTEST)
    consistent = trial.along(slopes, trial.slope(h / SHORT)) and _factor(least, trial.rates) is None
    cause = None if consistent else _cause(slopes, trial.slope(h / SHORT), least, trial, scene)
    try:
        back = trial.along(trial.slope(-h / SHORTER), trial.slope(-h / SHORT)) and trial.as_good_back(h / 2)
    except (MisuseError, Exhausted):
        return Heading(consistent, "refused", used, cause)
    return Heading(consistent, "right" if back else "wrong", used, cause)


class _Trial(Points):
    """The same, held against f."""

    def __init__(self, candidate: Candidate, scene: Scene, h: float) -> None:
        super().__init__(candidate, scene, h)
        rates = [scene.rates(NUMPY, t, tuple(one)) for t, one in zip(self.times, self.y, strict=True)]
        self.rates = np.array(rates)
        self.size = nonzero(np.max(np.abs(self.rates), axis=0))

    def slope(self, h: float) -> np.ndarray:
        """(step(y, h) - y)/h."""
        slopes: np.ndarray = (self.after(h) - self.y) / h
        return slopes

    def along(self, shorter: np.ndarray, short: np.ndarray) -> bool:
        """Whether slopes with two steps tend to f."""
        near, far = (float(np.max(np.abs(slopes - self.rates) / self.size)) for slopes in (shorter, short))
        return near <= NEAR or near <= FALLING * far

    def as_good_back(self, h: float) -> bool:
        """Whether a step back errs no more than one forward, within a large factor."""
        forth, back = (self.error(self.after(signed), signed) for signed in (h, -h))
        return back <= max(WORSE * forth, MATTERS)


def _cause(slopes: np.ndarray, longer: np.ndarray, least: np.ndarray, trial: _Trial, scene: Scene) -> str | None:
    """What a slope is in place of f, where it is known; that of a longer step and of the shortest tell besides."""
    rates = trial.rates
    if np.any(slopes) and _multiple(longer, slopes, (SHORTER / SHORT,)) is not None:
        return "what it adds goes with h^2, where it should go with h"
    if (factor := _factor(least, rates)) is not None:
        return f"it goes on by {factor:.4g} h{units_of_a_step(factor)}"
    if _in_degrees(least, trial, scene):
        return "it goes along f of angles in degrees, where they are in radians"
    first = scene.problem.space.places(scene.problem.space.positions)
    second = scene.rates_places or first
    signs = (1, 0, -1)
    known = (_multiple(slopes[:, places], rates[:, places], signs) for places in (first, second))
    return CAUSES.get(tuple(known))


def units_of_a_step(factor: float) -> str:
    """What explains steps of so many h, behind a comma; nothing where that is not known."""
    known = {1000: ", as where h is turned into milliseconds", 0.001: ", as where h is taken for milliseconds"}
    return next((why for k, why in known.items() if abs(factor / k - 1) < MATCH), "")


def _multiple(slopes: np.ndarray, rates: np.ndarray, factors: Sequence[float]) -> float | None:
    """The one of the factors whose product with the rates the slopes are, or None."""
    size = np.max(np.abs(rates))
    found = (one for one in factors if np.max(np.abs(slopes - one * rates)) <= MATCH * size * max(1.0, abs(one)))
    return next(found, None)


def _factor(slopes: np.ndarray, rates: np.ndarray) -> float | None:
    """The one number, of no sign and magnitude that is told otherwise, whose product with the rates the slopes are."""
    factor = float(np.sum(slopes * rates) / np.sum(rates * rates))
    if 1 / LEAST_FACTOR < factor < LEAST_FACTOR:
        return None
    if factor <= 0:
        return None
    return factor if np.max(np.abs(slopes / factor - rates)) <= MATCH * np.max(np.abs(rates)) else None


def _in_degrees(slopes: np.ndarray, trial: _Trial, scene: Scene) -> bool:
    """Whether slopes are the rates where the angles are turned into radians, or into degrees, once more."""
    angles = scene.problem.space.places(scene.problem.space.angles)
    for factor in (math.pi / 180, 180 / math.pi) if angles else ():
        y = trial.y.copy()
        y[:, angles] *= factor
        rates = np.array([scene.rates(NUMPY, t, tuple(one)) for t, one in zip(trial.times, y, strict=True)])
        if np.max(np.abs(slopes - rates)) <= MATCH * np.max(np.abs(rates)):
            return True
    return False


CAUSES: dict[tuple[float | None, ...], str] = {
    (1, -1): "the momenta go against the force, as with the gradient of the potential in its place: "
    "force = -gradient is what a step is given",
    (0, 0): "it does not move",
    (-1, -1): "it goes backwards, as with the sign of h or of f changed",
    (0, 1): "the positions do not move",
    (1, 0): "the momenta do not move",
}
"""By the multiples of the slopes of positions and of momenta that a step goes along."""
