"""What a report found: frozen records, which tables, figures and the page show and nothing else does."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

__all__ = ["Report", "WorkPoint"]


@dataclass(frozen=True)
class WorkPoint:
    """What one method or solver made of one problem, at one number of steps or tolerance.

    Attributes:
        family: of problems.
        amplitude: the number, in the family's units, or the name that tells the problem from others of its family.
        name: of the method or solver; of a pair with a controlled step with that of the controller.
        kind: "method", which takes a number of steps, or "adaptive" or "solver", which take a tolerance.
        setting: the number of steps, or the tolerance.
        max_error: the largest position error over the samples, in the family's units of errors; NaN where there is
            none.
        floor: whether the error is rounding rather than truncation.
        evaluations: what it took, in its own count; None where it failed.
        seconds: of the march or the call by itself; None where it failed.
        failure: what went wrong, or "".
    """

    family: str
    amplitude: float | str
    name: str
    kind: str
    setting: float
    max_error: float
    floor: bool
    evaluations: int | None
    seconds: float | None
    failure: str


@dataclass(frozen=True)
class Report:
    """Everything the page needs.

    Attributes:
        problem: what the files are called.
        parameters: what was asked for.
        units: of the parameters that have some.
        reference: where the truth comes from.
        engine: how the work was counted and clocked.
        points: in order of family, amplitude, method or solver, setting.
        missing: packages of solvers that are not here, with what installs them.
        left_out: methods and solvers by the problem that does not have what they need, such as momenta.
        counts: what the evaluations of a solver are, where they are no calls of the right-hand side.
    """

    problem: str
    parameters: dict[str, Any]
    units: dict[str, str]
    reference: dict[str, Any]
    engine: dict[str, Any]
    points: tuple[WorkPoint, ...]
    missing: dict[str, str]
    left_out: dict[str, list[str]]
    counts: dict[str, str]
