"""``compare.check``: is my integrator what it says it is?"""

from __future__ import annotations

import math
import time
from dataclasses import replace
from fractions import Fraction
from numbers import Real
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.claims import local, stiffness, tolerances
from compare.claims.candidate import Candidate
from compare.claims.coefficients import slip
from compare.claims.consistency import advance_of_a_constant_slope, iterates, uses
from compare.claims.defects import Evidence, reversibility, symplecticity
from compare.claims.energy import kept
from compare.claims.engine import Lanes, Steps, Traced, Whole, chosen
from compare.claims.findings import Claims
from compare.claims.frames import Exhausted, Frame, MisuseError, Scene
from compare.claims.half_step import half_step
from compare.claims.heading import UNTRIED, Heading, heading
from compare.claims.limits import SECONDS
from compare.claims.local import new_state
from compare.claims.motion import motion
from compare.claims.order import ladder, measured
from compare.claims.powers import lower, powers
from compare.claims.record import Check
from compare.claims.tolerances import with_tolerance
from compare.methods.own.adapters import adapted, with_arguments
from compare.methods.own.deadline import TimeOut, deadline
from compare.methods.own.hosting import repeatable
from reference.arithmetic.underflow import require_gradual

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from compare.claims.engine import Marcher
    from compare.claims.order import Order
    from compare.claims.verdicts import Verdict
    from reference.problem import Problem

__all__ = ["check"]

PURSUED = 0.25
"""Part of it within which an order that has not settled is pursued to finer steps."""
CALLS = 100_000
"""Calls of f that the marches of one scene may take, lane by lane."""
CALLS_ON_ARRAYS = 40_000
"""The same on arrays, where all lanes share a call."""
FRAME = 0.5, 0.7
"""Amplitude of the swinging frame in rad, or over the size of a motion, and its frequency over the motion's rate."""
MARCH, TIMED_STEPS = 1 / 30, 16
"""Part of the time for the marches of one scene, where a step is slow, and steps by which that is seen."""
FOLLOWED = 1 / 6
"""Part of the time for the one march along which the invariants are followed."""
ENOUGH = 4
"""That march says whether they are bounded where the time left one in so many of its steps."""
MOST_STEPS = 4096
LEAST_STEPS = 48
LANES_OF_A_LADDER = 7
"""Steps of all marches of a ladder, from two starts, over those of its longest."""
TRIAL_TIMES = 9
MOST_ORDER = 100
ORDERS = ("order", "dense", "estimate", "tolerance", "stiff")
"""Claims that are a number."""
USUAL_RTOL = 1e-6
"""The tolerance with which the rest is measured where one is claimed."""
ALMOST_TWO = 1.5
"""An order below this is one, and a claim from it on is of two or more."""


def check(
    step: Callable[..., Any],
    order: float | None = None,
    symplectic: bool | None = None,
    reversible: bool | None = None,
    backward: bool | None = None,
    conserves: bool | None = None,
    dense: float | None = None,
    interpolant: Callable[..., Any] | None = None,
    estimate: float | None = None,
    tolerance: float | None = None,
    stiff: float | None = None,
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
            A class, a generator or a solver over a span of time is called as ``compare.methods.own.adapters`` says, and
            ``step(y, h)`` has the equation of the problem built in.
        order: the order that is claimed, or None.
        symplectic: whether it is claimed to be symplectic.
        reversible: whether it is claimed to be reversible.
        backward: whether the order is claimed for negative steps too.
        conserves: whether it is claimed to keep every invariant that the problem declares, bounded or to rounding.
        dense: the order that is claimed of the states between steps, which ``interpolant`` gives.
        interpolant: ``interpolant(f, y, h, theta)``, with the time if the step takes it: the state after the part theta
            of a step.
        estimate: the order that is claimed of the embedded method whose error a step estimates: it then gives the new
            state and the estimate, as a tuple.
        tolerance: the power of the relative tolerance with which the error of an integrator that chooses its own steps
            is claimed to go: 1 in proportion.  It takes the tolerance as rtol, with atol or without.
        stiff: the order that is claimed to be left on Prothero and Robinson's stiff equation.
        problem: what it is tried on, any motion in time; the pendulum of 1 m released at 1 rad if None.
        form: "step", "timed", "separable", "gradient", "integrator", "own", "own-timed" or "own-separable", where the
            arguments' names do not say it.
        seconds: time after which the check is given up.

    Raises:
        TypeError: ``step`` cannot be called, or ``problem`` is no problem.
        ValueError: the step raises, gives no finite real state of the right shape, depends on more than its arguments,
            or takes too long; the order of an integrator is claimed that chooses its own steps; or the problem is a
            curve, does not split as a separable step needs it, or depends on a time that the step does not give.
    """
    require_gradual("a check")
    scene = Scene(motion(problem))
    claims = _claims(
        order=order,
        symplectic=symplectic,
        reversible=reversible,
        conserves=conserves,
        backward=backward,
        dense=dense,
        estimate=estimate,
        tolerance=tolerance,
        stiff=stiff,
    )
    if (dense is None) != (interpolant is None):
        raise ValueError("dense output is claimed by its order and an interpolant (f, y, h, theta); both are accepted.")
    candidate = _candidate(step, form, claims)
    if candidate.form.own and problem is None:
        raise ValueError(
            f"{candidate.name} takes no f, so that nobody knows of which equation it is a step; a problem is accepted "
            "besides, or a step (f, y, h)."
        )
    candidate.hold(scene)
    try:
        with deadline(seconds):
            found = _checked(candidate, claims, scene, seconds)
            return replace(found, more=tuple(_beside(step, candidate, claims, scene, interpolant, form)))
    except Exhausted as error:
        raise MisuseError(f"{candidate.name} {error} in one step; it does not come to an end.") from None
    except TimeOut:
        raise MisuseError(
            f"{candidate.name} took more than {seconds:g} s; a step that returns is accepted, or a longer time."
        ) from None


def _claims(**claimed: Any) -> Claims:
    """What is claimed.

    Raises:
        ValueError: an order is no positive number, or is claimed for negative steps alone.
    """
    for name in ORDERS:
        if claimed[name] is not None and not _is_order(claimed[name]):
            raise ValueError(f"{name} is {claimed[name]!r}; a positive number below {MOST_ORDER} is accepted.")
    if claimed["backward"] and claimed["order"] is None:
        raise ValueError("an order for negative steps is claimed without an order; both are accepted.")
    orders: dict[str, Any] = {name: float(claimed[name]) for name in ORDERS if claimed[name] is not None}
    return Claims(**{**claimed, **orders})


def _candidate(step: Callable[..., Any], form: str | None, claims: Claims) -> Candidate:
    """The user's function, and how it is called.

    Raises:
        TypeError, ValueError: it cannot be called, or not so.
        MisuseError: what is claimed is of a single step, and it has none, or gives it in parts.
    """
    if claims.tolerance is not None:
        step = with_arguments(step, with_tolerance(step, USUAL_RTOL, USUAL_RTOL))
    function, called = adapted(step if claims.estimate is None else new_state(step), form)
    candidate = Candidate(function, called, _name(step))
    if claims.tolerance is not None and not called.whole:
        raise MisuseError(f"a tolerance is claimed of {candidate.name}; that of (f, y0, t, rtol) is accepted.")
    if claims.stiff is not None and called.own:
        raise MisuseError(
            f"an order on a stiff equation is claimed of {candidate.name}, which has its equation built in; that of "
            "(f, t, y, h) is accepted."
        )
    if claims.dense is not None and called.whole:
        raise MisuseError(f"dense output is claimed of {candidate.name}; that of a step (f, y, h) is accepted.")
    if claims.estimate is not None and (called.whole or called.separable):
        raise MisuseError(f"an error estimate is claimed of {candidate.name}; that of a step (f, y, h) is accepted.")
    return candidate


def _beside(
    step: Callable[..., Any],
    candidate: Candidate,
    claims: Claims,
    scene: Scene,
    interpolant: Callable[..., Any] | None,
    form: str | None,
) -> Iterator[Verdict]:
    """Verdicts on what a step gives beside the new state."""
    if claims.dense is not None and interpolant is not None:
        yield local.dense(candidate, scene, scene.step, interpolant, claims.dense)
    if claims.estimate is not None:
        yield local.estimate(step, candidate, scene, scene.step, claims.estimate)
    if claims.stiff is not None:
        yield stiffness.stiff(candidate, claims.stiff)
    if claims.tolerance is not None:

        def with_one(rtol: float, atol: float) -> Candidate:
            bound = with_arguments(step, with_tolerance(step, rtol, atol))
            return Candidate(*adapted(bound, form), candidate.name)

        yield tolerances.judged(with_one, scene, claims.tolerance)


def _is_order(order: Any) -> bool:
    return type(order) is not bool and isinstance(order, Real) and 0 < float(order) < MOST_ORDER


def _name(step: Callable[..., Any]) -> str:
    return str(getattr(step, "__name__", type(step).__name__))


def _checked(candidate: Candidate, claims: Claims, scene: Scene, seconds: float) -> Check:
    until = time.monotonic() + seconds * PURSUED
    h = scene.step
    marcher, calls, timed, name = _marcher(candidate, scene, h)
    cost = _seconds_of_a_step(marcher)
    by_calls = _steps_by_calls(marcher, calls)
    counts = ladder(_steps_in_time(marcher, by_calls, seconds * MARCH / cost))
    still = measured(marcher, scene.span, counts, until)
    iterating = iterates(candidate, marcher, h)
    solves = iterating or candidate.form.own
    advance = None if solves else advance_of_a_constant_slope(candidate, scene, h)
    _hold_measurable(candidate.name, still, claims, advance)
    swinging = None
    if timed:
        frame = Scene(scene.problem, Frame(FRAME[0], FRAME[1] * scene.pace, scene.units))
        swinging = measured(_marcher(candidate, frame, h)[0], scene.span, counts, until)
        series = lower(powers(candidate, scene, h), powers(candidate, frame, h))
    else:
        series = None if marcher.whole else powers(candidate, scene, h)
    followed = min(by_calls, max(int(seconds * FOLLOWED / cost), LEAST_STEPS))
    energy, *others = kept(marcher, h, followed)
    evidence = Evidence(
        possible=name != "compiled" and still.kind != "own steps",
        iterates=iterating,
        bounded=energy.bounded if ENOUGH * followed >= by_calls else None,
    )
    headed = _heading(candidate, marcher, h)
    back = _back(marcher, counts, until) if claims.backward and headed.backward in {"right", "untried"} else None
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
        advance=advance,
    )
    return replace(found, hint=_hint(found, candidate, marcher, scene.span))


def _back(marcher: Marcher, counts: Sequence[int], until: float) -> Order | None:
    """The order with negative steps from the start; None where the motion is not known before it.

    None as well of a whole integrator that takes no falling times, of which nobody knows before.
    """
    scene = marcher.scene
    if not scene.problem.domain(scene.problem.row("state")).contains(Fraction(-scene.span)):
        return None
    try:
        return measured(marcher, -scene.span, counts, until)
    except MisuseError:
        if not marcher.whole:
            raise
        return None


def _hold_measurable(name: str, found: Order, claims: Claims, advance: float | None) -> None:
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
    if found.kind == "own steps" and claims.order is not None and advance in {None, 1}:
        raise MisuseError(
            f"{name} chooses its own steps: its error is {finest.error:.0e} whatever the spacing of t, so that its "
            "order cannot be measured; no order, or a step of fixed size, is accepted."
        )


def _heading(candidate: Candidate, marcher: Marcher, h: float) -> Heading:
    """Of a step; of a whole integrator only whether it makes use of f is known, if it is given one."""
    if marcher.whole:
        return replace(UNTRIED, uses=uses(candidate, marcher.scene, h))
    return heading(candidate, marcher.scene, h)


def _hint(found: Check, candidate: Candidate, marcher: Marcher, t_end: float) -> str | None:
    """What explains that an order is not the one that is claimed, where it is known."""
    claim, order = found.claims.order, found.measured_order
    if marcher.whole or claim is None or found.order_standing == "holds":
        return None
    if found.consistent and order is not None and order < ALMOST_TWO <= claim:
        place = half_step(marcher, t_end)
        if place is not None:
            return f"of order 2 with {place}: half a step parts them"
    return slip(candidate, marcher.scene, claim)


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


def _traced(marcher: Marcher) -> bool:
    return isinstance(marcher, Steps) and isinstance(marcher.engine, Traced)


def _together(marcher: Marcher) -> bool:
    """Whether all lanes share a call of f."""
    return isinstance(marcher, Steps) and not isinstance(marcher.engine, Lanes)


def _steps_by_calls(marcher: Marcher, calls: float) -> int:
    """The largest number of steps that the budget of calls allows; compiled steps make none."""
    if _traced(marcher):
        return MOST_STEPS
    allowed = CALLS_ON_ARRAYS if _together(marcher) else CALLS / LANES_OF_A_LADDER
    return int(min(max(allowed / max(calls, 1.0), LEAST_STEPS), MOST_STEPS))


def _steps_in_time(marcher: Marcher, steps: int, within: float) -> int:
    """So many steps, or halves of them until a ladder of them takes no longer than ``within`` steps do."""
    if _traced(marcher):
        return steps
    longest = within / (1 if _together(marcher) else LANES_OF_A_LADDER)
    while steps >= 2 * LEAST_STEPS and steps > longest:
        steps //= 2
    return steps


def _seconds_of_a_step(marcher: Marcher) -> float:
    """How long a step takes, once all is compiled."""
    start, h, wanted = marcher.scene.start[:, None], np.array([marcher.scene.step]), [[TIMED_STEPS]]
    marcher.states(start, h, wanted)
    begun = time.perf_counter()
    marcher.states(start, h, wanted)
    return (time.perf_counter() - begun) / TIMED_STEPS
