"""A certified number: as a float, as limbs, as decimals and in a format string, every digit of each proven."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from reference.arithmetic.binary64 import is_subnormal
from reference.arithmetic.exact import counted, positive
from reference.arithmetic.limbs import MAX_DIGITS, MAX_LIMBS, decimal, exact_decimal, interval, to_fixed, to_limbs
from reference.arithmetic.underflow import require_gradual
from reference.names import short
from reference.once import cached_property
from reference.routes import enclosure
from reference.routes.agreement import ROUTES, agreement

if TYPE_CHECKING:
    from reference.declaration import Declared, Quantity

__all__ = ["Certified"]

SPEC = re.compile(
    r"(?:(?P<fill>.)?(?P<align>[<>=^]))?(?P<sign>[-+ ]?)(?P<zero>0?)(?P<width>\d*)"
    r"(?P<group>[,_]?)\.(?P<precision>\d+)(?P<type>[eEfFgG])",
    re.DOTALL,
)
SIGNED = re.compile(r"((?:.?[<>=^])?[-+ ]?)", re.DOTALL)
"""What stands before the "z" that takes the sign of a zero away."""
SMALLEST_PLAIN = -4
"""The least decimal exponent that "g" writes without an exponent."""


@dataclass(frozen=True)
class Certified:
    """A proven real number: as a float, as limbs, and to any number of decimal digits, each correctly rounded.

    Raises:
        KeyError: the problem has no such row.
        ValueError: the argument is outside of the row's domain, or the row has no such component.
        TypeError: the argument is no real number.
    """

    problem: Declared
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
            math.ceil(count * math.log2(10)),
        )

    def fixed(self, places: int) -> str:
        """The decimal of ``places`` decimal places, correctly rounded.

        Raises:
            ValueError: ``places`` is not an integer from 0 to MAX_DIGITS.
            WorkBoundError: the digits could not be decided within the bound on the working precision.
        """
        places = counted(places, "places", MAX_DIGITS)
        bits = math.ceil(places * math.log2(10)) + 64  # a large number takes more, which the proof finds
        return self._decide(*to_fixed(places), bits)  # type: ignore[no-any-return]

    def __format__(self, spec: str) -> str:
        """As a float is formatted; with a precision and "e", "f" or "g" every digit shown is proven."""
        return _formatted(self, spec)

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


def _formatted(value: Certified, spec: str) -> str:
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
