"""Where the values of the pendulum are rational, exactly: what no ball could decide.

At t = 0 everything is as given, and so it is at any time at rest.  A start at the bottom, theta0 = 0, has

    E = omega0^2/2 - g/length,   k^2 = omega0^2 length/(4 g),   kc^2 = 1 - k^2,

of which the roots may be rational; from any other start these hold the cosine of a rational other than 0, which is
transcendental (Lindemann 1882).  So are, where k is algebraic, the periods and the state at any other time (Schneider
1937), and on the separatrix the state, a function of an exponential.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.arithmetic.exact import rational_root

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["rational"]

ONE, ZERO = Fraction(1), Fraction(0)
Values = tuple[Fraction | None, ...]


def rational(start: tuple[Fraction, ...], parameters: Mapping[str, Fraction], row: str, argument: Any) -> Values | None:
    """The values of a row that are rational, None for the others; None where all are."""
    theta0, omega0 = start
    if argument is None:
        return _of_the_bottom(omega0, parameters["g"] / parameters["length"]).get(row) if theta0 == 0 else None
    at_start: dict[str, Values] = {
        "state": start,
        "sensitivity": (ONE, ZERO),
        "curvature": (ZERO, ZERO),
        "gradient": (ONE, ZERO, ZERO, ZERO, ZERO, ONE, ZERO, ZERO),
        "condition": (ONE,),
    }
    at_rest: dict[str, Values] = {
        "state": start,
        "gradient": (None, None, ZERO, ZERO, None, None, ZERO, ZERO),
        "condition": (ONE,),
    }
    if argument == 0 and row in at_start:
        return at_start[row]
    return at_rest.get(row) if theta0 == omega0 == 0 else None


def _of_the_bottom(omega0: Fraction, square: Fraction) -> dict[str, Values]:
    """From theta0 = 0, with square = g/length."""
    modulus = omega0**2 / (4 * square)
    return {
        "energy": (omega0**2 / 2 - square,),
        "modulus": (rational_root(modulus),),
        "complementary_modulus": (rational_root(1 - modulus),),
    }
