"""Jacobi's elliptic functions of one modulus, in balls and in mpmath, behind one interface.

``k`` is the modulus, ``kc`` the complementary modulus (k^2 + kc^2 = 1); both are given, because near k = 1 the one
cannot be had from the other without loss.
"""

from __future__ import annotations

import math
from operator import mul
from typing import TYPE_CHECKING, Any, Protocol

from flint import acb, arb, arb_poly

from reference.arithmetic.precision import mp
from reference.once import cached_property

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["BallElliptic", "Elliptic", "MpmathElliptic", "sine_polynomial"]


class Elliptic(Protocol):
    """K(k), E(k), sn, cn, dn and Jacobi's epsilon function at one fixed modulus and one working precision."""

    first: Any
    """K, the complete integral of the first kind."""

    def second(self) -> Any:
        """E, the complete integral of the second kind."""

    def functions(self, u: Any) -> tuple[Any, Any, Any]:
        """(sn, cn, dn)(u)."""

    def epsilon(self, u: Any) -> Any:
        """E(am u), the incomplete integral of the second kind at the amplitude of u (DLMF 22.16.14)."""

    def incomplete(self, phi: Any) -> Any:
        """F(phi), the incomplete integral of the first kind: the u with am u = phi."""


class BallElliptic:
    """By theta functions of z = u/2K and tau = i K'/K (DLMF 22.2.4-9); every result encloses the exact value."""

    def __init__(self, k: arb, kc: arb) -> None:
        self.k = k
        half_pi = arb.pi() / 2
        self.first = half_pi / arb(1).agm(kc)
        self._tau = acb(0, half_pi / arb(1).agm(k) / self.first)
        _, t2, t3, t4 = (theta.real for theta in acb(0).modular_theta(self._tau))
        self._scale = t3 / t2, t4 / t2, t4 / t3

    def second(self) -> arb:
        return self._second

    @cached_property
    def _second(self) -> arb:
        return acb(self.k * self.k).elliptic_e().real

    def functions(self, u: arb) -> tuple[arb, arb, arb]:
        t1, t2, t3, t4 = (theta.real for theta in acb(u / (2 * self.first)).modular_theta(self._tau))
        sn, cn, dn = self._scale
        return sn * t1 / t4, cn * t2 / t4, dn * t3 / t4

    def incomplete(self, phi: arb) -> arb:
        return acb.elliptic_f(acb(phi), acb(self.k * self.k)).real

    def epsilon(self, u: arb) -> arb:
        period = 2 * self.first
        z = acb(u / period)
        t4 = z.modular_theta(self._tau)[3].real
        slope = z.modular_theta(self._tau, 1)[3].real
        return self.second() / self.first * u + slope / t4 / period


def sine_polynomial(k: arb, width: arb, bits: int) -> arb_poly:
    """P with sn(width x) = x P(x^2) for -1 <= x <= 1, width < 1, to about ``bits`` bits; every error is in its balls.

    With sn = x S(x^2), one coefficient after another follows from sn'' = -(1 + k^2) sn + 2 k^2 sn^3 (DLMF 22.13.13).
    By sn' = cn dn, cn' = -sn dn and dn' = -k^2 sn cn they are at most those of tan, as those of cn and dn are at most
    those of sec, for these obey the same equations with k = 1 and without the signs: for |v| <= r < pi/2,
    |sn v| <= tan r, and Cauchy's estimate bounds the rest of the series.  Not a number where width < 1 is not certain.
    """
    radius = arb(1.5)
    ratio = width / radius
    if not (0 < width < 1 and 0 < float(ratio) < 1):
        return arb_poly([arb.nan()])
    m, sn, square = k * k, [arb(1)], [arb(1)]
    for i in range(1, math.ceil((bits + 6) / -math.log2(float(ratio)) / 2)):
        cube = _convolved(square[:-1], sn[:-1])
        sn.append((2 * m * cube - (1 + m) * sn[-1]) / (2 * i * (2 * i + 1)))
        square.append(_convolved(sn, sn))
    odd = [value * width ** (2 * i + 1) for i, value in enumerate(sn)]
    odd[0] += arb(0, 1) * radius.tan() * ratio ** (2 * len(odd) + 1) / (1 - ratio)
    return arb_poly(odd)


def _convolved(a: Sequence[arb], b: Sequence[arb]) -> arb:
    """The last coefficient that a product of two series of equally many has."""
    return sum(map(mul, a, reversed(b)), arb(0))


class MpmathElliptic:
    """By mpmath's nome series and Carlson forms, to the working precision in force."""

    def __init__(self, k: Any, kc: Any) -> None:
        self.m = 1 - kc * kc if kc < k else k * k
        self.first = mp.pi / (2 * mp.agm(1, kc))

    def second(self) -> Any:
        return self._second

    @cached_property
    def _second(self) -> Any:
        return mp.ellipe(self.m)

    def functions(self, u: Any) -> tuple[Any, Any, Any]:
        return tuple(mp.ellipfun(name, u, m=self.m) for name in ("sn", "cn", "dn"))

    def incomplete(self, phi: Any) -> Any:
        return mp.ellipf(phi, self.m)

    def epsilon(self, u: Any) -> Any:
        halves = mp.nint(u / (2 * self.first))
        rest = u - 2 * halves * self.first
        sn, cn, _ = self.functions(rest)
        return mp.ellipe(mp.atan2(sn, cn), self.m) + 2 * halves * self.second()
