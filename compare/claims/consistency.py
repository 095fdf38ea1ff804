"""What a step does where the slope is another one, or constant, and whether it asks for more slopes as it iterates."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.claims.engine import Lanes, Steps, Traced, trial_states
from compare.claims.frames import Exhausted, MisuseError, Scene

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.claims.candidate import Candidate
    from compare.claims.engine import Marcher
    from reference.arithmetic.protocols import Arithmetic

__all__ = ["advance_of_a_constant_slope", "iterates", "uses"]

ROUNDING, NARROW_ROUNDING = 1e-12, 1e-6
"""A relative error of the advance up to this is rounding, or up to the second where the step works in binary32."""
FINER, STAYS = 8, 0.5
"""An advance is wrong if its relative error at h over the first is more than the second of that at h: where a step has
a part of the motion built in, its error falls with the step."""
FACTORS = (0.5, 1, 2)
"""Steps, over h, for which calls of f are counted."""
GRID = 9
"""Times of the grid for which those of a whole integrator are."""


@dataclass(frozen=True)
class _Straight(Scene):
    """q' = p, p' = force: p has a constant slope, and q has where the force is zero; 1 is that of what has no rate."""

    force: float = 0.0

    def rates(self, m: Arithmetic, t: Any, y: Sequence[Any]) -> tuple[Any, ...]:  # noqa: ARG002 - of the scene
        """dy/dt."""
        found = [0 * part + 1.0 for part in y]
        for position, rate in self.problem.space.pairs:
            found[position], found[rate] = y[rate], 0 * y[rate] + self.force
        return tuple(found)

    @property
    def straight(self) -> list[int]:
        """Where the components stand whose slope is 1, from zero with the momenta 1 - force."""
        moving = self.rates_places if self.force else self.rated
        return [i for i in range(self.dimension) if i in moving or i not in (*self.rated, *self.rates_places)]


def advance_of_a_constant_slope(candidate: Candidate, scene: Scene, h: float) -> float:
    """By how many h a step that solves nothing advances a component whose slope is 1: 1.0 if it is right to rounding.

    Of a whole integrator it is the mean over a few steps.

    The worst of the positions under no force, from zero with momenta 1, and the momenta under the force 1, from zero;
    components without a rate are among both.
    """
    worst = 1.0
    for force in (0.0, 1.0):
        coarse, fine = (_advances(candidate, _Straight(scene.problem, force=force), size) for size in (h, h / FINER))
        wrong, finer = np.abs(coarse - 1), np.abs(fine - 1)
        wrong[(finer <= ROUNDING) | (finer <= STAYS * wrong)] = 0
        place = int(np.argmax(wrong))
        if wrong[place] > max(ROUNDING, abs(worst - 1)):
            worst = float(coarse[place])
    return worst


def _advances(candidate: Candidate, scene: _Straight, h: float) -> np.ndarray:
    """Of each component with a constant slope, over h; 1 where the step gives no number at such a state."""
    y = np.zeros(scene.dimension)
    y[scene.rates_places] = 1 - scene.force
    steps = GRID - 1 if candidate.form.whole else 1
    try:
        found = _moved(candidate, scene, y, h)
        found = found[-1] if candidate.form.whole else found
    except (MisuseError, Exhausted):
        return np.ones(len(scene.straight))
    part = found[scene.straight]
    advance = np.where(np.isfinite(part), part / (steps * h), 1.0)
    with np.errstate(over="ignore"):
        narrow = np.array_equal(found, found.astype(np.float32).astype(np.float64))
    return np.where(np.abs(advance - 1) < NARROW_ROUNDING, 1.0, advance) if narrow else advance


def uses(candidate: Candidate, scene: Scene, h: float) -> bool:
    """Whether an integrator moves otherwise where f is another one: one with its motion built in may call f in vain."""
    try:
        here, there = (_moved(candidate, one, scene.start, h) for one in (scene, _Straight(scene.problem)))
        return not np.array_equal(here, there)
    except (MisuseError, Exhausted):
        return True  # the other f makes it fail


def _moved(candidate: Candidate, scene: Scene, y: np.ndarray, h: float) -> np.ndarray:
    if candidate.form.whole:
        return candidate.states(candidate.field(scene, GRID), y, h * np.arange(GRID))
    return Lanes(candidate, scene).one(y, h, 0.0)


def iterates(candidate: Candidate, marcher: Marcher, h: float) -> bool:
    """Whether an inner iteration is at work: as many calls of f are not enough for every state and every step."""
    if isinstance(marcher, Steps) and isinstance(marcher.engine, Traced):
        return False
    y = trial_states(marcher.scene, h)[0].T
    return len({_calls(candidate, marcher.scene, state, factor * h) for state in y for factor in FACTORS}) > 1


def _calls(candidate: Candidate, scene: Scene, y: np.ndarray, h: float) -> int:
    if candidate.form.whole:
        field = candidate.field(scene, GRID)
        candidate.states(field, y, h * np.arange(GRID))
        return field.calls
    plain = Lanes(candidate, scene)
    plain.one(y, h, 0.0)
    return plain.field.calls
