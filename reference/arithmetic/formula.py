"""Formulas of the user's own: parsed once, read by every arithmetic.

    Expression.parse("2*(x/pi)**4", "x")(m, x)

is the value in the arithmetic ``m``; several variables are given by name.  Accepted are numbers, taken exactly
as they are written, pi, the variables, + - * / **, brackets and the functions of FUNCTIONS; a power is a rational
number.  Python's own parser reads the text, and nothing of what it read is ever run.  Where a formula is a real number,
``domains`` proves.
"""

from __future__ import annotations

import ast
import operator
import warnings
from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.arithmetic.exact import as_number, exact, spelled
from reference.arithmetic.terms import Function, Named, Negative, Number, Operation, Pi, Power, Term, Variable
from reference.names import short, unknown

if TYPE_CHECKING:
    from collections.abc import Callable

    from reference.arithmetic.protocols import ElementaryArithmetic

__all__ = ["FUNCTIONS", "MAX_LENGTH", "Expression"]

FUNCTIONS = ("sqrt", "exp", "log", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh")
MAX_LENGTH = 1000
MAX_DEPTH = 100
"""How deep brackets, functions, powers and signs may be nested; a long sum or product is not deep."""
MAX_POWER = 100
"""The largest numerator and denominator of a power."""
MAX_BITS = 20_000
"""The size of a numerator or denominator that arithmetic with the formula's numbers may come to."""

JOINS: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}
Terms = tuple[Term, ...]


@dataclass(frozen=True, repr=False)
class Expression:
    """A formula of no variable, of one or of several.

    Attributes:
        text: as it was written; it reads back as the same formula.
        terms: what it is computed by, one after another.
    """

    text: str = field(compare=False)
    terms: Terms

    @classmethod
    def parse(cls, text: str, variable: str | tuple[str, ...] = "", what: str = "formula") -> Expression:
        """The formula that ``text`` spells; without a variable, a constant.

        Raises:
            ValueError: it is no formula of this variable, or of these; ``what`` names it in the message.
        """
        return cls(text.strip(), _Reader(text.strip(), variable, what).terms())

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
        return cls(spelled(number), (Number(spelled(number), number),))

    def __repr__(self) -> str:
        """As an argument is written: a number where it is one, else the text."""
        number = _number(self.terms)
        return repr(self.text if number is None else as_number(number))

    @property
    def names(self) -> frozenset[str]:
        """The variables that it names, of several."""
        return frozenset(term.name for term in self.terms if isinstance(term, Named))

    def __call__(self, m: ElementaryArithmetic, x: Any = None) -> Any:
        """The value in an arithmetic where the variable is ``x``, or several are those of ``x`` by name."""
        values: list[Any] = []
        for term in self.terms:
            count = len(values) - term.arity
            values[count:] = [term.of(m, x, *values[count:])]
        return values[0]


def _number(terms: Terms) -> Fraction | None:
    """The rational that the terms are, if they are nothing but that."""
    return terms[0].value if len(terms) == 1 and isinstance(terms[0], Number) else None


class _Reader:
    """Turns Python's syntax tree of one text into a formula, and refuses what has no place in one."""

    def __init__(self, text: str, variable: str | tuple[str, ...], what: str) -> None:
        self._text, self._variable, self._what = text, variable, what

    def terms(self) -> Terms:
        if len(self._text) > MAX_LENGTH:
            raise self._refusal(f"has {len(self._text)} characters; at most {MAX_LENGTH} are accepted")
        if "#" in self._text:  # Python's parser would read what follows as a comment
            raise self._refusal("holds '#', which has no place in a formula")
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                tree = ast.parse(self._text, mode="eval").body
        except (RecursionError, MemoryError):
            raise self._too_deep() from None
        except (SyntaxError, ValueError) as error:
            if "too many nested" in str(error):
                raise self._too_deep() from None
            raise self._refusal("is no formula: it has a mistake in its syntax") from None
        return self._read(tree, 0)

    def _refusal(self, why: str) -> ValueError:
        return ValueError(f"{self._what} '{short(self._text)}' {why}.")

    def _too_deep(self) -> ValueError:
        return self._refusal(f"is nested more than {MAX_DEPTH} deep")

    def _spelled(self, tree: ast.expr) -> str:
        return ast.get_source_segment(self._text, tree) or self._text

    def _read(self, tree: ast.expr, depth: int) -> Terms:
        """The terms of a tree; down the left of a sum or a product, which may be long, without a call for each."""
        rest: list[ast.BinOp] = []
        while isinstance(tree, ast.BinOp) and type(tree.op) in JOINS:
            rest.append(tree)
            tree = tree.left
        found = self._operand(tree, depth)
        for joined in reversed(rest):
            found = self._joined(joined, found, self._read(joined.right, depth + 1))
        return found

    def _operand(self, tree: ast.expr, depth: int) -> Terms:
        if depth > MAX_DEPTH:
            raise self._too_deep()
        match tree:
            case ast.Constant(value=int() | float()) if not isinstance(tree.value, bool):
                text = self._spelled(tree)
                return (Number(text, exact(text, f"a number of {self._what}")),)
            case ast.Name(id=name):
                return (self._name(name),)
            case ast.UnaryOp(op=ast.UAdd() | ast.USub()):
                operand = self._read(tree.operand, depth + 1)
                return operand if isinstance(tree.op, ast.UAdd) else self._negative(tree, operand)
            case ast.BinOp(op=ast.Pow()):
                return self._power(tree, self._read(tree.left, depth + 1), self._read(tree.right, depth + 1))
            case ast.Call(func=ast.Name(id=name), args=[argument], keywords=[]):
                return *self._read(argument, depth + 1), self._function(tree, name)
        hint = "; a power is written **" if isinstance(tree, ast.BinOp) and isinstance(tree.op, ast.BitXor) else ""
        raise self._refusal(f"holds '{short(self._spelled(tree))}', which has no place in a formula{hint}")

    def _name(self, name: str) -> Term:
        if name == "pi":
            return Pi(name)
        several = isinstance(self._variable, tuple)
        names = [one for one in (self._variable if isinstance(self._variable, tuple) else (self._variable,)) if one]
        if name not in names:
            raise ValueError(unknown(f"{self._what} '{short(self._text)}': the name", name, [*names, "pi"], FUNCTIONS))
        return Named(name, name) if several else Variable(name)

    def _function(self, tree: ast.Call, name: str) -> Term:
        if name not in FUNCTIONS:
            raise ValueError(unknown(f"{self._what} '{short(self._text)}': the function", name, FUNCTIONS))
        return Function(self._spelled(tree), name)

    def _negative(self, tree: ast.UnaryOp, operand: Terms) -> Terms:
        number, text = _number(operand), self._spelled(tree)
        return (*operand, Negative(text)) if number is None else (Number(text, -number),)

    def _joined(self, tree: ast.BinOp, left: Terms, right: Terms) -> Terms:
        """Two parts; of two numbers, the number, so that a fraction is exact."""
        join, one, other = JOINS[type(tree.op)], _number(left), _number(right)
        if join is operator.truediv and other == 0:
            raise self._refusal("divides by zero")
        if one is not None and other is not None:
            return (self._bounded(tree, join(one, other)),)
        return *left, *right, Operation(self._spelled(tree), join)

    def _power(self, tree: ast.BinOp, base: Terms, exponent: Terms) -> Terms:
        power, number = _number(exponent), _number(base)
        if power is None:
            raise self._refusal("has a power that is not a rational number")
        if max(abs(power.numerator), power.denominator) > MAX_POWER:
            raise self._refusal(f"has the power {short(str(power))}, of more than {MAX_POWER} or in finer parts")
        if power == 1:
            return base
        if number is None or power.denominator > 1:
            return *base, Power(self._spelled(tree), power)
        if number == 0 and power < 0:
            raise self._refusal("divides by zero")
        _ = self._bounded(tree, Fraction(1 << min(_bits(number) * abs(int(power)), 2 * MAX_BITS)))
        return (self._bounded(tree, number ** int(power)),)

    def _bounded(self, tree: ast.expr, value: Fraction) -> Number:
        if _bits(value) > MAX_BITS:
            raise self._refusal(f"holds a number of more than {MAX_BITS} bits")
        return Number(self._spelled(tree), value)


def _bits(value: Fraction) -> int:
    return max(value.numerator.bit_length(), value.denominator.bit_length())
