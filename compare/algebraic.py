"""Exact coefficients: rationals, and elements of a field Q(n^(1/d)).

A tableau holds ``Fraction``s; the triple jumps of Yoshida and Suzuki need 2^(1/3) and 4^(1/3).  Arithmetic on either is
exact, so that order conditions are proven, not estimated, and a coefficient is rounded once, to whatever type runs it.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TypeAlias

from flint import arb, fmpq, fmpq_poly

from reference.arithmetic import BALL

__all__ = ["Algebraic", "Coefficient", "Q", "enclose", "root"]

Q = Fraction


class Algebraic:
    """A polynomial in r = n^(1/d) with rational coefficients, reduced by r^d = n."""

    def __init__(self, polynomial: fmpq_poly, radicand: int, degree: int) -> None:
        self.radicand, self.degree = radicand, degree
        self._modulus = fmpq_poly([-radicand] + [0] * (degree - 1) + [1])
        self.polynomial = polynomial % self._modulus

    def _same_field(self, polynomial: fmpq_poly) -> Algebraic:
        return Algebraic(polynomial, self.radicand, self.degree)

    def _lift(self, other: Coefficient | int) -> fmpq_poly:
        if isinstance(other, Algebraic):
            if (other.radicand, other.degree) != (self.radicand, self.degree):
                raise ValueError(f"{other} and {self} are of different fields; numbers of one field are accepted.")
            return other.polynomial
        return fmpq_poly([fmpq(other.numerator, other.denominator)])

    def __add__(self, other: Coefficient | int) -> Algebraic:
        return self._same_field(self.polynomial + self._lift(other))

    def __neg__(self) -> Algebraic:
        return self._same_field(-self.polynomial)

    def __sub__(self, other: Coefficient | int) -> Algebraic:
        return self + (-other)

    def __rsub__(self, other: Coefficient | int) -> Algebraic:
        return -self + other

    def __mul__(self, other: Coefficient | int) -> Algebraic:
        return self._same_field(self.polynomial * self._lift(other))

    def __rtruediv__(self, other: Coefficient | int) -> Algebraic:
        divisor, inverse, _ = self.polynomial.xgcd(self._modulus)
        if divisor.degree() != 0:
            raise ZeroDivisionError(f"{self} has no inverse.")
        return self._same_field(inverse / divisor[0]) * other

    def __truediv__(self, other: Coefficient | int) -> Algebraic:
        return (1 / other) * self if isinstance(other, Algebraic) else self * (1 / Fraction(other))

    __radd__ = __add__
    __rmul__ = __mul__

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, (Algebraic, Fraction, int)):
            return NotImplemented
        return bool(self.polynomial == self._lift(other) % self._modulus)

    def __hash__(self) -> int:
        return hash((self.radicand, self.degree, str(self.polynomial)))

    def __repr__(self) -> str:
        powers = [self.polynomial[i] for i in range(self.degree)]
        symbol = f"{self.radicand}^(1/{self.degree})"
        names = ["", symbol, *(f"{self.radicand}^({i}/{self.degree})" for i in range(2, self.degree))]
        terms = [f"{c}" if not name else f"{c}*{name}" for c, name in zip(powers, names, strict=True) if c != 0]
        return " + ".join(terms).replace("+ -", "- ") or "0"

    def __reduce__(self) -> tuple[object, ...]:
        coefficients = [(int(self.polynomial[i].p), int(self.polynomial[i].q)) for i in range(self.degree)]
        return _rebuilt, (coefficients, self.radicand, self.degree)

    def ball(self) -> arb:
        """The enclosure at the precision in force, by Horner's rule."""
        r, value = arb(self.radicand).root(self.degree), arb(0)
        for i in reversed(range(self.degree)):
            value = value * r + arb(self.polynomial[i])
        return value


def _rebuilt(coefficients: list[tuple[int, int]], radicand: int, degree: int) -> Algebraic:
    """An unpickled number."""
    return Algebraic(fmpq_poly([fmpq(p, q) for p, q in coefficients]), radicand, degree)


Coefficient: TypeAlias = Fraction | Algebraic


def root(radicand: int, degree: int) -> Algebraic:
    """Return radicand^(1/degree), for a radicand that makes x^degree - radicand irreducible (2 and 4 do for 3)."""
    if len(fmpq_poly([-radicand] + [0] * (degree - 1) + [1]).factor()[1]) != 1:
        raise ValueError(f"x^{degree} - {radicand} is reducible; an irreducible one is accepted.")
    return Algebraic(fmpq_poly([0, 1]), radicand, degree)


def enclose(value: Coefficient | int) -> arb:
    """Return a ball around an exact coefficient at the precision in force."""
    return value.ball() if isinstance(value, Algebraic) else BALL.number(Fraction(value))
