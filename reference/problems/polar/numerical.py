"""The brachistochrone in a central field by numerical integration, in mpmath: the second way to every row.

phi and tau are integrals of their rates in psi, by Gauss's rule over panels; psi at a given tau is found along them.
"""

from __future__ import annotations

import cmath
import math
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from mpmath.calculus.quadrature import GaussLegendre

from reference.arithmetic import quadrature
from reference.arithmetic.dual import DualArithmetic
from reference.arithmetic.namespaces import MPMATH
from reference.arithmetic.precision import mp
from reference.once import cached_property
from reference.problems.polar.extremal import Extremal
from reference.problems.polar.optimality import chord_geometry, neighbour_rates
from reference.problems.polar.panels import Panels, Schedule, panels_of, periodic_mpmath

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.problems.polar.equations import End, Field

__all__ = ["Numerical", "PathIntegral"]

GRAIN = 64
"""Nodes are kept for working precisions that are multiples of this."""
SMOOTH = 0.05
"""How far from the real axis the singularities of a periodic function are where the trapezoidal rule is tried."""


@lru_cache(maxsize=32)
def _nodes(degree: int, bits: int) -> list[tuple[Any, Any]]:
    """The 3 2^(degree - 1) nodes and weights of Gauss's rule on [-1, 1]."""
    return GaussLegendre(mp).calc_nodes(degree, bits)  # type: ignore[no-any-return]


def _rule(ratio: float) -> list[tuple[Any, Any]]:
    """Nodes enough for an integrand whose nearest singularity is this many half-widths away."""
    bits = -(-(mp.prec + 20) // GRAIN) * GRAIN
    per_node = 2 * float(mp.log(ratio + mp.sqrt(ratio * ratio + 1), 2))
    degree = 1
    while 3 * 2 ** (degree - 1) * per_node < mp.prec + 10:
        degree += 1
    return _nodes(degree, bits)


class PathIntegral:
    """The integrals over psi of the rates of an extremal, a tuple each."""

    def __init__(self, panels: Panels, rates: Callable[[Any], tuple[Any, ...]]) -> None:
        self._panels, self._rates = panels, rates

    def over(self, low: Any, high: Any) -> tuple[Any, ...]:
        """The integrals from low to high."""
        total: tuple[Any, ...] = ()
        ends = self._panels.between(float(low), float(high))
        for end in [*(mp.mpf(end) for end in ends[:-1]), high]:
            part = self._panel(low, end)
            total = tuple(x + y for x, y in zip(total, part, strict=True)) if total else part
            low = end
        return total

    def _panel(self, low: Any, high: Any) -> tuple[Any, ...]:
        half, middle = (high - low) / 2, (low + high) / 2
        distance = self._panels.distance(float(middle))
        rule = _rule(distance / max(abs(float(half)), distance * 2.0**-mp.prec))
        sampled = [(weight, self._rates(middle + half * node)) for node, weight in rule]
        return tuple(half * mp.fsum(weight * rates[i] for weight, rates in sampled) for i in range(len(sampled[0][1])))

    def to(self, points: Sequence[Any]) -> list[tuple[Any, ...]]:
        """The integrals from 0 to each point, in one sweep."""
        found: dict[Any, tuple[Any, ...]] = {}
        for sign in (1, -1):
            at = mp.mpf(0)
            total: tuple[Any, ...] = ()
            for point in sorted({p for p in points if p * sign >= 0}, key=abs):
                part = self.over(at, point)
                total = tuple(x + y for x, y in zip(total, part, strict=True)) if total else part
                at, found[point] = point, total
        return [found[point] for point in points]


class Numerical(Extremal):
    """The rows of an extremal by numerical integration, in mpmath's numbers."""

    def __init__(
        self, field: Field, m: Any, z0: Any, end: End | None = None, unit: tuple[Any, Any] | None = None
    ) -> None:
        super().__init__(m, z0, end, unit)
        self.field = field
        self._panels = panels_of(field, float(self.z0))

    def rows(self, row: str, arguments: Sequence[Any]) -> list[tuple[Any, ...]]:
        together: dict[str, Callable[[Sequence[Any]], list[tuple[Any, ...]]]]
        together = {"curve": self._curves, "by_z": self._by_z, "by_height": self._by_height, "state": self._states}
        together |= {"si_curve": self._si_curves, "si_state": self._si_states}
        if row in together:
            return together[row]([self.m.number(argument) for argument in arguments])
        return super().rows(row, arguments)

    def _rates(self, psi: Any) -> tuple[Any, Any]:
        return self.field.rates(self.m, self.z0, mp.sin(psi / 2) ** 2, mp.cos(psi / 2) ** 2)

    @cached_property
    def path(self) -> PathIntegral:
        """phi and tau along psi."""
        return PathIntegral(self._panels, self._rates)

    @cached_property
    def _lowest(self) -> tuple[Any, Any]:
        phi, tau = self.path.over(mp.mpf(0), +mp.pi)
        return phi, tau

    @property
    def half_angle(self) -> Any:
        return self._lowest[0]

    @property
    def descent_time(self) -> Any:
        return self._lowest[1]

    @cached_property
    def _slopes(self) -> tuple[Any, Any]:
        """d(half_angle, descent_time)/dz0, by the derivative of the integrand."""
        m = DualArithmetic(MPMATH, 1)
        z0 = m.variable(self.z0, 0)

        def slopes(psi: Any) -> tuple[Any, ...]:
            return tuple(r.slopes[0] for r in self.field.rates(m, z0, mp.sin(psi / 2) ** 2, mp.cos(psi / 2) ** 2))

        phi, tau = PathIntegral(self._panels, slopes).over(mp.mpf(0), +mp.pi)
        return phi, tau

    @property
    def dhalf_angle_dz0(self) -> Any:
        return self._slopes[0]

    @property
    def ddescent_time_dz0(self) -> Any:
        return self._slopes[1]

    @cached_property
    def psi_end(self) -> Any:
        sine, cosine = self.last
        return 2 * mp.atan2(sine, cosine)

    @cached_property
    def at_end(self) -> tuple[Any, Any]:
        """(phi, tau) at the end."""
        phi, tau = self.path.over(mp.mpf(0), self.psi_end)
        return phi, tau

    @property
    def arrival_angle(self) -> Any:
        return self.at_end[0]

    @property
    def arrival_time(self) -> Any:
        return self.at_end[1]

    @property
    def chord_time(self) -> Any:
        """By the root s of the way from the nearer end of the whole chord: z^2 = 1 - s^2 (2 cos(beta) - s^2)."""
        radius, drop, angle = self.chord
        length, sine, cosine = chord_geometry(self.m, radius, drop, angle)
        nearest = cmath.sqrt(complex(float(cosine), float(sine)))
        panels = Panels([nearest, -nearest, cmath.sqrt(2 * float(cosine)), -cmath.sqrt(2 * float(cosine))])

        def slowness(s: Any) -> tuple[Any]:
            rest = 2 * cosine - s * s
            return (2 * self.field.slowness(self.m, mp.sqrt(1 - s * s * rest)) / mp.sqrt(rest),)

        def passed(way: Any) -> Any:
            return PathIntegral(panels, slowness).over(mp.mpf(0), mp.sqrt(way))[0]

        if length <= cosine:
            return passed(length)
        return 2 * passed(cosine) - passed(drop * (1 + radius) / length)

    def neighbour_gap(self, epsilon: Any) -> Any:
        """The time of the neighbour, less the extremal's."""

        def rate(psi: Any) -> Any:
            along, across = neighbour_rates(self.m, self.field, self.z0, self.psi_end, epsilon, psi)
            return mp.sqrt(along * along + across)

        if self.last[0] == 0 and self._panels.distance(math.pi) > SMOOTH:
            return periodic_mpmath(rate) - self.arrival_time
        middle = +mp.pi if self.psi_end > mp.pi else self.psi_end / 2
        parts = (mp.mpf(0), middle), (middle, self.psi_end)
        return sum(quadrature.integral(rate, *part) for part in parts) - self.arrival_time

    def _curves(self, psis: Sequence[Any]) -> list[tuple[Any, ...]]:
        turned = [mp.nint(psi / (2 * mp.pi)) for psi in psis]
        rest = [psi - 2 * mp.pi * turns for psi, turns in zip(psis, turned, strict=True)]
        return [
            (self.height(psi), 2 * turns * self.half_angle + phi, 2 * turns * self.descent_time + tau)
            for psi, turns, (phi, tau) in zip(rest, turned, self.path.to(rest), strict=True)
        ]

    def height(self, psi: Any) -> Any:
        """z at psi."""
        return self.field.height(self.m, self.z0, mp.sin(psi / 2) ** 2, mp.cos(psi / 2) ** 2)

    def psi_of_height(self, height: Any) -> Any:
        """psi on the way down at a fraction of the height between z0 and 1."""
        sine2, cosine2 = self.field.squares(self.z0, 1 - height, height)
        return 2 * mp.atan2(mp.sqrt(sine2), mp.sqrt(cosine2))

    def _by_height(self, heights: Sequence[Any]) -> list[tuple[Any, ...]]:
        return self._curves([self.psi_of_height(height) for height in heights])

    def _by_z(self, values: Sequence[Any]) -> list[tuple[Any, ...]]:
        return [found[1:] for found in self._by_height([(z - self.z0) / (1 - self.z0) for z in values])]

    def _states(self, taus: Sequence[Any]) -> list[tuple[Any, ...]]:
        period = 2 * self.descent_time
        turned = [mp.nint(tau / period) for tau in taus]
        rest = [tau - turns * period for tau, turns in zip(taus, turned, strict=True)]
        psis = self._psis_at([abs(tau) for tau in rest])
        found = []
        for tau, turns, (psi, phi) in zip(rest, turned, psis, strict=True):
            z, sign = self.height(psi), mp.sign(tau)
            rate = -sign * self.field.climb(self.m, self.z0, z) * mp.sin(psi) / 2
            found.append((z, rate, 2 * turns * self.half_angle + sign * phi))
        return found

    def _psis_at(self, taus: Sequence[Any]) -> list[tuple[Any, Any]]:
        """(psi, phi) at each tau from 0 to a descent time, by Newton's method along the path."""
        schedule, found = Schedule(self.field, float(self.z0)), {}
        psi, phi, tau = mp.mpf(0), mp.mpf(0), mp.mpf(0)
        for wanted in sorted(set(taus)):
            moved = mp.mpf(schedule.psi_at(float(wanted / self.descent_time))) if wanted else psi
            while abs(moved - psi) > abs(moved) * mp.mpf(2) ** (4 - mp.prec):
                further = self.path.over(psi, moved)
                psi, phi, tau = moved, phi + further[0], tau + further[1]
                moved = psi - (tau - wanted) / self._rates(psi)[1]
            found[wanted] = psi, phi
        return [found[tau] for tau in taus]

    def _si_curves(self, psis: Sequence[Any]) -> list[tuple[Any, ...]]:
        return [(z * self.length, tau * self.time_unit) for z, _, tau in self._curves(psis)]

    def _si_states(self, times: Sequence[Any]) -> list[tuple[Any, ...]]:
        states = self._states([time / self.time_unit for time in times])
        return [(z * self.length, rate * self.length / self.time_unit, phi) for z, rate, phi in states]
