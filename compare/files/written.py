"""A number as it was handed in: its exact value, and how many digits its format can hold.

A decimal is exact as written, whatever its length; a floating-point number at its binary value.
"""

from __future__ import annotations

import math
import re
from decimal import Decimal
from fractions import Fraction
from numbers import Rational
from typing import Any, NamedTuple

import numpy as np

from compare.files.spellings import hexadecimal, spelled
from reference.arithmetic.exact import MAX_DIGITS, as_number, exact
from reference.names import short

__all__ = ["BINARY64_DIGITS", "LOG10_2", "ROUND_TRIP_DIGITS", "Written", "of_decimal", "of_value"]

LOG10_2 = math.log10(2)
BINARY64_DIGITS = 53 * LOG10_2
ROUND_TRIP_DIGITS = 17
"""Significant decimal digits that tell any two binary64 numbers apart."""
DECIMAL = re.compile(r"([+-]?)(\d*)(?:\.(\d*))?(?:[eEdDqQ]([+-]?\d+))?", re.ASCII)
"""A decimal; Fortran writes its exponents with D or Q where they are of double or quadruple precision."""
NOT_FINITE = re.compile(r"[+-]?(nan|inf|infinity|1\.#(nan|inf|ind|qnan))(\(.*\))?", re.IGNORECASE)
DECIMAL_COMMA = re.compile(r"[+-]?(\d+,\d*|,\d+)([edq][+-]?\d+)?", re.IGNORECASE | re.ASCII)
ACCEPTED = "a number such as 0.5, -1.25e-3 or 1D0 is accepted"


class Written(NamedTuple):
    """One number as it was handed in.

    Attributes:
        value: the number, exactly.
        text: how it is shown.
        digits: significant decimal digits: those written, or those that the binary format can hold.
        last: power of ten of the last digit of a decimal; None for a binary or rational number, which has none.
    """

    value: Fraction
    text: str
    digits: float
    last: int | None = None


def of_decimal(text: str, name: str = "value") -> Written:
    """Return the decimal that ``text`` spells.

    Raises:
        ValueError: it spells none, or one that is not finite or beyond the limits of an input.
    """
    word = text.strip()
    match = DECIMAL.fullmatch(word) or DECIMAL.fullmatch(spelled(word) or "")
    digits = match[2] + (match[3] or "") if match else ""
    if match is None or not digits:
        return _of_hexadecimal(word, name)
    exponent = match[4] or "0"
    last = int(exponent[:10]) - len(match[3] or "")  # ten characters tell an exponent that is beyond the limit
    if len(digits) > MAX_DIGITS or abs(last) > MAX_DIGITS:
        raise ValueError(f"{name} is '{short(word)}', beyond the limit of {MAX_DIGITS} digits.")
    mantissa = int(digits) * (-1 if match[1] == "-" else 1)
    value = Fraction(mantissa * 10**last) if last >= 0 else Fraction(mantissa, 10**-last)
    return Written(value, match.string, len(digits.lstrip("0")), last)


def _of_hexadecimal(word: str, name: str) -> Written:
    """The binary number that hexadecimal digits spell, shown as the double or the fraction that it is.

    Raises:
        ValueError: they spell none.
    """
    found = hexadecimal(word) if len(word) <= MAX_DIGITS else None
    if found is None:
        raise ValueError(_refusal(word, name))
    value, bits = exact(found[0], name), found[1]
    text = as_number(value)
    return Written(value, text if isinstance(text, str) else repr(text), max(bits * LOG10_2, BINARY64_DIGITS))


def _refusal(word: str, name: str) -> str:
    if NOT_FINITE.fullmatch(word):
        return f"{name} is {short(word)}, which is not finite; {ACCEPTED}."
    if not word:
        return f"{name} is empty; {ACCEPTED}."
    if DECIMAL_COMMA.fullmatch(word):
        return f"{name} is '{short(word)}', with a decimal comma; a decimal point is accepted."
    return f"{name} is '{short(word)}', which is not a number; {ACCEPTED}."


def of_value(value: Any, name: str = "value") -> Written:
    """Return what a Python object stands for: a string, Decimal, Fraction, integer or floating-point number.

    Raises:
        ValueError: it is not finite, or a string that spells no number.
        TypeError: it is no real number.
    """
    if type(value) is float and math.isfinite(value):
        return Written(Fraction(value), repr(value), BINARY64_DIGITS)
    if isinstance(value, str) or (isinstance(value, Decimal) and value.is_finite()):
        return of_decimal(str(value), name)
    if hasattr(type(value), "man_exp"):  # it raises of what is not finite
        return _of_mpmath(value, name)
    if type(value).__module__.startswith("heyoka"):
        return _of_heyoka(value, name)
    return _of_standard(value, name)


def _of_standard(value: Any, name: str) -> Written:
    """Python's and NumPy's own numbers."""
    found = exact(value, name)
    if isinstance(value, np.floating):
        return Written(found, str(value), (np.finfo(type(value)).nmant + 1) * LOG10_2)
    if isinstance(value, Rational):
        bits = abs(found.numerator).bit_length() + found.denominator.bit_length()
        return Written(found, str(found), max(bits * LOG10_2, BINARY64_DIGITS))
    return Written(found, repr(float(value)), BINARY64_DIGITS)


def _of_mpmath(value: Any, name: str) -> Written:
    """A number of mpmath's, of the digits that its working precision or its own mantissa has."""
    mp = value.context
    if not mp.isfinite(value):
        raise ValueError(f"{name} is {value}, which is not finite; {ACCEPTED}.")
    mantissa, exponent = (int(part) for part in value.man_exp)
    digits = max(mantissa.bit_length(), mp.prec) * LOG10_2
    sign = -1 if value < 0 else 1  # man_exp is of the absolute value
    return Written(sign * mantissa * Fraction(2) ** exponent, mp.nstr(value, math.ceil(digits) + 1), digits)


def _of_heyoka(value: Any, name: str) -> Written:
    """A binary128 or MPFR number: the sum of doubles, each the nearest to what those before it leave."""
    if not math.isfinite(float(value)):
        raise ValueError(f"{name} is {value}, which is not finite; {ACCEPTED}.")
    found, rest = Fraction(0), value
    while rest != 0:
        limb = float(rest)
        found, rest = found + Fraction(limb), rest - limb
    return Written(found, str(value), getattr(value, "prec", 113) * LOG10_2)
