"""The order and the zero-stability of multistep methods by algebra: exact, with no step taken.

See E. Hairer, S. P. Norsett and G. Wanner, Solving Ordinary Differential Equations I (1993), chapters III.2 and III.10,
and J. J. H. Miller, J. Inst. Maths Applics 8 (1971), 397, for the polynomials whose zeros are in the unit disc.

The coefficients of multistep methods, derived: exact integrals of Lagrange's polynomials, and differences.

Time is measured in steps from the present, at 0; the new state is at 1, the past at -1, -2, ...
See E. Hairer, S. P. Norsett and G. Wanner, Solving Ordinary Differential Equations I (1993), chapters III.1 and III.10.
"""

from __future__ import annotations

from fractions import Fraction
from math import comb, perm
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

__all__ = ["adams", "backward_differences", "is_zero_stable", "multistep_order", "stormer", "velocity_weights"]


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


Polynomial: TypeAlias = list[Fraction]
"""Coefficients, lowest first, the last not zero; [] is zero."""


def multistep_order(alpha: Sequence[Fraction], beta: Sequence[Fraction], derivative: int = 1, limit: int = 12) -> int:
    """The order p <= limit of sum_j alpha_j y_{n+j} = h^d sum_j beta_j y_{n+j}^(d), d the derivative, exactly.

    It holds for the powers t^q, q < p + d: sum_j alpha_j j^q = q (q-1) ... (q-d+1) sum_j beta_j j^(q-d).
    """
    for q in range(limit + derivative):
        left = sum((weight * j**q for j, weight in enumerate(alpha)), Fraction(0))
        factor = perm(q, derivative)
        right = sum((weight * factor * j ** max(q - derivative, 0) for j, weight in enumerate(beta)), Fraction(0))
        if left != right:
            return q - derivative
    return limit


def is_zero_stable(alpha: Sequence[Fraction], multiplicity: int = 1) -> bool:
    """Whether the zeros of sum_j alpha_j z^j are in the unit disc, those on the circle of at most this multiplicity.

    The multiplicity is 1 for first-order equations and 2 for q'' = F(q).
    """
    polynomial = _trimmed(list(alpha))
    for _ in range(multiplicity - 1):
        repeated = _common(polynomial, _derivative(polynomial))
        if not _is_simple_von_neumann(_quotient(polynomial, repeated)):
            return False
        polynomial = repeated
    return _is_simple_von_neumann(polynomial)


def _is_simple_von_neumann(polynomial: Polynomial) -> bool:
    """Whether all zeros are in the closed unit disc and those on the circle are simple (Miller's theorem 6.3)."""
    if len(polynomial) <= 1:
        return True
    reduced = _reduced(polynomial)
    if not reduced:
        return _is_schur(_derivative(polynomial))
    return abs(polynomial[0]) < abs(polynomial[-1]) and _is_simple_von_neumann(reduced)


def _is_schur(polynomial: Polynomial) -> bool:
    """Whether all zeros are inside the unit circle (Miller's theorem 6.1)."""
    if len(polynomial) <= 1:
        return True
    return abs(polynomial[0]) < abs(polynomial[-1]) and _is_schur(_reduced(polynomial))


def _reduced(polynomial: Polynomial) -> Polynomial:
    """(p*(0) p(z) - p(0) p*(z))/z, p* the polynomial with its coefficients in reverse."""
    first, last = polynomial[0], polynomial[-1]
    return _trimmed([last * a - first * b for a, b in zip(polynomial, polynomial[::-1], strict=True)][1:])


def _trimmed(polynomial: Polynomial) -> Polynomial:
    while polynomial and polynomial[-1] == 0:
        polynomial = polynomial[:-1]
    return polynomial


def _derivative(polynomial: Polynomial) -> Polynomial:
    return [power * coefficient for power, coefficient in enumerate(polynomial)][1:]


def _divided(a: Polynomial, b: Polynomial) -> tuple[Polynomial, Polynomial]:
    """Quotient and remainder."""
    quotient = [Fraction(0)] * max(len(a) - len(b) + 1, 0)
    rest = list(a)
    for place in range(len(a) - len(b), -1, -1):
        quotient[place] = rest[place + len(b) - 1] / b[-1]
        for i, coefficient in enumerate(b):
            rest[place + i] -= quotient[place] * coefficient
    return quotient, _trimmed(rest)


def _quotient(a: Polynomial, b: Polynomial) -> Polynomial:
    return _divided(a, b)[0]


def _common(a: Polynomial, b: Polynomial) -> Polynomial:
    """The greatest common divisor, by Euclid."""
    while b:
        a, b = b, _divided(a, b)[1]
    return a
