"""Integrals and zeros for closed forms: rigorous in balls, by mpmath's own rules in its numbers.

The function is written once, ``function(m, x)`` in any arithmetic: the balls read it over complex numbers for an
integral, and with its slope for a zero.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from flint import acb, arb

from reference.arithmetic import quadrature
from reference.arithmetic.dual import with_slope
from reference.arithmetic.precision import ctx, mp

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["ball_integral", "ball_root", "ball_zero", "enclosed_zero", "mpmath_integral", "mpmath_root"]

WIDENINGS = 12
"""How often the neighbourhood of a zero is widened before this precision is given up."""


def ball_integral(arithmetic: Callable[[bool], Any], function: Callable[[Any, Any], Any], low: Any, high: Any) -> arb:
    """A ball around the integral of a real function that is analytic on [low, high] (``acb.integral``).

    ``arithmetic(analytic)`` gives the complex balls; where ``analytic`` is set a branch cut gives no number.  The
    interval is mapped to [0, 1], so that end points that are balls cost nothing but their own radius.
    """
    width = high - low

    def integrand(s: acb, analytic: bool) -> acb:
        return acb(function(arithmetic(analytic), low + width * s))

    return (acb.integral(integrand, 0, 1) * width).real


def mpmath_integral(m: Any, function: Callable[[Any, Any], Any], low: Any, high: Any) -> Any:
    """The same by mpmath's tanh-sinh rule.

    Raises:
        ArithmeticError: the rule's own error estimate does not reach the working precision less ten bits.
    """
    return quadrature.integral(lambda x: function(m, x), low, high)


def ball_root(m: Any, function: Callable[[Any, Any], Any], low: Any, high: Any) -> arb:
    """A ball around the one zero of a monotone function in [low, high]; not a number where it cannot be proven."""
    return ball_zero(lambda x: with_slope(m, function, x), low, high)


def ball_zero(both: Callable[[arb], tuple[arb, arb]], low: Any, high: Any) -> arb:
    """The same of a function that comes with its slope.

    Newton's method, kept inside the bracket, finds a point; the interval Newton step about it proves the zero.
    """

    def point(x: arb) -> tuple[arb, arb]:
        """A value that cannot be told from zero is as near to it as this precision comes."""
        value, slope = both(x)
        return arb(0) if value.contains(0) else value.mid(), slope.mid()

    x = _newton(point, arb(low).mid(), arb(high).mid(), ctx.prec, arb.mid)
    value, slope = both(x)
    return enclosed_zero(x, value, slope, lambda near: both(near)[1])


def enclosed_zero(x: arb, value: arb, slope: arb, slope_over: Callable[[arb], arb]) -> arb:
    """A ball around the one zero of a monotone function near the point x; not a number where it cannot be proven.

    The interval Newton step x - f(x)/f'(X) over a neighbourhood X of x that contains its own image contains a zero
    (R. E. Moore, Methods and Applications of Interval Analysis, SIAM 1979, section 5.1), and monotony makes it the only
    one.  ``value`` and ``slope`` are f and f' at x, ``slope_over(X)`` encloses f' over X.
    """
    radius = 2 * abs(value / slope) + abs(x) * arb(2) ** (8 - ctx.prec)
    for _ in range(WIDENINGS):
        near = arb(x, radius.upper())
        image = x - value / slope_over(near)
        if image.is_finite() and near.contains(image):
            return image
        radius = 16 * radius
    return arb.nan()


def _newton(both: Callable[[Any], tuple[Any, Any]], low: Any, high: Any, bits: int, point: Callable[[Any], Any]) -> Any:
    """The zero to about ``bits`` bits, from a bracket in which the function changes sign once.

    Newton's step where it stays inside the bracket, else the middle; ``point(x)`` is x without a radius.  No claim is
    made that the zero was reached.
    """
    rising = both(high)[0] > both(low)[0]
    x = point((low + high) / 2)
    for _ in range(4 * bits):
        value, slope = both(x)
        if value == 0:
            return x
        low, high = (x, high) if (value < 0) == rising else (low, x)
        moved = point(x - value / slope) if slope != 0 else low
        if not low < moved < high:
            moved = point((low + high) / 2)
        if abs(moved - x) * 2 ** (bits - 4) <= abs(moved):
            return moved
        x = moved
    return x


def mpmath_root(m: Any, function: Callable[[Any, Any], Any], low: Any, high: Any) -> Any:
    """The same zero in mpmath's numbers.

    Raises:
        ArithmeticError: the sign does not change within ten bits of the working precision around it.
    """
    bits = mp.prec
    with mp.extraprec(20):
        found = _newton(lambda x: with_slope(m, function, x), mp.mpf(low), mp.mpf(high), mp.prec, mp.mpf)
        near = abs(found) * mp.mpf(2) ** (10 - bits)
        if mp.sign(function(m, found - near)) == mp.sign(function(m, found + near)):
            raise ArithmeticError(f"no zero was found between {mp.nstr(low, 5)} and {mp.nstr(high, 5)}.")
    return +found
