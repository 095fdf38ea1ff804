"""An exact coefficient as it is read: its closed form where it has one, its decimal, its LaTeX."""

from __future__ import annotations

import re
from fractions import Fraction
from typing import TYPE_CHECKING

from compare.methods.order.algebraic import Algebraic
from reference.arithmetic.limbs import decimal, exact_decimal, fixed, interval, ziv

if TYPE_CHECKING:
    from compare.methods.order.algebraic import Coefficient

__all__ = ["DIGITS", "closed_form", "decimal_form", "exact_form", "latex_form"]

DIGITS = 25
"""Significant digits of a decimal."""
LONG_DENOMINATOR, MOST_PLACES = 10**5, 40


def closed_form(value: Coefficient) -> str:
    """The number exactly, such as "1/6" or "5/36 - sqrt(15)/30"; of a proven zero's coordinate, its decimal."""
    exact = exact_form(value)
    return decimal_form(value) if exact is None else exact


def exact_form(value: Coefficient) -> str | None:
    """The number exactly, or None where it has no closed form."""
    if isinstance(value, (int, Fraction)):
        return _rational(Fraction(value))
    return repr(value) if isinstance(value, Algebraic) else None


def _rational(value: Fraction) -> str:
    """A fraction, or where it is one of many digits that ends as a decimal, this."""
    if value.denominator > LONG_DENOMINATOR:
        places = next((n for n in range(6, MOST_PLACES) if 10**n % value.denominator == 0), None)
        if places is not None:
            return fixed(value, places)
    return str(value)


def decimal_form(value: Coefficient, digits: int = DIGITS) -> str:
    """The decimal of so many digits, proven correctly rounded."""
    if isinstance(value, (int, Fraction)):
        text = exact_decimal(Fraction(value), digits)
        return text.rstrip("0").rstrip(".") if "." in text and "e" not in text else text
    if isinstance(value, Algebraic) and value.rational is not None:
        return decimal_form(value.rational, digits)
    ((found,),) = ziv(
        lambda _: [[value.ball()]], lambda ball: decimal(interval(ball), digits), 1, 4 * digits + 40, repr(value)
    )
    return found


def latex_form(value: Coefficient) -> str:
    r"""The number in LaTeX's mathematics, such as \frac{5}{36} - \frac{\sqrt{15}}{30}."""
    text = closed_form(value)
    if exact_form(value) is None:
        return text
    text = re.sub(r"\*(?=\d)", r" \\cdot ", text).replace("*", "")
    text = re.sub(r"\^\((\d+/\d+)\)", r"^{\1}", text)
    text = re.sub(r"sqrt\((\d+)\)", r"\\sqrt{\1}", text)
    text = re.sub(r"r\^(\d+)", r"r^{\1}", text)
    return re.sub(r"(-?)((?:[^\s/{}-]|\{[^{}]*\})+)/(\d+)", r"\1\\frac{\2}{\3}", text)
