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
from typing import TYPE_CHECKING, Any

from flint import arb, ctx
from mpmath import mp

from reference.arithmetic import BALL
from reference.exact import as_number
from reference.limbs import ziv

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from reference.problems.polar.extremal import End, Extremal, Field

__all__ = ["end_of", "lowest_point"]

DECISION_BITS = 128
WIDENINGS = 12
STEPS = 200


def end_of(radius: Fraction, angle: Fraction, field: Field, extremal: Callable[..., Extremal]) -> End:
    """The end at (radius, angle), and on which branch of its extremal it lies.

    Raises:
        ValueError: no smooth extremal reaches it.
    """
    from reference.problems.polar.extremal import End

    told = f"end is ({as_number(radius)}, {as_number(angle)})"
    if not 0 < radius <= 1:
        raise ValueError(f"{told}; a radius with 0 < R <= 1, the radius of the release, is accepted.")
    if angle <= 0:
        raise ValueError(f"{told}; a positive angle is accepted: the fall along the radius is no curve of this family.")
    what = f"the branch at {told[7:]}"
    if _positive(lambda: BALL.number(angle) - BALL.number(field.sweep) * arb.pi(), what):
        raise ValueError(
            f"{told}, which no smooth extremal reaches: released at rest, all sweep less than {field.beyond}, and "
            "beyond it curves through ever smaller distances from the centre are ever faster."
        )
    after = radius == 1 or _positive(lambda: BALL.number(angle) - extremal(BALL, BALL.number(radius)).half_angle, what)
    return End(radius, angle, after)


def _positive(difference: Callable[[], arb], what: str) -> bool:
    """Whether a number is positive, decided in balls; it is not zero."""

    def certain(ball: arb) -> bool | None:
        return ball > 0 if ball.is_finite() and not ball.contains(0) else None

    return ziv(lambda _: [[difference()]], certain, 1, DECISION_BITS, what)[0][0]


def lowest_point(m: Any, end: End, field: Field, extremal: Callable[..., Extremal]) -> Any:
    """z0 of the extremal to ``end``: in balls proven, not a number where it cannot be.

    z0 = R (1 - t^2) with t > 0 before the lowest point and t < 0 after it makes one falling function of both branches,
    from the sweep at t = -1 over half_angle(R) at t = 0 to 0 at t = 1; at R = 1 the second half is missing.
    """
    radius, angle = m.number(end.radius), m.number(end.angle)

    def excess(t: Any) -> Any:
        return extremal(m, radius * (1 - t) * (1 + t), end).arrival_angle - angle

    middle = -angle if end.radius == 1 else extremal(m, radius).half_angle - angle
    edge = m.number(field.sweep) * m.pi() - angle if end.after else -angle
    bracket = (m.number(Fraction(-1 if end.after else 1)), edge), (m.number(Fraction(0)), middle)
    t = _proven_zero(excess, bracket) if m is BALL else _mpmath_zero(excess, bracket)
    return radius * (1 - t) * (1 + t)


Bracket = tuple[tuple[Any, Any], tuple[Any, Any]]
"""Two arguments, each with the value there; the values are of opposite signs."""


def _proven_zero(function: Callable[[arb], arb], bracket: Bracket) -> arb:
    """A ball around the zero of a falling function, at whose ends the function has the signs that it must have."""

    def at(t: arb) -> arb:
        value = function(t)
        return arb(0) if value.contains(0) else value.mid()

    points = [(t.mid(), value.mid()) for t, value in bracket]
    t = next(t for t, step in _approach(at, points, arb.mid) if step <= abs(t) * arb(2) ** (8 - ctx.prec))
    radius = abs(t) * arb(2) ** (8 - ctx.prec)
    for _ in range(WIDENINGS):
        if function((t - radius).mid()) > 0 > function((t + radius).mid()):
            return t + radius * arb(0, 1)
        radius *= 16
    return arb.nan()


def _mpmath_zero(function: Callable[[Any], Any], bracket: Bracket) -> Any:
    bound = mp.mpf(2) ** (4 - mp.prec)
    with mp.extraprec(20):
        return next(t for t, step in _approach(function, bracket, mp.mpf) if step <= abs(t) * bound)


def _approach(function: Callable[[Any], Any], bracket: Any, point: Callable[[Any], Any]) -> Iterator[tuple[Any, Any]]:
    """Ever better approximations to the zero in a bracket, each with the size of the step to it.

    The false position of N. Anderson and Å. Björck, BIT 13, 253 (1973): the end that stays is weighed down, so that the
    order is about 1.7.  ``point(t)`` is t without a radius.

    Raises:
        ArithmeticError: STEPS steps do not suffice.
    """
    (low, low_value), (high, high_value) = bracket
    for _ in range(STEPS):
        t = point(high - high_value * (high - low) / (high_value - low_value))
        if not min(low, high) < t < max(low, high):
            t = point((low + high) / 2)
        value = function(t)
        yield t, 0 * t if value == 0 else abs(t - high)
        if (value > 0) != (high_value > 0):
            low, low_value = high, high_value
        else:
            weight = 1 - value / high_value
            low_value = low_value * weight if weight > 0 else low_value / 2
        high, high_value = t, value
    raise ArithmeticError(f"no extremal was found in {STEPS} steps.")
