"""Inputs are exact real numbers.

A float is taken at its exact binary64 value, a string or a Fraction as the exact rational that it spells.
Nothing in the reference ever sees a rounded input.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from decimal import Decimal
from fractions import Fraction
from numbers import Rational
from typing import Any

import numpy as np

__all__ = ["as_number", "exact", "exact_array", "spelled"]

ACCEPTED = "a finite number, a decimal string such as '9.81', or a Fraction is accepted"
EXPONENT_LIMIT = 5000


def exact(value: Any, name: str = "value") -> Fraction:
    """Return ``value`` as the exact rational it stands for.

    Accepts int, float, NumPy real scalars, Fraction, Decimal and strings such as ``"9.81"``, ``"1e-3"``, ``"981/100"``.

    Raises:
        ValueError: the value is not finite, or a string spells no number.
        TypeError: the value is not a real number.
    """
    if isinstance(value, str):
        return _spelled_number(value, name)
    if isinstance(value, (bool, np.bool_, complex, np.complexfloating)):
        raise TypeError(f"{name} is {value!r}, which is not a real number; {ACCEPTED}.")
    if isinstance(value, (Rational, np.integer)):
        return Fraction(int(value.numerator), int(value.denominator))
    if isinstance(value, np.ndarray) and value.ndim == 0:
        return exact(value[()], name)
    if isinstance(value, (float, np.floating, Decimal)):
        if not math.isfinite(value):
            raise ValueError(f"{name} is {value}, which is not finite; {ACCEPTED}.")
        return Fraction(*(int(part) for part in value.as_integer_ratio()))
    raise TypeError(f"{name} is of type {type(value).__name__}; {ACCEPTED}.")


def _spelled_number(text: str, name: str) -> Fraction:
    _mantissa, _, exponent = text.lower().partition("e")
    if exponent.strip().lstrip("+-").isdigit() and abs(int(exponent)) > EXPONENT_LIMIT:
        raise ValueError(f"{name} is '{text}', whose exponent is beyond the limit of {EXPONENT_LIMIT}.")
    try:
        return Fraction(text.strip())
    except (ValueError, ZeroDivisionError):
        raise ValueError(f"{name} is '{text}', which spells no number; {ACCEPTED}.") from None


def exact_array(values: Any, name: str = "value") -> tuple[list[Fraction], tuple[int, ...]]:
    """Return the exact rationals of ``values`` in C order, and the shape they came in.

    ``values`` is one number, an array of any shape, or nested sequences of numbers, strings or Fractions.

    Raises:
        ValueError: ``values`` is empty or ragged, or one of them is not finite.
    """
    if isinstance(values, (str, Rational, float, Decimal)):
        return [exact(values, name)], ()
    try:
        array = values if isinstance(values, np.ndarray) else np.array(_listed(values), dtype=object)
    except ValueError:
        raise ValueError(f"{name} is ragged; an array with rows of one length is accepted.") from None
    if array.size == 0:
        raise ValueError(f"{name} is empty; at least one number is accepted.")
    return [exact(value, name) for value in array.ravel().tolist()], array.shape


def _listed(values: Any) -> Any:
    """Iterables other than lists and tuples (ranges, generators) as lists."""
    if isinstance(values, Iterable) and not isinstance(values, (str, list, tuple)):
        return list(values)
    return values


def as_number(value: Fraction) -> float | str:
    """Return the float that equals ``value``, or where there is none its decimal or fraction as a string.

    ``exact(as_number(x)) == x`` for every x.
    """
    try:
        rounded = float(value)
    except OverflowError:
        rounded = math.inf
    if math.isfinite(rounded) and Fraction(rounded) == value:
        return rounded
    return spelled(value)


def spelled(value: Fraction) -> str:
    """Return ``value`` as an exact decimal where it has one of at most 40 digits, else as ``numerator/denominator``."""
    twos = (value.denominator & -value.denominator).bit_length() - 1
    fives, rest = 0, value.denominator >> twos
    while rest % 5 == 0:
        fives, rest = fives + 1, rest // 5
    places = max(twos, fives)
    scaled = value.numerator * 10**places // value.denominator if rest == 1 and places < 400 else None
    if scaled is None or len(str(abs(scaled))) > 40:
        return str(value)
    sign, digits = int(scaled < 0), tuple(int(digit) for digit in str(abs(scaled)))
    return str(Decimal((sign, digits, -places)))
