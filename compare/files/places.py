"""Phases, amplitudes and energies of many states of a pendulum in doubles, and by how much they may be off.

What is lost comes of the differences c - |p|, near the separatrix, and of sin(theta/2) where theta has whole turns:

    kappa = 1 + (1 + |theta|) (c + |p|)/|c^2 - p^2| + |theta|/k where |theta| > 4

times a few dozen roundings bounds the relative error of what ``swings`` computes from s, c and p.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from flint import arb

from compare.files.pendulum_bounds import BITS, SLACK
from reference.arithmetic.namespaces import BALL, NUMPY
from reference.arithmetic.precision import ctx
from reference.problems.orbits import orbits

if TYPE_CHECKING:
    from compare.files.pendulum_bounds import Sketched
    from reference.problems.pendulum import Pendulum

__all__ = ["Found", "Places"]

TURNED = 4.0
"""rad: beyond, the sine of half an angle has lost digits."""
CLOSE = 1 / 100
"""Carlson's series, of which the terms of the eighth degree are left out, is taken where its variables are below."""


class Found(NamedTuple):
    """Bounds on what is found of rows, float64 [rows].

    Attributes:
        phase: at least |phase error|, rad; infinite where the row may have none.
        amplitude: at least |amplitude error|, rad.
        energy: at least |energy error|.
        lost: whether the row may be on no orbit of the exact motion's kind.
    """

    phase: np.ndarray
    amplitude: np.ndarray
    energy: np.ndarray
    lost: np.ndarray


class Places:
    """Where states of a libration's or rotation's kind are, against the exact motion."""

    def __init__(self, problem: Pendulum) -> None:
        self._problem, self._rotates = problem, problem.motion == "rotation"
        self._direction = 1 if problem.omega0 > 0 else -1
        self._parameters = {name: float(value) for name, value in problem.parameters.items()}
        with ctx.workprec(BITS + problem.working_bits([])):
            kind = orbits(problem)
            start = None if kind is None else kind.truth(problem.theta0 * 0)
            self._phase = float("nan") if start is None or start.phase is None else float(start.phase)
            self._amplitude = float("nan") if start is None or start.amplitude is None else float(start.amplitude)
            parameters = {name: BALL.number(value) for name, value in problem.parameters.items()}
            y = [BALL.number(value) for value in problem.start]
            self._energy = float(arb(problem.invariant(BALL, y, parameters)))

    def found(self, theta: np.ndarray, omega: np.ndarray, true: Sketched, late: np.ndarray) -> Found:
        """The bounds of states, whose exact motion's phases may be ``late`` periods off."""
        w = math.sqrt(self._parameters["g"] / self._parameters["length"])
        s, c, p = np.sin(theta / 2), np.cos(theta / 2), omega / (2 * w)
        s, c = np.where(c < 0, -s, s), np.abs(c)
        square, rest = s * s + p * p, (c - np.abs(p)) * (c + np.abs(p))
        turned = np.where(np.abs(theta) > TURNED, np.abs(theta), 0.0)
        kappa = 1 + (1 + np.abs(theta)) * (c + np.abs(p)) / np.abs(rest) + turned / np.sqrt(square)
        kind = rest < 0 if self._rotates else rest > 0
        certain = kind & (kappa * SLACK < 1) & (square > 0)
        if self._rotates:
            certain &= p * self._direction > 0
        here = np.full(len(theta), np.nan)
        chosen = (column[certain] for column in (s, c, p, square, rest))
        here[certain] = (self._turns if self._rotates else _quarters)(*chosen)
        periods = here - self._phase - true.periods
        error = 2 * math.pi * (np.abs(periods - np.rint(periods)) + SLACK * (2 + kappa) + late)
        k, kc = np.sqrt(square), np.sqrt(np.abs(rest))
        amplitude = np.abs(2 * np.arctan2(k, kc) - self._amplitude) + SLACK * (self._amplitude + kappa * k * kc)
        energy = self._problem.invariant(NUMPY, (theta, omega), self._parameters) / self._energy
        within = SLACK * (1 + energy + 4 * turned * w * w / self._energy)
        return Found(
            np.where(certain, error, np.inf),
            np.where(certain, amplitude, np.inf),
            np.abs(energy - 1) + within,
            ~certain,
        )

    def _turns(self, s: np.ndarray, c: np.ndarray, p: np.ndarray, square: np.ndarray, rest: np.ndarray) -> np.ndarray:
        """The phase of a rotation, in turns since the bottom."""
        since = s * _first_kind(c * c, p * p / square, np.ones_like(s))
        found: np.ndarray = self._direction * since / (2 * _complete(np.sqrt(-rest / square)))
        return found


def _quarters(s: np.ndarray, c: np.ndarray, p: np.ndarray, square: np.ndarray, rest: np.ndarray) -> np.ndarray:
    """The phase of a libration, in periods since the last upward passage through the bottom."""
    del c
    quarters = s * _first_kind(p * p, p * p + rest * s * s, square) / _complete(np.sqrt(rest))
    found: np.ndarray = np.where(p >= 0, quarters, 2 - quarters) / 4
    return found


def _first_kind(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
    """Carlson's R_F by duplication and its series (DLMF 19.36.1), of arguments of which at most one is zero."""
    while True:
        mean = (x + y + z) / 3
        dx, dy = 1 - x / mean, 1 - y / mean
        dz = -dx - dy
        if not len(x) or max(np.abs(dx).max(), np.abs(dy).max(), np.abs(dz).max()) < CLOSE:
            break
        root_x, root_y, root_z = np.sqrt(x), np.sqrt(y), np.sqrt(z)
        joined = root_x * root_y + root_z * (root_x + root_y)
        x, y, z = (x + joined) / 4, (y + joined) / 4, (z + joined) / 4
    e2, e3 = dx * dy - dz * dz, dx * dy * dz
    series = 1 - e2 / 10 + e3 / 14 + e2 * e2 / 24 - 3 * e2 * e3 / 44
    series += -5 * e2**3 / 208 + 3 * e3 * e3 / 104 + e2 * e2 * e3 / 16
    found: np.ndarray = series / np.sqrt(mean)
    return found


def _complete(kc: np.ndarray) -> np.ndarray:
    """K by the arithmetic-geometric mean."""
    a, b = np.ones_like(kc), kc
    while len(kc) and np.any(np.abs(a - b) > 1e-8 * a):
        a, b = (a + b) / 2, np.sqrt(a * b)
    found: np.ndarray = math.pi / (a + b)
    return found
