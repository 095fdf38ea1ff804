"""What a file says of its values beside their limbs: decimals of 50 digits, and how far the routes agreed.

A file is not loaded where its decimals are not those of the limbs, as far as these go, or its measurements cannot be.
Verifying proves every digit of the decimals again.  The measurements are those of the build, of more arguments than are
asked for again: the routes must agree as far again.
"""

from __future__ import annotations

import math
import re
from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING

from reference.arithmetic.limbs import exact_decimal
from reference.names import short
from reference.routes.agreement import REQUIRED_DIGITS, ROUTE_DIGITS, ROUTES

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence
    from typing import Any

    import numpy as np

    from reference.declaration import Row

__all__ = ["DECIMAL_DIGITS", "attributes", "decimal_fault", "free_attributes", "limbs_fault", "measurement_fault"]

DECIMAL_DIGITS = 50
LONGEST_DECIMAL = 60
"""Characters of -0.000000 and 50 digits, and the blank after them."""
DECIMAL = re.compile(r"-?\d{1,50}(\.\d{1,56})?(e[+-]\d{1,4})?")


def attributes(
    row: Row, digits: Sequence[float], checked: Sequence[int], decimals: Sequence[str]
) -> dict[str, str | float | int]:
    """The attributes of a row's variable: for each of ROUTES its digits over how many elements; its decimals."""
    found: dict[str, str | float | int] = {}
    for route, agreed, count in zip(ROUTES, digits, checked, strict=True):
        found[f"{route}_checked_elements"] = count
        if count:
            found[f"{route}_digits"] = agreed
        else:
            found[f"{route}_reason"] = _reason(row, route)
    found["checked_elements"] = min(count for count in checked if count)
    if decimals:
        found["decimal"] = " ".join(decimals)
    return found


def _reason(row: Row, route: str) -> str:
    return dict(row.lacks).get(route, f"the {route} route does not reach these arguments")


def free_attributes(row: Row) -> set[str]:
    """The attributes in which the files of one schema differ: measurements, and a scalar's decimals."""
    found = {f"{route}_{what}" for route in ROUTES for what in ("digits", "reason", "checked_elements")}
    return found | {"checked_elements"} | ({"decimal"} if row.over == "once" else set())


def limbs_fault(text: str, limbs: np.ndarray, limit: int) -> str:
    """What is wrong with a variable's decimals, given its limbs, float64 (n, 3); empty where nothing is.

    They may differ by the roundings of the last limb and of the last digit.  A text of ``limit`` bytes is left out.
    """
    numbers = text.split()
    if not text and len(limbs) * LONGEST_DECIMAL >= limit:
        return ""
    if len(numbers) != len(limbs):
        return f"the attribute 'decimal' has {len(numbers)} numbers where {len(limbs)} are expected"
    for i, (said, stored) in enumerate(zip(numbers, limbs.tolist(), strict=True)):
        if not DECIMAL.fullmatch(said) or exact_decimal(Fraction(said), DECIMAL_DIGITS) != said:
            return f"the attribute 'decimal' says '{short(said)}' of element {i}; {DECIMAL_DIGITS} digits are expected"
        last_digit = Fraction(10) ** (Decimal(said).adjusted() - DECIMAL_DIGITS + 1) if said != "0" else Fraction(0)
        rounding = (Fraction(math.ulp(stored[-1])) + last_digit) / 2
        if abs(Fraction(said) - sum(map(Fraction, stored))) > rounding:
            return f"the attribute 'decimal' says {said} of element {i}, which is stored as {stored}"
    return ""


def decimal_fault(decimals: str, proven: Sequence[str], limit: int) -> str:
    """What is wrong with a variable's attribute ``decimal``, given the proven ones in order; empty where nothing is.

    A text of ``limit`` bytes is too long for an attribute, and left out.
    """
    text = " ".join(proven)
    expected = proven if len(text) < limit else ()
    stored = decimals.split()
    if len(stored) != len(expected):
        return f"the attribute 'decimal' has {len(stored)} numbers where {len(expected)} are expected"
    for i, (said, shown) in enumerate(zip(stored, expected, strict=True)):
        if said != shown:
            return f"the attribute 'decimal' says {said} of element {i}, which is proven to be {shown}"
    return ""


def measurement_fault(said: Mapping[str, Any], size: int, row: Row, agreeing: Collection[str] | None = None) -> str:
    """What is wrong with the measurements of a row's variable of ``size`` elements; empty where nothing is.

    Where the routes have been asked again, ``agreeing`` are those that agree.
    """
    counts = []
    for route in ROUTES:
        count = said.get(f"{route}_checked_elements")
        possible = isinstance(count, int) and 0 <= count <= size
        if not possible or (agreeing is not None and bool(count) != (route in agreeing)):
            return f"the attribute '{route}_checked_elements' is {count}, which is not how many it can have been"
        names = {f"{route}_digits"} if count else {f"{route}_reason"}
        if names != {name for name in (f"{route}_digits", f"{route}_reason") if name in said}:
            return (
                f"of the attributes '{route}_digits' and '{route}_reason' not the one that belongs to {count} is there"
            )
        digits = said.get(f"{route}_digits", math.inf)
        if count and not (isinstance(digits, float) and REQUIRED_DIGITS <= digits <= ROUTE_DIGITS):
            return f"the attribute '{route}_digits' is {digits}; from {REQUIRED_DIGITS} to {ROUTE_DIGITS} are possible"
        if not count and said[f"{route}_reason"] != _reason(row, route):
            return f"the attribute '{route}_reason' is not the schema's"
        counts.append(count)
    if said.get("checked_elements") != min((count for count in counts if count), default=None):
        return f"the attribute 'checked_elements' is {said.get('checked_elements')}, not the least of the routes'"
    return ""
