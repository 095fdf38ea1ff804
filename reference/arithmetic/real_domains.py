"""Where a formula is a real number: the domain of each of its terms, proven in real balls.

No part may be without a value, also one that cancels or whose derivative is zero, such as acos(2) or log(-1) - log(-1).
"""

from __future__ import annotations

import math
import operator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from reference.arithmetic.balls import BALL
from reference.arithmetic.terms import Function, Operation, Power, Term, Variable
from reference.names import short

if TYPE_CHECKING:
    from collections.abc import Callable

    from flint import arb

    from reference.arithmetic.formula import Expression

__all__ = ["OutsideDomainError", "real"]


class OutsideDomainError(ArithmeticError):
    """A part of a formula has no value, or was not proven to have one, at a ball.

    Attributes:
        certain: whether it has no value anywhere in the ball.
        constant: whether the variable is not in the part, so that a smaller ball would tell no more.
        pole: whether it is a quotient or a tangent, which has a pole where it has no value.
    """

    def __init__(self, why: str, *, certain: bool, constant: bool, pole: bool) -> None:
        super().__init__(why)
        self.certain, self.constant, self.pole = certain, constant, pole


@dataclass(frozen=True)
class Domain:
    """Where a term has a value: what of a number it is, which numbers are ``inside`` and ``outside``, and in words."""

    of: str
    inside: Callable[[arb], Any]
    outside: Callable[[arb], Any]
    words: str


ROOT = Domain("the square root of", lambda x: x >= 0, lambda x: x < 0, "zero or positive")
ARC = (lambda x: -1 <= x <= 1, lambda x: x < -1 or x > 1, "from -1 to 1")
DIVISOR = Domain("a division by", lambda x: x != 0, lambda x: x.is_zero(), "other than zero")
FUNCTIONS = {
    "sqrt": ROOT,
    "log": Domain("the logarithm of", lambda x: x > 0, lambda x: x <= 0, "positive"),
    "asin": Domain("the arc sine of", *ARC),
    "acos": Domain("the arc cosine of", *ARC),
    "tan": Domain("the tangent of", lambda x: x.tan().is_finite(), lambda _: False, "away from its poles"),
}
"""The functions that not every real number has."""
HALVED = Domain("a fractional power of", ROOT.inside, ROOT.outside, ROOT.words)
RAISED = Domain("a fractional power of", lambda x: x > 0 or x.is_zero(), ROOT.outside, ROOT.words)
LOWERED = Domain("a negative fractional power of", lambda x: x > 0, lambda x: x <= 0, "positive")


def _domain(term: Term) -> Domain | None:
    """The domain of a term's last argument, if it is not all numbers."""
    match term:
        case Function(name=name):
            return FUNCTIONS.get(name)
        case Operation(join=operator.truediv):
            return DIVISOR
        case Power(exponent=exponent) if exponent.denominator > 1:
            return LOWERED if exponent < 0 else HALVED if exponent.denominator == 2 else RAISED
        case Power(exponent=exponent) if exponent < 0:
            return DIVISOR
    return None


def real(formula: Expression, x: arb | None = None) -> arb:
    """The value of a formula, of which every part is proven to be real and finite where the variable is in the ball.

    Raises:
        OutsideDomainError: a part is not, or could not be proven to be, at the precision in force.
    """
    stack: list[tuple[arb, bool]] = []
    for term in formula.terms:
        count = len(stack) - term.arity
        values = [value for value, _ in stack[count:]]
        constant = not isinstance(term, Variable) and all(known for _, known in stack[count:])
        value = _checked(term, x, values, constant=constant)
        stack[count:] = [(value, constant)]
    return stack[0][0]


def _checked(term: Term, x: arb | None, values: list[arb], *, constant: bool) -> arb:
    domain = _domain(term)
    if domain is not None and not domain.inside(values[-1]):
        argument = values[-1]
        certain = bool(domain.outside(argument))
        what = _shown(argument) if certain else f"a number that is not proven to be {domain.words}"
        pole = domain in {DIVISOR, FUNCTIONS["tan"]}
        raise OutsideDomainError(
            f"'{short(term.text)}' is {domain.of} {what}", certain=certain, constant=constant, pole=pole
        )
    value: arb = term.of(BALL, x, *values)
    if not value.is_finite():
        why = f"'{short(term.text)}' is a number that is not proven to be finite"
        raise OutsideDomainError(why, certain=False, constant=constant, pole=False)
    return value


def _shown(value: arb) -> str:
    """The middle of a ball, to six digits."""
    near = float(value.mid())
    return f"{near:.6g}" if math.isfinite(near) else value.str(6, radius=False)
