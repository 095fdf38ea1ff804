"""What a printed solution should be: a component of a problem's state at one time, proven."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING

from reference.problems.families import find_family

if TYPE_CHECKING:
    from compare.sources.published.number import Number
    from compare.sources.published.source import Table

__all__ = ["as_printed", "component"]


def component(table: Table, row: str) -> Number:
    """The component that a row names, at the table's time: of its problem, or of the one before it in the row."""
    *named, name = row.split()
    problem = find_family(named[0] if named else table.parameters["problem"]).problem()
    return problem.certified("state", Fraction(table.parameters["t"]), problem.state_names.index(name))


def as_printed(number: Number, printed: str) -> str:
    """The number rounded to the last digit that is printed, with the same power of ten if there is one."""
    mantissa, e, power = printed.partition("e")
    places = len(mantissa.partition(".")[2])
    if not e:
        return number.fixed(places)
    return f"{Decimal(number.fixed(places - int(power))).scaleb(-int(power)):f}{e}{power}"
