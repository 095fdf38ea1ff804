"""The race computed again, sharing nothing with the package: each curve by a formula of its own.

With sigma = x/pi the fraction of the horizontal way from the bottom, y = 2 sigma^n falls by 2 (1 - sigma^n), and with
sigma = 1 - s^2

    t = int 2 sqrt(pi^2 + 4 n^2 sigma^(2 n - 2))/sqrt(4 g (1 + sigma + ... + sigma^(n - 1))) ds.

The circular arc is a pendulum of length R = (pi^2 + 4)/4, so that its time is an elliptic integral; on the ellipse and
on the cycloid the angle is the variable.
"""

from __future__ import annotations

from typing import Any

from reference.arithmetic.precision import mp

__all__ = ["arc_length", "passage", "place"]

POWERS = {"line": 1, "parabola": 2, "cubic": 3, "quartic": 4}


def integral(function: Any, high: Any) -> Any:
    """From 0 to ``high``, good to the working precision.

    Raises:
        AssertionError: the rule says that it is not.
    """
    with mp.workprec(mp.prec + 20):
        value, error = mp.quad(function, [0, high / 2, high], error=True)
    assert error <= abs(value) * mp.mpf(2) ** (10 - mp.prec)
    return value


def place(name: str, fraction: Any) -> tuple[Any, Any]:
    """x and y at the fraction of the way: of x, of the tangent of half the angle, of the angle or of the arc."""
    sigma = 1 - fraction
    if name in POWERS:
        return mp.pi * sigma, 2 * sigma ** POWERS[name]
    if name == "circular_arc":
        angle, radius = 2 * mp.atan(2 * sigma / mp.pi), (mp.pi**2 + 4) / 4
        return radius * mp.sin(angle), 2 * radius * mp.sin(angle / 2) ** 2
    if name == "quarter_ellipse":
        return mp.pi * mp.cos(mp.pi * fraction / 2), 2 - 2 * mp.sin(mp.pi * fraction / 2)
    angle = 2 * mp.acos(sigma)
    return mp.pi - angle + mp.sin(angle), 1 + mp.cos(angle)


def passage(name: str, fraction: Any, g: Any) -> Any:
    """The time at which the body passes the fraction of the way, fraction > 0."""
    if name in POWERS:
        n = POWERS[name]

        def rate(s: Any) -> Any:
            sigma = 1 - s * s
            slope = 2 * n * sigma ** (n - 1)
            return 2 * mp.hypot(mp.pi, slope) / mp.sqrt(4 * g * mp.fsum(sigma**k for k in range(n)))

        return integral(rate, mp.sqrt(fraction))
    if name == "circular_arc":
        radius, start = (mp.pi**2 + 4) / 4, mp.atan(2 / mp.pi)
        half = mp.atan(2 * (1 - fraction) / mp.pi)
        k = mp.sin(start)
        quarter = mp.ellipk(k * k) - mp.ellipf(mp.asin(mp.sin(half) / k), k * k)
        return quarter * mp.sqrt(radius / g)
    if name == "quarter_ellipse":

        def by_root(s: Any) -> Any:
            sine, cosine = mp.sin(s * s), mp.cos(s * s)
            return 2 * mp.hypot(mp.pi * sine, 2 * cosine) / mp.sqrt(4 * g * mp.sincpi(s * s / mp.pi))

        return integral(by_root, mp.sqrt(mp.pi * fraction / 2))
    return 2 * mp.acos(1 - fraction) / mp.sqrt(g)


def arc_length(name: str) -> Any:
    """The length of the whole curve."""
    if name in POWERS:
        n = POWERS[name]
        return integral(lambda sigma: mp.hypot(mp.pi, 2 * n * sigma ** (n - 1)), mp.mpf(1))
    if name == "circular_arc":
        return (mp.pi**2 + 4) / 2 * mp.atan(2 / mp.pi)
    if name == "quarter_ellipse":
        return mp.pi * mp.ellipe(1 - 4 / mp.pi**2)
    return mp.mpf(4)
