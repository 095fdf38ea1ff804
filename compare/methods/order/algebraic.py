"""Exact coefficients: rationals, and elements of a number field Q(r), r a real root of a polynomial.

A tableau holds ``Fraction``s; Gauss' nodes need sqrt(3) or sqrt(15), the triple jumps of Yoshida and Suzuki 2^(1/3) and
4^(1/3).  Arithmetic on either is exact, so that order conditions are proven, not estimated, and a coefficient is
rounded once, to whatever type runs it.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias

from flint import arb, fmpq, fmpq_poly, fmpz_poly

from reference.arithmetic.namespaces import BALL
from reference.arithmetic.precision import PrecisionError, ctx

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.methods.order.certified_roots import Linear

__all__ = [
    "EXACT",
    "NARROW_BITS",
    "PROOF_BITS",
    "Algebraic",
    "Coefficient",
    "Enclosed",
    "Field",
    "Q",
    "enclose",
    "provable",
    "root",
    "root_of",
    "vanishes",
]

PROOF_BITS = 300
NARROW_BITS = 100
"""A number that is zero is known to be smaller than 2^-NARROW_BITS; one that is not is far larger."""

Q = Fraction
EXACT = Q(0)
"""What exact coefficients miss of the conditions that they are to satisfy."""


class Enclosed(Protocol):
    """A real number known by its enclosures."""

    def ball(self) -> arb:
        """A ball around it, at the precision in force."""


@dataclass(frozen=True)
class Field:
    """Q(r), where r is the root of an irreducible polynomial that is nearest to a float.

    Attributes:
        coefficients: of the polynomial, integers, the constant first.
        near: a float nearer to r than to any other root.
        powers: r, r^2, ... as they are printed.
    """

    coefficients: tuple[int, ...]
    near: float
    powers: tuple[str, ...]

    def __post_init__(self) -> None:
        if len(fmpz_poly(list(self.coefficients)).factor()[1]) != 1:
            raise ValueError(f"the polynomial of {self.powers[0]} is reducible; an irreducible one is accepted.")

    @property
    def modulus(self) -> fmpq_poly:
        return fmpq_poly(list(self.coefficients))

    @property
    def degree(self) -> int:
        return len(self.coefficients) - 1

    @property
    def generator(self) -> Algebraic:
        """r itself."""
        return Algebraic(fmpq_poly([0, 1]), self)

    def root(self) -> arb:
        """The enclosure of r at the precision in force."""
        return _nearest_root(self, ctx.prec)


@lru_cache(maxsize=256)
def _nearest_root(field: Field, bits: int) -> arb:
    with ctx.workprec(bits):
        roots = [value for value, _ in fmpz_poly(list(field.coefficients)).complex_roots() if value.imag == 0]
    found: arb = min((value.real for value in roots), key=lambda value: abs(float(value) - field.near))
    return found


class Algebraic:
    """A polynomial in the root of a field with rational coefficients, of lower degree than the field's."""

    def __init__(self, polynomial: fmpq_poly, field: Field) -> None:
        self.field = field
        self.polynomial = polynomial if polynomial.degree() < field.degree else polynomial % field.modulus

    def _lift(self, other: Algebraic | Fraction | int) -> fmpq_poly:
        if not isinstance(other, Algebraic):
            return fmpq_poly([fmpq(other.numerator, other.denominator)])
        if other.field != self.field:
            raise ValueError(f"{other} and {self} are of different fields; numbers of one field are accepted.")
        return other.polynomial

    def __add__(self, other: Algebraic | Fraction | int) -> Algebraic:
        return Algebraic(self.polynomial + self._lift(other), self.field)

    def __neg__(self) -> Algebraic:
        return Algebraic(-self.polynomial, self.field)

    def __sub__(self, other: Algebraic | Fraction | int) -> Algebraic:
        return self + (-other)

    def __rsub__(self, other: Algebraic | Fraction | int) -> Algebraic:
        return -self + other

    def __mul__(self, other: Algebraic | Fraction | int) -> Algebraic:
        return Algebraic(self.polynomial * self._lift(other), self.field)

    def __rtruediv__(self, other: Algebraic | Fraction | int) -> Algebraic:
        divisor, inverse, _ = self.polynomial.xgcd(self.field.modulus)
        if divisor.degree() != 0:
            raise ZeroDivisionError(f"{self} has no inverse.")
        return Algebraic(inverse / divisor[0], self.field) * other

    def __truediv__(self, other: Algebraic | Fraction | int) -> Algebraic:
        return (1 / other) * self if isinstance(other, Algebraic) else self * (1 / Fraction(other))

    __radd__ = __add__
    __rmul__ = __mul__

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Algebraic) and other.field != self.field:
            return self.rational is not None and self.rational == other.rational
        if not isinstance(other, (Algebraic, Fraction, int)):
            return NotImplemented
        return bool(self.polynomial == self._lift(other))

    def __hash__(self) -> int:
        return hash((self.field, str(self.polynomial))) if self.rational is None else hash(self.rational)

    @property
    def rational(self) -> Fraction | None:
        """The number as a fraction, where it is one."""
        if self.polynomial.degree() > 0:
            return None
        return _fraction(self.polynomial[0])

    @property
    def terms(self) -> tuple[tuple[Fraction, int], ...]:
        """(coefficient, power of the root) of every term that is not zero."""
        terms = ((_fraction(self.polynomial[i]), i) for i in range(self.field.degree))
        return tuple((coefficient, power) for coefficient, power in terms if coefficient)

    def __repr__(self) -> str:
        terms = [_term(coefficient, self.field.powers[power - 1] if power else "") for coefficient, power in self.terms]
        return " + ".join(terms).replace("+ -", "- ") or "0"

    def __reduce__(self) -> tuple[object, ...]:
        values = [_fraction(self.polynomial[i]) for i in range(self.field.degree)]
        return _rebuilt, (values, self.field)

    def ball(self) -> arb:
        """The enclosure at the precision in force, by Horner's rule."""
        r, value = self.field.root(), arb(0)
        for i in reversed(range(self.field.degree)):
            value = value * r + arb(self.polynomial[i])
        return value


def _term(coefficient: Fraction, power: str) -> str:
    """For example 5/12 and sqrt(6) as "5*sqrt(6)/12"."""
    if not power:
        return str(coefficient)
    top = {1: power, -1: f"-{power}"}.get(coefficient.numerator, f"{coefficient.numerator}*{power}")
    return top if coefficient.denominator == 1 else f"{top}/{coefficient.denominator}"


def _fraction(value: fmpq) -> Fraction:
    return Fraction(int(value.p), int(value.q))


def _rebuilt(values: Sequence[Fraction], field: Field) -> Algebraic:
    """An unpickled number."""
    return Algebraic(fmpq_poly([fmpq(value.numerator, value.denominator) for value in values]), field)


Coefficient: TypeAlias = "Fraction | Algebraic | Linear"
"""A real number known exactly: rational, algebraic, or a combination of a proven zero's coordinates."""


def root(radicand: int, degree: int = 2) -> Algebraic:
    """Return radicand^(1/degree), for a radicand that makes x^degree - radicand irreducible (2 and 4 do for 3).

    Raises:
        ValueError: it is reducible.
    """
    powers = (f"sqrt({radicand})",) if degree == 2 else tuple(f"{radicand}^({i}/{degree})" for i in range(1, degree))
    return Field((-radicand, *(0,) * (degree - 1), 1), radicand ** (1 / degree), powers).generator


def root_of(coefficients: tuple[int, ...], near: float) -> Algebraic:
    """Return the real root nearest to ``near`` of an irreducible polynomial, given by its constant first.

    Raises:
        ValueError: the polynomial is reducible.
    """
    powers = ("r", *(f"r^{i}" for i in range(2, len(coefficients) - 1)))
    return Field(coefficients, near, powers).generator


def enclose(value: Coefficient | int) -> arb:
    """Return a ball around an exact coefficient at the precision in force."""
    return BALL.number(Fraction(value)) if isinstance(value, (int, Fraction)) else value.ball()


def provable(coefficients: Sequence[Coefficient | arb]) -> list[Any]:
    """The coefficients as they are where arithmetic on them is exact, else in balls at the precision in force."""
    if all(isinstance(value, (int, Fraction, Algebraic)) for value in coefficients):
        return list(coefficients)
    return [value if isinstance(value, arb) else 0 if value == 0 else enclose(value) for value in coefficients]


def vanishes(value: Any, bound: arb | None = None) -> bool:
    """Whether what was computed of coefficients that are ``provable`` is zero, or where there is a bound below it.

    Raises:
        PrecisionError: its ball is too wide to tell.
    """
    if not isinstance(value, arb):
        return bool(value == 0)
    if bound is not None:
        size = abs(value)
        if not (size < bound or size > bound):
            raise PrecisionError("a condition was met in balls too wide to decide it.")
        return bool(size < bound)
    if value.contains(0) and not value.rad() < arb(2) ** -NARROW_BITS:
        raise PrecisionError("a condition was met in balls too wide to decide it.")
    return bool(value.contains(0))
