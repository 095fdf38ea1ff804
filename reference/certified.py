"""The routes against each other, and the certified number that comes of it.

The enclosure decides every digit.  The other routes must agree with it: to REQUIRED_DIGITS digits of the size that
the quantity has over the arguments at hand, or everything stops.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.arithmetic.exact import counted, positive, spelled
from reference.arithmetic.limbs import MAX_DIGITS, MAX_LIMBS, decimal, exact_decimal, interval, to_fixed, to_limbs
from reference.once import cached_property
from reference.routes import enclosure

if TYPE_CHECKING:
    from collections.abc import Sequence

    from flint import arb

    from reference.problem import Problem, Quantity, Row

__all__ = ["REQUIRED_DIGITS", "ROUTES", "Agreement", "Certified", "DisagreementError", "agreement"]

REQUIRED_DIGITS = 45
ROUTE_DIGITS = 60
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


def agreement(problem: Problem, row: str, arguments: Sequence[Any], route: str) -> tuple[Agreement, ...] | None:
    """Compare a route with the enclosure on every argument: one Agreement a quantity, None if it has no such row.

    Digits are -log10(|difference| / scale), with the scale the largest absolute value of the quantity over the
    arguments: near its zeros a relative error would say nothing about the route.  Over an index each value is its own
    scale.

    Raises:
        DisagreementError: fewer than REQUIRED_DIGITS digits agree somewhere.
    """
    found = problem.by_route(route, row, arguments, ROUTE_DIGITS)
    if found is None:
        return None
    proven = enclosure.balls(problem, row, arguments, int(ROUTE_DIGITS * 3.33) + 20)
    asked, results = problem.row(row), []
    for i, quantity in enumerate(asked.quantities):
        pairs = [(truth[i], value[i]) for truth, value in zip(proven, found, strict=True)]
        each = [[pair] for pair in pairs] if asked.over == "index" else [pairs]
        digits = [found for compared in each for found in _digits(compared)]
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


def _digits(pairs: Sequence[tuple[arb, Fraction]]) -> list[float]:
    """The digits of each pair, at most ROUTE_DIGITS, by exact arithmetic on the balls' middles and radii."""
    balls = [(_point(truth.mid()), _point(truth.rad()), value) for truth, value in pairs]
    scale = max(abs(middle) + radius for middle, radius, _ in balls) or Fraction(1)
    gaps = [float(min((abs(middle - value) + radius) / scale, FAR)) for middle, radius, value in balls]
    return [min(float(ROUTE_DIGITS), -math.log10(gap)) if gap else float(ROUTE_DIGITS) for gap in gaps]


def _point(exact: arb) -> Fraction:
    mantissa, exponent = exact.man_exp()
    return int(mantissa) * Fraction(2) ** int(exponent)


def _shown(row: Row, argument: Any) -> str:
    if argument is None:
        return "the given parameters"
    return f"{row.domain.name} = {spelled(argument)}" if isinstance(argument, Fraction) else f"index {argument}"


@dataclass(frozen=True)
class Certified:
    """A proven real number: as a float, as limbs, and to any number of decimal digits, each correctly rounded.

    Raises:
        KeyError: the problem has no such row.
        ValueError: the argument is outside of the row's domain, or the row has no such component.
        TypeError: the argument is no real number.
    """

    problem: Problem
    row: str
    argument: Any = None
    component: int = 0

    def __post_init__(self) -> None:
        (argument,) = self.problem.arguments(self.row, [self.argument])
        names = [quantity.name for quantity in self.problem.row(self.row).quantities]
        component = counted(self.component, "component", len(names) - 1, f" ({', '.join(names)})")
        object.__setattr__(self, "argument", argument)
        object.__setattr__(self, "component", component)

    @property
    def quantity(self) -> Quantity:
        """Name, units and definition."""
        return self.problem.row(self.row).quantities[self.component]

    def _decide(self, of_ball: Any, of_exact: Any, bits: int) -> Any:
        asked = self.problem, self.row, [self.argument]
        ((found,),) = enclosure.decide(*asked, of_ball, of_exact, bits, component=self.component)
        return found

    def limbs(self, count: int = 3) -> tuple[float, ...]:
        """The correctly rounded double and the ``count`` - 1 limbs of its tail.

        Raises:
            ValueError: ``count`` is not an integer from 1 to MAX_LIMBS.
            WorkBoundError: a limb could not be decided within the bound on the working precision.
        """
        count = positive(count, "limbs", MAX_LIMBS)
        return self._decide(*to_limbs(count), 53 * count)  # type: ignore[no-any-return]

    @cached_property
    def _three(self) -> tuple[float, ...]:
        return self.limbs(3)

    def __float__(self) -> float:
        return self._three[0]

    @property
    def tail(self) -> tuple[float, float]:
        """The two limbs after the double: value + tail[0] + tail[1] has about 48 correct digits."""
        return self._three[1], self._three[2]

    def digits(self, count: int = 50) -> str:
        """The decimal of ``count`` significant digits, correctly rounded.

        Raises:
            ValueError: ``count`` is not an integer from 1 to MAX_DIGITS.
            WorkBoundError: the digits could not be decided within the bound on the working precision.
        """
        count = positive(count, "digits", MAX_DIGITS)
        return self._decide(  # type: ignore[no-any-return]
            lambda ball: decimal(interval(ball), count),
            lambda value: exact_decimal(value, count),
            math.ceil(count * math.log2(10)) + 8,
        )

    def fixed(self, places: int) -> str:
        """The decimal of ``places`` decimal places, correctly rounded.

        Raises:
            ValueError: ``places`` is not an integer from 0 to MAX_DIGITS.
            WorkBoundError: the digits could not be decided within the bound on the working precision.
        """
        places = counted(places, "places", MAX_DIGITS)
        bits = math.ceil(places * math.log2(10)) + 64  # more where the number is large: the proof doubles them
        return self._decide(*to_fixed(places), bits)  # type: ignore[no-any-return]

    def __format__(self, spec: str) -> str:
        """As a float is formatted; with a precision and "e", "f" or "g" every digit shown is proven."""
        from reference.formatting import formatted

        return formatted(self, spec)

    @cached_property
    def routes(self) -> dict[str, float]:
        """The routes to this number and the digits to which each agrees with the enclosure (at most 60 are compared).

        Raises:
            DisagreementError: a route differs within the first 45 digits.
        """
        agreed: dict[str, float] = {"enclosure": math.inf}
        for route in ROUTES:
            found = agreement(self.problem, self.row, [self.argument], route)
            if found is not None:
                agreed[route] = found[self.component].digits
        return agreed

    def __repr__(self) -> str:
        units = "" if self.quantity.units == "1" else f" {self.quantity.units}"
        return f"{self.quantity.name} = {self.digits(17)}{units}"
