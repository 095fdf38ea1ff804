"""What a study found: frozen records, which tables and plots show and nothing else does."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

__all__ = ["Cell", "Drift", "FittedOrder", "Study", "Trace"]


@dataclass(frozen=True)
class Cell:
    """The error of one method at one number of steps.

    Attributes:
        method: the method's name.
        n: number of steps.
        h: step size in s, as the double that the march used.
        theta0: amplitude in rad.
        max_error: largest |theta - exact| over the sample times, in rad.
        end_error: |theta - exact| at the last sample time, in rad.
        local_order: log2-slope of max_error from the previous N of the same method and amplitude, or None.
        floor: True where the cell is rounding, not order: within ten times the rounding floor.
        evaluations: evaluations of the right-hand side (or force) over the march.
    """

    method: str
    n: int
    h: float
    theta0: float
    max_error: float
    end_error: float
    local_order: float | None
    floor: bool
    evaluations: int


@dataclass(frozen=True)
class FittedOrder:
    """One slope of log(max_error) against log(h) over the asymptotic range; None where it has fewer than three cells.

    Attributes:
        n_range: the smallest and largest N used, or None.
        spread: the largest distance of a local slope in the range from the fitted one, or None.
    """

    method: str
    theta0: float
    declared_order: int
    fitted_order: float | None
    spread: float | None
    cells_used: int
    n_range: tuple[int, int] | None


@dataclass(frozen=True)
class Drift:
    """The energy drift of one method at one number of steps.

    Attributes:
        max_drift_above_rest: max over every step of |E - E0| / (E0 - Emin).
        max_drift_relative: max over every step of |E - E0| / |E0|.
        slope_per_period: least-squares slope of (E - E0)/(E0 - Emin) over the sample times, per period.
        slope_interval: half-width of its 95 % interval.
    """

    method: str
    n: int
    h: float
    theta0: float
    max_drift_above_rest: float
    max_drift_relative: float
    slope_per_period: float
    slope_interval: float


@dataclass(frozen=True)
class Trace:
    """A trajectory for plotting: arrays of length S, at one method, N and amplitude.

    Attributes:
        time: sample times in s.
        theta: angle in rad.
        omega: angular velocity in rad/s.
        drift: (E - E0)/(E0 - Emin).
    """

    method: str
    n: int
    theta0: float
    time: Any
    theta: Any
    omega: Any
    drift: Any


@dataclass(frozen=True)
class Study:
    """Everything a table or plot needs.

    Attributes:
        problem: name of the problem, such as "pendulum".
        parameters: its parameters and the study's, such as {"theta0": [1.0], "g": 9.81, "length": 1.0, "t_end": 10.0}.
        reference: where the truth comes from: routes, version, and what was compared.
        engine: how the numbers were marched: precision, compiler, what a rounding floor belongs to.
    """

    problem: str
    parameters: dict[str, Any]
    reference: dict[str, Any]
    engine: dict[str, Any]
    error_vs_n: tuple[Cell, ...]
    order: tuple[FittedOrder, ...]
    energy_drift: tuple[Drift, ...]
    traces: tuple[Trace, ...] = field(default=(), repr=False)
    exact: tuple[Trace, ...] = field(default=(), repr=False)
