"""What of a score counts against an earlier one: digits on scale, the largest errors, and how far the rows go."""

from __future__ import annotations

import math
import sys
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from compare.baseline import Entry, Gate, Large, Small
from compare.files.limits import ERROR_FACTOR
from compare.files.written import BINARY64_DIGITS, ROUND_TRIP_DIGITS, of_decimal

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

__all__ = ["GATE", "ROUNDING_DIGITS"]

ROUNDING_DIGITS = 3.0
"""The last digits of those that doubles, or longer numbers, hold, which rounding over a march may take."""
SHORTER = 1e-9
"""Part of the last time that may be missing: rounding of a sum of steps."""
ROWS = "the rows"


def _facts(document: Any) -> Mapping[str, Any]:
    return {"problem": document["problem"]}


def _entries(document: Any, factor: float | None) -> Iterator[Entry]:
    factor = ERROR_FACTOR if factor is None else factor
    held = document["digits_held"]
    enough = (held if held > ROUND_TRIP_DIGITS else BINARY64_DIGITS) - ROUNDING_DIGITS
    yield Entry(ROWS, "digits on scale", document["worst_scaled_digits"], Large(math.log10(factor), enough))
    for name, error in document["max_errors"].items():
        least = document["scales"][name] * 10.0**-enough
        yield Entry(name, "largest error", error, Small(factor, least))
    last = _number(document["points"][-1]["t"])
    yield Entry(ROWS, "last time", last, Large(SHORTER * abs(last)))


def _number(text: str) -> float:
    """A time as it is shown, a decimal or a fraction; one beyond the range of doubles is the last of them."""
    numerator, _, denominator = text.partition("/")
    value = of_decimal(numerator).value / of_decimal(denominator or "1").value
    return float(min(value, Fraction(sys.float_info.max)))


GATE = Gate("score", _facts, _entries)
