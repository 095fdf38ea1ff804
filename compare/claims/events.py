"""Times of events that an integrator finds, held against the proven zero crossings: none missed, none told twice."""

from __future__ import annotations

import inspect
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.claims.frames import Exhausted, Field, MisuseError, Scene
from compare.claims.limits import SECONDS
from compare.claims.motion import motion
from compare.claims.verdicts import Tried, Verdict
from compare.methods.own.deadline import TimeOut, deadline
from compare.methods.own.forms import role_of
from compare.methods.own.hosting import calling
from reference.arithmetic.namespaces import NUMPY

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.problem import Problem

__all__ = ["assert_events", "check_events"]

LEAST = 1e-14
"""No accuracy beyond this can be told."""
COUNT = 8
"""Crossings that are looked for, where there are so many; SPANS of time over which an order is measured, at most."""
SPANS = 8
CALLS = 10_000_000
ROLES = ("f", "event", "span", "y")
PLACES = {"event": ("event", "events", "g", "condition")}
"""What the event function is called, where not by its place."""
NEAR = 0.25
"""Of the time to the next crossing: what is found so near to one is that one."""
AT_START = 1e-9


def check_events(
    find: Callable[..., Any],
    accuracy: float = 1e-6,
    problem: Problem | None = None,
    seconds: float = SECONDS,
) -> Tried:
    """Hold the times of events against the proven ones.

    Args:
        find: ``find(f, event, t_span, y0)`` gives the times in the span, after its beginning, at which event(t, y) is
            zero, or an object that has them as ``t_events`` as SciPy's has; ``f`` and ``event`` take (y) or (t, y).
        accuracy: the largest error of a time that is claimed, over the mean time between two crossings.
        problem: any that has proven crossings; the pendulum of 1 m released at 1 rad, which crosses the bottom, if
            None.
        seconds: time after which it is given up.

    Raises:
        TypeError, ValueError: as ``compare.check``; the problem has no crossings, or the accuracy is out of range.
    """
    if not LEAST <= accuracy < 1:
        raise ValueError(f"accuracy is {accuracy!r}; a number from {LEAST:g} to 1 is accepted.")
    scene = Scene(motion(problem))
    until, proven = _crossings(scene)
    name = str(getattr(find, "__name__", type(find).__name__))
    field = Field(scene, CALLS, find)

    def event(*arguments: Any) -> Any:
        return scene.problem.event(NUMPY, field.time_and_state(arguments)[1])

    values = {"f": field, "event": event, "span": (0.0, until), "y": scene.start}
    try:
        with deadline(seconds), calling(name):
            found = find(*(values[role] for role in _roles(find)))
    except TimeOut:
        raise MisuseError(f"{name} took more than {seconds:g} s; one that returns is accepted.") from None
    except Exhausted:
        raise MisuseError(f"{name} called f more than {CALLS} times; one that returns is accepted.") from None
    return Tried(name, repr(scene.problem), (_verdict(_times(found, name), proven, accuracy),))


def assert_events(find: Callable[..., Any], accuracy: float = 1e-6, **how: Any) -> Tried:
    """Return the check of events that are all found, once, and as accurately as claimed.

    Raises:
        AssertionError: they are not.
        TypeError, ValueError: as ``check_events``.
    """
    found = check_events(find, accuracy, **how)
    found.assert_holds()
    return found


def _roles(find: Callable[..., Any]) -> list[str]:
    """The roles of its arguments: by their names where each is known, else by their places."""
    needed = [one.name for one in inspect.signature(find).parameters.values() if one.default is one.empty]
    if len(needed) != len(ROLES):
        raise MisuseError(f"it has the arguments {', '.join(needed) or 'none'}; (f, event, t_span, y0) is accepted.")
    found: list[str] = []
    for name in needed:
        left = [role for role in ROLES if role not in found and role != "event"]
        role = "event" if name.casefold() in PLACES["event"] else role_of(name, left)
        found += [role] if role is not None else []
    return found if set(found) == set(ROLES) and len(found) == len(ROLES) else list(ROLES)


def _crossings(scene: Scene) -> tuple[float, np.ndarray]:
    """A time, and the proven crossings from the start to it, COUNT of them where there are.

    Raises:
        MisuseError: there are none that are proven.
    """
    problem, until = scene.problem, scene.span
    for _ in range(SPANS.bit_length()):
        known = problem.passages(until)
        if known is None:
            raise MisuseError(f"{problem!r} has no event of which crossings are proven; one that has is accepted.")
        row, count = known
        if count >= COUNT:
            break
        until *= 2
    if not count:
        raise MisuseError(f"{problem!r} has no crossing up to t = {until:.4g}; a problem that has is accepted.")
    count = min(count, COUNT)
    times = np.array([float(problem.certified(row, k)) for k in range(count)])
    gap = times[-1] - times[-2] if count > 1 else times[-1]
    return float(times[-1] + gap / 2), times


def _times(found: Any, name: str) -> np.ndarray:
    """The times that were found, in the order in which they are told."""
    found = getattr(found, "t_events", found)
    if isinstance(found, (list, tuple)) and len(found) == 1 and np.ndim(found[0]) == 1:
        found = found[0]
    try:
        times = np.asarray(found, dtype=float)
    except (TypeError, ValueError):
        times = np.empty((0, 0))
    if times.ndim != 1 or not np.all(np.isfinite(times)):
        raise MisuseError(f"{name} returned what is no list of times; finite times in a list are accepted.")
    return times


def _verdict(times: np.ndarray, proven: np.ndarray, accuracy: float) -> Verdict:
    unit = float(proven[-1]) / len(proven)
    words = f"all events, to {accuracy:g}"
    place = np.array([int(np.argmin(np.abs(proven - t))) for t in times], dtype=int)
    near = [abs(float(t - proven[k])) <= NEAR * _gap(proven, k) for t, k in zip(times, place, strict=True)]
    own = {int(k): float(t) for t, k, ok in zip(times, place, near, strict=True) if ok}
    missed = [k for k in range(len(proven)) if k not in own]
    extra = [float(t) for t, ok in zip(times, near, strict=True) if not ok]
    twice = sorted({int(k) for k, ok in zip(place, near, strict=True) if ok and list(place[near]).count(k) > 1})
    errors = [abs(t - float(proven[k])) / unit for k, t in own.items()]
    largest = max(errors, default=0.0)
    measured = f"{len(own)} of {len(proven)} found"
    measured += f", largest error {largest:.1e} of the mean time between two" * bool(errors)
    causes = _causes(proven, missed, extra, twice)
    if bool(np.any(np.diff(times) < 0)):
        causes.append("they are not in the order of time")
    wrong = bool(causes) or largest > accuracy
    return Verdict.of("events", words, "fails" if wrong else "holds", measured, tuple(causes))


def _gap(proven: np.ndarray, k: int) -> float:
    """The time from a crossing to the nearest other one, or to the start."""
    return float(np.min(np.abs(np.append(np.delete(proven, k), 0.0) - proven[k])))


def _causes(proven: np.ndarray, missed: Sequence[int], extra: Sequence[float], twice: Sequence[int]) -> list[str]:
    """What is wrong with the number of events."""
    told = []
    if len(missed) == len(proven):
        told.append("none is found")
    elif len(missed) > 1 and {k % 2 for k in missed} in ({0}, {1}) and 2 * len(missed) >= len(proven) - 1:
        told.append("those of one direction are missed")
    elif missed:
        told.append(f"missed at t = {', '.join(f'{proven[k]:.4g}' for k in missed)}")
        if any(b == a + 1 for a, b in pairwise(missed)):
            told.append("two within a step leave its ends with the same sign: signs are to be seen between them too")
    if twice:
        told.append(f"told more than once at t = {', '.join(f'{proven[k]:.4g}' for k in twice)}")
    at_start = [t for t in extra if abs(t) <= AT_START]
    others = [t for t in extra if abs(t) > AT_START]
    if at_start:
        told.append("the beginning of the span is told as an event")
    if others:
        told.append(f"told where there is none, at t = {', '.join(f'{t:.4g}' for t in others[:3])}")
    return told
