"""How far roundings of the time, the start, g and the length lead the pendulum's state.

With w = sqrt(g/l) and the derivatives of (theta, omega/w) by (theta0, omega0/w) at fixed t as the matrix Y,

    theta:  |t omega|  + |theta0 Y11| + |omega0/w Y12| + |t omega - omega0/w Y12|,
    omega:  |t omega'| + w (|theta0 Y21| + |omega0/w Y22|) + |omega + t omega' - omega0 Y22|.

The last terms are of g and l together: the state depends on them by w alone, and w dw takes half of each.

Y is proven at many nodes of one period, and about them solves x'' = -w^2 cos(theta) x by its power series.  A change of
the start that changes the period makes each period later, and nothing else, so that n periods after s

    Y = Y(s) + n z(s) r,  z = (omega/w, -sin(theta)),  Y(T) - 1 = z(0) r.
"""

from __future__ import annotations

import math
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from reference.problems.pendulum.bounds import FARTHEST, KEPT, sketch
from reference.routes import enclosure

if TYPE_CHECKING:
    from reference.problem import Problem
    from reference.problems.pendulum.bounds import Sketch

__all__ = ["LinearCondition", "pendulum_condition"]

DEGREE = 6
"""Powers of w t in the series of Y: a node is a 32nd away at most, so that what is left out is below 2^-39."""
BITS = 64
"""Of proven derivatives."""


@lru_cache(maxsize=KEPT)
def pendulum_condition(problem: Problem) -> NodesCondition | ProvenCondition:
    """By nodes around one period, or of a motion that has none, or too long a one, by its proven derivatives."""
    motion = problem.motion  # type: ignore[attr-defined]
    found = sketch(problem, rotates=motion == "rotation") if motion in {"libration", "rotation"} else None
    return ProvenCondition(problem) if found is None else NodesCondition(problem, found)


class NodesCondition:
    """Of a libration or rotation."""

    def __init__(self, problem: Problem, motion: Sketch) -> None:
        self._motion = motion
        self._start = tuple(map(float, problem.start))
        self._series = _series(motion)
        times = [node * Fraction(motion.piece) for node in range(len(motion.theta))]
        self._nodes = _slopes(problem, times, motion.w)
        last = len(times) - 2
        whole = self._about(np.array([last]), motion.period - last * motion.piece)[0] @ self._nodes[last]
        along = np.array([self._start[1] / motion.w, -math.sin(self._start[0])])
        size = along @ along  # zero of a start that is none in doubles
        self._later = along @ (whole - np.eye(2)) / size if size else np.full(2, np.nan)

    def _about(self, node: np.ndarray, away: np.ndarray | float) -> np.ndarray:
        """Y from some nodes to times ``away`` from them, [nodes, 2, 2]."""
        found = np.zeros((len(node), 2, 2))
        tau = np.broadcast_to(self._motion.w * np.asarray(away), node.shape)[:, None, None]
        for coefficient in reversed(self._series):
            found = found * tau + coefficient[node]
        return found

    def led(self, t: np.ndarray) -> np.ndarray:
        """As the protocol says; NaN beyond FARTHEST periods."""
        known = np.abs(t) < FARTHEST * self._motion.period
        t = np.where(known, t, 0.0)
        true = self._motion.states(t, 0.0)
        periods, since, rest = self._motion.reduced(t)
        node = np.clip(np.rint(since / self._motion.piece), 0, len(self._nodes) - 1).astype(np.intp)
        local = self._about(node, (since - node * self._motion.piece) + rest) @ self._nodes[node]
        w = self._motion.w
        along = np.stack([true.omega / w, -np.sin(true.theta)], axis=1) * periods[:, None]
        slopes = local + along[:, :, None] * self._later
        found = _led(t, (true.theta, true.omega), -w * w * np.sin(true.theta), slopes, self._start, w)
        return np.where(known[:, None], found, np.nan)


def _series(motion: Sketch) -> list[np.ndarray]:
    """The coefficients of Y about each node by powers of w t, each [nodes, 2, 2]."""
    angle = [motion.theta, motion.omega / motion.w]
    sine, cosine = [np.sin(motion.theta)], [np.cos(motion.theta)]
    one = np.ones_like(motion.theta)
    solutions = [[one, 0 * one], [0 * one, one]]
    for k in range(DEGREE):
        angle.append(-sine[k] / ((k + 1) * (k + 2)))
        for x in solutions:
            x.append(-sum(cosine[j] * x[k - j] for j in range(k + 1)) / ((k + 1) * (k + 2)))
        rates = [(j + 1) * angle[j + 1] for j in range(k + 1)]
        sine.append(sum(rates[j] * cosine[k - j] for j in range(k + 1)) / (k + 1))
        cosine.append(-sum(rates[j] * sine[k - j] for j in range(k + 1)) / (k + 1))
    return [
        np.moveaxis(np.array([[x[k] for x in solutions], [(k + 1) * x[k + 1] for x in solutions]]), 2, 0)
        for k in range(DEGREE)
    ]


class ProvenCondition:
    """By the derivatives that are proven at each time."""

    def __init__(self, problem: Problem) -> None:
        self._problem = problem

    def led(self, t: np.ndarray) -> np.ndarray:
        """As the protocol says."""
        times = [Fraction(time) for time in t.tolist()]
        theta, omega = np.array(_floats(self._problem, "state", times)).T
        slopes = np.array(_floats(self._problem, "gradient", times)).reshape(-1, 2, 4)
        inputs = np.array([float(value) for value in (*self._problem.start, *self._problem.parameters.values())])
        w2 = inputs[2] / inputs[3]
        rates = np.stack([omega, -w2 * np.sin(theta)], axis=1)
        found: np.ndarray = np.abs(t[:, None] * rates) + np.abs(slopes * inputs).sum(axis=2)
        return found


def _floats(problem: Problem, row: str, times: list[Fraction]) -> list[list[float]]:
    return [list(map(float, values)) for values in enclosure.balls(problem, row, times, BITS)]


def _slopes(problem: Problem, times: list[Fraction], w: float) -> np.ndarray:
    """Y at some times, as proven, [times, 2, 2]."""
    found: np.ndarray = np.array(_floats(problem, "gradient", times)).reshape(-1, 2, 4)[:, :, :2]
    found *= np.array([[1.0, w], [1 / w, 1.0]])
    return found


class LinearCondition:
    """Of the linearised pendulum, whose Y turns by w t."""

    def __init__(self, problem: Problem) -> None:
        self._start = tuple(map(float, problem.start))
        self._w = math.sqrt(problem.parameters["g"] / problem.parameters["length"])

    def led(self, t: np.ndarray) -> np.ndarray:
        """As the protocol says."""
        (theta0, omega0), w = self._start, self._w
        cosine, sine = np.cos(w * t), np.sin(w * t)
        theta, omega = theta0 * cosine + omega0 / w * sine, omega0 * cosine - theta0 * w * sine
        slopes = np.moveaxis(np.array([[cosine, sine], [-sine, cosine]]), 2, 0)
        return _led(t, (theta, omega), -w * w * theta, slopes, self._start, w)


def _led(
    t: np.ndarray,
    state: tuple[np.ndarray, np.ndarray],
    acceleration: np.ndarray,
    slopes: np.ndarray,
    start: tuple[float, ...],
    w: float,
) -> np.ndarray:
    """The sums above, [times, state], of Y at the times."""
    (_, omega), (theta0, omega0) = state, start
    moved, turned = t * omega, t * acceleration
    theta_led = (
        np.abs(moved)
        + np.abs(theta0 * slopes[:, 0, 0])
        + np.abs(omega0 / w * slopes[:, 0, 1])
        + np.abs(moved - omega0 / w * slopes[:, 0, 1])
    )
    omega_led = (
        np.abs(turned)
        + w * np.abs(theta0 * slopes[:, 1, 0])
        + np.abs(omega0 * slopes[:, 1, 1])
        + np.abs(omega + turned - omega0 * slopes[:, 1, 1])
    )
    return np.stack([theta_led, omega_led], axis=1)
