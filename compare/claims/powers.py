"""The order of a step by its power series in h: the first term that is not the solution's.

Slopes of errors need a range of steps between coarse and rounding, and a method of order eight has little of it in
doubles.  A step that is plain arithmetic is evaluated on series in h instead, with 160 bits: sum_k a_k(y) h^k, where
the solution through y has the terms y^(k)/k!.  It is of order p where those agree for k <= p, and no further.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.claims.engine import Lanes, trial_states
from compare.claims.expansion import Expansion, Expansions
from compare.claims.frames import Exhausted, MisuseError
from reference.arithmetic.namespaces import MPMATH
from reference.arithmetic.precision import mp
from reference.arithmetic.series import jet

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.claims.candidate import Candidate
    from compare.claims.frames import Scene

__all__ = ["Powers", "lower", "powers"]

BITS = 160
STATES = 3
CALLS = 200
"""Calls of f up to which a step is worth its series."""
LEAST, MOST = 12, 24
"""Terms that are computed, and up to which no difference makes the order unknown."""
ROUNDED, CLEAR = 1e-12, 1e-9
"""Differences up to the first are what rounding to doubles makes of coefficients; from the second they are the
method's.  Of 78 methods none has more than 2e-13 in a term that it shares, or less than 1e-8 in the first that it does
not."""
NO_SERIES = (ArithmeticError, ValueError)
"""What a function raises that has no series, as the square root of h."""
REACH, TAIL, AGREEMENT = 4, 1e-14, 1e-12
"""The series is held against plain evaluation at h over the first, or where its last term is less than the second."""


@dataclass(frozen=True)
class Powers:
    """What the terms of a step's series and of the solution's say.

    Attributes:
        differences: of h^1, h^2, ... where h is one over the rate of the motion, relative to the motion's size.
    """

    differences: tuple[float, ...]

    @property
    def order(self) -> int | None:
        """The number of terms that agree; None where all do, or where it hangs on what coefficients were rounded to."""
        first = next((k for k, size in enumerate(self.differences) if not size <= ROUNDED), None)
        return first if first is not None and self.differences[first] >= CLEAR else None

    @property
    def rounded(self) -> bool:
        """Whether a term differs by what may be digits that a coefficient lacks."""
        return any(ROUNDED < size < CLEAR for size in self.differences) and self.order is None


def lower(one: Powers | None, other: Powers | None) -> Powers | None:
    """Of two scenes both: a term agrees where it does on either."""
    if one is None or other is None:
        return None
    return Powers(tuple(map(max, zip(one.differences, other.differences, strict=False))))


def powers(candidate: Candidate, scene: Scene, h: float) -> Powers | None:
    """The differences at some states about the motion; None where the step has no series, or is not what it says."""
    y, _, times = trial_states(scene, h)
    try:
        with mp.workprec(BITS):
            trials = [_Trial(candidate, scene, y[:, i], float(times[i])) for i in range(STATES)]
            differences = _differences(trials, 1 / scene.pace, scene.sizes(y))
            agree = all(trial.agrees(h, len(differences)) for trial in trials)
    except (MisuseError, Exhausted, *NO_SERIES):
        return None
    return Powers(tuple(differences)) if agree else None


class _Trial:
    """The series of a step from one state and time, and those of the solution."""

    def __init__(self, candidate: Candidate, scene: Scene, y: np.ndarray, t: float) -> None:
        self._plain, self._y, self._t = Lanes(candidate, scene), y, t
        self._numbers = Expansions(LEAST)
        state = np.array([self._numbers.constant(value) for value in y], dtype=object)
        field = candidate.field(scene)
        field.limit = CALLS
        found = candidate.step(field, state, self._numbers.step(), self._numbers.constant(t))
        parts = np.array(found, dtype=object)
        if parts.shape != state.shape or not all(isinstance(part, Expansion) for part in parts):
            raise MisuseError(f"{candidate.name} does not return series for series.")
        self._parts = list(parts)
        start = [mp.mpf(float(value)) for value in (*y, t)]
        self._solution = jet(MPMATH, lambda m, s: (*scene.rates(m, s[-1], s[:-1]), mp.mpf(1)), start, MOST)

    def term(self, k: int) -> list[Any]:
        """The k-th term of each component.

        Raises:
            MisuseError: one is not real.
        """
        self._numbers.known(k)
        found = [part.series.term(k) for part in self._parts]
        if not all(isinstance(value, (int, mp.mpf)) for value in found):
            raise MisuseError("a term of the step's series is not real.")
        return found

    def gap(self, k: int) -> list[Any]:
        """The k-th terms less those of the solution."""
        return [own - true for own, true in zip(self.term(k), self._solution[k - 1], strict=False)]

    def agrees(self, h: float, length: int) -> bool:
        """Whether the sum of the series is the step, where it converges fast."""
        tails = [(k, max(abs(float(value)) for value in self.term(k))) for k in (length - 1, length)]
        h = min([h / REACH, *((TAIL / size) ** (1 / k) for k, size in tails if size)])
        terms = [[float(value * mp.mpf(h) ** k) for value in self.term(k)] for k in range(length, -1, -1)]
        plain = self._plain.one(self._y, h, self._t)
        return bool(np.all(np.abs(plain - np.sum(terms, axis=0)) <= AGREEMENT * (1 + np.abs(plain))))


def _differences(trials: Sequence[_Trial], unit: float, size: np.ndarray) -> list[float]:
    """Of each term, up to one that is clearly not the solution's."""
    found: list[float] = []
    for k in range(1, MOST + 1):
        gaps = np.array([[float(value) for value in trial.gap(k)] for trial in trials])
        found.append(float(np.max(np.abs(gaps) / size)) * unit**k)
        if k >= LEAST and max(found) >= CLEAR:
            break
    return found
