"""mpmath's quadrature at its working precision, its own error estimate held against what is asked."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.arithmetic.precision import mp

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["integral", "to_fraction"]


def integral(integrand: Callable[[Any], Any], low: Any, high: Any) -> Any:
    """The integral of a function that is analytic on the closed interval [low, high].

    Raises:
        ArithmeticError: the rule's own error estimate does not reach the working precision less ten bits.
    """
    value, error = mp.quad(integrand, [low, (low + high) / 2, high], error=True)
    if error > abs(value) * mp.mpf(2) ** (10 - mp.prec):
        raise ArithmeticError(
            f"quadrature stopped at an error of {mp.nstr(error, 3)} where {mp.nstr(value, 5)} was sought."
        )
    return value


def to_fraction(value: Any) -> Fraction:
    """An mpmath number as the rational it is."""
    sign, mantissa, exponent, _ = mp.mpf(value)._mpf_
    return Fraction((-1) ** int(sign) * int(mantissa)) * Fraction(2) ** int(exponent)
