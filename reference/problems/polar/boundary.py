"""Which extremal reaches a given point: the boundary-value form of the brachistochrone in a central field.

Released at rest at (1, 0), the extremal with the lowest point z0 passes the radius R >= z0 twice, at

    before:  phi(R; z0),   which rises with z0: dphi/dz at a fixed z rises with kappa, and kappa with z0;
    after:   2 half_angle(z0) - phi(R; z0),   which therefore falls, half_angle falling with z0.

The two meet at z0 = R, and as z0 -> 0 they tend to 0 and to the full sweep (2 pi/3 about a point mass, pi through a
uniform ball).  So every point with 0 < R <= 1 and 0 < angle < sweep is reached by exactly one smooth extremal, and no
other point by any.  The time to arrive rises with the angle, by the envelope law dtau = sqrt(kappa) dphi, to that of
the fall to the centre and the climb from it: beyond the sweep, curves that pass ever nearer to the centre are ever
faster, and none is the fastest.
"""

from __future__ import annotations

from fractions import Fraction
from functools import lru_cache
from itertools import islice
from typing import TYPE_CHECKING, Any

from flint import arb

from reference.arithmetic.exact import as_number
from reference.arithmetic.limbs import WorkBoundError, ziv
from reference.arithmetic.namespaces import BALL
from reference.arithmetic.precision import ctx, mp
from reference.problems.polar.equations import End, Field

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from reference.problems.polar.extremal import Extremal

__all__ = ["DECISION_BITS", "end_of", "exponent_near", "lowest_point", "positive"]

DECISION_BITS = 128
RANGE = 512
SPREAD = 40
"""Bits to which bisection finds the logarithm of w."""
WIDENINGS = 12
STEPS = 100
FINISHING = 3


def end_of(radius: Fraction, angle: Fraction, field: Field, extremal: Callable[..., Extremal]) -> End:
    """The end at (radius, angle), and on which branch of its extremal it lies.

    Raises:
        ValueError: no smooth extremal reaches it.
    """
    told = _told(radius, angle)
    if not 0 < radius <= 1:
        raise ValueError(f"{told}; a radius with 0 < R <= 1, the radius of the release, is accepted.")
    if angle <= 0:
        raise ValueError(f"{told}; a positive angle is accepted: the fall along the radius is no curve of this family.")
    what = f"the branch at {told[7:]}"
    if positive(lambda: BALL.number(angle) - BALL.number(field.sweep) * arb.pi(), what):
        raise ValueError(
            f"{told}, which no smooth extremal reaches: released at rest, all sweep less than {field.beyond}, and "
            "beyond it curves through ever smaller distances from the centre are ever faster."
        )
    after = radius == 1 or positive(lambda: BALL.number(angle) - extremal(BALL, BALL.number(radius)).half_angle, what)
    return End(radius, angle, after)


def _told(radius: Fraction, angle: Fraction) -> str:
    return f"end is ({as_number(radius)}, {as_number(angle)})"


def positive(difference: Callable[[], arb], what: str, bits: int = DECISION_BITS) -> bool:
    """Whether a number is positive, decided in balls; it is not zero."""

    def certain(ball: arb) -> bool | None:
        return ball > 0 if ball.is_finite() and not ball.contains(0) else None

    return ziv(lambda _: [[difference()]], certain, 1, bits, what)[0][0]


def lowest_point(m: Any, end: End, extremal: Callable[..., Extremal], exponent: Fraction) -> Any:
    """z0 of the extremal to ``end``, near to where ``exponent_near`` puts it: in balls proven, or not a number.

    z0 = R/(1 + w^2), w > 0 before the lowest point and w < 0 after it: the angle falls with w on both branches, and no
    digits are lost near z0 = R, near 0 or near 1.
    """
    angle, spread = m.number(end.angle), m.number(Fraction(1, 1 << SPREAD))
    near = m.power(m.number(Fraction(2)), exponent) * (-1 if end.after else 1)

    def excess(w: Any) -> Any:
        return extremal(m, _lowest(m, end, w), end).arrival_angle - angle

    zero = _proven_zero if m is BALL else _mpmath_zero
    return _lowest(m, end, zero(excess, near * (1 - spread), near * (1 + spread)))


def _lowest(m: Any, end: End, w: Any) -> Any:
    return m.number(end.radius) / (1 + w * w)


@lru_cache(maxsize=64)
def exponent_near(end: End, extremal: Callable[..., Extremal]) -> Fraction:
    """log2 |w| by bisection, every sign decided in balls.

    Raises:
        WorkBoundError: it is beyond RANGE: the end is too near to the limits of what is reached.
    """
    side = -1 if end.after else 1
    low, high = Fraction(-RANGE), Fraction(RANGE)

    def wide(exponent: Fraction) -> bool:
        """Whether |w| is too large."""

        def excess() -> arb:
            w = side * BALL.power(BALL.number(Fraction(2)), exponent)
            return side * (BALL.number(end.angle) - extremal(BALL, _lowest(BALL, end, w), end).arrival_angle)

        return positive(excess, f"the path to {_told(end.radius, end.angle)}")

    if wide(low) or not wide(high):
        raise WorkBoundError(
            f"{_told(end.radius, end.angle)}, too near to where no smooth extremal reaches: its lowest point is within "
            f"2^-{2 * RANGE} of 0, of 1 or of R, the limit."
        )
    while high - low > Fraction(1, 1 << SPREAD + 4):
        middle = (low + high) / 2
        low, high = (low, middle) if wide(middle) else (middle, high)
    return low


def _proven_zero(function: Callable[[arb], arb], *ends: arb) -> arb:
    """A ball around the zero of a falling function, at whose ends the function has the signs that it must have."""

    def at(w: arb) -> arb:
        value = function(w)
        return arb(0) if value.contains(0) else value.mid()

    bracket = [(w.mid(), at(w.mid())) for w in ends]
    if not bracket[0][1] * bracket[1][1] < 0:
        return arb.nan()
    least = abs(bracket[0][0]) * arb(2) ** (8 - ctx.prec)
    w = next(w for w, step, _ in _approach(at, bracket, arb.mid) if step <= least)
    slope = abs((bracket[1][1] - bracket[0][1]) / (bracket[1][0] - bracket[0][0]))
    radius = least + 2 * function(w).rad() / slope
    for _ in range(WIDENINGS):
        low, high = (w - radius).mid(), (w + radius).mid()
        if function(low) > 0 > function(high):
            return low.union(high)
        radius *= 16
    return arb.nan()


def _mpmath_zero(function: Callable[[Any], Any], *ends: Any) -> Any:
    """The same in mpmath's numbers: steps to half of the digits, and of as many more as give the rest the best."""
    half = mp.mpf(2) ** (-mp.prec // 2)
    with mp.extraprec(20):
        steps = _approach(function, [(w, function(w)) for w in ends], mp.mpf)
        near = next(found for found in steps if found[1] <= abs(found[0]) * half)
        return min([near, *islice(steps, FINISHING)], key=lambda found: abs(found[2]))[0]


def _approach(function: Callable[[Any], Any], bracket: Any, point: Callable[[Any], Any]) -> Iterator[tuple[Any, ...]]:
    """Ever better approximations to the zero in a bracket, each with the size of the step to it and the value there.

    The false position of N. Anderson and Å. Björck, BIT 13, 253 (1973): the end that stays is weighed down, so that the
    order is about 1.7.  ``point(t)`` is t without a radius.  Where the value is zero the steps end, the last of size 0.

    Raises:
        ArithmeticError: STEPS steps do not suffice.
    """
    (low, low_value), (high, high_value) = bracket
    for _ in range(STEPS):
        t = point(high - high_value * (high - low) / (high_value - low_value))
        if not min(low, high) < t < max(low, high):
            t = point((low + high) / 2)
        value = function(t)
        yield t, 0 * t if value == 0 else abs(t - high), value
        if value == 0:
            return
        if (value > 0) != (high_value > 0):
            low, low_value = high, high_value
        else:
            weight = 1 - value / high_value
            low_value = low_value * weight if weight > 0 else low_value / 2
        high, high_value = t, value
    raise ArithmeticError(f"no extremal was found in {STEPS} steps.")
