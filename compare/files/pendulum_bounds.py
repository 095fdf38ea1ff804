"""The pendulum's exact motion in doubles, for many rows at once, and how far from the truth each number may be.

From the nearest of many nodes, whose states are proven, the addition theorem of ``motions`` leads to any time, with

    sn(u | m) = u - (1 + m) u^3/3! + (1 + 14 m + m^2) u^5/5! - (1 + 135 m + 135 m^2 + m^3) u^7/7! + ...,

of which what is left out is below 2^-52 u (DLMF 22.10.1; the coefficients are at most those of tan, and for m > 1 those
of sn(sqrt(m) u | 1/m)/sqrt(m)).  A time is reduced by whole periods in pairs of doubles, so that it loses nothing.
Nothing here is reported: it decides only which rows cannot matter, and the enclosure judges the others.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from reference.arithmetic.namespaces import BALL
from reference.arithmetic.precision import ctx
from reference.problems.pendulum.motions import addition
from reference.routes import enclosure

if TYPE_CHECKING:
    from flint import arb

    from reference.problems.pendulum import Pendulum

__all__ = ["SLACK", "Sketch", "sketch"]

SLACK = 2.0**-44
"""What any of these numbers may be wrong by, relative to its scale: some fifty roundings of 2^-53, ten times over."""
WIDEST = 1 / 64
"""The largest |u sqrt(max(1, m))| from a node."""
MOST_NODES = 1 << 14
PIECE_BITS = 38
"""Bits of the time from node to node, so that its multiples are doubles."""
BITS = 160
"""Working bits of the constants, whose pairs of doubles have 106."""
FARTHEST = 2.0**40
"""Periods up to which times are reduced."""


class Sketched(NamedTuple):
    """States at times: float64 [rows] each, and by how much each may differ from the exact one."""

    theta: np.ndarray
    omega: np.ndarray
    theta_within: np.ndarray
    omega_within: np.ndarray
    periods: np.ndarray
    """The time over the period, less whole ones, to SLACK."""


def sketch(problem: Pendulum) -> Sketch | None:
    """The sketch of a libration or rotation; None where its period is too long for one."""
    with ctx.workprec(BITS + problem.working_bits([])):
        form = problem.closed_form(BALL)
        scale = max(1.0, float(form.modulus))  # type: ignore[attr-defined]
        pieces = math.ceil(float(form.period * form.w) * scale / (2 * WIDEST))  # type: ignore[attr-defined]
        return Sketch(problem, pieces) if pieces <= MOST_NODES else None


class Sketch:
    """The motion by its states at ``pieces`` + 1 times, equally far from each other, over one period."""

    def __init__(self, problem: Pendulum, pieces: int) -> None:
        form = problem.closed_form(BALL)
        period = form.period  # type: ignore[attr-defined]
        self.w = float(form.w)
        self.frequency = float(1 / period)
        self.square = float(form.modulus**2)  # type: ignore[attr-defined]
        self._advance = 2 * math.pi * form.direction if problem.motion == "rotation" else 0.0  # type: ignore[attr-defined]
        self._period, self._frequency = _pair(period), _pair(1 / period)
        mantissa, exponent = math.frexp(float(period / pieces))
        self._piece = math.ldexp(round(math.ldexp(mantissa, PIECE_BITS)), exponent - PIECE_BITS)
        times = [place * Fraction(self._piece) for place in range(pieces + 2)]
        states = enclosure.balls(problem, "state", times, 64)
        self._theta, self._omega = (np.array([float(state[i]) for state in states]) for i in (0, 1))
        self._s, self._c = np.sin(self._theta / 2), np.cos(self._theta / 2)
        self._size = min(1.0, math.sqrt(self.square))
        self._fastest = 2 * self.w * math.sqrt(self.square)

    def states(self, t: np.ndarray, late: float) -> Sketched:
        """The states at times that may be wrong by ``late`` of themselves; beyond the reach nothing is certain."""
        periods, since, rest = self._reduced(t)
        node = np.clip(np.rint(since / self._piece), 0, len(self._theta) - 1).astype(np.intp)
        away = (since - node * self._piece) + rest
        s, c, p = self._s[node], self._c[node], self._omega[node] / (2 * self.w)
        sn = self._sn(self.w * away)
        small = sn * sn
        sine, cosine, rate, scale = addition(s, c, p, sn, np.sqrt(1 - small), np.sqrt(1 - self.square * small))
        turned = np.arctan2(sine * c - cosine * s, cosine * c + sine * s)
        theta = self._theta[node] + 2 * turned + periods * self._advance
        omega = 2 * self.w * rate / scale
        moved = np.where(np.abs(periods) < FARTHEST, np.abs(t) * late, np.nan) * self._fastest
        return Sketched(
            theta,
            omega,
            SLACK * (self._size + np.abs(theta)) + moved,
            SLACK * self._fastest + moved * self.w,
            (since + rest) * self._frequency[0],
        )

    def _reduced(self, t: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Whole periods, and what is left of t in a pair of doubles, within about [0, period]."""
        periods = np.floor(t * self._frequency[0])
        high, low = _product(periods, self._period[0])
        since = t - high  # exact: both are near each other, or one is zero
        return periods, since, -low - periods * self._period[1]

    def _sn(self, u: np.ndarray) -> np.ndarray:
        m, square = self.square, u * u
        fifth, seventh = 1 + m * (14 + m), 1 + m * (135 + m * (135 + m))
        inner = (fifth - seventh * square / 42) * square / 20
        found: np.ndarray = u * (1 - ((1 + m) - inner) * square / 6)
        return found


def _pair(value: arb) -> tuple[float, float]:
    """A number as the sum of two doubles."""
    high = float(value)
    return high, float(value - high)


def _product(a: np.ndarray, b: float) -> tuple[np.ndarray, np.ndarray]:
    """a b as the sum of two doubles, exactly (Dekker 1971)."""
    product = a * b
    (a_high, a_low), (b_high, b_low) = _split(a), _split(np.float64(b))
    return product, a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low)


def _split(a: np.ndarray | np.float64) -> tuple[np.ndarray, np.ndarray]:
    large = a * 134217729.0
    high = np.asarray(large - (large - a))
    return high, np.asarray(a - high)
