"""What follows from a Runge-Kutta matrix and its weights: symplectic, symmetric, A-stable and L-stable methods.

See E. Hairer, C. Lubich and G. Wanner, Geometric Numerical Integration (2006), sections V.2 and VI.4, and E. Hairer and
G. Wanner, Solving Ordinary Differential Equations II (1996), section IV.3.
"""

from __future__ import annotations

from fractions import Fraction
from math import lcm
from typing import TYPE_CHECKING, Any, TypeAlias

from flint import fmpz_poly

from compare.methods.order.algebraic import Algebraic

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["Stability", "is_symmetric", "is_symplectic", "used_stages"]

Matrix: TypeAlias = "Sequence[Sequence[Any]]"
Polynomial: TypeAlias = list[Fraction]
"""Coefficients, the constant first."""


def is_symplectic(matrix: Matrix, hat: Matrix, b: Sequence[Any]) -> bool:
    """Whether b_i hat_ij + b_j a_ji = b_i b_j for all i and j; ``hat`` is the matrix itself where there is one."""
    stages = range(len(b))
    return all(b[i] * hat[i][j] + b[j] * matrix[j][i] == b[i] * b[j] for i in stages for j in stages)


def is_symmetric(matrix: Matrix, b: Sequence[Any]) -> bool:
    """Whether the method is its own adjoint: a_ij + a_(s+1-i)(s+1-j) = b_j for all i and j."""
    last = len(b) - 1
    stages = range(len(b))
    return all(matrix[i][j] + matrix[last - i][last - j] == b[j] for i in stages for j in stages)


def used_stages(matrix: Matrix, b: Sequence[Any]) -> tuple[int, ...]:
    """The stages on which the step depends: those with a weight, and those that such stages need."""
    used = {i for i, weight in enumerate(b) if weight != 0}
    while more := {j for i in used for j, a in enumerate(matrix[i]) if a != 0} - used:
        used |= more
    return tuple(sorted(used))


class Stability:
    """The stability function R(z) = det(I - z a + z 1 b^T)/det(I - z a) of a method.

    Attributes:
        numerator, denominator: integer polynomials without a common factor.
    """

    def __init__(self, matrix: Matrix, b: Sequence[Any]) -> None:
        shifted = [[entry - weight for entry, weight in zip(row, b, strict=True)] for row in matrix]
        above, below = _determinant(shifted), _determinant(matrix)
        scale = lcm(*(value.denominator for value in [*above, *below]))
        first, second = (fmpz_poly([int(value * scale) for value in p]) for p in (above, below))
        common = first.gcd(second)
        self.numerator, self.denominator = first // common, second // common

    @property
    def a_stable(self) -> bool:
        """Whether |R(z)| <= 1 where Re z <= 0: so on the imaginary axis, and no pole to its left or on it."""
        if any(not value.real > 0 for value, _ in self.denominator.complex_roots()):
            return False
        excess = _on_the_axis(self.denominator) - _on_the_axis(self.numerator)
        return excess == 0 or (excess[excess.degree()] > 0 and not _changes_sign(excess))

    @property
    def l_stable(self) -> bool:
        """Whether it is A-stable, and R(z) vanishes at infinity."""
        return self.a_stable and self.numerator.degree() < self.denominator.degree()


def _determinant(matrix: Matrix) -> Polynomial:
    """det(I - z a) in powers of z, by Faddeev and LeVerrier; rational, as it is for every method of this package."""
    size = range(len(matrix))
    coefficients: list[Any] = [Fraction(1)]
    product: list[list[Any]] = [[Fraction(0)] * len(matrix) for _ in size]
    for k in range(1, len(matrix) + 1):
        inner = [[product[i][j] + (coefficients[-1] if i == j else 0) for j in size] for i in size]
        product = [[sum((matrix[i][m] * inner[m][j] for m in size), Fraction(0)) for j in size] for i in size]
        coefficients.append(-sum((product[i][i] for i in size), Fraction(0)) / k)
    return [_rational(value) for value in coefficients]


def _rational(value: Fraction | Algebraic) -> Fraction:
    fraction = value.rational if isinstance(value, Algebraic) else value
    if fraction is None:
        raise ArithmeticError(f"the stability function has the coefficient {value}, which is not rational.")
    return fraction


def _on_the_axis(polynomial: fmpz_poly) -> fmpz_poly:
    """|p(iy)|^2 as a polynomial in x = y^2."""
    mirrored = fmpz_poly([int(c) * (-1) ** i for i, c in enumerate(polynomial.coeffs())])
    product = polynomial * mirrored
    return fmpz_poly([int(c) * (-1) ** i for i, c in enumerate(product.coeffs()[::2])])


def _changes_sign(polynomial: fmpz_poly) -> bool:
    """Whether a polynomial has a root of odd multiplicity on the positive axis."""
    odd = (factor for factor, times in polynomial.factor()[1] if times % 2)
    roots = [value for factor in odd if factor.degree() > 0 for value, _ in factor.complex_roots()]
    return any(value.imag == 0 and value.real > 0 for value in roots)
