"""The cycloid computed again, sharing nothing with the package: other unknowns, other formulas.

The brachistochrone by its radius, from x = R acos(1 - y/R) - sqrt(y (2 R - y)) down to the bottom and 2 pi R less the
same beyond it; points as x + i y = R (theta + i (1 - exp(-i theta))); times on neighbours straight from ds/sqrt(2 g y).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from reference.arithmetic.precision import mp


def number(x: Fraction | float) -> Any:
    """An exact input as mpmath's number."""
    value = Fraction(x)
    return mp.mpf(value.numerator) / value.denominator


def before_bottom(radius: Any, y: Any) -> Any:
    """x of the cycloid at the depth y, on the way down."""
    return radius * mp.acos(1 - y / radius) - mp.sqrt(y * (2 * radius - y))


@dataclass
class Descent:
    """The brachistochrone to (x, y) at mpmath's working precision."""

    x: Any
    y: Any
    g: Any

    def __post_init__(self) -> None:
        self.past = self.x > mp.pi / 2 * self.y
        low = self.y / 2
        high = self.x if self.past else self.y * (1 + (self.y / self.x) ** 2)
        self.radius = mp.findroot(
            lambda r: self.on_curve(r, self.y, past=self.past) - self.x, (low, high), solver="anderson", verify=False
        )
        self.angle = mp.acos(1 - self.y / self.radius)
        if self.past:
            self.angle = 2 * mp.pi - self.angle
        side = 1 if self.past else -1
        self.length = 4 * self.radius + side * 2 * mp.sqrt(2 * self.radius * (2 * self.radius - self.y))
        self.time = self.angle * mp.sqrt(self.radius / self.g)
        self.chord = mp.hypot(self.x, self.y) * mp.sqrt(2 / (self.g * self.y))

    @staticmethod
    def on_curve(radius: Any, y: Any, *, past: bool) -> Any:
        x = before_bottom(radius, y)
        return 2 * mp.pi * radius - x if past else x

    def point(self, fraction: Any) -> tuple[Any, Any]:
        theta = fraction * self.angle
        z = self.radius * (theta + 1j * (1 - mp.expj(-theta)))
        return z.real, z.imag

    def by_arc(self, s: Any) -> tuple[Any, Any]:
        y = s - s**2 / (8 * self.radius)
        return self.on_curve(self.radius, y, past=s > 4 * self.radius), y

    def state(self, t: Any) -> tuple[Any, Any]:
        """4 R (1 - cos a), a = sqrt(g/(4 R)) t, by exponentials."""
        turned = mp.expj(mp.sqrt(self.g / (4 * self.radius)) * t)
        return 4 * self.radius * (1 - turned.real), 2 * mp.sqrt(self.g * self.radius) * turned.imag

    def position(self, t: Any) -> tuple[Any, Any]:
        return self.by_arc(self.state(t)[0])

    def neighbour_time(self, epsilon: Any) -> Any:
        """The integral of |d(x, y)|/sqrt(2 g y) over theta."""

        def rate(theta: Any) -> Any:
            along = mp.pi * theta / self.angle
            factor = 1 + epsilon * mp.sin(along)
            depth = 2 * self.radius * mp.sin(theta / 2) ** 2
            across = depth
            down = self.radius * mp.sin(theta) * factor + depth * epsilon * mp.pi / self.angle * mp.cos(along)
            return mp.hypot(across, down) / mp.sqrt(2 * self.g * depth * factor)

        return mp.quad(rate, [0, self.angle / 2, self.angle])


def swing(angle: Any, radius: Any, g: Any, t: Any) -> dict[str, tuple[Any, Any]]:
    """Huygens' pendulum by its arc length s(0) cos(w t) alone: rows of the package by name."""
    w = mp.sqrt(g / radius) / 2
    start = 4 * radius * mp.sin(angle / 2)
    turned = start * mp.expj(w * t)
    arc, rate = turned.real, -w * turned.imag
    half = mp.arg(mp.mpc(mp.sqrt((4 * radius - arc) * (4 * radius + arc)), arc))
    height = arc * arc / (8 * radius)
    # dx/dh = sqrt((2 R - h)/h): half of the generating circle's chord, and the arc that it subtends
    across = 2 * radius * half + mp.sign(arc) * mp.sqrt(height * (2 * radius - height))
    return {
        "state": (2 * half, rate / mp.sqrt((2 * radius - height) * 2 * radius)),
        "position": (across, height),
        "arc": (arc, rate),
    }
