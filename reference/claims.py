"""What a file says of its values beside their limbs: decimals of 50 digits, and how far the routes agreed.

The decimals are proven again.  The measurements are those of the build, of more arguments than are asked for again:
they must be possible, and the routes must agree as far again.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from reference.certify import REQUIRED_DIGITS, ROUTE_DIGITS, ROUTES

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence
    from typing import Any

    from reference.problem import Row
    from reference.store import Variable

__all__ = ["attributes", "decimal_fault", "measurement_fault"]


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


def decimal_fault(variable: Variable, proven: Sequence[str], limit: int) -> str:
    """What is wrong with a variable's decimals, given the proven ones in order; empty where nothing is.

    A text of ``limit`` bytes is too long for an attribute, and left out.
    """
    text = " ".join(proven)
    expected = proven if len(text) < limit else ()
    stored = str(variable.attrs.get("decimal", "")).split()
    if len(stored) != len(expected):
        return f"the attribute 'decimal' has {len(stored)} numbers where {len(expected)} are expected"
    for i, (said, shown) in enumerate(zip(stored, expected, strict=True)):
        if said != shown:
            return f"the attribute 'decimal' says {said} of element {i}, which is proven to be {shown}"
    return ""


def measurement_fault(variable: Variable, row: Row, agreeing: Iterable[str]) -> str:
    """What is wrong with the measurements of a row's variable, given the routes that agree again; empty where none."""
    said: Mapping[str, Any] = variable.attrs
    served = set(agreeing)
    counts = []
    for route in ROUTES:
        count = said.get(f"{route}_checked_elements")
        if (
            not isinstance(count, int)
            or not 0 <= count <= math.prod(variable.shape)
            or bool(count) != (route in served)
        ):
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
