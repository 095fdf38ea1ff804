"""The pendulum computed again, sharing nothing with the package: other formulas, other algorithms, own rounding."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from flint import arb, fmpq

from reference.arithmetic.precision import ctx, mp

if TYPE_CHECKING:
    from collections.abc import Sequence


def nearest_double(x: Fraction) -> float:
    """The binary64 number nearest to x, of two equally near ones the one whose last bit is 0.

    Found by comparing distances among neighbours as exact fractions; no rounding rule of the package is used.
    """
    guess = x.numerator / x.denominator
    candidates = {math.nextafter(guess, -math.inf), guess, math.nextafter(guess, math.inf)}

    def distance_then_evenness(candidate: float) -> tuple[Fraction, int]:
        last_bit = int(candidate / math.ulp(candidate)) & 1 if candidate else 0
        return abs(Fraction(candidate) - x), last_bit

    return min(candidates, key=distance_then_evenness)


def correct_limbs(x: Fraction, count: int) -> list[float]:
    """x as a sum of ``count`` doubles, each the nearest to what the ones before it leave."""
    found: list[float] = []
    for _ in range(count):
        found.append(nearest_double(x))
        x -= Fraction(found[-1])
    return found


def fraction(x: Any) -> Fraction:
    """An mpmath number or the midpoint of a ball as the fraction that it is."""
    if isinstance(x, arb):
        mantissa, exponent = x.mid().man_exp()
    else:
        sign, mantissa, exponent, _ = x._mpf_
        mantissa = -mantissa if sign else mantissa
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


def mpmath_states(theta0: Any, g: Any, length: Any, times: Sequence[Any], bits: int) -> list[tuple[Fraction, Fraction]]:
    """(theta, theta') by mpmath's elliptic functions, with cd and sd where the package has cn and sn/dn.

    theta = 2 asin(k cd u),  theta' = -2 k omega0 kc sd u
    """
    with mp.workprec(bits):
        half, omega0 = mp.mpf(theta0) / 2, mp.sqrt(mp.mpf(g) / mp.mpf(length))
        k, kc = mp.sin(half), mp.cos(half)
        found = []
        for t in times:
            u = omega0 * mp.mpf(t)
            theta = 2 * mp.asin(k * mp.ellipfun("cd", u, k=k))
            omega = -2 * k * kc * omega0 * mp.ellipfun("sd", u, k=k)
            found.append((fraction(theta), fraction(omega)))
        return found


def ball(x: float) -> arb:
    """A double as the point ball that it is."""
    numerator, denominator = x.as_integer_ratio()
    return arb(fmpq(numerator, denominator))


def landen_states(
    theta0: float, g: float, length: float, times: Sequence[float], bits: int
) -> list[tuple[Fraction, Fraction]]:
    """(theta, theta') by descending Landen transformations of the amplitude: the agm and arcsines, no theta functions.

    With phi = am(u + K): theta = 2 asin(k sin phi), theta' = 2 k omega0 cos phi (DLMF 22.20.3-6).

    Raises:
        AssertionError: a ball is not accurate to ``bits`` bits.
    """
    with ctx.workprec(2 * bits):
        half, omega0 = ball(theta0) / 2, (ball(g) / ball(length)).sqrt()
        k = half.sin()
        means, ratios = [(arb(1), half.cos())], []
        while not ratios or ratios[-1].abs_upper() > arb(2) ** (-bits):
            a, b = means[-1]
            means.append(((a + b) / 2, (a * b).sqrt()))
            ratios.append((a - b) / 2 / means[-1][0])
        a = means[-1][0]
        quarter = arb.pi() / (2 * a)
        found = []
        for t in times:
            phi = 2 ** len(ratios) * a * (omega0 * ball(t) + quarter)
            for ratio in reversed(ratios):
                phi = (phi + (ratio * phi.sin()).asin()) / 2
            state = 2 * (k * phi.sin()).asin(), 2 * k * omega0 * phi.cos()
            assert all(x.rel_accuracy_bits() > bits for x in state)
            found.append((fraction(state[0]), fraction(state[1])))
        return found


def general_state(theta0: Any, omega0: Any, g: Any, length: Any, t: Any) -> tuple[Any, Any]:
    """(theta, theta') of libration or rotation in mpmath's numbers, by the amplitude function with the start's phase.

    sin(theta/2) = k sn(w t + phase) in libration, theta = 2 am(k w t + phase, 1/k) in rotation; the package spares
    itself the phase.  Smooth in every argument, so that mpmath can differentiate it.
    """
    w, half, rate = mp.sqrt(g / length), theta0 / 2, omega0 / 2
    kk = mp.sin(half) ** 2 + (rate / w) ** 2
    if kk < 1:
        u = w * t + mp.ellipf(mp.atan2(mp.sin(half), rate / w), kk)
        theta = 2 * mp.asin(mp.sqrt(kk) * mp.ellipfun("sn", u, m=kk))
        return theta, 2 * w * mp.sqrt(kk) * mp.ellipfun("cn", u, m=kk)
    k, sign = mp.sqrt(kk), 1 if omega0 > 0 else -1
    u = k * w * t + mp.ellipf(sign * half, 1 / kk)
    turns = mp.nint(u / (2 * mp.ellipk(1 / kk)))
    rest = u - 2 * turns * mp.ellipk(1 / kk)
    theta = sign * 2 * (mp.asin(mp.ellipfun("sn", rest, m=1 / kk)) + turns * mp.pi)
    return theta, sign * 2 * w * k * mp.ellipfun("dn", u, m=1 / kk)


def released_state(theta0: Any, g: Any, length: Any, t: Any) -> tuple[Any, Any]:
    """The same for a release from rest, by cd and sd."""
    w, k = mp.sqrt(g / length), mp.sin(theta0 / 2)
    u = w * t
    rate = -2 * k * mp.cos(theta0 / 2) * w * mp.ellipfun("sd", u, k=k)
    return 2 * mp.asin(k * mp.ellipfun("cd", u, k=k)), rate


def condition_number(theta0: Any, omega0: Any, g: Any, length: Any, t: Any) -> Any:
    """The largest singular value of d(theta, theta'/w)/d(theta0, omega0/w): differences, then an eigenvalue."""
    w = mp.sqrt(g / length)

    def scaled(angle: Any, rate: Any) -> tuple[Any, Any]:
        theta, omega = general_state(angle, rate * w, g, length, t)
        return theta, omega / w

    start = (theta0, omega0 / w)
    (a, b), (c, d) = (
        [mp.diff(lambda x, y, i=i: scaled(x, y)[i], start, order) for order in ((1, 0), (0, 1))] for i in range(2)
    )
    trace = a * a + b * b + c * c + d * d
    return mp.sqrt((trace + mp.sqrt(trace**2 - 4 * (a * d - b * c) ** 2)) / 2)


def agm_period(theta0: Any, g: Any, length: Any) -> Any:
    """The period of a release from rest, by Gauss' arithmetic-geometric mean."""
    return 2 * mp.pi * mp.sqrt(length / g) / mp.agm(1, mp.cos(theta0 / 2))
