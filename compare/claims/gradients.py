"""Derivatives of a solution by its start, its parameters and its initial time, held against proven sensitivities.

dy(t)/dy0 = S(t),  S' = (df/dy) S,  S(0) = 1;    dy(t)/dp = s(t),  s' = (df/dy) s + df/dp,  s(0) = 0;
dy(t)/dt0 = -S(t) f(t0, y0)
"""

from __future__ import annotations

import math
from fractions import Fraction
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.claims.frames import MisuseError, Scene
from compare.claims.limits import SECONDS
from compare.claims.motion import motion
from compare.claims.verdicts import Tried, Verdict
from compare.methods.own.deadline import TimeOut, deadline
from compare.methods.own.hosting import calling
from reference.arithmetic.namespaces import NUMPY
from reference.flow import Flow
from reference.names import unknown

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from reference.problem import Problem

__all__ = ["INITIAL_TIME", "assert_gradients", "check_gradients"]

INITIAL_TIME = "t0"
"""The name of what is no component and no parameter."""
LEAST = 1e-12
"""No accuracy beyond this can be told: what is given are doubles."""
ALIKE = 0.01
"""A column within so much of a known mistake is that."""
HALF_WAY = 0.5
"""Of the time over which an order is measured."""


def check_gradients(
    gradients: Callable[..., Any],
    accuracy: float = 1e-6,
    problem: Problem | None = None,
    t: float | None = None,
    seconds: float = SECONDS,
) -> Tried:
    """Hold derivatives of a solution against the proven ones.

    Args:
        gradients: ``gradients(y0, parameters, t)`` of the start, of a dict of the parameters by name, and of a time
            gives dy(t)/dy0 as an array [state, state], or a dict of columns dy(t)/dx [state] by the names of components
            and of parameters, and ``t0``.
        accuracy: the relative error of each column, over its largest entry, that is claimed to be reached.
        problem: of which it has the solution; the pendulum of 1 m released at 1 rad if None.
        t: the time; about half of a period if None.
        seconds: time after which it is given up.

    Raises:
        TypeError, ValueError: as ``compare.check``; the accuracy is out of range, or a name unknown.
    """
    if not LEAST <= accuracy < 1:
        raise ValueError(f"accuracy is {accuracy!r}; a number from {LEAST:g} to 1 is accepted.")
    scene = Scene(motion(problem))
    name = str(getattr(gradients, "__name__", type(gradients).__name__))
    t = HALF_WAY * scene.span if t is None else float(t)
    _hold_time(scene, t)
    parameters = {key: float(value) for key, value in scene.problem.parameters.items()}
    try:
        with deadline(seconds), calling(name):
            found = gradients(scene.start, dict(parameters), t)
    except TimeOut:
        raise MisuseError(f"{name} took more than {seconds:g} s; one that returns is accepted.") from None
    columns = _columns(found, name, scene, parameters)
    try:
        with deadline(seconds):
            proven = _proven(scene, parameters, t, list(columns))
    except TimeOut:
        raise MisuseError(
            f"the derivatives at t = {t:g} take more than {seconds:g} s to be proven; an earlier time is accepted, or "
            "a longer one for them."
        ) from None
    return Tried(name, repr(scene.problem), (_verdict(columns, proven, accuracy, t),))


def assert_gradients(gradients: Callable[..., Any], accuracy: float = 1e-6, **how: Any) -> Tried:
    """Return the check of derivatives that are as accurate as claimed.

    Raises:
        AssertionError: one is not.
        TypeError, ValueError: as ``check_gradients``.
    """
    found = check_gradients(gradients, accuracy, **how)
    found.assert_holds()
    return found


def _hold_time(scene: Scene, t: float) -> None:
    """Refuse a time at which there is nothing to be seen.

    Raises:
        ValueError: it is the start, or the motion does not go on until then.
    """
    domain = scene.problem.domain(scene.problem.row("state"))
    if not math.isfinite(t) or t == 0 or not domain.contains(Fraction(t)):
        raise ValueError(f"t is {t!r}; a time other than the start, of the motion of {scene.problem!r}, is accepted.")


def _columns(found: Any, name: str, scene: Scene, parameters: Mapping[str, float]) -> dict[str, np.ndarray]:
    """The columns by names.

    Raises:
        MisuseError: they have other names or shapes.
    """
    d, names = scene.dimension, scene.problem.state_names
    if not isinstance(found, dict):
        array = np.asarray(found, dtype=float)
        if array.shape != (d, d):
            raise MisuseError(
                f"{name} returned an array of shape {array.shape}; ({d}, {d}), dy(t)/dy0, or a dict of columns by name "
                "is accepted."
            )
        return dict(zip(names, array.T, strict=True))
    accepted = (*names, *parameters, INITIAL_TIME)
    columns = {}
    for key, value in found.items():
        if key not in accepted:
            raise MisuseError(unknown("derivative", str(key), accepted))
        columns[key] = np.asarray(value, dtype=float)
        if columns[key].shape != (d,):
            raise MisuseError(f"{name} returned d/d{key} of shape {columns[key].shape}; ({d},) is accepted.")
    if not columns:
        raise MisuseError(f"{name} returned no derivative; columns by the names {', '.join(accepted)} are accepted.")
    return columns


def _proven(scene: Scene, parameters: Mapping[str, float], t: float, names: list[str]) -> dict[str, np.ndarray]:
    """The proven columns: of the equation from the start and with the parameters that are given, as doubles."""
    problem = scene.problem
    components = problem.state_names
    flow = Flow(
        problem.derivative,
        start=dict(zip(components, scene.start.tolist(), strict=True)),
        numbers=parameters,
        autonomous=problem.autonomous,
    )
    needed = [*(name for name in names if name != INITIAL_TIME), *(components if INITIAL_TIME in names else ())]
    found = {
        name: np.array([float(flow.certified(f"sensitivity_{name}", t, i)) for i in range(len(components))])
        for name in dict.fromkeys(needed)
    }
    if INITIAL_TIME in names:
        rates = scene.rates(NUMPY, 0.0, list(scene.start))
        found[INITIAL_TIME] = -sum(found[name] * rate for name, rate in zip(components, rates, strict=True))
    return {name: found[name] for name in names}


def _verdict(columns: Mapping[str, np.ndarray], proven: Mapping[str, np.ndarray], accuracy: float, t: float) -> Verdict:
    scale = max(float(np.max(np.abs(column))) for column in proven.values())
    errors = {name: _error(columns[name], truth, scale) for name, truth in proven.items()}
    worst = max(errors, key=lambda name: errors[name])
    measured = f"largest relative error {errors[worst]:.1e}, of d/d{worst}, at t = {t:.3g}"
    wrong = {name: columns[name] for name in columns if not errors[name] <= accuracy}
    words = f"derivatives by {', '.join(columns)} to {accuracy:g}"
    causes = tuple(_causes(wrong, columns, proven))
    return Verdict.of("gradients", words, "fails" if wrong else "holds", measured, causes)


def _error(found: np.ndarray, truth: np.ndarray, scale: float) -> float:
    size = float(np.max(np.abs(truth))) or scale or 1.0
    error = float(np.max(np.abs(found - truth))) / size
    return error if np.isfinite(error) else float("inf")


def _causes(
    wrong: Mapping[str, np.ndarray], columns: Mapping[str, np.ndarray], proven: Mapping[str, np.ndarray]
) -> list[str]:
    """What explains wrong columns, where it is known."""
    names = list(proven)
    given, square = (np.array([one[name] for name in names]) for one in (columns, proven))
    if wrong and square.shape[0] == square.shape[1] and _close(given, square.T):
        return ["the matrix is transposed: its columns are derivatives by a component of the start"]
    told = []
    for name, column in wrong.items():
        truth = proven[name]
        other = next((one for one in names if one != name and _close(column, proven[one])), None)
        if not np.any(column):
            told.append(f"d/d{name} is zero: the solution is not followed by it")
        elif _close(column, -truth):
            told.append(f"d/d{name} has the wrong sign")
        elif other is not None:
            told.append(f"what is said to be d/d{name} is d/d{other}")
        elif (factor := _factor(column, truth)) is not None:
            told.append(f"d/d{name} is {factor:.4g} times what it should be")
    return told


def _close(found: np.ndarray, truth: np.ndarray) -> bool:
    return bool(np.max(np.abs(found - truth)) <= ALIKE * np.max(np.abs(truth)))


def _factor(found: np.ndarray, truth: np.ndarray) -> float | None:
    """The one number that all entries are times the truth."""
    with np.errstate(all="ignore"):
        ratios = (found / truth)[np.abs(truth) > ALIKE * np.max(np.abs(truth))]
    same = len(ratios) > 1 and all(abs(b - a) <= ALIKE * abs(a) for a, b in pairwise(ratios.tolist()))
    return float(ratios[0]) if same else None
