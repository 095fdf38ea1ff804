"""What formulas are made of, each a function of the values before it, read by every arithmetic.

A formula is its terms in the order in which they are computed, each after its own arguments: x**2 + 1 is x, **2, 1, +.
So no formula is too deep to be computed, compared or hashed.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, ClassVar

if TYPE_CHECKING:
    from collections.abc import Callable
    from fractions import Fraction

    from reference.arithmetic.protocols import ElementaryArithmetic

__all__ = ["Function", "Named", "Negative", "Number", "Operation", "Pi", "Power", "Term", "Variable"]


@dataclass(frozen=True)
class Term:
    """A step of a formula.

    Attributes:
        text: what it computes, as the formula spells it.
    """

    text: str = field(compare=False)

    arity: ClassVar[int] = 0
    """How many values it takes."""

    def of(self, m: ElementaryArithmetic, x: Any, *values: Any) -> Any:
        """Its value in the arithmetic m where the variable has the value x."""
        raise NotImplementedError


@dataclass(frozen=True)
class Number(Term):
    """An exact rational."""

    value: Fraction

    def of(self, m: ElementaryArithmetic, x: Any, *values: Any) -> Any:
        del x, values
        return m.number(self.value)


@dataclass(frozen=True)
class Pi(Term):
    """The circle number."""

    def of(self, m: ElementaryArithmetic, x: Any, *values: Any) -> Any:
        del x, values
        return m.pi()


@dataclass(frozen=True)
class Variable(Term):
    """What the formula is a function of."""

    def of(self, m: ElementaryArithmetic, x: Any, *values: Any) -> Any:
        del m, values
        return x


@dataclass(frozen=True)
class Named(Term):
    """One of several variables, of which the formula is given the values by name."""

    name: str

    def of(self, m: ElementaryArithmetic, x: Any, *values: Any) -> Any:
        del m, values
        return x[self.name]


@dataclass(frozen=True)
class Negative(Term):
    """- operand"""

    arity: ClassVar[int] = 1

    def of(self, m: ElementaryArithmetic, x: Any, *values: Any) -> Any:
        del m, x
        (operand,) = values
        return -operand


@dataclass(frozen=True)
class Operation(Term):
    """Left and right, joined by +, -, * or /."""

    join: Callable[[Any, Any], Any]

    arity: ClassVar[int] = 2

    def of(self, m: ElementaryArithmetic, x: Any, *values: Any) -> Any:
        del m, x
        return self.join(*values)


@dataclass(frozen=True)
class Power(Term):
    """base ** exponent, with a whole or a rational exponent; base ** 0 is one wherever the base is a number."""

    exponent: Fraction

    arity: ClassVar[int] = 1

    def of(self, m: ElementaryArithmetic, x: Any, *values: Any) -> Any:
        del x
        (base,) = values
        if not self.exponent:
            return m.number(self.exponent + 1)
        if self.exponent.denominator > 2:
            return m.power(base, self.exponent)
        if self.exponent.denominator == 2:
            base = m.sqrt(base)
        raised = _raised(base, abs(self.exponent.numerator))
        return raised if self.exponent > 0 else 1 / raised


def _raised(base: Any, count: int) -> Any:
    """base ** count by products, which balls around zero take too."""
    half = base if count < 2 else _raised(base, count // 2)
    square = base if count < 2 else half * half
    return square * base if count > 1 and count % 2 else square


@dataclass(frozen=True)
class Function(Term):
    """A named function of an argument."""

    name: str

    arity: ClassVar[int] = 1

    def of(self, m: ElementaryArithmetic, x: Any, *values: Any) -> Any:
        del x
        (argument,) = values
        return getattr(m, self.name)(argument)
