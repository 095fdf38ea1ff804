"""A certified number in a format string: laid out as a float is, from digits that are proven."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from reference.arithmetic.binary64 import is_subnormal
from reference.arithmetic.underflow import require_gradual
from reference.names import short

if TYPE_CHECKING:
    from reference.certified import Certified

__all__ = ["formatted"]

SPEC = re.compile(
    r"(?:(?P<fill>.)?(?P<align>[<>=^]))?(?P<sign>[-+ ]?)(?P<zero>0?)(?P<width>\d*)"
    r"(?P<group>[,_]?)\.(?P<precision>\d+)(?P<type>[eEfFgG])",
    re.DOTALL,
)
SIGNED = re.compile(r"((?:.?[<>=^])?[-+ ]?)", re.DOTALL)
"""What stands before the "z" that takes the sign of a zero away."""
SMALLEST_PLAIN = -4
"""The least decimal exponent that "g" writes without an exponent."""


def formatted(value: Certified, spec: str) -> str:
    """The number as ``format(float(value), spec)`` would lay it out, but for zeros, which have no sign.

    For "e", "f" and "g" with a precision the digits are the correctly rounded ones of the number itself, however many;
    anything else formats the nearest double.

    Raises:
        UnderflowModeError: the nearest double is subnormal, and the processor takes it for zero.
    """
    asked = SPEC.fullmatch(spec)
    if asked is None or (asked["group"] and (asked["zero"] or asked["align"] == "=")):
        number = float(value)
        if is_subnormal(number):
            require_gradual(f"{value.quantity.name} in the format '{short(spec)}'")
        return format(number, spec if "z" in spec else SIGNED.sub(r"\1z", spec, count=1))
    precision, kind = int(asked["precision"]), asked["type"].lower()
    text = {"e": _scientific, "f": _fixed, "g": _general}[kind](value, precision)
    body = text.removeprefix("-")
    if asked["group"]:
        whole = re.match(r"\d+", body)
        body = format(int(whole[0]), asked["group"]) + body[whole.end() :] if whole else body
    sign = "-" if text != body and text.startswith("-") else asked["sign"].replace("-", "")
    body = body.upper() if asked["type"].isupper() else body
    return _padded(sign, body, asked)


def _padded(sign: str, body: str, asked: re.Match[str]) -> str:
    align = asked["align"] or ("=" if asked["zero"] else ">")
    fill = asked["fill"] or ("0" if asked["zero"] else " ")
    missing = max(0, int(asked["width"] or 0) - len(sign) - len(body))
    before = {"<": 0, ">": missing, "=": missing, "^": missing // 2}[align]
    if align == "=":
        return sign + fill * before + body
    return fill * before + sign + body + fill * (missing - before)


def _fixed(value: Certified, places: int) -> str:
    return value.fixed(places)


def _scientific(value: Certified, places: int) -> str:
    sign, digits, exponent = _parts(value, places + 1)
    return f"{sign}{_pointed(digits, 1)}e{exponent:+03d}"


def _general(value: Certified, precision: int) -> str:
    count = max(1, precision)
    sign, digits, exponent = _parts(value, count)
    kept = digits.rstrip("0") or "0"
    if not SMALLEST_PLAIN <= exponent < count:
        return f"{sign}{_pointed(kept, 1)}e{exponent:+03d}"
    if exponent < 0:
        return f"{sign}0.{'0' * (-exponent - 1)}{kept}"
    return sign + _pointed(kept.ljust(exponent + 1, "0"), exponent + 1)


def _pointed(digits: str, whole: int) -> str:
    return f"{digits[:whole]}.{digits[whole:]}" if len(digits) > whole else digits


def _parts(value: Certified, count: int) -> tuple[str, str, int]:
    """Sign, ``count`` significant digits and the exponent of the first of them."""
    text = value.digits(count)
    mantissa, _, written = text.removeprefix("-").partition("e")
    whole, _, rest = mantissa.partition(".")
    digits = (whole + rest).lstrip("0")
    if not digits:
        return "", "0" * count, 0
    exponent = len(whole) - 1 if whole != "0" else len(digits) - len(rest) - 1
    return "-" if text.startswith("-") else "", digits, exponent + int(written or 0)
