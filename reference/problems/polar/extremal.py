"""The brachistochrone in a central field in closed form: what does not depend on the law of the force.

Everything is said in psi/2, which runs from 0 at the release over pi/2 at the lowest point to pi at rest again.  A
family gives the angle and the time on the way down; by mirror symmetry about the lowest point, and by the period of the
smooth equation in time, the rest follows.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.declaration import ClosedForm
from reference.once import cached_property
from reference.problems.polar.optimality import chord_time, neighbour_excess
from reference.problems.polar.panels import panels_of, periodic_ball

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.problems.polar.equations import End, Field


__all__ = ["Extremal"]

HALF = Fraction(1, 2)
STRIPS = (0.3, 0.1)
"""Parts of the strip in which the rates are analytic, to be tried for a neighbour."""


class Extremal(ClosedForm):
    """The rows of the extremal with the lowest point ``z0``, in the arithmetic ``m``.

    z0 is an exact rational or a number of the arithmetic.  Without an ``end`` the extremal ends where it is at rest
    again.  ``unit`` holds the length and the square of the time, in m and s^2, that stand for 1, where they are known.
    """

    field: Field

    def __init__(self, m: Any, z0: Any, end: End | None = None, unit: tuple[Any, Any] | None = None) -> None:
        self.m, self.end = m, end
        self._rational = z0 if isinstance(z0, Fraction) else None
        self.z0 = z0 if self._rational is None else m.number(z0)
        if unit is not None:
            self.length, self.time_unit = unit[0], m.sqrt(unit[1])

    def rows(self, row: str, arguments: Sequence[Any]) -> list[tuple[Any, ...]]:
        lowest = self._rational
        if row == "by_z" and lowest is not None:  # exact fractions of the height: none is told from 0 by a ball
            return [found[1:] for found in self.rows("by_height", [(z - lowest) / (1 - lowest) for z in arguments])]
        return super().rows(row, arguments)

    def angle(self, sine: Any, cosine: Any) -> Any:
        """phi at -pi <= psi <= pi, by the sine and the cosine of psi/2."""
        raise NotImplementedError

    def time(self, sine: Any, cosine: Any) -> Any:
        """tau at -pi <= psi <= pi."""
        raise NotImplementedError

    def psi_at(self, tau: Any) -> Any:
        """psi at a tau within one descent time of 0."""
        raise NotImplementedError

    @cached_property
    def half_angle(self) -> Any:
        """phi at the lowest point."""
        raise NotImplementedError

    @property
    def dhalf_angle_dz0(self) -> Any:
        """d(half_angle)/dz0."""
        raise NotImplementedError

    @cached_property
    def descent_time(self) -> Any:
        """tau at the lowest point."""
        raise NotImplementedError

    @cached_property
    def kappa(self) -> Any:
        return self.field.kappa(self.z0)

    @property
    def ddescent_time_dz0(self) -> Any:
        """The envelope law: dtau = sqrt(kappa) dphi from one extremal to the next at the same height."""
        return self.m.sqrt(self.kappa) * self.dhalf_angle_dz0

    @cached_property
    def last(self) -> tuple[Any, Any]:
        """The sine and the cosine of psi/2 at the end; the cosine is negative beyond the lowest point."""
        m, end = self.m, self.end
        if end is None or end.radius == 1:
            return m.number(Fraction(0)), m.number(Fraction(-1))
        depth = 1 - self.z0
        below, above = m.number(1 - end.radius) / depth, (m.number(end.radius) - self.z0) / depth
        sine, cosine = (m.sqrt(square) for square in self.field.squares(self.z0, below, above))
        return sine, -cosine if end.after else cosine

    @property
    def arrival_angle(self) -> Any:
        """phi at the end."""
        return self._arrived(self.half_angle, self.angle)

    @property
    def arrival_time(self) -> Any:
        """tau at the end."""
        return self._arrived(self.descent_time, self.time)

    def _arrived(self, lowest: Any, passed: Callable[[Any, Any], Any]) -> Any:
        if self.end is None or self.end.radius == 1:
            return 2 * lowest
        sine, cosine = self.last
        return 2 * lowest - passed(sine, -cosine) if self.end.after else passed(sine, cosine)

    @property
    def chord(self) -> tuple[Any, Any, Any]:
        """The radius of the end, the part of 1 that it lies below the start, and its angle."""
        if self.end is None:
            return self.m.number(Fraction(1)), self.m.number(Fraction(0)), 2 * self.half_angle
        return tuple(self.m.number(value) for value in (self.end.radius, 1 - self.end.radius, self.end.angle))

    @property
    def chord_time(self) -> Any:
        """The time along the straight line to the end."""
        return chord_time(self.m, self.field, *self.chord)

    @property
    def chord_gap(self) -> Any:
        """By how much the straight line takes longer."""
        return self.chord_time - self.arrival_time

    def neighbour_gap(self, epsilon: Any) -> Any:
        """By how much a neighbouring curve takes longer."""
        m, (sine, cosine) = self.m, self.last
        psi_end = 2 * m.atan2(sine, cosine)
        excess = neighbour_excess(self.field, self.z0, psi_end, epsilon)
        strip = panels_of(self.field, float(self.z0)).distance(math.pi)
        found = periodic_ball(excess, [part * strip for part in STRIPS]) if sine == 0 else None
        return m.integral(excess, m.number(Fraction(0)), psi_end) if found is None else found

    def _turned(self, psi: Any) -> tuple[Any, Any, Any]:
        """Whole turns of psi, and the sine and the cosine of half of what is left."""
        m = self.m
        turns = m.floor(psi / (2 * m.pi()) + m.number(HALF))
        half = psi / 2 - turns * m.pi()
        return turns, m.sin(half), m.cos(half)

    def curve(self, psi: Any) -> tuple[Any, Any, Any]:
        """(z, phi, tau) at psi."""
        turns, sine, cosine = self._turned(psi)
        z = self.field.height(self.m, self.z0, sine * sine, cosine * cosine)
        phi = 2 * turns * self.half_angle + self.angle(sine, cosine)
        return z, phi, 2 * turns * self.descent_time + self.time(sine, cosine)

    def by_z(self, z: Any) -> tuple[Any, Any]:
        """(phi, tau) on the way down at z."""
        depth = 1 - self.z0
        return self._between((1 - z) / depth, (z - self.z0) / depth)

    def by_height(self, height: Any) -> tuple[Any, Any, Any]:
        """(z, phi, tau) on the way down at a fraction of the height between z0 and 1."""
        return self.z0 + (1 - self.z0) * height, *self._between(1 - height, height)

    def _between(self, below: Any, above: Any) -> tuple[Any, Any]:
        sine, cosine = (self.m.sqrt(square) for square in self.field.squares(self.z0, below, above))
        return self.angle(sine, cosine), self.time(sine, cosine)

    def state(self, tau: Any) -> tuple[Any, Any, Any]:
        """(z, z', phi) at tau, continued beyond the rest at z = 1 as the equation in time continues."""
        m, period = self.m, 2 * self.descent_time
        turns = m.floor(tau / period + m.number(HALF))
        half = self.psi_at(tau - turns * period) / 2
        sine, cosine = m.sin(half), m.cos(half)
        z = self.field.height(m, self.z0, sine * sine, cosine * cosine)
        rate = -self.field.climb(m, self.z0, z) * sine * cosine
        return z, rate, 2 * turns * self.half_angle + self.angle(sine, cosine)

    @property
    def descent_seconds(self) -> Any:
        return self.descent_time * self.time_unit

    @property
    def arrival_seconds(self) -> Any:
        return self.arrival_time * self.time_unit

    def si_curve(self, psi: Any) -> tuple[Any, Any]:
        """(r, t) at psi in m and s."""
        z, _, tau = self.curve(psi)
        return z * self.length, tau * self.time_unit

    def si_state(self, time: Any) -> tuple[Any, Any, Any]:
        """(r, r', phi) at a time in s."""
        z, rate, phi = self.state(time / self.time_unit)
        return z * self.length, rate * self.length / self.time_unit, phi
