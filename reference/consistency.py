"""A problem held against itself: its declarations agree, and its solution solves its equation.

What a user's problem says of itself is taken at its word nowhere: a closed form that is off by a factor would be proven
to every digit, and an energy that is none would be charged to the methods.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from reference.arithmetic.namespaces import MPMATH, NUMPY
from reference.arithmetic.precision import mp
from reference.problem import NO_TIME, UndeclaredError

if TYPE_CHECKING:
    from reference.problem import Problem

__all__ = ["consistent", "examine"]

TIMES = (Fraction(1, 4), Fraction(5, 8), Fraction(1))
"""Of some time, at which a motion is looked at."""
LOOKED_AT = 4
"""Of a motion without a period it is so many turns or e-foldings of its start."""
WHERE = 0.618
"""Of each interval of the trial, the equation is read once: not in its middle, where symmetry may be."""
LIMBS, BITS = 4, 212
STEP = Fraction(1, 1 << 20)
"""Of that time, about which a slope is taken."""
STENCIL = tuple(Fraction(*c) for c in ((5, 6), (-5, 21), (5, 84), (-5, 504), (1, 1260)))
"""f'(x) = sum_k c_k (f(x + k h) - f(x - k h))/h, k = 1 ... 5, to order 10 (B. Fornberg, Math. Comp. 51, 1988, 699)."""
PAIRS = len(STENCIL)
SOON, BEGUN = Fraction(1, 1 << 200), 1e-9
"""Of that time, after which a motion is still at its start, also where that is singular; and within what part of it."""
WITHIN = 1e-24
"""Within such parts of their size a slope is what the equation says, and what is conserved is what it was."""
LEAST_SEEN, SEEN_A_TURN, MOST_SEEN, LEAP = 64, 16, 1024, 0.1
"""At so many times leaps are looked for, in a turn or an e-folding; and what is one, in parts of the largest value."""


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
    _hold(problem, names == space.components, f"the state row has {', '.join(names)}")
    later = [one.name for one in problem.invariants[1:]]
    _hold(problem, "energy" not in later, "its energy is not the first of its invariants")
    for one in problem.invariants:
        _hold(problem, callable(getattr(problem, one.value, None)), f"there is no method {one.value} of {one.name}")
    with mp.workprec(BITS):
        _rates(problem, Fraction(0), [mp.mpf(low + WHERE * (high - low)) for low, high in trial.states])


def _hold(problem: Problem, holds: bool, fault: str) -> None:
    if not holds:
        components = ", ".join(problem.space.components)
        raise ValueError(f"{problem.name}: {fault}; the components of its state are {components}.")


def _motion(problem: Problem) -> None:
    """Hold the solution against the start, the equation, the invariants and the reversor."""
    period = problem.cycle()
    span = Fraction(period if math.isfinite(period) else LOOKED_AT / (problem.rate() or 1.0))
    while not _reaches(problem, span * (1 + PAIRS * STEP)):
        span /= 2
    with mp.workprec(BITS):
        seen = [_Seen.at(problem, span * part, span * STEP) for part in TIMES]
        start = [MPMATH.number(value) for value in map(Fraction, problem.start)]
        sizes = [max(abs(one.y[i]) for one in seen) for i in range(len(start))]
        for here, value, size in zip(_state(problem, span * SOON), start, sizes, strict=True):
            if abs(here - value) > BEGUN * (abs(value) + size):
                raise ValueError(f"the solution of {problem!r} does not begin at its start.")
        sizes = [max(size, abs(value)) for size, value in zip(sizes, start, strict=True)]
        for one in seen:
            one.hold(problem, start, sizes, span)
            if problem.space.odd is not None and problem.autonomous:
                one.turn(problem, sizes, span)
    _unbroken(problem, span)


@dataclass(frozen=True)
class _Seen:
    """The proven state at a time, its slope from states about it, and what the equation says."""

    t: Fraction
    y: list[Any]
    slopes: list[Any]
    rates: list[Any]

    @classmethod
    def at(cls, problem: Problem, t: Fraction, h: Fraction) -> _Seen:
        pairs = [(_state(problem, t + k * h), _state(problem, t - k * h)) for k in range(1, PAIRS + 1)]
        step = MPMATH.number(h)
        weights = [MPMATH.number(c) / step for c in STENCIL]
        slopes = [
            mp.fsum(c * (up[i] - down[i]) for c, (up, down) in zip(weights, pairs, strict=True))
            for i in range(len(problem.start))
        ]
        y = _state(problem, t)
        return cls(t, y, slopes, _rates(problem, t, y))

    def hold(self, problem: Problem, start: list[Any], sizes: list[Any], span: Fraction) -> None:
        """Refuse a slope that is not the equation's, and an invariant that changes."""
        p, when = problem.parameters_in(MPMATH), f"at t = {float(self.t):.6g}"
        unit = mp.mpf(span.denominator) / span.numerator
        for name, slope, rate, size in zip(problem.state_names, self.slopes, self.rates, sizes, strict=True):
            if abs(slope - rate) > WITHIN * (abs(slope) + abs(rate) + size * unit):
                raise ValueError(
                    f"the solution of {problem!r} does not solve its equation: {when} the slope of {name} is "
                    f"{mp.nstr(slope, 30)}, and the equation says {mp.nstr(rate, 30)}."
                )
        for one in problem.invariants:
            initial, now = (getattr(problem, one.value)(MPMATH, state, p) for state in (start, self.y))
            if abs(now - initial) > WITHIN * (abs(now) + abs(initial) + 1):
                raise ValueError(
                    f"{one.name} of {problem!r} is not conserved: it is {mp.nstr(initial, 30)} at the start and "
                    f"{mp.nstr(now, 30)} {when}."
                )

    def turn(self, problem: Problem, sizes: list[Any], span: Fraction) -> None:
        """Refuse a reversor R that is none: f(R y) = -R f(y)."""
        odd, unit = problem.space.places(problem.space.odd or ()), mp.mpf(span.denominator) / span.numerator
        back = _rates(problem, self.t, [-value if i in odd else value for i, value in enumerate(self.y)])
        for i, rate in enumerate(self.rates):
            expected = rate if i in odd else -rate
            if abs(back[i] - expected) > WITHIN * (abs(rate) + sizes[i] * unit):
                raise ValueError(
                    f"{problem!r} does not turn back where {', '.join(problem.space.odd or ()) or 'nothing'} changes "
                    f"sign: at t = {float(self.t):.6g} the slope of {problem.state_names[i]} would then be "
                    f"{mp.nstr(expected, 12)}, and is {mp.nstr(back[i], 12)}."
                )


def _rates(problem: Problem, t: Fraction, y: list[Any]) -> list[Any]:
    """What the equation says of a state.

    Raises:
        ValueError: it asks for what there is not, or has not a slope for each component.
    """
    time = NO_TIME if problem.autonomous else MPMATH.number(t)
    try:
        found = list(problem.derivative(MPMATH, time, y, problem.parameters_in(MPMATH)))
    except KeyError as lacking:
        raise ValueError(f"the equation of {problem.name} asks for {lacking}; no parameter is called so.") from None
    except UndeclaredError:
        raise
    except AttributeError as lacking:
        raise ValueError(f"the equation of {problem.name} asks for '{lacking.name}'; no arithmetic has it.") from None
    _hold(problem, len(found) == len(y), f"derivative gives {len(found)} slopes")
    return [value if isinstance(value, mp.mpf) else mp.mpf(value) for value in found]


def _unbroken(problem: Problem, span: Fraction) -> None:
    """Refuse a solution that leaps: its slopes may be right on both sides.

    Over a short time a component moves by about the mean of its slopes at both ends.
    """
    from reference.arithmetic.arrays import np

    count = min(max(LEAST_SEEN, math.ceil(SEEN_A_TURN * problem.rate() * float(span))), MOST_SEEN)
    times = [span * k / count for k in range(1, count + 1)]
    states = problem.state(times)
    p: Any = problem.parameters_in(NUMPY)
    rates = np.array(
        [
            problem.derivative(NUMPY, NO_TIME if problem.autonomous else float(t), y, p)
            for t, y in zip(times, states.tolist(), strict=True)
        ]
    )
    moved, expected = np.diff(states, axis=0), (rates[1:] + rates[:-1]) / 2 * float(span / count)
    leaps = np.abs(moved - expected) > LEAP * (np.max(np.abs(states), axis=0) + np.abs(expected))
    if leaps.any():
        place, component = np.argwhere(leaps)[0]
        before, after = ((float(times[i]), float(states[i, component])) for i in (place, place + 1))
        raise ValueError(
            f"the solution of {problem!r} leaps: {problem.state_names[component]} is {before[1]:.6g} at "
            f"t = {before[0]:.6g} and {after[1]:.6g} at t = {after[0]:.6g}, and the equation moves it by "
            f"{expected[place, component]:.6g}."
        )


def _state(problem: Problem, t: Fraction) -> list[Any]:
    """The proven state, to BITS bits."""
    proven = (problem.certified("state", t, place) for place in range(len(problem.state_names)))
    return [mp.fsum(map(mp.mpf, one.limbs(LIMBS))) for one in proven]


def _reaches(problem: Problem, t: Fraction) -> bool:
    """Whether the motion has not ended at a time."""
    row = problem.row("state")
    return problem.domain(row).contains(t)
