"""The extremals of a point mass by elliptic integrals, in balls.

With s = sqrt(3 - 2 z0), w = z0 s, q = 1/w, d = 1 - z0, tan^2(theta/2) = w tan^2(psi/2) and

    k^2 = d^3 (3 + z0)/(4 s (2 s + 3 - z0^2)) <= 1/2 - sqrt(3)/4,     a = (k' + i k)^2,

the integral of the first kind is F(theta, k) = 2 R_F(x, x + a, x + a*), x = cot^2(theta/2) = cot^2(psi/2)/w (B. C.
Carlson's forms, DLMF 19.16).  The angle needs no other: sqrt(kappa (1 - z)/z^3) is the sine of the angle alpha of the
path with the vertical, and dphi = (2/3) dalpha - (z0/(3 sqrt(s))) dF, because the pole of dphi at z = 0 is a point of
order three of the elliptic curve.  Hence

    phi = (2/3) alpha - z0 F/(3 sqrt(s)),     half_angle = pi/3 - 2 z0 K(k)/(3 sqrt(s)) < pi/3,

and half_angle falls with z0: the logarithmic derivative of z0/sqrt(s) is 1/z0 + 1/(2 s^2) > 1, and that of K at least
(dk^2/dz0)/(2 k'^2) > -1/10, for K k' falls with k and dk^2/dz0 = -3 d^2/(4 s^3).

The time has a pole at infinity besides and takes all three kinds: with P = x (x + a) (x + a*)

    tau = sqrt(d q) [(1 - d (2 + z0)/4) F - (d q/3) R_J(x, x + a, x + a*, x + q)
                     + Re{((1 - a^2)/3) R_D(x, x + a*, x + a) + sqrt(P) (q - a)/((x + q) (x + a))}/(d q)].

Nothing is lost as z0 -> 1, and half of z0's own digits as z0 -> 0.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from flint import acb, arb

from reference.arithmetic.calculus import ball_zero, enclosed_zero
from reference.arithmetic.precision import ctx
from reference.once import cached_property
from reference.problems.polar.equations import POINT_MASS
from reference.problems.polar.extremal import Extremal
from reference.problems.polar.panels import Schedule

if TYPE_CHECKING:
    from reference.problems.polar.equations import End, Field

__all__ = ["Carlson"]

FLOAT_BITS = 45
"""Bits that a first guess in floats is good for."""
LATE = 1.0, 3.5
"""Where to look for a psi near the lowest point."""
SPARE_BITS = 40
"""Bits that a Newton step may lose, and that a proof begins with to spare."""


class Carlson(Extremal):
    """The closed form in balls."""

    field: Field = POINT_MASS

    def __init__(self, m: Any, z0: Any, end: End | None = None, unit: tuple[arb, arb] | None = None) -> None:
        super().__init__(m, z0, end, unit)
        z0 = self.z0
        self.d = 1 - z0
        self.s = (3 - 2 * z0).sqrt()
        self.q = 1 / (z0 * self.s)
        self.modulus2 = self.d**3 * (3 + z0) / (4 * self.s * (2 * self.s + 3 - z0 * z0))
        self.both = (self.modulus2 * (1 - self.modulus2)).sqrt()
        self.a = acb(1 - 2 * self.modulus2, 2 * self.both)
        self.a_less_q = acb(-(self.d**2) * self.q * (2 + z0) / 2, 2 * self.both)
        self.bouguer = z0 * z0.sqrt()

    @cached_property
    def first(self) -> arb:
        """K(k)."""
        return arb.pi() / (2 * arb(1).agm((1 - self.modulus2).sqrt()))

    @cached_property
    def half_angle(self) -> arb:
        return arb.pi() / 3 - 2 * self.z0 * self.first / (3 * self.s.sqrt())

    @property
    def dhalf_angle_dz0(self) -> arb:
        """-(2/3) d(z0 K s^(-1/2))/dz0 with dK/dk^2 = B/(2 k'^2), B = K - D, and dk^2/dz0 = -3 d^2/(4 s^3)."""
        z0, s, complement = self.z0, self.s, 1 - self.modulus2
        b = self.first - acb.elliptic_rd(0, complement, 1).real / 3
        by_modulus = -3 * self.d**2 * b / (8 * complement * s**3)
        return -2 * (self.first + z0 * self.first / (2 * s * s) + z0 * by_modulus) / (3 * s.sqrt())

    @cached_property
    def descent_time(self) -> arb:
        return self._time(arb(0))

    def _abscissa(self, sine: arb, cosine: arb) -> arb:
        return cosine * cosine * self.q / (sine * sine)

    def _first_kind(self, x: arb) -> arb:
        """F = 2 R_F(x, x + a, x + a*)."""
        return 2 * acb.elliptic_rf(x, x + self.a, x + self.a.conjugate()).real

    def angle(self, sine: arb, cosine: arb) -> arb:
        x = self._abscissa(sine, cosine)
        z = self.z0 + self.d * cosine * cosine
        alpha = arb.atan2(self.bouguer * sine, cosine * POINT_MASS.quadratic(self.z0, z).sqrt())
        return (2 * alpha - sine.sgn() * self.z0 * self._first_kind(x) / self.s.sqrt()) / 3

    def time(self, sine: arb, cosine: arb) -> arb:
        return sine.sgn() * self._time(self._abscissa(sine, cosine))

    def _time(self, x: arb) -> arb:
        a, q, scale = self.a, self.q, self.d * self.q
        beside, mirrored = x + a, x + a.conjugate()
        third = acb.elliptic_rj(x, beside, mirrored, x + q).real
        second = -4 * acb(0, self.both) * a * acb.elliptic_rd(x, mirrored, beside) / 3
        edge = (x * (x * x + 2 * a.real * x + 1)).sqrt() * self.a_less_q / ((x + q) * beside)
        whole = (1 - self.d * (2 + self.z0) / 4) * self._first_kind(x)
        return scale.sqrt() * (whole - scale * third / 3 + (second - edge).real / scale)

    @cached_property
    def _schedule(self) -> Schedule:
        return Schedule(self.field, float(self.z0))

    def psi_at(self, tau: arb) -> arb:
        """The zero of tau(psi) - tau by interval Newton, from a guess in floats and steps at growing precision.

        Very near to the lowest point of a very deep path these may fail, and bisection helps.
        """
        x, good = arb(self._schedule.psi_at(float(tau / self.descent_time))), FLOAT_BITS
        while 2 * good < ctx.prec - SPARE_BITS:
            with ctx.workprec(2 * good + SPARE_BITS):
                x = (x - (self._time_at(x) - tau) / self._slope(x)).mid()
            good *= 2
        found = enclosed_zero(x, self._time_at(x) - tau, self._slope(x), self._slope)
        if found.is_finite():
            return found
        bracket = LATE if tau > 0 else (-LATE[1], -LATE[0])
        return ball_zero(lambda x: (self._time_at(x) - tau, self._slope(x)), *bracket)

    def _time_at(self, psi: arb) -> arb:
        """tau a little beyond the lowest points too."""
        sine, cosine = (psi / 2).sin(), (psi / 2).cos()
        if cosine < 0:
            return 2 * sine.sgn() * self.descent_time - self.time(sine, -cosine)
        return self.time(sine, cosine)

    def _slope(self, psi: arb) -> arb:
        cosine2 = (psi / 2).cos() ** 2
        rate: arb = self.field.rates(self.m, self.z0, 1 - cosine2, cosine2)[1]
        return rate
