"""The pendulum's exact motion in doubles, for many states at once, and how far from the truth each number may be.

From the nearest of many nodes, whose states are proven, the addition theorem of ``motions`` leads to any time, with

    sn(u | m) = u - (1 + m) u^3/3! + (1 + 14 m + m^2) u^5/5! - (1 + 135 m + 135 m^2 + m^3) u^7/7! + ...,

of which what is left out is below 2^-52 u (DLMF 22.10.1; the coefficients are at most those of tan, and for m > 1 those
of sn(sqrt(m) u | 1/m)/sqrt(m)).  A time is reduced by whole periods in pairs of doubles, so that it loses nothing.

Phase, amplitude and energy of a state follow from s, c = sin, cos(theta/2) and p = theta'/(2 w).  What is lost comes of
the differences c - |p|, near the separatrix, and of sin(theta/2) where theta has whole turns:

    kappa = 1 + (1 + |theta|) (c + |p|)/|c^2 - p^2| + |theta|/k where |theta| > 4

times a few dozen roundings bounds the relative error of what is computed from s, c and p.
Nothing here is reported: it decides only which states cannot matter, and the enclosure judges the others.
"""

from __future__ import annotations

import math
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from flint import arb

from reference.arithmetic.namespaces import BALL, NUMPY
from reference.arithmetic.precision import ctx
from reference.problems.pendulum.motions import addition
from reference.routes import enclosure
from reference.state_bounds import Bounds, Found

if TYPE_CHECKING:
    from reference.problem import Problem

__all__ = ["SLACK", "PendulumBounds", "Sketch", "sketch"]

TURNED = 4.0
"""rad: beyond, the sine of half an angle has lost digits."""
CLOSE = 1 / 100
"""Carlson's series, of which the terms of the eighth degree are left out, is taken where its variables are below."""


class Places:
    """Where states of a libration's or rotation's kind are, against the exact motion."""

    def __init__(self, problem: Problem, *, rotates: bool) -> None:
        self._problem, self._rotates = problem, rotates
        self._direction = 1 if problem.start[1] > 0 else -1
        self._parameters = problem.parameters_in(NUMPY)
        with ctx.workprec(BITS + problem.working_bits([])):
            kind = problem.orbits()
            start = None if kind is None else kind.truth(Fraction(0))
            self._phase = float("nan") if start is None or start.phase is None else float(start.phase)
            self._amplitude = float("nan") if start is None or start.amplitude is None else float(start.amplitude)
            parameters = problem.parameters_in(BALL)
            y = problem.start_in(BALL)
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


SLACK = 2.0**-44
"""What any of these numbers may be wrong by, relative to its scale: some fifty roundings of 2^-53, ten times over."""
WIDEST = 1 / 64
"""The largest |u sqrt(max(1, m))| from a node."""
MOST_NODES = 1 << 14
PIECE_BITS = 38
"""Bits of the time from node to node, so that its multiples are doubles."""
BITS = 160
"""Working bits of the constants, whose pairs of doubles have 106."""
KEPT = 4
"""Sketches of the problems that were asked for last."""
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


@lru_cache(maxsize=KEPT)
def sketch(problem: Problem, *, rotates: bool) -> Sketch | None:
    """The sketch of a libration or rotation; None where its period is too long for one."""
    with ctx.workprec(BITS + problem.working_bits([])):
        form: Any = problem.closed_form(BALL)
        scale = max(1.0, float(form.modulus))
        pieces = math.ceil(float(form.period * form.w) * scale / (2 * WIDEST))
        return Sketch(problem, pieces, rotates=rotates) if pieces <= MOST_NODES else None


class Sketch:
    """The motion by its states at ``pieces`` + 1 times, equally far from each other, over one period.

    Attributes:
        w: sqrt(g/length), ``period`` the period and ``frequency`` its inverse.
        theta: the states at those times, and ``omega``.
        piece: what lies between two of them, s.
    """

    def __init__(self, problem: Problem, pieces: int, *, rotates: bool) -> None:
        form: Any = problem.closed_form(BALL)
        period = form.period
        self.w = float(form.w)
        self.frequency = float(1 / period)
        self.period = float(period)
        self.square = float(form.modulus**2)
        self._advance = 2 * math.pi * form.direction if rotates else 0.0
        self._period, self._frequency = _pair(period), _pair(1 / period)
        mantissa, exponent = math.frexp(float(period / pieces))
        self.piece = math.ldexp(round(math.ldexp(mantissa, PIECE_BITS)), exponent - PIECE_BITS)
        times = [place * Fraction(self.piece) for place in range(pieces + 2)]
        states = enclosure.balls(problem, "state", times, 64)
        self.theta, self.omega = (np.array([float(state[i]) for state in states]) for i in (0, 1))
        self._s, self._c = np.sin(self.theta / 2), np.cos(self.theta / 2)
        self._size = min(1.0, math.sqrt(self.square))
        self._fastest = 2 * self.w * math.sqrt(self.square)

    def states(self, t: np.ndarray, late: float) -> Sketched:
        """The states at times that may be wrong by ``late`` of themselves; beyond the reach nothing is certain."""
        periods, since, rest = self.reduced(t)
        node = np.clip(np.rint(since / self.piece), 0, len(self.theta) - 1).astype(np.intp)
        away = (since - node * self.piece) + rest
        s, c, p = self._s[node], self._c[node], self.omega[node] / (2 * self.w)
        sn = self._sn(self.w * away)
        small = sn * sn
        sine, cosine, rate, scale = addition(s, c, p, sn, np.sqrt(1 - small), np.sqrt(1 - self.square * small))
        turned = np.arctan2(sine * c - cosine * s, cosine * c + sine * s)
        theta = self.theta[node] + 2 * turned + periods * self._advance
        omega = 2 * self.w * rate / scale
        moved = np.where(np.abs(periods) < FARTHEST, np.abs(t) * late, np.nan) * self._fastest
        return Sketched(
            theta,
            omega,
            SLACK * (self._size + np.abs(theta)) + moved,
            SLACK * self._fastest + moved * self.w,
            (since + rest) * self._frequency[0],
        )

    def reduced(self, t: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
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


class PendulumBounds:
    """What many states of a libration or a rotation share."""

    def __init__(self, problem: Problem, *, rotates: bool) -> None:
        self._sketch, self._places = sketch(problem, rotates=rotates), Places(problem, rotates=rotates)

    def bounds(self, numbers: np.ndarray, rounding: float) -> Bounds | None:
        """The bounds of rows of t, theta and omega, each of which may be wrong by ``rounding`` of itself.

        None where the motion has no sketch.
        """
        if self._sketch is None:
            return None
        t, theta, omega = numbers.T
        with np.errstate(all="ignore"):
            true = self._sketch.states(t, rounding)
            truths = np.stack([true.theta, true.omega], axis=1)
            apart = np.stack([true.theta_within, true.omega_within], axis=1)
            within = apart + SLACK * np.abs(numbers[:, 1:])
            about = numbers[:, 1:] - truths
            errors, least = np.abs(about) + within, np.abs(truths) - within
            digits = np.where(least > 0, np.maximum(0.0, -np.log10(errors / least) - SLACK), 0.0)
            found = self._places.found(theta, omega, true, np.abs(t) * rounding * self._sketch.frequency)
        return Bounds(about, errors, digits, np.abs(truths) + apart, found)
