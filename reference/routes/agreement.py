"""The routes against each other.

The enclosure decides every digit.  The other routes must agree with it: to REQUIRED_DIGITS digits of the size that
the quantity has over the arguments at hand, or everything stops.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.arithmetic.exact import spelled
from reference.arithmetic.limbs import exact_decimal
from reference.routes import enclosure

if TYPE_CHECKING:
    from collections.abc import Sequence

    from flint import arb

    from reference.declaration import Declared, Row

__all__ = ["FLOW_ACCURACY", "REQUIRED_DIGITS", "ROUTES", "ROUTE_DIGITS", "Agreement", "DisagreementError", "agreement"]

REQUIRED_DIGITS = 45
ROUTE_DIGITS, FLOW_DIGITS = 60, 50
"""To so many digits routes are held against the enclosure, and where that is a flow."""
ROUTE_ACCURACY, FLOW_ACCURACY = 219, 174
"""And to so many bits is the enclosure known there: 20 beyond these digits, and of flows, which cost more, 8."""
FAR = Fraction(10) ** 300
"""A gap that is larger is as bad."""
ROUTES = ("taylor", "quadrature")
"""The routes that are held against the enclosure."""


class DisagreementError(ArithmeticError):
    """Two routes to one number differ: one of them is wrong."""


@dataclass(frozen=True)
class Agreement:
    """How far one route agrees with the enclosure on one quantity: the least digits over ``checked`` elements."""

    digits: float
    checked: int


def agreement(problem: Declared, row: str, arguments: Sequence[Any], route: str) -> tuple[Agreement, ...] | None:
    """Compare a route with the enclosure on every argument: one Agreement a quantity, None if it has no such row.

    Digits are -log10(|difference| / scale), with the scale the largest absolute value of the quantity over the
    arguments: near its zeros a relative error would say nothing about the route.  Over an index each value is its own
    scale.

    Raises:
        DisagreementError: fewer than REQUIRED_DIGITS digits agree somewhere.
    """
    held, bits = (ROUTE_DIGITS, ROUTE_ACCURACY) if problem.has_closed_form else (FLOW_DIGITS, FLOW_ACCURACY)
    found = problem.by_route(route, row, arguments, held)
    if found is None:
        return None
    proven = enclosure.balls(problem, row, arguments, bits)
    asked, results = problem.row(row), []
    for i, quantity in enumerate(asked.quantities):
        pairs = [(truth[i], value[i]) for truth, value in zip(proven, found, strict=True)]
        each = [[pair] for pair in pairs] if asked.over == "index" else [pairs]
        digits = [found for compared in each for found in _digits(compared, held)]
        worst = min(range(len(pairs)), key=digits.__getitem__)
        if digits[worst] < REQUIRED_DIGITS:
            truth, value = pairs[worst]
            raise DisagreementError(
                f"{quantity.name} of {problem!r} at {_shown(asked, arguments[worst])} is {truth.str(50, radius=False)} "
                f"by the enclosure and {exact_decimal(value, 50)} by {route}: "
                f"{digits[worst]:.1f} digits agree where {REQUIRED_DIGITS} must."
            )
        results.append(Agreement(math.floor(digits[worst] * 10) / 10, len(pairs)))
    return tuple(results)


def _digits(pairs: Sequence[tuple[arb, Fraction]], most: int) -> list[float]:
    """The digits of each pair, at most so many, by exact arithmetic on the balls' middles and radii."""
    balls = [(_point(truth.mid()), _point(truth.rad()), value) for truth, value in pairs]
    scale = max(abs(middle) + radius for middle, radius, _ in balls) or Fraction(1)
    gaps = [float(min((abs(middle - value) + radius) / scale, FAR)) for middle, radius, value in balls]
    return [min(float(most), -math.log10(gap)) if gap else float(most) for gap in gaps]


def _point(exact: arb) -> Fraction:
    mantissa, exponent = exact.man_exp()
    return int(mantissa) * Fraction(2) ** int(exponent)


def _shown(row: Row, argument: Any) -> str:
    if argument is None:
        return "the given parameters"
    return f"{row.domain.name} = {spelled(argument)}" if isinstance(argument, Fraction) else f"index {argument}"
