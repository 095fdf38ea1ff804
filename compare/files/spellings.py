"""Numbers as programs spell them that write no plain decimals: each as the decimal that it stands for, or exactly.

U+2212 or a dash for minus; Fortran's 0.1-104, which leaves out the E of an exponent of three digits; Mathematica's
exponent 1.5*^-3, and its mark of precision 0.5`16.; a power of ten such as 1.5×10^-3; np.float64(0.5) and mpf('0.5'),
as numbers are shown within lists; a spreadsheet's ="0.5"; Julia's 0.5f0; and 0x1.8p-2 as C's %a prints the bits.
"""

from __future__ import annotations

import re
from fractions import Fraction

__all__ = ["hexadecimal", "spelled"]

NUMBER = r"[+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)"
MINUS = str.maketrans(dict.fromkeys("\u2010\u2011\u2012\u2013\u2212\ufe63\uff0d", "-"))
RAISED = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺", "0123456789-+")
PLAIN = re.compile(rf"{NUMBER}(?:[eEdDqQ][+-]?\d+)?", re.ASCII)
WRAPPERS = (
    "float", "float16", "float32", "float64", "float128", "longdouble", "double", "half", "single", "clongdouble",
    "mpf", "decimal", "bigfloat", "real128", "real", "array", "tensor",
)  # fmt: skip
WRAPPED = re.compile(
    rf"(?:[a-z_]\w*\.)*(?:{'|'.join(WRAPPERS)})\((['\"]?)({NUMBER}(?:[edq][+-]?\d+)?)\1\)", re.IGNORECASE | re.ASCII
)
FORMULA = re.compile(rf"=\s*(\"?)({NUMBER}(?:[eE][+-]?\d+)?)\1", re.ASCII)
NO_LETTER = re.compile(r"([+-]?\d*\.\d+)([+-][1-9]\d\d)", re.ASCII)
MATHEMATICA = re.compile(rf"({NUMBER})(?:``?(?:\d+\.?\d*)?)?(?:\*\^([+-]?\d+))?", re.ASCII)
POWER = re.compile(rf"({NUMBER})\s*[*x×·⋅]\s*10(?:\^|\*\*)?\s*[({{]?([+-]?\d+)[)}}]?", re.ASCII)
SINGLE = re.compile(rf"({NUMBER})f([+-]?\d+)", re.ASCII)
HEX = re.compile(r"([+-]?)0x([0-9a-f]*)(?:\.([0-9a-f]*))?(?:p([+-]?\d{1,6}))?", re.IGNORECASE | re.ASCII)


def spelled(word: str) -> str | None:
    """The decimal that a word stands for, with its own decimal mark; None where it is none of these spellings."""
    text = word.translate(MINUS)
    if PLAIN.fullmatch(text):
        return text
    for pattern in (NO_LETTER, MATHEMATICA, SINGLE):
        match = pattern.fullmatch(text)
        if match:
            return f"{match[1]}e{match[2]}" if match[2] else match[1]
    match = POWER.fullmatch(text.translate(RAISED))
    if match:
        return f"{match[1]}e{match[2]}"
    match = WRAPPED.fullmatch(text) or FORMULA.fullmatch(text)
    return match[2] if match else None


def hexadecimal(word: str) -> tuple[Fraction, int] | None:
    """A number in hexadecimal digits and a power of two, exactly, and how many bits it has; None where it is none."""
    match = HEX.fullmatch(word.translate(MINUS))
    digits = match[2] + (match[3] or "") if match else ""
    if match is None or not digits:
        return None
    mantissa = int(digits, 16) * (-1 if match[1] == "-" else 1)
    value = mantissa * Fraction(2) ** (int(match[4] or 0) - 4 * len(match[3] or ""))
    return value, abs(mantissa).bit_length()
