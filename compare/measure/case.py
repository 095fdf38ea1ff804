"""A problem of a study in a few words, as its records carry it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

__all__ = ["Case", "OfCase"]


@dataclass(frozen=True)
class Case:
    """A problem of a study in a few words.

    Attributes:
        problem: the problem, as Python would make it.
        inputs: what tells it from others of its family, by name, such as (("theta0", 1.0),).
        label: the same in words, such as "theta0 = 1.0 rad".
        error: what an error of the place is.
        unit: its unit; "" where it is relative to the largest value of the place.
        samples: what the states are compared at: "times" or "points".
        step: the unit of the step size; "" for a number.
        drift: what the conserved quantity is called and its change, or None where there is none.
        energy: whether it is an energy that has a value of its own beside that above rest.
        cycle: what the slope of the drift is per: "period", or a unit of time where there is none.
        axes: what the axes of a phase portrait are called; () where there is no velocity.
    """

    problem: str
    inputs: tuple[tuple[str, Any], ...]
    label: str
    error: str = "|theta - exact|"
    unit: str = "rad"
    samples: str = "times"
    step: str = "s"
    drift: tuple[str, str] | None = ("Energy", "(E - E0)/(E0 - Emin)")
    energy: bool = True
    cycle: str = "period"
    axes: tuple[str, ...] = ("angle θ [rad]", "angular velocity ω [rad/s]")


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
