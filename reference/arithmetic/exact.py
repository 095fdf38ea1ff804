"""Inputs are exact real numbers.

A float is taken at its exact binary64 value, a string or a Fraction as the exact rational that it spells.
Nothing in the reference ever sees a rounded input.
"""

from __future__ import annotations

import math
import operator
import re
import sys
from collections.abc import Iterable, Mapping, Set
from decimal import Decimal
from fractions import Fraction
from numbers import Rational
from typing import Any, NamedTuple

from reference.arithmetic.binary64 import exact_value, nearest
from reference.names import said, short

__all__ = ["as_number", "counted", "exact", "exact_array", "expansion", "positive", "rational_root", "spelled"]

ACCEPTED = "a finite number, a decimal string such as '9.81', or a Fraction is accepted"
ROWS_ACCEPTED = "an array with rows of one length is accepted"
LOG2_10 = math.log2(10)
NUMBER_KINDS = "fiuOU"
"""NumPy kinds of arrays whose elements can be numbers: floats, integers, objects and strings."""
NO_SEQUENCES = (bytes, bytearray, memoryview, Mapping, Set)
"""What can be iterated over, but is not a sequence of numbers, or has no order."""
MAX_DEPTH = 32
"""Axes that an array may have."""
MAX_DIGITS = 4000
"""Digits that the numerator or the denominator of an input may have, so that every input can be printed exactly."""
SINGLE = (float, str, Rational, Decimal)
"""What is one number, be it a good one or not, and no array."""


class Classes(NamedTuple):
    """NumPy's classes of what is given for a number; none where nobody has imported NumPy, as nothing is of them."""

    array: Any = ()
    masked: Any = ()
    floating: Any = ()
    not_real: Any = ()


NONE = Classes()


def _numpys(value: Any) -> Classes:
    """NumPy's classes that a value may be of; none for Python's own numbers."""
    np = None if type(value) in (float, int, Decimal) else sys.modules.get("numpy")
    if np is None:
        return NONE
    return Classes(np.ndarray, np.ma.MaskedArray, np.floating, (np.bool_, np.complexfloating, np.timedelta64))


def exact(value: Any, name: str = "value") -> Fraction:
    """Return ``value`` as the exact rational it stands for.

    Accepts int, float, NumPy real scalars, Fraction, Decimal and strings such as ``"9.81"``, ``"1e-3"``, ``"981/100"``.

    Raises:
        ValueError: the value is not finite or beyond MAX_DIGITS, or a string spells no number.
        TypeError: the value is not a real number.
    """
    found = _exact(value, name)
    if max(found.numerator.bit_length(), found.denominator.bit_length()) > (MAX_DIGITS + 1) * LOG2_10:
        raise _too_long(name)
    return found


def _too_long(name: str) -> ValueError:
    return ValueError(f"{name} has a numerator or denominator of more than {MAX_DIGITS} digits; fewer are accepted.")


def _exact(value: Any, name: str) -> Fraction:
    if type(value) is Fraction:
        return value
    if isinstance(value, str):
        return _spelled_number(value, name)
    _refuse_masked(value, name)
    numpys = _numpys(value)
    if isinstance(value, (bool, complex, numpys.not_real)):
        raise TypeError(f"{name} is {value!r}, which is not a real number; {ACCEPTED}.")
    if isinstance(value, Rational):
        return Fraction(int(value.numerator), int(value.denominator))
    if isinstance(value, numpys.array) and value.ndim == 0:
        return _exact(value[()], name)
    if isinstance(value, Decimal) and value.is_finite():
        return _spelled_number(str(value), name)
    if isinstance(value, (float, numpys.floating, Decimal)):
        if isinstance(value, Decimal) or not abs(value) < math.inf:
            raise ValueError(f"{name} is {value}, which is not finite; {ACCEPTED}.")
        return exact_value(value)
    raise TypeError(f"{name} is of type {type(value).__name__}; {ACCEPTED}.")


def _refuse_masked(values: Any, name: str) -> None:
    """A masked element is no number."""
    if isinstance(values, _numpys(values).masked):
        raise TypeError(f"{name} is a masked array, whose elements need not be numbers; {ACCEPTED}.")


def _spelled_number(text: str, name: str) -> Fraction:
    exponent = text.lower().partition("e")[2].strip().lstrip("+-0")
    if exponent.isdecimal() and (len(exponent) > 9 or int(exponent) > MAX_DIGITS):
        raise ValueError(f"{name} is '{short(text)}', whose exponent is beyond the limit of {MAX_DIGITS}.")
    try:
        return Fraction(text.strip())
    except (ValueError, ZeroDivisionError):
        if any(len(digits) > MAX_DIGITS for digits in re.findall(r"\d+", text)):
            raise _too_long(name) from None
        raise ValueError(f"{name} is '{short(text)}', which spells no number; {ACCEPTED}.") from None


def exact_array(values: Any, name: str = "value") -> tuple[list[Fraction], tuple[int, ...]]:
    """Return the exact rationals of ``values`` in C order, and the shape they came in.

    ``values`` is one number, an array of any shape, or nested sequences of numbers, strings or Fractions.

    Raises:
        ValueError: ``values`` is empty or ragged, or one of them is not finite.
        TypeError: ``values`` is or holds something else, such as bytes, dates, a mapping or a set.
        ModuleNotFoundError: ``values`` is no number and no list of numbers, and NumPy is not installed.
    """
    if isinstance(values, SINGLE):
        return [exact(values, name)], ()
    if isinstance(values, (list, tuple)) and values and all(isinstance(value, SINGLE) for value in values):
        return [exact(value, name) for value in values], (len(values),)
    from reference.arithmetic.arrays import np, with_subnormals

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


def _refuse_no_sequence(values: Any, name: str, depth: int = 0) -> None:
    """NumPy would take bytes, inside lists too, for numbers, and what is masked for what is under the mask."""
    _refuse_masked(values, name)
    if isinstance(values, NO_SEQUENCES):
        raise TypeError(f"{name} is of type {type(values).__name__}; {ACCEPTED}.")
    if isinstance(values, (list, tuple)):
        if depth == MAX_DEPTH:
            raise ValueError(f"{name} is nested more than {MAX_DEPTH} deep; an array with fewer axes is accepted.")
        for value in values:
            _refuse_no_sequence(value, name, depth + 1)


def _listed(values: Any) -> Any:
    """Iterables other than lists and tuples (ranges, generators) as lists."""
    if isinstance(values, Iterable) and not isinstance(values, (str, list, tuple)):
        return list(values)
    return values


def positive(value: Any, name: str, most: int | None = None) -> int:
    """Return a count as an int; NumPy's integers are counts, truth values are not.

    Raises:
        ValueError: it is not a positive integer, or more than ``most``.
    """
    count = _integer(value, name, 1, None, "a positive integer")
    if most is not None and count > most:
        raise ValueError(f"{name} is {said(count)}; at most {most} are accepted.")
    return count


def counted(value: Any, name: str, most: int, what: str = "", least: int = 0) -> int:
    """Return a number from ``least`` to ``most`` as an int; ``what`` says what it counts.

    Raises:
        ValueError: it is no such integer.
    """
    return _integer(value, name, least, most, f"an integer from {least} to {most}{what}")


def _integer(value: Any, name: str, least: int, most: int | None, accepted: str) -> int:
    try:
        count = least - 1 if isinstance(value, bool) else operator.index(value)
    except TypeError:
        count = least - 1
    if count < least or (most is not None and count > most):
        raise ValueError(f"{name} is {said(value)}; {accepted} is accepted.")
    return count


def rational_root(square: Fraction) -> Fraction | None:
    """The square root of a rational, where it is rational."""
    if square < 0:
        return None
    root = Fraction(math.isqrt(square.numerator), math.isqrt(square.denominator))
    return root if root * root == square else None


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
