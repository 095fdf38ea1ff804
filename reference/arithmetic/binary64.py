"""Binary64 numbers by their bits, without floating-point arithmetic.

So it is right for subnormal numbers too where the processor takes them for zero (``underflow``): there 1e-310 == 0.0,
its ``repr`` is "0.0", and ``math.ldexp`` gives zero instead of it.
"""

from __future__ import annotations

import struct
import sys
from decimal import Context, Decimal
from fractions import Fraction
from typing import Any

__all__ = [
    "BINARY64_BITS",
    "bits_of",
    "exact_value",
    "hexadecimal",
    "is_subnormal",
    "nearest",
    "number_of",
    "parts",
    "pattern",
    "rounded",
    "shortest",
]

BINARY64_BITS = 53
DECIMAL_DIGITS = 17
"""Significant decimal digits that tell any two binary64 numbers apart."""
MIN_EXPONENT = -1074
BIAS = 1075
"""m 2^e of a normal number, 2^52 <= m < 2^53, is stored with the exponent e + BIAS."""
INFINITE = 0x7FF << 52
"""The bits of infinity; those of a finite number are below."""
NORMAL = 2.0**-1022
"""From here on numbers are normal, and all arithmetic on them is as always."""
NORMAL_EXPONENTS = 1000
SIGN = 1 << 63
LEADING = 1 << 52
PLACES = {2: (10, 5), 4: (23, 8), 8: (52, 11)}
"""Bits of the significand, without the leading one, and of the exponent, in a number of so many bytes."""


def rounded(mantissa: int, exponent: int, bits: int, min_exponent: int | None = None) -> tuple[int, int]:
    """Round ``mantissa * 2^exponent`` to ``bits`` bits, nearest, ties to even: the result as (mantissa, exponent).

    With ``min_exponent`` no bit below 2^min_exponent is kept (gradual underflow).
    """
    drop = mantissa.bit_length() - bits
    if min_exponent is not None:
        drop = max(drop, min_exponent - exponent)
    if drop <= 0:
        return mantissa, exponent
    if drop > mantissa.bit_length():
        return 0, exponent + drop
    floor, rest = mantissa >> drop, mantissa & ((1 << drop) - 1)
    half = 1 << (drop - 1)
    if rest > half or (rest == half and floor & 1):
        floor += 1
    return floor, exponent + drop


def pattern(mantissa: int, exponent: int) -> int:
    """The 64 bits of ``mantissa * 2^exponent`` correctly rounded; zero is +0.0, and beyond the range is infinity."""
    sign, size = (SIGN, -mantissa) if mantissa < 0 else (0, mantissa)
    size, exponent = rounded(size, exponent, BINARY64_BITS, MIN_EXPONENT)
    if not size:
        return 0
    spare = min(BINARY64_BITS - size.bit_length(), exponent - MIN_EXPONENT)  # -1 where it was rounded to 2^53
    size, exponent = (size >> 1 if spare < 0 else size << spare), exponent - spare
    bits = size if size < LEADING else ((exponent + BIAS) << 52) + (size - LEADING)
    return sign | min(bits, INFINITE)


def bits_of(value: float) -> int:
    """The 64 bits of a number."""
    return int.from_bytes(struct.pack("<d", value), "little")


def number_of(bits: int) -> float:
    """The number that has these 64 bits."""
    found: float = struct.unpack("<d", bits.to_bytes(8, "little"))[0]
    return found


def parts(bits: int) -> tuple[int, int]:
    """The finite number that has these 64 bits, as (mantissa, exponent): mantissa 2^exponent."""
    field, size = (bits >> 52) & 0x7FF, bits & (LEADING - 1)
    size, exponent = (size | LEADING, field - BIAS) if field else (size, MIN_EXPONENT)
    return -size if bits & SIGN else size, exponent


def nearest(value: Fraction) -> float:
    """An exact rational correctly rounded to binary64; infinite where it is beyond the range."""
    top, bottom = value.numerator, value.denominator
    if abs(top.bit_length() - bottom.bit_length()) < NORMAL_EXPONENTS:
        return top / bottom  # Python rounds the quotient of two integers correctly
    shift = max(0, BINARY64_BITS + 2 - top.bit_length() + bottom.bit_length())
    quotient, rest = divmod(abs(top) << shift, bottom)
    quotient = 2 * quotient + bool(rest)  # what is left of the quotient only breaks ties
    return number_of(pattern(-quotient if top < 0 else quotient, -shift - 1))


def exact_value(value: Any) -> Fraction:
    """A finite float of Python's or NumPy's as the rational it is."""
    if isinstance(value, float) and abs(value) >= NORMAL:
        return Fraction(*value.as_integer_ratio())
    stored = struct.pack("=d", value) if isinstance(value, float) else value.tobytes()
    if len(stored) not in PLACES:
        return Fraction(*(int(part) for part in value.as_integer_ratio()))
    places, width = PLACES[len(stored)]
    bits = int.from_bytes(stored, sys.byteorder)
    field, size = (bits >> places) & ((1 << width) - 1), bits & ((1 << places) - 1)
    exponent = max(field, 1) - (1 << (width - 1)) + 1 - places
    size = (size | 1 << places if field else size) * (-1 if bits >> (places + width) else 1)
    return Fraction(size << exponent) if exponent >= 0 else Fraction(size, 1 << -exponent)


def is_subnormal(value: float) -> bool:
    """Whether a number is one of those below 2^-1022 that are not zero."""
    return 0 < bits_of(value) & ~SIGN < LEADING


def hexadecimal(value: float) -> str:
    """``value.hex()``."""
    if not is_subnormal(value):
        return value.hex()
    bits = bits_of(value)
    return f"{'-' if bits & SIGN else ''}0x0.{bits & ~SIGN:013x}p-1022"


def shortest(value: float) -> str:
    """``repr(value)``: the shortest decimal that is read as this number."""
    if not is_subnormal(value):
        return repr(value)
    bits = bits_of(value)
    size, scale = Decimal(parts(bits)[0]), Decimal(1 << -MIN_EXPONENT)
    texts = (str(Context(prec=digits).divide(size, scale)).lower() for digits in range(1, DECIMAL_DIGITS + 1))
    return next(text for text in texts if bits_of(nearest(Fraction(text))) == bits)
