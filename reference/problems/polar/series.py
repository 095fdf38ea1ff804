"""The two limits of the polar brachistochrone, each with its whole series and a proven bound on what it leaves out.

The half angle is a hypergeometric function of kappa = z0^3/(1 - z0), and the envelope law dtau = sqrt(kappa) dphi makes
one of the descent time:

    half_angle = (pi/3) (1 - 2F1(1/3, 2/3; 1; -27/(4 kappa))),
    descent_time = (pi/sqrt(kappa)) 3F2(1/2, 4/3, 5/3; 3/2, 2; -27/(4 kappa)).

Near the surface, z0 -> 1, they are series in 1/kappa, whose first terms are the cycloid's, pi/(2 kappa) and
pi/sqrt(kappa).  Near the centre, z0 -> 0, they are series in kappa^(1/3) (DLMF 15.8.2) that begin with the radial
fall's pi/3 and pi/2:

    half_angle = pi/3 - p sum f[n] (-x)^n + q sum g[n] (-x)^n,     x = 4 kappa/27,
    descent_time = pi/2 - sqrt(kappa) (p sum f[n] (n + 1/3)/(n + 5/6) (-x)^n - q sum g[n] (n + 2/3)/(n + 7/6) (-x)^n)

with K = K(sin(pi/12)), p = 2 K kappa^(1/3)/(3 3^(1/4)) and q = pi kappa^(2/3)/(9 3^(1/4) K).  The terms of each sum
alternate and fall, for kappa > 27/4 or for kappa < 27/4, so that the first one left out bounds the error.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any, NamedTuple

from reference.arithmetic.exact import counted

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["EQUAL", "Limit", "deep", "shallow", "surface_coefficients"]

EQUAL = Fraction(27, 4)
"""The kappa between the two series: z0 = 0.894."""
MAX_ORDER = 1000
THIRD = Fraction(1, 3)


class Limit(NamedTuple):
    """The half angle and the descent time by a truncated series, each with a bound on its error."""

    half_angle: Any
    half_angle_error: Any
    descent_time: Any
    descent_time_error: Any


def surface_coefficients(order: int) -> tuple[Fraction, ...]:
    """c[1], ..., c[order] of half_angle = (pi/3) sum c[n] kappa^-n; descent_time has c[n] n/(n - 1/2) kappa^(1/2 - n).

    Raises:
        ValueError: ``order`` is not an integer from 1 to MAX_ORDER.
    """
    found, c = [], Fraction(-1)
    for n in range(1, _checked(order) + 1):
        c *= -EQUAL * (n - 2 * THIRD) * (n - THIRD) / n**2
        found.append(c)
    return tuple(found)


def _checked(order: Any) -> int:
    return counted(order, "order", MAX_ORDER, least=1)


def shallow(m: Any, kappa: Any, order: int) -> Limit:
    """The first ``order`` terms about z0 = 1, for kappa > 27/4.

    Raises:
        ValueError: ``order`` is not an integer from 1 to MAX_ORDER.
    """
    coefficients = [m.number(c) for c in surface_coefficients(_checked(order) + 1)]
    angles = [m.pi() / 3 * c / kappa**n for n, c in enumerate(coefficients, 1)]
    times = [m.sqrt(kappa) * term * 2 * n / (2 * n - 1) for n, term in enumerate(angles, 1)]
    zero = m.number(Fraction(0))
    return Limit(sum(angles[:-1], zero), abs(angles[-1]), sum(times[:-1], zero), abs(times[-1]))


def deep(m: Any, kappa: Any, order: int) -> Limit:
    """The first ``order`` terms of each sum about z0 = 0, for kappa < 27/4.

    Raises:
        ValueError: ``order`` is not an integer from 1 to MAX_ORDER.
    """
    fourth, root = m.sqrt(m.sqrt(m.number(Fraction(3)))), m.sqrt(kappa)
    sine, cosine = ((m.sqrt(m.number(Fraction(6))) + sign * m.sqrt(m.number(Fraction(2)))) / 4 for sign in (-1, 1))
    first, cubic = m.elliptic(sine, cosine).first, m.power(kappa, THIRD)
    p, q = 2 * first * cubic / (3 * fourth), m.pi() * cubic * cubic / (9 * fourth * first)
    angle, time = m.pi() / 3, m.pi() / 2
    angle_error = time_error = m.number(Fraction(0))
    for scale, a in ((-p, THIRD), (q, 2 * THIRD)):
        terms = [(n, scale * m.number(c) * kappa**n) for n, c in enumerate(_deep_coefficients(a, order))]
        times = [root * term * m.number((n + a) / (n + a + Fraction(1, 2))) for n, term in terms]
        angle, angle_error = angle + sum(term for _, term in terms[:-1]), angle_error + abs(terms[-1][1])
        time, time_error = time + sum(times[:-1]), time_error + abs(times[-1])
    return Limit(angle, angle_error, time, time_error)


def _deep_coefficients(a: Fraction, order: int) -> Iterator[Fraction]:
    """The coefficients of kappa^n, n = 0 ... order, in 2F1(a, a; 2 a; -4 kappa/27); c = 2 a is 2/3 and 4/3."""
    c = Fraction(1)
    for n in range(_checked(order) + 1):
        yield c
        c *= -((n + a) ** 2) / ((n + 2 * a) * (n + 1) * EQUAL)
