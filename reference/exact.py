"""Inputs are exact real numbers.

A float is taken at its exact binary64 value, a string or a Fraction as the exact rational that it spells.
Nothing in the reference ever sees a rounded input.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Iterable, Mapping, Set
from decimal import Decimal
from fractions import Fraction
from numbers import Rational
from typing import Any

import numpy as np

from reference.binary64 import exact_value, nearest, with_subnormals
from reference.names import short

__all__ = ["as_number", "exact", "exact_array", "expansion", "positive", "spelled"]

ACCEPTED = "a finite number, a decimal string such as '9.81', or a Fraction is accepted"
ROWS_ACCEPTED = "an array with rows of one length is accepted"
LOG2_10 = math.log2(10)
NUMBER_KINDS = "fiuOU"
"""NumPy kinds of arrays whose elements can be numbers: floats, integers, objects and strings."""
NO_SEQUENCES = (bytes, bytearray, memoryview, Mapping, Set)
"""What can be iterated over, but is not a sequence of numbers, or has no order."""
MAX_DIGITS = 4000
"""Digits that the numerator or the denominator of an input may have, so that every input can be printed exactly."""


def exact(value: Any, name: str = "value") -> Fraction:
    """Return ``value`` as the exact rational it stands for.

    Accepts int, float, NumPy real scalars, Fraction, Decimal and strings such as ``"9.81"``, ``"1e-3"``, ``"981/100"``.

    Raises:
        ValueError: the value is not finite or beyond MAX_DIGITS, or a string spells no number.
        TypeError: the value is not a real number.
    """
    found = _exact(value, name)
    if max(found.numerator.bit_length(), found.denominator.bit_length()) > (MAX_DIGITS + 1) * LOG2_10:
        raise ValueError(f"{name} has a numerator or denominator of more than {MAX_DIGITS} digits; fewer are accepted.")
    return found


def _exact(value: Any, name: str) -> Fraction:
    if isinstance(value, str):
        return _spelled_number(value, name)
    if isinstance(value, (bool, np.bool_, complex, np.complexfloating, np.timedelta64)):
        raise TypeError(f"{name} is {value!r}, which is not a real number; {ACCEPTED}.")
    if isinstance(value, (Rational, np.integer)):
        return Fraction(int(value.numerator), int(value.denominator))
    if isinstance(value, np.ndarray) and value.ndim == 0:
        return _exact(value[()], name)
    if isinstance(value, Decimal) and value.is_finite():
        return _spelled_number(str(value), name)
    if isinstance(value, (float, np.floating, Decimal)):
        if isinstance(value, Decimal) or not np.isfinite(value):
            raise ValueError(f"{name} is {value}, which is not finite; {ACCEPTED}.")
        return exact_value(value)
    raise TypeError(f"{name} is of type {type(value).__name__}; {ACCEPTED}.")


def _spelled_number(text: str, name: str) -> Fraction:
    exponent = text.lower().partition("e")[2].strip().lstrip("+-0")
    if exponent.isdecimal() and (len(exponent) > 9 or int(exponent) > MAX_DIGITS):
        raise ValueError(f"{name} is '{short(text)}', whose exponent is beyond the limit of {MAX_DIGITS}.")
    try:
        return Fraction(text.strip())
    except (ValueError, ZeroDivisionError):
        raise ValueError(f"{name} is '{short(text)}', which spells no number; {ACCEPTED}.") from None


def exact_array(values: Any, name: str = "value") -> tuple[list[Fraction], tuple[int, ...]]:
    """Return the exact rationals of ``values`` in C order, and the shape they came in.

    ``values`` is one number, an array of any shape, or nested sequences of numbers, strings or Fractions.

    Raises:
        ValueError: ``values`` is empty or ragged, or one of them is not finite.
        TypeError: ``values`` is or holds something else, such as bytes, dates, a mapping or a set.
    """
    if isinstance(values, (str, Rational, float, Decimal)):
        return [exact(values, name)], ()
    _refuse_no_sequence(values, name)
    try:
        array = values if isinstance(values, np.ndarray) else np.array(_listed(values), dtype=object)
    except ValueError:
        raise ValueError(f"{name} is ragged; {ROWS_ACCEPTED}.") from None
    if array.dtype.kind not in NUMBER_KINDS:
        raise TypeError(f"{name} is an array of {array.dtype}; {ACCEPTED}.")
    if array.size == 0:
        raise ValueError(f"{name} is empty; at least one number is accepted.")
    elements = array.ravel().tolist()
    if array.dtype.kind == "f" and array.itemsize <= 8 and np.isfinite(array).all():
        if with_subnormals(array):
            return [exact_value(value) for value in array.ravel()], array.shape
        return [Fraction(value) for value in elements], array.shape
    if any(isinstance(value, (list, tuple, np.ndarray)) for value in elements):
        raise ValueError(f"{name} is ragged; {ROWS_ACCEPTED}.")
    return [exact(value, name) for value in elements], array.shape


def _refuse_no_sequence(values: Any, name: str) -> None:
    """NumPy would take bytes, inside lists too, for numbers."""
    if isinstance(values, NO_SEQUENCES):
        raise TypeError(f"{name} is of type {type(values).__name__}; {ACCEPTED}.")
    if isinstance(values, (list, tuple)):
        for value in values:
            _refuse_no_sequence(value, name)


def _listed(values: Any) -> Any:
    """Iterables other than lists and tuples (ranges, generators) as lists."""
    if isinstance(values, Iterable) and not isinstance(values, (str, list, tuple)):
        return list(values)
    return values


def positive(value: Any, name: str) -> int:
    """Return a count as an int; NumPy's integers are counts, truth values are not.

    Raises:
        ValueError: it is not a positive integer.
    """
    try:
        count = 0 if isinstance(value, (bool, np.bool_)) else operator.index(value)
    except TypeError:
        count = 0
    if count < 1:
        raise ValueError(f"{name} is {value!r}; a positive integer is accepted.")
    return count


def as_number(value: Fraction) -> float | str:
    """Return the float that equals ``value``, or where there is none its decimal or fraction as a string.

    ``exact(as_number(x)) == x`` for every x.  Where the processor takes a float for zero it is no number to be shown.
    """
    rounded = nearest(value)
    if not math.isfinite(rounded) or exact_value(rounded) != value:
        return spelled(value)
    return rounded if value == 0 or rounded != 0.0 else spelled(value)


def spelled(value: Fraction) -> str:
    """Return ``value`` as an exact decimal where it has one of at most 40 digits, else as ``numerator/denominator``."""
    twos = (value.denominator & -value.denominator).bit_length() - 1
    fives, rest = 0, value.denominator >> twos
    while rest % 5 == 0:
        fives, rest = fives + 1, rest // 5
    places = max(twos, fives)
    scaled = value.numerator * 10**places // value.denominator if rest == 1 and places < 400 else None
    if scaled is None or abs(scaled) >= 10**40:
        return str(value)
    sign, digits = int(scaled < 0), tuple(int(digit) for digit in str(abs(scaled)))
    return str(Decimal((sign, digits, -places)))


def expansion(value: Fraction) -> str:
    """Return the exact decimal expansion of a binary64 number, whatever its length."""
    brief = spelled(value)
    if "/" not in brief:
        return brief
    places = value.denominator.bit_length() - 1
    whole, rest = divmod(abs(value.numerator) * 10**places // value.denominator, 10**places)
    return f"{'-' if value < 0 else ''}{whole}.{rest:0{places}d}"
