"""What a study found: frozen records, which tables and plots show and nothing else does.

Each record carries its case: the problem in a few words.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from reference.declaration import ENERGY_ABOVE_REST

if TYPE_CHECKING:
    from reference.declaration import Invariant

__all__ = [
    "FLOOR_FACTOR",
    "AdaptiveCell",
    "Case",
    "Cell",
    "Defect",
    "Drift",
    "FittedOrder",
    "Growth",
    "OfCase",
    "OwnPeriod",
    "Phase",
    "Study",
    "Trace",
]


@dataclass(frozen=True)
class Case:
    """A problem of a study in a few words.

    Attributes:
        problem: the problem, as Python would make it.
        inputs: what tells it from others of its family, by name, such as (("theta0", 1.0),).
        label: the same in words, such as "theta0 = 1.0 rad".
        error: what a position error is.
        unit: its unit; "" where it is relative to the largest value of the place.
        samples: what the states are compared at: "times" or "points".
        step: the unit of the step size; "" for a number.
        invariants: what is conserved.
        energy: whether the first is an energy that has a value of its own beside that above rest.
        cycle: what the slope of the drift is per: "period", or a unit of time where there is none.
        axes: what the axes of a phase portrait are called; () where there is no velocity.
        pair: where the first position and its rate stand in the state; () where there is no velocity.
        absolute: the position error in the units of the state, with those where they are all the same.
        events: what the proven events are called.
        freedom: the degrees of freedom: how many positions have a rate.
        lacks: the scores that need what the problem has not, and why.
    """

    problem: str
    inputs: tuple[tuple[str, Any], ...]
    label: str
    error: str = "|theta - exact|"
    unit: str = "rad"
    samples: str = "times"
    step: str = "s"
    invariants: tuple[Invariant, ...] = (ENERGY_ABOVE_REST,)
    energy: bool = True
    cycle: str = "period"
    axes: tuple[str, ...] = ("angle θ [rad]", "angular velocity ω [rad/s]")
    pair: tuple[int, ...] = (0, 1)
    absolute: str = "|theta - exact|, in rad"
    events: str = "passages through the bottom"
    freedom: int = 1
    lacks: tuple[tuple[str, str], ...] = ()


class OfCase:
    """A record of one case, whose inputs can be read as attributes: ``cell.theta0``."""

    case: Case

    def __getattr__(self, name: str) -> Any:
        """An input of the case.

        Raises:
            AttributeError: it has none of this name.
        """
        if name != "case" and not name.startswith("__"):
            for known, value in self.case.inputs:
                if known == name:
                    return value
        raise AttributeError(f"{type(self).__name__} has no attribute {name!r}")


FLOOR_FACTOR = 2
"""A number within this factor of the bound on what rounding made of it is rounding, which is mostly an eighth of it."""


@dataclass(frozen=True)
class Cell(OfCase):
    """The error of one method at one number of steps.

    Position errors are in the case's unit; those of the velocity likewise, per second, or relative to its largest
    value.  NaN where the case has no velocity.

    Attributes:
        method: the method's name.
        n: number of steps.
        h: step size in s, or in the case's own unit, as the double that the march used.
        case: the problem.
        max_error: largest position error over the samples.
        end_error: its error at the last sample.
        local_order: log2-slope of max_error from the previous N of the same method and case, or None.
        floor: True where the cell is rounding, not order: which may have made half of the error or more.
        evaluations: evaluations of the right-hand side (or force) over the march.
        rms_error: root mean square over the samples of the position error.
        max_velocity_error: largest error of the velocity over the samples.
        end_velocity_error: its error at the last sample.
        rms_velocity_error: root mean square over the samples of the error of the velocity.
        digits: correct digits: -log10 of max_error over the largest value of the place, at most what the format holds.
        jacobians: evaluations of the Jacobian, or of the invariant's gradient, over the march.
        rounding: a bound on rounding's part of the position errors; what it may change is not printed.
        velocity_rounding: the same of the errors of the velocity.
        order_rounding: the same of the local order.
    """

    method: str
    n: int
    h: float
    case: Case
    max_error: float
    end_error: float
    local_order: float | None
    floor: bool
    evaluations: int
    rms_error: float
    max_velocity_error: float
    end_velocity_error: float
    rms_velocity_error: float
    digits: float
    jacobians: int
    rounding: float = 0.0
    velocity_rounding: float = 0.0
    order_rounding: float = 0.0


@dataclass(frozen=True)
class AdaptiveCell(OfCase):
    """The error of one embedded pair with one controller of its step at one tolerance.

    Errors are those of a Cell, at 128 times evenly over the march.

    Attributes:
        method: the pair's name.
        controller: that of its step size.
        rtol, atol: the tolerances that were asked for: atol + rtol |y| of each component in a step.
        case: the problem.
        max_error: largest position error over the samples; NaN where the march is lost.
        end_error: its error at the last sample.
        rms_error: root mean square over the samples of the position error.
        max_velocity_error: largest error of the velocity over the samples.
        digits: correct digits, as of a Cell.
        evaluations: evaluations of the right-hand side (or force), those of rejected attempts and of the choice of the
            first step among them.
        jacobians: evaluations of the Jacobian.
        accepted, rejected: attempts at a step.
        floor: True where rounding may have made half of the error or more.
        failure: why the march is lost, or "".
        seconds: of its loop over the attempts; of the loop of all that were marched together where it was not alone.
        rounding: a bound on rounding's part of the position errors.
    """

    method: str
    controller: str
    rtol: float
    atol: float
    case: Case
    max_error: float
    end_error: float
    rms_error: float
    max_velocity_error: float
    digits: float
    evaluations: int
    jacobians: int
    accepted: int
    rejected: int
    floor: bool
    failure: str
    seconds: float
    rounding: float = 0.0

    @property
    def name(self) -> str:
        """The pair and its controller in a few words."""
        return f"{self.method}, {self.controller}"


@dataclass(frozen=True)
class FittedOrder(OfCase):
    """One slope of log(max_error) against log(h) over the asymptotic range; None where it has fewer than three cells.

    Attributes:
        n_range: the smallest and largest N used, or None.
        spread: the largest distance from the fitted one of a local slope in the range, or None; of those that are clear
            of rounding where there are two.
        rounding: a bound on rounding's part of the fitted order.
        spread_rounding: the same of the spread.
    """

    method: str
    case: Case
    declared_order: int
    fitted_order: float | None
    spread: float | None
    cells_used: int
    n_range: tuple[int, int] | None
    rounding: float = 0.0
    spread_rounding: float = 0.0


@dataclass(frozen=True)
class Drift(OfCase):
    """The drift of one invariant, such as the energy, of one method at one number of steps.

    Attributes:
        invariant: its name.
        max_drift_above_rest: max over every step of |E - E0| over the invariant's scale: for an energy E0 - Emin.
        max_drift_relative: max over every step of |E - E0| / |E0|.
        slope_per_period: least-squares slope of (E - E0)/(E0 - Emin) over the sample times, per period, or per unit of
            time where the motion has no period: the case says which.
        slope_interval: half-width of its 95 % interval.
        rounding: a bound on rounding's part of max_drift_above_rest.
        slope_rounding: the same of slope_per_period.
        relative_rounding: the same of max_drift_relative.
    """

    method: str
    n: int
    h: float
    case: Case
    invariant: str
    max_drift_above_rest: float
    max_drift_relative: float
    slope_per_period: float
    slope_interval: float
    rounding: float = 0.0
    slope_rounding: float = 0.0
    relative_rounding: float = 0.0


@dataclass(frozen=True)
class Phase(OfCase):
    """The error of one method at one number of steps as one of phase and one of amplitude.

    Attributes:
        max_phase_error: largest |phase - exact| over the samples, in rad, whole turns counted; 2 pi a period.
        end_phase_error: phase - exact at the last sample, in rad: positive where the march is ahead.
        max_amplitude_error: largest |amplitude - exact| over the samples, in the place's units; NaN where it has none.
        end_amplitude_error: amplitude - exact at the last sample.
        lost: samples whose state is on no orbit of the exact motion's kind, and has no phase.
        phase_rounding: a bound on rounding's part of max_phase_error.
        amplitude_rounding: the same of max_amplitude_error.
    """

    method: str
    n: int
    h: float
    case: Case
    max_phase_error: float
    end_phase_error: float
    max_amplitude_error: float
    end_amplitude_error: float
    lost: int
    phase_rounding: float = 0.0
    amplitude_rounding: float = 0.0


@dataclass(frozen=True)
class Growth(OfCase):
    """How one error of one method at one number of steps grows: as t to the power of the exponent.

    Attributes:
        quantity: "place", "phase" or the name of an invariant, such as "energy".
        exponent: of t; NaN where the march has too few periods or an error is not a number.
        interval: half-width of its 95 % interval.
        law: "bounded", "sqrt t", "t", "t^3/2" or "t^2"; "" where none is clear.
        windows: the windows of time that were used, each twice as long as the one before it.
        starts: the marches that it is the mean of: several where the error is rounding.
        floor: whether the error is rounding.
        rounding: a bound on rounding's part of the exponent; 0 where the error is rounding, whose exponent it is.
    """

    method: str
    n: int
    h: float
    case: Case
    quantity: str
    exponent: float
    interval: float
    law: str
    windows: int
    starts: int
    floor: bool
    rounding: float = 0.0


@dataclass(frozen=True)
class OwnPeriod(OfCase):
    """The period of one method's own motion at one step size, from one passage through the bottom to the next.

    Attributes:
        period: in the units of time; NaN where two passages were not found.
        relative_error: period/exact - 1.
        rounding: a bound on rounding's part of it.
    """

    method: str
    n: int
    h: float
    case: Case
    period: float
    relative_error: float
    rounding: float = 0.0


@dataclass(frozen=True)
class Defect(OfCase):
    """What one method at one step size keeps of the geometry of the exact motion.

    Attributes:
        symplecticity: how far a step is from keeping the symplectic form, at states of the exact motion: with one
            degree of freedom |det d(y_{n+1})/d(y_n) - 1| in position and momentum; NaN for a method that carries more
            than the state from step to step, or a problem without momenta.
        reversibility: the distance from the start after n steps forward, the velocity turned round, and n steps back,
            each component over its largest value.
        symplecticity_rounding, reversibility_rounding: bounds on rounding's part of each.
    """

    method: str
    n: int
    h: float
    case: Case
    symplecticity: float
    reversibility: float
    symplecticity_rounding: float = 0.0
    reversibility_rounding: float = 0.0


@dataclass(frozen=True)
class Trace(OfCase):
    """A trajectory for plotting: arrays of length S, at one method, N and case.

    Attributes:
        time: sample times in s, or in the case's own unit.
        states: [S, state].
        drifts: the drift of each invariant over its scale: [invariants, S].
    """

    method: str
    n: int
    case: Case
    time: Any
    states: Any
    drifts: Any


@dataclass(frozen=True)
class Study:
    """Everything a table or plot needs.

    Attributes:
        problem: name of the problem, such as "pendulum".
        parameters: its parameters and the study's, such as {"theta0": [1.0], "g": 9.81, "length": 1.0, "t_end": 10.0}.
        reference: where the truth comes from: routes, version, and what was compared.
        engine: how the numbers were marched: precision, compiler, what a rounding floor belongs to.
        cases: the problems.
        scores: what is to be shown, of ``compare.measure.wanted.SCORES``.
        units: of the parameters that have some.
        phase, growth, period, defects, adaptive: None where they were not asked for.
    """

    problem: str
    parameters: dict[str, Any]
    reference: dict[str, Any]
    engine: dict[str, Any]
    cases: tuple[Case, ...]
    error_vs_n: tuple[Cell, ...]
    order: tuple[FittedOrder, ...]
    energy_drift: tuple[Drift, ...]
    scores: tuple[str, ...] = ("error", "drift")
    phase: tuple[Phase, ...] | None = None
    growth: tuple[Growth, ...] | None = None
    period: tuple[OwnPeriod, ...] | None = None
    defects: tuple[Defect, ...] | None = None
    adaptive: tuple[AdaptiveCell, ...] | None = None
    units: dict[str, str] = field(default_factory=dict, repr=False)
    traces: tuple[Trace, ...] = field(default=(), repr=False)
    exact: tuple[Trace, ...] = field(default=(), repr=False)
