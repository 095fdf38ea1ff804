"""From a ball to the numbers that every one of its points rounds to.

A value x is stored as ``limb[0] + limb[1] + limb[2] + ...``: limb[0] is x correctly rounded to binary64 (nearest, ties
to even), limb[1] is x - limb[0] correctly rounded, and so on.  Three limbs carry about 159 bits, 48 digits.
"""

from __future__ import annotations

import math
from decimal import ROUND_HALF_EVEN, Context, Decimal
from fractions import Fraction
from typing import TYPE_CHECKING, TypeVar

from reference.arithmetic.binary64 import BINARY64_BITS, exact_value, nearest, number_of, parts, pattern, rounded
from reference.arithmetic.precision import ctx

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from flint import arb

__all__ = [
    "BINARY64_BITS",
    "MAX_BITS",
    "MAX_DIGITS",
    "MAX_LIMBS",
    "Interval",
    "WorkBoundError",
    "decimal",
    "fixed",
    "interval",
    "limbs",
    "of_ball",
    "rounded",
    "to_fixed",
    "to_limbs",
    "ziv",
]

HALVES = 2.0**BINARY64_BITS
"""Halves of the last bit in a power of two."""
LEAST = 2.0**-960
"""From here on a double and half of its last bit are far from the subnormal numbers, whatever the processor's mode."""
DECIMAL_EXPONENT = 1 << 20
"""Numbers beyond 2^this, about 10^315653, or below its reciprocal have no decimals: they would take minutes."""
MAX_BITS = 1 << 17
"""Working precision at which a proof is given up, with an error."""
MAX_LIMBS = 10_000
MAX_DIGITS = 100_000
"""Limbs, and decimal digits, that can be asked for: more than MAX_BITS leaves room for, but for rational values."""

Interval = tuple[int, int, int]
"""(a, b, e): the closed interval [a 2^e, b 2^e]."""

Limbs = tuple[float, ...]

Answer = TypeVar("Answer")


class WorkBoundError(ArithmeticError):
    """A value could not be decided within the stated bound on the working precision."""


def interval(ball: arb) -> Interval | None:
    """Return the exact end points of ``ball``, or None where it is not finite."""
    if not ball.is_finite():
        return None
    (low, low_exponent), (high, high_exponent) = (
        (int(man), int(exp)) for man, exp in (ball.lower().man_exp(), ball.upper().man_exp())
    )
    exponent = min(low_exponent, high_exponent)
    return low << (low_exponent - exponent), high << (high_exponent - exponent), exponent


def _beyond_range() -> OverflowError:
    return OverflowError(
        "the value is beyond the range of a double, about 1.8e308; its decimal digits can be asked for instead."
    )


def limbs(bounds: Interval | None, count: int) -> tuple[float, ...] | None:
    """Return the ``count`` binary64 limbs shared by every point of the interval, or None where they differ.

    Raises:
        OverflowError: every point of the interval is beyond the range of binary64.
    """
    if bounds is None:
        return None
    low, high, exponent = bounds
    found: list[float] = []
    for _ in range(count):
        bits = pattern(low, exponent)
        if bits != pattern(high, exponent):
            return None
        value = number_of(bits)
        if math.isinf(value):
            raise _beyond_range()
        found.append(value)
        mantissa, value_exponent = parts(bits)
        shift = max(0, exponent - value_exponent)
        exponent -= shift
        taken = mantissa << (value_exponent - exponent)
        low, high = (low << shift) - taken, (high << shift) - taken
    return tuple(found)


def of_ball(ball: arb, count: int) -> Limbs | None:
    """Return the ``count`` limbs shared by every point of the ball, or None where they differ.

    A double v is what every point rounds to where ball - v lies strictly within half of v's last bit, which the next
    limb shows: it is the nearest double to the remainder's midpoint, and half a last bit is itself a double.  Powers of
    two, whose lower neighbour is nearer, numbers near and below the end of the normal range and what is not decided at
    once are left to the exact end points.

    Raises:
        OverflowError: every point of the ball is beyond the range of binary64.
    """
    found: list[float] = []
    rest, bound = ball, math.inf
    for _ in range(count):
        value = float(rest)
        size, half = abs(value), math.ulp(value) / 2
        if not LEAST < size < bound or size == half * HALVES:
            return limbs(interval(ball), count)
        found.append(value)
        rest, bound = rest - value, half
    return tuple(found) if float(rest.abs_upper()) < bound else limbs(interval(ball), count)


def exact_limbs(value: Fraction, count: int) -> tuple[float, ...]:
    """Return the limbs of an exact rational; zero is +0.0, also where a negative number underflows to it.

    Raises:
        OverflowError: the value is beyond the range of binary64.
    """
    found: list[float] = []
    for _ in range(count):
        found.append(nearest(value))
        if math.isinf(found[-1]):
            raise _beyond_range()
        value -= exact_value(found[-1])
    return tuple(found)


def to_limbs(count: int) -> tuple[Callable[[arb], Limbs | None], Callable[[Fraction], Limbs]]:
    """How a ball and how an exact rational give their ``count`` limbs: the two questions of a proof."""
    return lambda ball: of_ball(ball, count), lambda value: exact_limbs(value, count)


def decimal(bounds: Interval | None, digits: int) -> str | None:
    """Return the decimal of ``digits`` significant digits that every point of the interval rounds to, or None."""
    return _shared(bounds, lambda value: exact_decimal(value, digits))


def _shared(bounds: Interval | None, spell: Callable[[Fraction], str]) -> str | None:
    """The text of both ends of the interval, and so of every point between them; None where they differ.

    Raises:
        OverflowError: every point of the interval is beyond 2^DECIMAL_EXPONENT or below its reciprocal.
    """
    if bounds is None:
        return None
    low, high, exponent = bounds
    if abs(exponent) > DECIMAL_EXPONENT:
        if low.bit_length() == high.bit_length() and low * high > 0:
            raise OverflowError(f"the value is about 2^{exponent + low.bit_length()}, too far from 1 for decimals.")
        return None
    scale = Fraction(2) ** exponent
    text = spell(low * scale)
    return text if spell(high * scale) == text else None


def exact_decimal(value: Fraction, digits: int) -> str:
    """Return an exact rational rounded to ``digits`` significant digits (nearest, ties to even), zeros kept."""
    context = Context(prec=digits, rounding=ROUND_HALF_EVEN, Emin=-(10**9), Emax=10**9)
    quotient = context.divide(Decimal(value.numerator), Decimal(value.denominator))
    if not quotient:
        return "0"
    missing = digits - len(quotient.as_tuple().digits)
    padded = quotient if missing <= 0 else quotient.quantize(quotient.scaleb(-missing, context), context=context)
    return f"{padded:f}" if -7 < padded.adjusted() < digits else f"{padded:e}"


def fixed(value: Fraction, places: int) -> str:
    """Return an exact rational rounded to ``places`` decimal places (nearest, ties to even); zero has no sign."""
    rounded_value = round(value * 10**places)
    scaled = f"{Decimal(abs(rounded_value)):f}".zfill(places + 1)
    whole, rest = scaled[: len(scaled) - places], scaled[len(scaled) - places :]
    return f"{'-' if rounded_value < 0 else ''}{whole}{'.' if places else ''}{rest}"


def to_fixed(places: int) -> tuple[Callable[[arb], str | None], Callable[[Fraction], str]]:
    """How a ball and how an exact rational give their decimal of ``places`` places."""

    def spell(value: Fraction) -> str:
        return fixed(value, places)

    return lambda ball: _shared(interval(ball), spell), spell


def ziv(
    enclose: Callable[[Sequence[int]], Sequence[Sequence[arb]]],
    decide: Callable[[arb], Answer | None],
    count: int,
    bits: int,
    what: str,
    max_bits: int = MAX_BITS,
    more: Callable[[int, int], int] = lambda bits, _least: 2 * bits,
) -> list[list[Answer]]:
    """Ziv's loop over ``count`` rows of balls: raise the precision until every ball of every row is decided.

    ``enclose(rows)`` returns the balls of the given rows at the working precision in force; ``decide(ball)`` the one
    answer of all its points, or None; ``more(bits, least)`` the precision after one that was not enough, by which the
    undecided balls have ``least`` bits of relative accuracy.

    Raises:
        WorkBoundError: a row is undecided at ``max_bits`` bits.
    """
    answers: dict[int, list[Answer]] = {}
    pending = list(range(count))
    while pending:
        if bits > max_bits:
            raise WorkBoundError(
                f"{what} could not be decided with {max_bits} bits of working precision, the limit; "
                "fewer digits, or inputs less extreme, are accepted."
            )
        least = bits
        with ctx.workprec(bits):
            for row, balls in zip(pending, enclose(pending), strict=True):
                decided = [(ball, decide(ball)) for ball in balls]
                found = [answer for _, answer in decided if answer is not None]
                if len(found) == len(balls):
                    answers[row] = found
                least = min([least, *(ball.rel_accuracy_bits() for ball, answer in decided if answer is None)])
        pending = [row for row in pending if row not in answers]
        bits = more(bits, least)
    return [answers[row] for row in range(count)]
