"""How the state of each family of problems is read: places and their rates, the units of an error, the period.

Families are known by their names, so that none is imported to march another.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from reference.problem import Problem

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["Aspect", "Trial", "aspect_of", "conserves", "period_of"]

Interval = tuple[float, float]


@dataclass(frozen=True)
class Trial:
    """Where a compiled step is tried: intervals of states, parameters and step sizes in which the equation is real.

    A block takes many steps from there, and must stay where it is.
    """

    states: tuple[Interval, ...] = ()
    parameters: Mapping[str, Interval] = field(default_factory=dict)
    step: Interval = (0.01, 0.1)

    def state(self, component: int) -> Interval:
        """The interval of a component of the state."""
        return self.states[component] if self.states else (-3.0, 3.0)

    def parameter(self, name: str) -> Interval:
        """The interval of a parameter."""
        return self.parameters.get(name, (0.5, 2.0))


@dataclass(frozen=True)
class Aspect:
    """How a family's state is read.

    Attributes:
        places: the components whose error is the error of the place.
        rates: their rates, whose error is told besides.
        angle: the unit in which errors of the place are left as they are; "" where each component is measured by its
            own largest value.
        odd: the components that change their sign with that of time; None where turning back means nothing.
        along: the component that the others are a function of, which is marched with them and rounded too; None where
            the time stands outside of the state.
        invariant: what the conserved quantity is called in the title of a table, and its change in units of itself.
        trial: where a compiled step is tried.
    """

    places: tuple[int, ...] = (0,)
    rates: tuple[int, ...] = (1,)
    angle: str = ""
    odd: tuple[int, ...] | None = (1,)
    along: int | None = None
    invariant: tuple[str, str] = ("Energy", "(E - E0)/(E0 - Emin)")
    trial: Trial = Trial()


_CENTRAL = Aspect(
    places=(0, 2),
    odd=(1, 2),
    invariant=("Invariant", "(I - I0)/I0"),
    trial=Trial(states=((0.5, 0.9), (-0.5, 0.5), (-1.0, 1.0)), step=(0.001, 0.01)),
)
_ASPECTS = {
    "pendulum": Aspect(angle="rad"),
    "linear pendulum": Aspect(angle="rad"),
    "tautochrone": Aspect(trial=Trial(states=((-2.0, 2.0), (-1.0, 1.0)), step=(0.001, 0.01))),
    "descent": Aspect(trial=Trial(states=((0.2, 0.5), (0.0, 0.5)), step=(0.001, 0.005))),
    "polar": _CENTRAL,
    "tunnel": _CENTRAL,
    "cycloid arc": Aspect(
        rates=(), odd=None, along=1, trial=Trial(states=((-3.0, 3.0), (0.1, 0.6)), step=(0.001, 0.005))
    ),
    "polar curve in z": Aspect(
        rates=(), odd=None, along=1, trial=Trial(((-3.0, 3.0), (0.1, 0.2)), {"z0": (0.2, 0.4)}, step=(0.001, 0.002))
    ),
    "polar curve in psi": Aspect(
        places=(0, 1),
        rates=(),
        odd=None,
        along=2,
        trial=Trial(((-3.0, 3.0), (-3.0, 3.0), (0.5, 6.0)), {"z0": (0.2, 0.8)}),
    ),
}


def aspect_of(problem: Problem) -> Aspect:
    """How the problem's state is read; one component and its rate where the family is not known."""
    return _ASPECTS.get(problem.name, Aspect())


def conserves(problem: Problem) -> bool:
    """Whether the problem has a conserved quantity."""
    return type(problem).invariant is not Problem.invariant


def period_of(problem: Problem) -> float:
    """The period of the motion in its own unit of time; NaN where it has none."""
    if problem.serves("period"):
        return float(problem.certified("period"))
    if problem.name in {"polar", "tunnel"}:
        return 2 * float(problem.certified("descent_time"))
    if problem.name == "cycloid":
        return 2 * math.pi / problem.rate()
    return math.nan
