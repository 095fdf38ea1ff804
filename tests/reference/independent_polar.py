"""Brachistochrones in central fields computed again, sharing nothing with the package.

About a point mass by rigorous integrals over Jacobi's amplitude theta, tan(theta/2) = sqrt(z0 s) tan(psi/2), instead of
closed forms; the complete ones as hypergeometric series.  Through a uniform ball by the rolling circle, as the complex
number (1 - b) exp(i a) + b exp(-i a (1 - b)/b).  Times on other curves straight from ds/v.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from flint import acb, arb, fmpq

from reference.arithmetic.precision import ctx, mp

if TYPE_CHECKING:
    from fractions import Fraction

BITS = 3 * 159 + 40


def ball(x: Fraction) -> arb:
    return arb(fmpq(x.numerator, x.denominator))


def number(x: Fraction) -> Any:
    return mp.mpf(x.numerator) / x.denominator


@dataclass(frozen=True)
class Amplitude:
    """The extremal about a point mass, at the precision of ``flint.ctx``."""

    z0: arb

    def passed(self, tangent: arb) -> tuple[arb, arb]:
        """(phi, tau) where tan(psi/2) is positive and given."""
        z0, s = self.z0, (3 - 2 * self.z0).sqrt()
        modulus2 = (1 - (3 - z0 * z0) / (2 * s)) / 2
        end = 2 * ((z0 * s).sqrt() * tangent).atan()

        def rates(theta: acb, analytic: bool) -> tuple[acb, acb]:
            cosine = theta.cos()
            up, down = s * (1 + cosine), 1 - cosine
            root = (1 - modulus2 * (1 - cosine * cosine)).sqrt(analytic=analytic)
            z = z0 * (up + down) / (z0 * up + down)
            return (1 - z0) / s.sqrt() * down / (up + down) / root, ((1 - z0) / (z0 * s)).sqrt() * z * z / root

        phi, tau = (
            acb.integral(lambda x, analytic, i=i: rates(end * x, analytic)[i], 0, 1).real * end for i in range(2)
        )
        return phi, tau

    def psi_at(self, tau: arb) -> arb:
        """psi at a tau before the lowest point, by Newton's method from the radial fall."""
        psi = 2 * (tau / 2).sin().asin() if tau < 1 else arb(2)
        for _ in range(40):
            z = (1 + self.z0) / 2 + (1 - self.z0) / 2 * psi.cos()
            rate = z * z * ((1 - self.z0) / ((1 - self.z0) * z * z + self.z0 * (1 - self.z0) * z + self.z0**2)).sqrt()
            step = (self.passed((psi / 2).tan())[1] - tau) / rate
            psi = min(max((psi - step).mid(), psi / 2), (psi + arb.pi()) / 2).mid()
            if abs(step) < arb(2) ** (40 - ctx.prec):
                return psi
        raise AssertionError


def complete(z0: Fraction) -> tuple[Any, Any]:
    """Half angle and descent time, to mpmath's precision."""
    kappa = number(z0**3 / (1 - z0))
    third, argument = mp.mpf(1) / 3, -27 / (4 * kappa)
    angle = mp.pi / 3 * (1 - mp.hyp2f1(third, 2 * third, 1, argument))
    time = mp.pi / mp.sqrt(kappa) * mp.hyper([mp.mpf(1) / 2, 4 * third, 5 * third], [mp.mpf(3) / 2, 2], argument)
    return angle, time


def rolled(z0: Fraction, psi: Fraction) -> tuple[Any, Any, Any]:
    """(z, phi, tau) on the hypocycloid, 0 <= psi <= 2 pi, to mpmath's precision."""
    b = number((1 - z0) / 2)
    a = b * number(psi)
    point = (1 - b) * mp.expj(a) + b * mp.expj(-a * (1 - b) / b)
    return abs(point), mp.arg(point) % (2 * mp.pi), number(psi) * mp.sqrt(b * (1 - b))


def neighbour_time(z0: Any, kappa: Any, field: Field, psi_end: Any, epsilon: Any) -> Any:
    """The integral of ds/v over 0 <= psi <= psi_end along phi + epsilon eta, from z(psi) and Bouguer's law."""

    def rate(psi: Any) -> Any:
        z, slope = field(z0, psi)
        speed2 = field.speed2(z)
        swept = mp.sqrt(kappa) * speed2 / z**2 * abs(slope) / mp.sqrt(speed2 - kappa * (speed2 / z) ** 2)
        sine, rest = mp.sin(psi / 2), (psi_end - psi) / 2
        aside = sine**2 * (3 * mp.cos(psi / 2) * mp.sin(rest) - sine * mp.cos(rest)) / 2
        return mp.sqrt(slope**2 + z**2 * (swept + epsilon * (1 - z0) * aside) ** 2) / mp.sqrt(speed2)

    ends = [0, psi_end / 2, psi_end] if psi_end < mp.pi else [0, 1, 2, 2.6, mp.pi, 3.7, psi_end]
    return mp.quad(rate, ends, method="gauss-legendre")


def chord_time(field: Field, radius: Any, angle: Any) -> Any:
    """The integral of ds/v along the straight line from (1, 0) to (radius, angle), its part p^2 (3 - 2 p) by p."""
    end = radius * mp.expj(angle)

    def slowness(p: Any) -> Any:
        return 6 * p * (1 - p) / mp.sqrt(field.speed2(abs(1 + p * p * (3 - 2 * p) * (end - 1))))

    return abs(end - 1) * mp.quad(slowness, mp.linspace(0, 1, 9), method="gauss-legendre")


class Field:
    """z and dz/dpsi, and v^2, of a law of force."""

    def __init__(self, power: int) -> None:
        self.power = power

    def speed2(self, z: Any) -> Any:
        return (1 - z) / z if self.power == 1 else 1 - z * z

    def __call__(self, z0: Any, psi: Any) -> tuple[Any, Any]:
        n = self.power
        z = (z0**n * mp.sin(psi / 2) ** 2 + mp.cos(psi / 2) ** 2) ** (mp.mpf(1) / n)
        return z, -(1 - z0**n) * mp.sin(psi) / (2 * n) / z ** (n - 1)


POINT_MASS, UNIFORM_BALL = Field(1), Field(2)
