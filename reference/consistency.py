"""A problem held against itself: its declarations agree, and its solution solves its equation.

What a user's problem says of itself is taken at its word nowhere: a closed form that is off by a factor would be proven
to every digit, and an energy that is none would be charged to the methods.
"""

from __future__ import annotations

import math
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from reference.arithmetic.namespaces import NUMPY
from reference.problem import NO_TIME

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.problem import Problem

__all__ = ["consistent", "examine"]

TIMES = (Fraction(1, 4), Fraction(5, 8), Fraction(1))
"""Of some time, at which a motion is looked at."""
LOOKED_AT = 4
"""Of a motion without a period it is so many turns or e-foldings of its start."""
LIMBS = 3
STEP = Fraction(1, 1 << 26)
"""Of that time, over which a difference is taken: of two proven states, it loses nothing."""
SOON = Fraction(1, 1 << 200)
"""Of that time, after which a motion is still at its start, also where that is singular."""
WITHIN = 1e-9
"""Within such parts of their size a state is the start, a difference a rate, and what is conserved what it was."""


@lru_cache(maxsize=1024)
def consistent(problem: Problem) -> None:
    """Refuse a problem of a user's whose declarations contradict each other, or its own motion, as ``examine`` does.

    The tests examine those of this package.
    """
    if not type(problem).__module__.startswith("reference."):
        examine(problem)


def examine(problem: Problem) -> None:
    """Hold the declarations of a problem against each other, and its motion, at a few times, against them.

    Raises:
        ValueError: they contradict; the sentence names the declaration.
    """
    _declarations(problem)
    _motion(problem)


def _declarations(problem: Problem) -> None:
    space, row = problem.space, problem.row("state")
    names = tuple(quantity.name for quantity in row.quantities)
    start, trial = problem.start, problem.trial
    _hold(problem, len(names) == len(space.components), f"the state row has {len(names)} quantities")
    _hold(problem, len(start) == len(space.components), f"start has {len(start)} numbers")
    _hold(problem, all(isinstance(value, (int, Fraction)) for value in start), "start is not of exact numbers")
    _hold(problem, len(trial.states) == len(space.components), f"trial has {len(trial.states)} intervals of states")
    lacking = sorted(set(problem.parameters) - set(trial.parameters))
    _hold(problem, not lacking, f"trial has no interval of the parameter {', '.join(lacking)}")
    if space.scale == "units":
        units = {row.quantities[place].units for place in space.places(space.positions)}
        _hold(problem, len(units) == 1, f"scale is 'units', and positions are in {' and in '.join(sorted(units))}")
    for one in problem.invariants:
        _hold(problem, callable(getattr(problem, one.value, None)), f"there is no method {one.value} of {one.name}")


def _hold(problem: Problem, holds: bool, fault: str) -> None:
    if not holds:
        components = ", ".join(problem.space.components)
        raise ValueError(f"{problem.name}: {fault}; the components of its state are {components}.")


def _motion(problem: Problem) -> None:
    """Hold the solution against the equation, the start and the invariants."""
    period = problem.cycle()
    span = period if math.isfinite(period) else LOOKED_AT / (problem.rate() or 1.0)
    while not _reaches(problem, Fraction(span) * (1 + STEP)):
        span /= 2
    p, h = problem.parameters_in(NUMPY), Fraction(span) * STEP
    at_start: Sequence[Any] = problem.start_in(NUMPY)
    soon, later = (_state(problem, Fraction(span) * part) for part in (SOON, TIMES[0]))
    for start, value, moved in zip(problem.start, soon, later, strict=True):
        if abs(value - start) > WITHIN * (abs(start) + abs(moved)):
            raise ValueError(f"the solution of {problem!r} does not begin at its start.")
    for part in TIMES:
        t = Fraction(span) * part
        before, here, after = (_state(problem, moment) for moment in (t - h, t, t + h))
        y = [float(value) for value in here]
        rates = problem.derivative(NUMPY, NO_TIME if problem.autonomous else float(t), y, p)
        for name, rate, low, high in zip(problem.state_names, rates, before, after, strict=True):
            slope = float((high - low) / (2 * h))
            if abs(slope - float(rate)) > WITHIN * (abs(slope) + abs(float(rate)) + max(map(abs, y)) / span):
                raise ValueError(
                    f"the solution of {problem!r} does not solve its equation: at t = {float(t):.6g} the slope of "
                    f"{name} is {slope:.6g}, and the equation says {float(rate):.6g}."
                )
        for one in problem.invariants:
            initial, now = (float(getattr(problem, one.value)(NUMPY, state, p)) for state in (at_start, y))
            if abs(now - initial) > WITHIN * (abs(now) + abs(initial) + 1e-3):
                raise ValueError(
                    f"{one.name} of {problem!r} is not conserved: it is {initial:.6g} at the start and {now:.6g} at "
                    f"t = {float(t):.6g}."
                )


def _state(problem: Problem, t: Fraction) -> list[Fraction]:
    """The proven state, to thrice the digits of a double."""
    proven = (problem.certified("state", t, place) for place in range(len(problem.state_names)))
    return [sum(map(Fraction, one.limbs(LIMBS)), Fraction(0)) for one in proven]


def _reaches(problem: Problem, t: Fraction) -> bool:
    """Whether the motion has not ended at a time."""
    row = problem.row("state")
    return problem.domain(row).contains(t)
