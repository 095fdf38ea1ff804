"""Marches of an integrator over lanes of its own step sizes and starts, whole integrators too."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Protocol

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.claims.candidate import Candidate
    from compare.claims.engine import Engine
    from compare.claims.frames import Scene

__all__ = ["Marcher", "Steps", "Whole"]


class Marcher(Protocol):
    """What carries a state along."""

    @property
    def scene(self) -> Scene:
        """What it is tried on."""

    @property
    def whole(self) -> bool:
        """Whether it goes over a grid by itself."""

    def states(self, starts: np.ndarray, h: np.ndarray, wanted: Sequence[Sequence[int]]) -> list[np.ndarray]:
        """For each lane the states [times, state] after the wanted numbers of steps, which increase."""


@dataclass(frozen=True)
class Steps:
    """A one-step integrator."""

    engine: Engine
    scene: Scene
    whole: ClassVar[bool] = False

    def states(self, starts: np.ndarray, h: np.ndarray, wanted: Sequence[Sequence[int]]) -> list[np.ndarray]:
        """All lanes in lockstep, each until its last wanted step."""
        events: dict[int, list[tuple[int, int]]] = defaultdict(list)
        for lane, steps in enumerate(wanted):
            for place, step in enumerate(steps):
                events[step].append((lane, place))
        found = [np.empty((len(steps), len(starts))) for steps in wanted]
        last = np.array([steps[-1] for steps in wanted])
        alive = np.arange(len(wanted))
        y, sizes = starts.copy(), h.copy()
        for step in range(1, int(last.max()) + 1):
            y = self.engine.advance(y, sizes, (step - 1) * sizes)
            if step in events:
                where = {int(lane): i for i, lane in enumerate(alive)}
                for lane, place in events[step]:
                    found[lane][place] = y[:, where[lane]]
                keep = last[alive] > step
                alive, y, sizes = alive[keep], y[:, keep], sizes[keep]
        return found


@dataclass(frozen=True)
class Whole:
    """An integrator that goes over a grid of times by itself."""

    candidate: Candidate
    scene: Scene
    whole: ClassVar[bool] = True

    def states(self, starts: np.ndarray, h: np.ndarray, wanted: Sequence[Sequence[int]]) -> list[np.ndarray]:
        """One lane after another, each on its own grid."""
        found = []
        for start, size, steps in zip(starts.T, h, wanted, strict=True):
            grid = size * np.arange(
                max(steps[-1], len(start) + 1) + 1
            )  # more times than components: no doubt which is which
            field = self.candidate.field(self.scene, len(grid))
            found.append(self.candidate.states(field, start, grid)[list(steps)])
        return found
