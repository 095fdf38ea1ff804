"""Exact series in an amplitude a whose coefficients are sums of cosines: sum of c a^n cos(k x), n up to ORDER.

They decide what an expansion in powers of the amplitude says, with no number rounded.
"""

from __future__ import annotations

from collections import defaultdict
from fractions import Fraction
from math import factorial
from typing import TypeAlias

__all__ = ["ORDER", "Cosines", "coefficient", "plus", "sine", "times"]

ORDER = 5
Cosines: TypeAlias = dict[tuple[int, int], Fraction]
"""c by (n, k)."""


def times(p: Cosines, q: Cosines) -> Cosines:
    """The product, from cos(i x) cos(j x) = (cos((i - j) x) + cos((i + j) x))/2, up to ORDER."""
    found: dict[tuple[int, int], Fraction] = defaultdict(Fraction)
    for (n, i), c in p.items():
        for (m, j), d in q.items():
            if n + m <= ORDER:
                found[n + m, abs(i - j)] += c * d / 2
                found[n + m, i + j] += c * d / 2
    return _kept(found)


def plus(*series: Cosines) -> Cosines:
    """The sum."""
    found: dict[tuple[int, int], Fraction] = defaultdict(Fraction)
    for one in series:
        for key, c in one.items():
            found[key] += c
    return _kept(found)


def sine(p: Cosines) -> Cosines:
    """The sine of a series that begins with a, from Taylor's series."""
    power, terms = p, [p]
    for n in range(3, ORDER + 1, 2):
        power = times(times(power, p), p)
        terms.append({key: (-1) ** (n // 2) * c / factorial(n) for key, c in power.items()})
    return plus(*terms)


def coefficient(p: Cosines, n: int) -> dict[int, Fraction]:
    """What a^n is multiplied by: c by k."""
    return {k: c for (m, k), c in p.items() if m == n}


def _kept(found: dict[tuple[int, int], Fraction]) -> Cosines:
    return {key: c for key, c in found.items() if c != 0}
