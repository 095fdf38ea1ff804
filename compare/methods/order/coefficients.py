"""The coefficients of multistep methods, derived: exact integrals of Lagrange's polynomials, and differences.

Time is measured in steps from the present, at 0; the new state is at 1, the past at -1, -2, ...
See E. Hairer, S. P. Norsett and G. Wanner, Solving Ordinary Differential Equations I (1993), chapters III.1 and III.10.
"""

from __future__ import annotations

from fractions import Fraction
from math import comb
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

__all__ = ["adams", "backward_differences", "integral_weights", "stormer", "velocity_weights"]


def integral_weights(nodes: Sequence[int], moment: Callable[[int], Fraction]) -> tuple[Fraction, ...]:
    """The weights w_j = integral of L_j, the Lagrange polynomials of the nodes, where that of x^q is moment(q)."""
    weights = []
    for node in nodes:
        polynomial = [Fraction(1)]
        for other in nodes:
            if other != node:
                shifted = [Fraction(0), *polynomial]
                scaled = [*(other * coefficient for coefficient in polynomial), Fraction(0)]
                polynomial = [(a - b) / (node - other) for a, b in zip(shifted, scaled, strict=True)]
        weights.append(sum((c * moment(q) for q, c in enumerate(polynomial)), Fraction(0)))
    return tuple(weights)


def adams(steps: int, *, implicit: bool) -> tuple[tuple[Fraction, ...], tuple[Fraction, ...]]:
    """alpha and beta of y_{n+1} - y_n = integral of f from 0 to 1, f interpolated through the past k values.

    That are those at 0, -1, ..., 1 - k, and in an implicit method that at 1 besides.
    """
    nodes = range(1 - steps, 2 if implicit else 1)
    beta = integral_weights(nodes, lambda q: Fraction(1, q + 1))
    alpha = (Fraction(0),) * (steps - 1) + (Fraction(-1), Fraction(1))
    return alpha, beta if implicit else (*beta, Fraction(0))


def backward_differences(steps: int) -> tuple[tuple[Fraction, ...], tuple[Fraction, ...]]:
    """alpha and beta of sum_{i=1}^k (1/i) nabla^i y_{n+k} = h f_{n+k}, divided so that alpha_k = 1."""
    alpha = [
        sum(((-1) ** (steps - j) * Fraction(comb(i, steps - j), i) for i in range(1, steps + 1)), Fraction(0))
        for j in range(steps + 1)
    ]
    return tuple(a / alpha[-1] for a in alpha), (Fraction(0),) * steps + (1 / alpha[-1],)


def stormer(steps: int, *, implicit: bool) -> tuple[Fraction, ...]:
    """beta of q_{n+1} - 2 q_n + q_{n-1} = h^2 (integral of (1 - |x|) F from -1 to 1), F interpolated as above."""
    nodes = range(1 - steps, 2 if implicit else 1)
    beta = integral_weights(nodes, lambda q: Fraction(1 + (-1) ** q, (q + 1) * (q + 2)))
    return beta if implicit else (*beta, Fraction(0))


def velocity_weights(count: int) -> tuple[Fraction, ...]:
    """w of q'_n = (q_n - q_{n-1})/h + h sum_j w_j F_{n-j}: the integral of (1 + x) F from -1 to 0, latest first."""
    return integral_weights(range(0, -count, -1), lambda q: Fraction((-1) ** q, (q + 1) * (q + 2)))
