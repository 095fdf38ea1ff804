"""The whole job of whole_job.py as one would write it in Python with numba: it needs numba and NumPy, nothing else.

Run as ``python whole_job_numba.py IN OUT``: files as of whole_job.c.
"""

from __future__ import annotations

import sys
from math import sin
from typing import Any

import numba
import numpy as np

AMPLITUDES, SAMPLES, FIRST, LAST = 16, 128, 7, 20
G, L, T_END = 9.81, 1.0, 10.0
W = 1 / (2 - 2 ** (1 / 3))
WEIGHTS4 = (W, 1 - 2 * W, W)
WEIGHTS6 = (
    0.78451361047755726382,
    0.23557321335935813368,
    -1.17767998417887100695,
    1.31518632068391121889,
    -1.17767998417887100695,
    0.23557321335935813368,
    0.78451361047755726382,
)


@numba.njit
def acceleration(q: float) -> float:
    return -(G / L) * sin(q)


@numba.njit
def energy(q: float, v: float) -> float:
    s = sin(q / 2)
    return v * v / 2 + 2 * (G / L) * s * s


@numba.njit
def euler(q: float, v: float, h: float) -> tuple[float, float]:
    return q + h * v, v + h * acceleration(q)


@numba.njit
def symplectic_euler(q: float, v: float, h: float) -> tuple[float, float]:
    v += h * acceleration(q)
    return q + h * v, v


@numba.njit
def verlet(q: float, v: float, h: float) -> tuple[float, float]:
    v += h / 2 * acceleration(q)
    q += h * v
    return q, v + h / 2 * acceleration(q)


@numba.njit
def rk4(q: float, v: float, h: float) -> tuple[float, float]:
    k1, a1 = v, acceleration(q)
    k2, a2 = v + h / 2 * a1, acceleration(q + h / 2 * k1)
    k3, a3 = v + h / 2 * a2, acceleration(q + h / 2 * k2)
    k4, a4 = v + h * a3, acceleration(q + h * k3)
    return q + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)


@numba.njit
def yoshida4(q: float, v: float, h: float) -> tuple[float, float]:
    for w in WEIGHTS4:
        q += w * h / 2 * v
        v += w * h * acceleration(q)
        q += w * h / 2 * v
    return q, v


@numba.njit
def yoshida6(q: float, v: float, h: float) -> tuple[float, float]:
    for w in WEIGHTS6:
        q += w * h / 2 * v
        v += w * h * acceleration(q)
        q += w * h / 2 * v
    return q, v


def marcher(step: Any) -> Any:
    """The compiled loop over the steps of one method."""

    @numba.njit
    def march(q: float, h: float, n: int, exact: np.ndarray) -> tuple[float, float]:
        v = 0.0
        level, most, error = energy(q, v), 0.0, 0.0
        every, k = n // SAMPLES, 0
        for i in range(1, n + 1):
            q, v = step(q, v, h)
            most = max(most, abs(energy(q, v) - level))
            if i % every == 0:
                error = max(error, abs(q - exact[k]))
                k += 1
        return error, most / level

    return march


def main(words: list[str]) -> None:
    """Do the job."""
    given = np.fromfile(words[0])
    amplitudes, exact = given[:AMPLITUDES], given[AMPLITUDES:].reshape(AMPLITUDES, SAMPLES)
    found = []
    for step in (euler, symplectic_euler, verlet, rk4, yoshida4, yoshida6):
        march = marcher(step)
        for amplitude, angles in zip(amplitudes, exact, strict=True):
            found += [march(amplitude, T_END / 2**k, 2**k, angles) for k in range(FIRST, LAST + 1)]
    np.array(found).tofile(words[1])


if __name__ == "__main__":
    main(sys.argv[1:])
