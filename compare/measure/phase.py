"""The error as one of phase and one of amplitude: each state seen as a point of an exact orbit.

The energy of a state gives the orbit that it is on, and so an amplitude; where it is on that orbit is its phase.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from compare.measure.records import Phase

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.measure.result import Run

__all__ = ["phases"]


def phases(runs: Sequence[Run]) -> list[Phase]:
    """A record for each run whose problem has orbits that are known."""
    return [_phase(run) for run in runs if run.orbital_known]


def _phase(run: Run) -> Phase:
    phase, amplitude = run.orbital.T
    return Phase(
        method=run.method.name,
        n=run.course.n,
        h=float(run.course.h),
        case=run.course.case,
        max_phase_error=_largest(phase),
        end_phase_error=float(phase[-1]),
        max_amplitude_error=_largest(amplitude),
        end_amplitude_error=float(amplitude[-1]),
        lost=int(np.count_nonzero(~np.isfinite(phase))),
        phase_rounding=run.phase_rounding,
        amplitude_rounding=run.amplitude_rounding,
    )


def _largest(errors: np.ndarray) -> float:
    """The largest size of those that are known; NaN if none is."""
    known = np.abs(errors[np.isfinite(errors)])
    return float(np.max(known)) if known.size else math.nan
