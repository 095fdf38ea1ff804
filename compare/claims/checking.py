"""``compare.check``: is my integrator what it says it is?"""

from __future__ import annotations

import math
import time
from dataclasses import replace
from fractions import Fraction
from numbers import Real
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.claims.candidate import Candidate
from compare.claims.consistency import advance_of_a_constant_slope, iterates, uses
from compare.claims.defects import Evidence, reversibility, symplecticity
from compare.claims.energy import kept
from compare.claims.engine import Lanes, Steps, Traced, Whole, chosen
from compare.claims.findings import Claims
from compare.claims.frames import Exhausted, Frame, MisuseError, Scene
from compare.claims.half_step import half_step
from compare.claims.heading import UNTRIED, Heading, heading
from compare.claims.limits import SECONDS
from compare.claims.order import ladder, measured
from compare.claims.powers import lower, powers
from compare.claims.record import Check
from compare.methods.own.deadline import TimeOut, deadline
from compare.methods.own.forms import form_of
from compare.methods.own.hosting import repeatable
from reference.arithmetic.underflow import require_gradual
from reference.consistency import consistent
from reference.problem import Problem
from reference.problems.families import usual_problem

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from compare.claims.engine import Marcher
    from compare.claims.order import Order

__all__ = ["check"]

PURSUED = 0.25
"""Part of it within which an order that has not settled is pursued to finer steps."""
CALLS = 100_000
"""Calls of f that the marches of one scene may take, lane by lane."""
CALLS_ON_ARRAYS = 40_000
"""The same on arrays, where all lanes share a call."""
FRAME = 0.5, 0.7
"""Amplitude of the swinging frame in rad, or over the size of a motion, and its frequency over the motion's rate."""
MOST_STEPS = 4096
LEAST_STEPS = 48
LANES_OF_A_LADDER = 7
"""Steps of all marches of a ladder, from two starts, over those of its longest."""
TRIAL_TIMES = 9
MOST_ORDER = 100
ALMOST_TWO = 1.5
"""An order below this is one, and a claim from it on is of two or more."""


def check(
    step: Callable[..., Any],
    order: float | None = None,
    symplectic: bool | None = None,
    reversible: bool | None = None,
    backward: bool | None = None,
    conserves: bool | None = None,
    problem: Problem | None = None,
    form: str | None = None,
    seconds: float = SECONDS,
) -> Check:
    """Measure an integrator, and hold what it claims against what was measured.

    The step runs in the caller's process, so that it may be a lambda, a closure or compiled by JAX; what one does to
    the process cannot be contained there: ``os._exit``, a crash, closed files, a fork, memory, changed signal handlers,
    a loop in compiled code that no timer stops, or a KeyboardInterrupt of its own.  The command line runs it in a
    process that is ended.

    Args:
        step: ``step(f, y, h)`` gives the state a step later; ``step(f, t, y, h)`` if it takes the time;
            ``step(q, p, force, h)`` gives (q, p); ``integrate(f, y0, t)`` the states at the times of a grid.  ``f`` is
            called as f(y) or f(t, y), and gives an array of y's shape, components in the order of the problem's state.
        order: the order that is claimed, or None.
        symplectic: whether it is claimed to be symplectic.
        reversible: whether it is claimed to be reversible.
        backward: whether the order is claimed for negative steps too.
        conserves: whether it is claimed to keep every invariant that the problem declares, bounded or to rounding.
        problem: what it is tried on, any motion in time; the pendulum of 1 m released at 1 rad if None.
        form: "step", "timed", "separable" or "integrator", where the arguments' names do not say it.
        seconds: time after which the check is given up.

    Raises:
        TypeError: ``step`` cannot be called, or ``problem`` is no problem.
        ValueError: the step raises, gives no finite real state of the right shape, depends on more than its arguments,
            or takes too long; the order of an integrator is claimed that chooses its own steps; or the problem is a
            curve, does not split as a separable step needs it, or depends on a time that the step does not give.
    """
    require_gradual("a check")
    scene = Scene(usual_problem() if problem is None else _motion(problem))
    if order is not None and not _is_order(order):
        raise ValueError(f"order is {order!r}; a positive number below {MOST_ORDER} is accepted.")
    if backward and order is None:
        raise ValueError("an order for negative steps is claimed without an order; both are accepted.")
    candidate = Candidate(step, form_of(step, form), _name(step))
    candidate.hold(scene)
    try:
        with deadline(seconds):
            claims = Claims(None if order is None else float(order), symplectic, reversible, conserves, backward)
            return _checked(candidate, claims, scene, time.monotonic() + seconds * PURSUED)
    except Exhausted as error:
        raise MisuseError(f"{candidate.name} {error} in one step; it does not come to an end.") from None
    except TimeOut:
        raise MisuseError(
            f"{candidate.name} took more than {seconds:g} s; a step that returns is accepted, or a longer time."
        ) from None


def _motion(problem: Any) -> Problem:
    """A problem whose state at a time is proven.

    Raises:
        TypeError: it is no problem.
        ValueError: it is a curve, or has no such row.
    """
    if not isinstance(problem, Problem):
        raise TypeError(
            f"problem is {problem!r}; a problem with positions and momenta, such as Pendulum(1.0), is accepted."
        )
    accepted = "a motion in time, such as Pendulum(1.0), is accepted."
    if problem.space.along is not None:
        raise ValueError(f"problem is {problem!r}, a curve along {problem.space.along}; {accepted}")
    if not problem.serves("state") or problem.row("state").over in {"once", "index"}:
        raise ValueError(f"problem is {problem!r}, without a state at a time; {accepted}")
    consistent(problem)
    return problem


def _is_order(order: Any) -> bool:
    return type(order) is not bool and isinstance(order, Real) and 0 < float(order) < MOST_ORDER


def _name(step: Callable[..., Any]) -> str:
    return str(getattr(step, "__name__", type(step).__name__))


def _checked(candidate: Candidate, claims: Claims, scene: Scene, until: float) -> Check:
    h = scene.step
    marcher, calls, timed, name = _marcher(candidate, scene, h)
    counts = ladder(_most_steps(marcher, calls))
    still = measured(marcher, scene.span, counts, until)
    _hold_measurable(candidate.name, still, claims)
    swinging = None
    if timed:
        frame = Scene(scene.problem, Frame(FRAME[0], FRAME[1] * scene.pace, scene.units))
        swinging = measured(_marcher(candidate, frame, h)[0], scene.span, counts, until)
        series = lower(powers(candidate, scene, h), powers(candidate, frame, h))
    else:
        series = None if marcher.whole else powers(candidate, scene, h)
    iterating = iterates(candidate, marcher, h)
    energy, *others = kept(marcher, h, _most_steps(marcher, calls))
    evidence = Evidence(
        possible=name != "compiled" and still.kind != "own steps",
        iterates=iterating,
        bounded=energy.bounded,
    )
    explicit = not (marcher.whole or iterating)
    headed = _heading(candidate, marcher, h)
    back = _back(marcher, counts, until) if claims.backward and headed.backward == "right" else None
    found = Check(
        name=candidate.name,
        form=candidate.form.name,
        engine=name,
        problem=repr(scene.problem),
        claims=claims,
        still=still,
        swinging=swinging,
        symplecticity=symplecticity(marcher, h, evidence),
        reversibility=reversibility(marcher, h, evidence),
        energy=energy,
        others=tuple(others),
        heading=headed,
        back=back,
        powers=series,
        advance=advance_of_a_constant_slope(candidate, scene, h) if explicit else None,
    )
    return replace(found, hint=_hint(found, marcher, scene.span))


def _back(marcher: Marcher, counts: Sequence[int], until: float) -> Order | None:
    """The order with negative steps from the start; None where the motion is not known before it."""
    scene = marcher.scene
    domain = scene.problem.domain(scene.problem.row("state"))
    return measured(marcher, -scene.span, counts, until) if domain.contains(Fraction(-scene.span)) else None


def _hold_measurable(name: str, found: Order, claims: Claims) -> None:
    """Refuse an integrator of which an order that is claimed cannot be measured, or nothing can.

    Raises:
        MisuseError: its finest march is lost, or it chooses its own steps.
    """
    finest = found.cells[-1]
    if not math.isfinite(finest.error):
        some = any(math.isfinite(cell.error) for cell in found.cells)
        where = f"with steps of h = {finest.h:.3g}, though it does with longer ones"
        raise MisuseError(
            f"{name} gives no finite states {where if some else 'however short its steps are'}; finite ones are "
            "accepted."
        )
    if found.kind == "own steps" and claims.order is not None:
        raise MisuseError(
            f"{name} chooses its own steps: its error is {finest.error:.0e} whatever the spacing of t, so that its "
            "order cannot be measured; no order, or a step of fixed size, is accepted."
        )


def _heading(candidate: Candidate, marcher: Marcher, h: float) -> Heading:
    """Of a step; of a whole integrator only whether it makes use of f is known."""
    if marcher.whole:
        return replace(UNTRIED, uses=uses(candidate, marcher.scene, h))
    return heading(candidate, marcher.scene, h)


def _hint(found: Check, marcher: Marcher, t_end: float) -> str | None:
    """What would make one of order one the method of order two that it claims to be."""
    claim, order = found.claims.order, found.measured_order
    if marcher.whole or not found.consistent or claim is None or order is None or not (order < ALMOST_TWO <= claim):
        return None
    place = half_step(marcher, t_end)
    return None if place is None else f"of order 2 with {place}: half a step parts them"


def _marcher(candidate: Candidate, scene: Scene, h: float) -> tuple[Marcher, float, bool, str]:
    """What carries a state along on a scene, the calls of f for a step, whether f is given the time, and the engine."""
    if candidate.form.whole:
        calls, timed = _trial(candidate, scene, h)
        return Whole(candidate, scene), calls, timed, "whole"
    engine, calls, timed = chosen(candidate, scene, h)
    return Steps(engine, scene), calls, timed, engine.name


def _trial(candidate: Candidate, scene: Scene, h: float) -> tuple[float, bool]:
    """The calls of f for each time of a grid, and whether f is given the time.

    Raises:
        MisuseError: the integrator fails, gives no finite states, or gives two answers to one question.
    """
    grid = h * np.arange(TRIAL_TIMES)
    field = candidate.field(scene, TRIAL_TIMES)
    first = candidate.states(field, scene.start, grid)
    if not np.all(np.isfinite(first)):
        raise MisuseError(f"{candidate.name} returned states that are not finite; finite numbers are accepted.")
    calls = field.calls / TRIAL_TIMES
    candidate.states(candidate.field(scene, TRIAL_TIMES), 0.9 * scene.start, grid)
    repeatable(candidate.name, first, candidate.states(candidate.field(scene, TRIAL_TIMES), scene.start, grid))
    return calls, field.timed


def _most_steps(marcher: Marcher, calls: float) -> int:
    """The largest number of steps that the budget of calls allows."""
    if isinstance(marcher, Steps) and isinstance(marcher.engine, Traced):
        return MOST_STEPS
    on_arrays = isinstance(marcher, Steps) and not isinstance(marcher.engine, Lanes)
    allowed = CALLS_ON_ARRAYS if on_arrays else CALLS / LANES_OF_A_LADDER
    return int(min(max(allowed / max(calls, 1.0), LEAST_STEPS), MOST_STEPS))
