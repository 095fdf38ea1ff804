"""How far a step is from keeping areas, and from running backwards."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from compare.claims.engine import Steps, Traced, trial_states
from compare.claims.frames import MisuseError
from compare.march.precision import precision
from compare.measure.defects import (
    CONFINED_SPACING,
    SPACING,
    STENCIL,
    canonical_places,
    largest_change,
    symplectic_changes,
    symplectic_form,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.claims.engine import Marcher

__all__ = ["Defect", "Evidence", "reversibility", "symplecticity"]

ROUNDING = 1e-11
"""A defect up to this is rounding."""
FACTORS = (0.5, 1, 2)
"""Steps with which a defect is measured, over h."""
TOLERATED, GROWTH = 1e-5, 4096.0
"""A defect up to the first that grows over FACTORS by less than the second may be what the tolerance of an inner
iteration leaves: that varies fifty times with the step, and fifty times with whether the number of iterations changes
along the stencil; a defect of the method that is so small is of a high power of the step, and mostly grows by more."""
STATES = 4
"""States at which a defect is measured."""
STEPS_BACK = 32
NUDGE, CARRIED = 2.0**-30, 16
"""The turned state is moved by the first part of itself, one component at a time, to see how far the way back carries a
rounding; so many of those are taken for rounding where that is far, as on an unstable motion."""
STEPS_OF_A_GRID = 12
"""Steps over which a whole integrator's map is differentiated: its first ones may be another method's."""


@dataclass(frozen=True)
class Defect:
    """A defect, the step at which it was measured, and whether it is none.

    Attributes:
        size: the largest over some states about the motion.
        h: the step, s.
        none: whether it is rounding, or the tolerance of an inner iteration.
        tolerance: whether it is the latter.
        undecided: whether it has the size of a tolerance, and nothing says that it is one or that it is a fault.
        lacks: why there is no such defect, of which the size is then no number; None where there is one.
    """

    size: float
    h: float
    none: bool
    tolerance: bool = False
    undecided: bool = False
    lacks: str | None = None


@dataclass(frozen=True)
class Evidence:
    """What else is known of an integrator that may iterate inside.

    Attributes:
        possible: whether it may: not where it is compiled, or chooses its own steps.
        iterates: whether the calls of f that it makes differ from state to state or from step to step.
        bounded: whether the energy stays bounded; None where the time was too short to see it.
    """

    possible: bool
    iterates: bool
    bounded: bool | None


def _judged(sizes: Sequence[float], signed: np.ndarray, h: float, evidence: Evidence) -> Defect:
    """The verdict of the defects at FACTORS of h; ``signed`` tells one that always goes the same way: no tolerance."""
    if sizes[-1] <= ROUNDING:
        return Defect(sizes[1], h, none=True)
    both_ways = bool(np.min(signed) < 0 < np.max(signed))
    steady = max(sizes) <= GROWTH * sizes[0]
    if max(sizes) <= TOLERATED and evidence.possible and evidence.bounded is not False and both_ways:
        if steady != evidence.iterates or evidence.bounded is None:
            return Defect(sizes[1], h, none=False, undecided=True)
        if steady:
            return Defect(sizes[1], h, none=True, tolerance=True)
    return Defect(sizes[1], h, none=False) if sizes[1] > ROUNDING else Defect(sizes[-1], FACTORS[-1] * h, none=False)


def _trials(marcher: Marcher, h: float) -> tuple[np.ndarray, np.ndarray]:
    """The same states with each step: [state, lanes] and [lanes]."""
    states = trial_states(marcher.scene, h)[0][:, :STATES]
    return np.tile(states, len(FACTORS)), np.repeat([factor * h for factor in FACTORS], STATES)


def _hold_finite(defects: np.ndarray, h: np.ndarray) -> None:
    """Refuse an integrator that gives no number with some step.

    Raises:
        MisuseError: it does.
    """
    lost = ~np.isfinite(defects)
    if np.any(lost):
        raise MisuseError(f"a step of h = {np.min(h[lost]):.4g} gives no finite state; finite numbers are accepted.")


def _largest(defects: np.ndarray) -> list[float]:
    """The largest defect with each step."""
    return [float(np.max(part)) for part in np.split(defects, len(FACTORS), axis=-1)]


def symplecticity(marcher: Marcher, h: float, evidence: Evidence) -> Defect:
    """|S' W S - W|/|W|, S = d(step)/dy exact but for rounding where the step is compiled, else by differences.

    W is the symplectic form, S' W S with W after the step; with one degree of freedom the defect is |det S M(after)/
    M(before) - 1|, M the mass.  Of a whole integrator it is that of the map over several steps.
    """
    problem = marcher.scene.problem
    if not problem.has_momenta:
        return Defect(math.nan, h, none=False, lacks=f"{problem!r} declares no momenta, nor an energy that tells them")
    y, sizes = _trials(marcher, h)
    if isinstance(marcher, Steps) and isinstance(marcher.engine, Traced):
        jacobians = marcher.engine.jacobian(y, sizes)
    else:
        jacobians = _differences(marcher, y, sizes)
    places, form = canonical_places(problem), symplectic_form(problem, precision("float64"))
    slopes, after = jacobians[np.ix_(places, places)], _after(_steps_of_the_map(marcher), marcher, y, sizes)
    with np.errstate(over="ignore", invalid="ignore"):
        if len(places) == 2:
            mass = form(after)[0, 1] / form(y)[0, 1]
            defects = np.linalg.det(np.moveaxis(slopes, -1, 0)) * mass - 1
        else:
            defects = largest_change(symplectic_changes(slopes, form(y), form(after))[0])
    _hold_finite(defects, sizes)
    return _judged(_largest(np.abs(defects)), defects, h, evidence)


def _differences(marcher: Marcher, y: np.ndarray, h: np.ndarray) -> np.ndarray:
    """d(step)/dy as [state, state, lanes] by the stencil."""
    d, lanes = y.shape
    spacings = (CONFINED_SPACING if marcher.scene.confined else SPACING) * marcher.scene.sizes(y)
    shifts = [(i, k) for i in range(d) for k in range(-len(STENCIL), len(STENCIL) + 1) if k]
    moved = [y + (k * spacings[i] * np.eye(d)[i])[:, None] for i, k in shifts]
    after = _after(_steps_of_the_map(marcher), marcher, np.hstack(moved), np.tile(h, len(shifts)))
    jacobians = np.zeros((d, d, lanes))
    for place, (i, k) in enumerate(shifts):
        weight = np.sign(k) * STENCIL[abs(k) - 1] / spacings[i]
        jacobians[:, i] += weight * after[:, place * lanes : (place + 1) * lanes]
    return jacobians


def _steps_of_the_map(marcher: Marcher) -> int:
    return STEPS_OF_A_GRID if marcher.whole else 1


def _after(steps: int, marcher: Marcher, y: np.ndarray, h: np.ndarray) -> np.ndarray:
    return np.stack([states[0] for states in marcher.states(y, h, [[steps]] * len(h))], axis=1)


def reversibility(marcher: Marcher, h: float, evidence: Evidence) -> Defect:
    """Steps forward, turned round, as many on: the distance from the start, over the components' sizes.

    Where the equation depends on the time, that is turned round too: the way back leads from -t to 0.
    """
    scene = marcher.scene
    space = scene.problem.space
    if space.odd is None:
        return Defect(math.nan, h, none=False, lacks=f"{scene.problem!r} declares no way back in time")
    start, sizes = _trials(marcher, h)
    flip = np.ones((len(start), 1))
    flip[space.places(space.odd)] = -1
    steps = int(min(STEPS_BACK, scene.end / (2 * FACTORS[-1] * h)))
    wanted, later = [[steps]] * len(sizes), 0 if scene.problem.autonomous else steps
    end = _last(marcher.states(start, sizes, wanted, 0))
    y = flip * _last(marcher.states(flip * end, sizes, wanted, later))
    moved = flip * _last(marcher.states(flip * end * (1 + NUDGE * flip), sizes, wanted, later))
    with np.errstate(all="ignore"):
        gained = np.zeros(len(sizes)) if scene.lacks_energy else scene.energy(y.T) - scene.energy(start.T)
    away = np.abs(y - start) / scene.sizes(start)[:, None]
    carried = np.abs(moved - y) / scene.sizes(start)[:, None] / NUDGE
    away = np.maximum(away - CARRIED * np.finfo(float).eps * carried, 0) if _unstable(carried) else away
    return _judged(_largest(away), gained, h, evidence)


def _last(ways: list[np.ndarray]) -> np.ndarray:
    """The last state of each lane: [state, lanes]."""
    return np.stack([states[-1] for states in ways], axis=1)


def _unstable(carried: np.ndarray) -> bool:
    """Whether the way back carries roundings so far that they would pass for a defect."""
    return bool(np.nanmax(carried) * CARRIED * np.finfo(float).eps > ROUNDING)
