"""What a study of solvers found: frozen records, which tables and plots show and nothing else does."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from compare.measure.records import OfCase

if TYPE_CHECKING:
    from compare.measure.records import Case

__all__ = ["EventCell", "SolverCell", "SolverEntry", "SolverStudy"]


@dataclass(frozen=True)
class SolverEntry:
    """A solver of the study, whether it is here or not.

    Attributes:
        version: of its package; None where it is missing.
        install: the command that installs it.
        call: the call in one line.
        dial: what its tolerance is called, or what stands in its place.
        counts: what its evaluations are.
        tolerance: what its tolerance bounds.
    """

    solver: str
    package: str
    version: str | None
    install: str
    call: str
    dial: str
    counts: str
    tolerance: str


@dataclass(frozen=True)
class SolverCell(OfCase):
    """One solver at one tolerance.

    Attributes:
        rtol: the tolerance that was asked for, relative and absolute.
        used: what the solver worked with, on its own dial; NaN where it failed.
        case: the problem.
        max_error: largest position error over the times, in the units of the state; NaN where it failed.
        end_error: the same at the last time.
        velocity_error: largest error of the velocity over the times, likewise; NaN where there is none.
        evaluations: what it took, in the solver's own count; None where it failed.
        seconds: the shortest of a few calls, without what is compiled before the first; None where it failed.
        failure: the solver's own message where it failed, or "".
        said: the solver's warnings.
        stopped: whether it failed because its work was bounded.
        suited: whether the problem has what the solver needs; one that lacks it was not asked.
    """

    solver: str
    rtol: float
    used: float
    case: Case
    max_error: float
    end_error: float
    velocity_error: float
    evaluations: int | None
    seconds: float | None
    failure: str
    said: str
    stopped: bool
    suited: bool

    @property
    def floor(self) -> bool:
        """A cell is never marked as rounding: a tolerance says nothing of the floor."""
        return False


@dataclass(frozen=True)
class EventCell(OfCase):
    """The events that one solver found at one tolerance, against the proven ones.

    Attributes:
        expected: how many it was to find: all of them, or one where it stops at the first.
        matched: how many of those it found.
        spurious: how many it found besides.
        max_error: largest |t - exact| over the matched ones; NaN where there are none.
        first_only: whether the solver stops at the first event.
        failure: the solver's own message where it failed, or "".
    """

    solver: str
    rtol: float
    case: Case
    expected: int
    matched: int
    spurious: int
    max_error: float
    first_only: bool
    failure: str


@dataclass(frozen=True)
class SolverStudy:
    """Everything a table or plot needs.

    Attributes:
        problem: name of the problem, such as "pendulum".
        parameters: its parameters and the study's.
        reference: where the truth comes from.
        engine: how the solvers were called.
        solvers: all that were asked for, missing ones included.
        cases: the problems.
        units: of the parameters that have some.
    """

    problem: str
    parameters: dict[str, Any]
    reference: dict[str, Any]
    engine: dict[str, Any]
    solvers: tuple[SolverEntry, ...]
    error_vs_rtol: tuple[SolverCell, ...]
    events: tuple[EventCell, ...]
    cases: tuple[Case, ...] = ()
    units: dict[str, str] = field(default_factory=dict, repr=False)

    @property
    def scored(self) -> bool:
        """Whether any solver gave states that could be scored."""
        return any(not cell.failure for cell in self.error_vs_rtol)
