"""The stability function of a one-step method, and what it decides: A-stable, L-stable.

On y' = lambda y a step multiplies by R(z), z = h lambda.  That |R| <= 1 in the left half-plane is decided by
polynomials in any ordered field, rational or algebraic numbers exactly: no pole there by Routh's scheme, and no point
of the imaginary axis where |R| > 1 by Sturm's theorem.  Where coefficients are zeros known by their enclosures the
signs are those of balls.  See E. Hairer and G. Wanner, Solving Ordinary Differential Equations II (1996), section IV.3,
and E. Hairer, S. P. Nørsett and G. Wanner, Solving Ordinary Differential Equations I (1993), section I.13.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise, zip_longest
from typing import TYPE_CHECKING, Any, TypeAlias

from flint import arb

from compare.methods.order.algebraic import Algebraic, enclose, provable, vanishes
from reference.arithmetic.precision import ctx

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.methods.kinds.rosenbrock import Rosenbrock

__all__ = ["Stability", "stability_of_rosenbrock"]

Polynomial: TypeAlias = list[Any]
"""Coefficients, the constant first, the last of them not zero; empty for zero."""

STABILITY_BITS = 600


class Stability:
    """The stability function R(z) = det(I - z a + z 1 b^T)/det(I - z a) of a method with the matrix a, the weights b.

    Attributes:
        numerator, denominator: polynomials without a common factor, their coefficients with the constant first.
    """

    def __init__(self, matrix: Sequence[Sequence[Any]], b: Sequence[Any]) -> None:
        size = len(b)
        with ctx.workprec(STABILITY_BITS):
            values = provable([*b, *(entry for row in matrix for entry in row)])
            if any(isinstance(value, arb) for value in values):
                values = list(map(arb, values))
            weights, rows = values[:size], [values[size * i : size * (i + 1)] for i in range(1, size + 1)]
            shifted = [[entry - weight for entry, weight in zip(row, weights, strict=True)] for row in rows]
            above, below = _determinant(shifted), _determinant(rows)
            common = _common(above, below)
            self.numerator, self.denominator = _divided(above, common)[0], _divided(below, common)[0]

    @property
    def a_stable(self) -> bool:
        """Whether |R(z)| <= 1 where Re z <= 0: so on the imaginary axis, and no pole to its left or on it."""
        with ctx.workprec(STABILITY_BITS):
            if not _all_to_the_left([value * (-1) ** i for i, value in enumerate(self.denominator)]):
                return False
            excess = _sum(_on_the_axis(self.denominator), [0 - value for value in _on_the_axis(self.numerator)])
            return not excess or (_positive(excess[-1]) and not _changes_sign(excess))

    @property
    def l_stable(self) -> bool:
        """Whether it is A-stable, and R(z) vanishes at infinity."""
        return self.a_stable and len(self.numerator) < len(self.denominator)


def stability_of_rosenbrock(method: Rosenbrock) -> Stability:
    """That of the Runge-Kutta method with the matrix beta: on a linear equation the two are the same."""
    with ctx.workprec(STABILITY_BITS):
        slopes, (weights,) = method.slopes(method.m)
        return Stability([[*row, *[0] * (method.stages - len(row))] for row in slopes.beta], weights)


def _positive(value: Any) -> bool:
    """Whether a number that is not zero is above it."""
    return bool((enclose(value) if isinstance(value, (int, Fraction, Algebraic)) else value) > 0)


def _trimmed(values: Sequence[Any]) -> Polynomial:
    """Without the zeros at the end."""
    found = list(values)
    while found and vanishes(found[-1]):
        found.pop()
    return found


def _determinant(matrix: Sequence[Sequence[Any]]) -> Polynomial:
    """det(I - z a) in powers of z, by Faddeev and LeVerrier."""
    size = range(len(matrix))
    nothing = matrix[0][0] - matrix[0][0]
    coefficients: Polynomial = [nothing + 1]
    product: list[list[Any]] = [[nothing] * len(matrix) for _ in size]
    for k in range(1, len(matrix) + 1):
        inner = [[product[i][j] + (coefficients[-1] if i == j else 0) for j in size] for i in size]
        product = [[_total(matrix[i][m] * inner[m][j] for m in size) for j in size] for i in size]
        coefficients.append((0 - _total(product[i][i] for i in size)) / k)
    return _trimmed(coefficients)


def _total(values: Any) -> Any:
    first, *others = values
    return sum(others, first)


def _sum(a: Polynomial, b: Polynomial) -> Polynomial:
    return _trimmed([first + second for first, second in zip_longest(a, b, fillvalue=0)])


def _product(a: Polynomial, b: Polynomial) -> Polynomial:
    found: Polynomial = [0] * (len(a) + len(b) - 1)
    for i, first in enumerate(a):
        for j, second in enumerate(b):
            found[i + j] = first * second + found[i + j]
    return found


def _divided(a: Polynomial, b: Polynomial) -> tuple[Polynomial, Polynomial]:
    """Quotient and remainder."""
    rest, quotient = list(a), []
    while len(rest) >= len(b):
        factor = rest.pop() / b[-1]
        quotient.append(factor)
        for i, value in enumerate(b[:-1], start=len(rest) + 1 - len(b)):
            rest[i] = rest[i] - factor * value
    return quotient[::-1], _trimmed(rest)


def _common(a: Polynomial, b: Polynomial) -> Polynomial:
    """The greatest common divisor, by Euclid."""
    while b:
        a, b = b, _divided(a, b)[1]
    return [value / a[-1] for value in a]


def _derivative(polynomial: Polynomial) -> Polynomial:
    return [value * i for i, value in enumerate(polynomial)][1:]


def _on_the_axis(polynomial: Polynomial) -> Polynomial:
    """|p(iy)|^2 as a polynomial in x = y^2."""
    mirrored = [value * (-1) ** i for i, value in enumerate(polynomial)]
    return [value * (-1) ** i for i, value in enumerate(_product(polynomial, mirrored)[::2])]


def _all_to_the_left(polynomial: Polynomial) -> bool:
    """Whether every zero has a negative real part, by Routh's scheme."""
    above, below = _trimmed(polynomial[::-1][::2]), list(polynomial[::-1][1::2])
    upward = _positive(above[0])
    for _ in range(len(polynomial) - 1):
        if vanishes(below[0]) or _positive(below[0]) != upward:
            return False
        factor = above[0] / below[0]
        above, below = below, [x - factor * y for x, y in zip_longest(above[1:], below[1:], fillvalue=0)]
    return True


def _changes_sign(polynomial: Polynomial) -> bool:
    """Whether a polynomial has a zero of odd multiplicity on the positive axis."""
    first = next(i for i, value in enumerate(polynomial) if not vanishes(value))
    rest = polynomial[first:]
    common = _common(rest, _derivative(rest))
    factor = _divided(rest, common)[0]
    times = 1
    while len(factor) > 1:
        shared = _common(factor, common)
        if times % 2 and _positive_zeros(_divided(factor, shared)[0]):
            return True
        factor, common, times = shared, _divided(common, shared)[0], times + 1
    return False


def _positive_zeros(polynomial: Polynomial) -> int:
    """How many zeros a polynomial with simple zeros, none of them 0, has on the positive axis, by Sturm's theorem."""
    if len(polynomial) < 2:
        return 0
    chain = [polynomial, _derivative(polynomial)]
    while rest := _divided(*chain[-2:])[1]:
        chain.append([0 - value for value in rest])
    at_zero = [value for value in (member[0] for member in chain) if not vanishes(value)]
    return _changes(at_zero) - _changes([member[-1] for member in chain])


def _changes(values: Sequence[Any]) -> int:
    signs = [_positive(value) for value in values]
    return sum(first != second for first, second in pairwise(signs))
