"""Formulas of the user's own: parsed once, read by every arithmetic.

    Expression.parse("2*(x/pi)**4", "x")(m, x)

is the formula's value in the arithmetic ``m``.  Accepted are numbers, taken exactly as they are written, pi, one
variable, + - * / **, brackets and the functions of FUNCTIONS; a power is a rational number.  Python's own parser reads
the text, and nothing of what it read is ever run.
"""

from __future__ import annotations

import ast
import operator
import warnings
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING, Any, Protocol

from reference.exact import as_number, exact, spelled
from reference.names import short, unknown

if TYPE_CHECKING:
    from collections.abc import Callable

    from reference.arithmetic import ElementaryArithmetic

__all__ = ["FUNCTIONS", "Expression"]

FUNCTIONS = ("sqrt", "exp", "log", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh")
MAX_LENGTH = 1000
MAX_DEPTH = 100
MAX_POWER = 100
"""The largest numerator and denominator of a power."""
MAX_BITS = 20_000
"""The size of a numerator or denominator that arithmetic with the formula's numbers may come to."""


class Node(Protocol):
    """A part of a formula: ``at(m, x)`` is its value in the arithmetic m where the variable has the value x."""

    def at(self, m: ElementaryArithmetic, x: Any) -> Any: ...


@dataclass(frozen=True)
class Number:
    """An exact rational."""

    value: Fraction

    def at(self, m: ElementaryArithmetic, x: Any) -> Any:
        del x
        return m.number(self.value)


@dataclass(frozen=True)
class Pi:
    """The circle number."""

    def at(self, m: ElementaryArithmetic, x: Any) -> Any:
        del x
        return m.pi()


@dataclass(frozen=True)
class Variable:
    """What the formula is a function of."""

    def at(self, m: ElementaryArithmetic, x: Any) -> Any:
        del m
        return x


@dataclass(frozen=True)
class Negative:
    """- operand"""

    operand: Node

    def at(self, m: ElementaryArithmetic, x: Any) -> Any:
        return -self.operand.at(m, x)


@dataclass(frozen=True)
class Operation:
    """Left and right, joined by +, -, * or /."""

    join: Callable[[Any, Any], Any]
    left: Node
    right: Node

    def at(self, m: ElementaryArithmetic, x: Any) -> Any:
        return self.join(self.left.at(m, x), self.right.at(m, x))


@dataclass(frozen=True)
class Power:
    """base ** exponent, with a whole or a rational exponent other than zero."""

    base: Node
    exponent: Fraction

    def at(self, m: ElementaryArithmetic, x: Any) -> Any:
        base, count = self.base.at(m, x), abs(self.exponent.numerator)
        if self.exponent.denominator > 2:
            return m.power(base, self.exponent)
        if self.exponent.denominator == 2:
            base = m.sqrt(base)
        raised = _raised(base, count)
        return raised if self.exponent > 0 else 1 / raised


def _raised(base: Any, count: int) -> Any:
    """base ** count by products, which balls around zero take too."""
    half = base if count < 2 else _raised(base, count // 2)
    square = base if count < 2 else half * half
    return square * base if count > 1 and count % 2 else square


@dataclass(frozen=True)
class Function:
    """A named function of an argument."""

    name: str
    argument: Node

    def at(self, m: ElementaryArithmetic, x: Any) -> Any:
        return getattr(m, self.name)(self.argument.at(m, x))


JOINS: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}


@dataclass(frozen=True, repr=False)
class Expression:
    """A formula of at most one variable.

    Attributes:
        text: as it was written; it reads back as the same formula.
        root: what it was parsed into.
    """

    text: str = field(compare=False)
    root: Node

    @classmethod
    def parse(cls, text: str, variable: str = "", what: str = "formula") -> Expression:
        """The formula that ``text`` spells; without a variable, a constant.

        Raises:
            ValueError: it is no formula of this variable; ``what`` names it in the message.
        """
        return cls(text.strip(), _Reader(text.strip(), variable, what).node())

    @classmethod
    def constant(cls, value: Any, what: str = "value") -> Expression:
        """A number at its exact value, or a formula without a variable, such as "pi/2".

        Raises:
            ValueError: it is not finite, or no formula of a constant.
            TypeError: it is neither a number nor a string.
        """
        if isinstance(value, str):
            return cls.parse(value, what=what)
        number = exact(value, what)
        return cls(spelled(number), Number(number))

    def __repr__(self) -> str:
        """As an argument is written: a number where it is one, else the text."""
        return repr(as_number(self.root.value) if isinstance(self.root, Number) else self.text)

    def __call__(self, m: ElementaryArithmetic, x: Any = None) -> Any:
        """The value in an arithmetic, where the variable has the value ``x``."""
        return self.root.at(m, x)


class _Reader:
    """Turns Python's syntax tree of one text into a formula, and refuses what has no place in one."""

    def __init__(self, text: str, variable: str, what: str) -> None:
        self._text, self._variable, self._what = text, variable, what

    def node(self) -> Node:
        if len(self._text) > MAX_LENGTH:
            raise self._refusal(f"has {len(self._text)} characters; at most {MAX_LENGTH} are accepted")
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                tree = ast.parse(self._text, mode="eval").body
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            raise self._refusal("is no formula: it has a mistake in its syntax") from None
        return self._read(tree, 0)

    def _refusal(self, why: str) -> ValueError:
        return ValueError(f"{self._what} '{short(self._text)}' {why}.")

    def _read(self, tree: ast.expr, depth: int) -> Node:
        if depth > MAX_DEPTH:
            raise self._refusal(f"is nested more than {MAX_DEPTH} deep")
        match tree:
            case ast.Constant(value=int() | float()) if not isinstance(tree.value, bool):
                return Number(exact(ast.get_source_segment(self._text, tree), f"a number of {self._what}"))
            case ast.Name(id=name):
                return self._name(name)
            case ast.UnaryOp(op=ast.UAdd() | ast.USub()):
                operand = self._read(tree.operand, depth + 1)
                return operand if isinstance(tree.op, ast.UAdd) else self._negative(operand)
            case ast.BinOp(op=ast.Pow() | ast.Add() | ast.Sub() | ast.Mult() | ast.Div()):
                left, right = self._read(tree.left, depth + 1), self._read(tree.right, depth + 1)
                return self._power(left, right) if isinstance(tree.op, ast.Pow) else self._joined(tree.op, left, right)
            case ast.Call(func=ast.Name(id=name), args=[argument], keywords=[]):
                return self._function(name, self._read(argument, depth + 1))
        piece = short(ast.get_source_segment(self._text, tree) or self._text)
        hint = "; a power is written **" if isinstance(tree, ast.BinOp) and isinstance(tree.op, ast.BitXor) else ""
        raise self._refusal(f"holds '{piece}', which has no place in a formula{hint}")

    def _name(self, name: str) -> Node:
        if name == "pi":
            return Pi()
        if name != self._variable or not name:
            known = [name for name in (self._variable, "pi") if name]
            raise ValueError(unknown(f"{self._what} '{short(self._text)}': the name", name, known, FUNCTIONS))
        return Variable()

    def _function(self, name: str, argument: Node) -> Node:
        if name not in FUNCTIONS:
            raise ValueError(unknown(f"{self._what} '{short(self._text)}': the function", name, FUNCTIONS))
        return Function(name, argument)

    def _negative(self, operand: Node) -> Node:
        return Number(-operand.value) if isinstance(operand, Number) else Negative(operand)

    def _joined(self, sign: ast.operator, left: Node, right: Node) -> Node:
        """Two parts; of two numbers, the number, so that a fraction is exact."""
        join = JOINS[type(sign)]
        if join is operator.truediv and right == Number(Fraction(0)):
            raise self._refusal("divides by zero")
        if isinstance(left, Number) and isinstance(right, Number):
            return self._bounded(join(left.value, right.value))
        return Operation(join, left, right)

    def _power(self, base: Node, exponent: Node) -> Node:
        if not isinstance(exponent, Number):
            raise self._refusal("has a power that is not a rational number")
        power = exponent.value
        if max(abs(power.numerator), power.denominator) > MAX_POWER:
            raise self._refusal(f"has the power {short(str(power))}, of more than {MAX_POWER} or in finer parts")
        if power in {0, 1}:
            return base if power else Number(Fraction(1))
        if not isinstance(base, Number) or power.denominator > 1:
            return Power(base, power)
        if base.value == 0 and power < 0:
            raise self._refusal("divides by zero")
        _ = self._bounded(Fraction(1 << min(_bits(base.value) * abs(int(power)), 2 * MAX_BITS)))
        return Number(base.value ** int(power))

    def _bounded(self, value: Fraction) -> Number:
        if _bits(value) > MAX_BITS:
            raise self._refusal(f"holds a number of more than {MAX_BITS} bits")
        return Number(value)


def _bits(value: Fraction) -> int:
    return max(value.numerator.bit_length(), value.denominator.bit_length())
