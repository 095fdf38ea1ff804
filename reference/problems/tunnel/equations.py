"""A tunnel through a planet of uniform density and its brachistochrones, each equation written once.

Lengths in units of the planet's radius r0, times in units of sqrt(r0/g), g the gravity at the surface: z = r/r0,
gravity is z, and the speed is v^2 = 1 - z^2.  The extremal with the lowest point z0 keeps Bouguer's constant
z^2 phi'/v^2 = sqrt(kappa), and it is the hypocycloid

    z^2 = z0^2 sin^2(psi/2) + cos^2(psi/2),   phi = atan(z0 tan(psi/2)) - z0 psi/2,   tau = sqrt(1 - z0^2) psi/2,

of a circle of radius (1 - z0)/2 that rolls inside the planet (G. Venezian, Am. J. Phys. 34, 701, 1966): in closed form
by elementary functions alone.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.once import cached_property
from reference.problems.polar.extremal import Extremal

if TYPE_CHECKING:
    from reference.arithmetic.protocols import Arithmetic
    from reference.problems.polar.equations import Field

__all__ = ["UNIFORM_BALL", "Hypocycloid", "UniformBall"]


class UniformBall:
    """Gravity that grows with the radius; ``m`` comes first, ``sine2`` and ``cosine2`` are squares for psi/2."""

    sweep = Fraction(1)
    """The total angle of an extremal from rest to rest, in units of pi, as z0 -> 0: all sweep less."""
    beyond = "pi"

    @staticmethod
    def kappa(z0: Any) -> Any:
        """kappa = z0^2/(1 - z0^2), the square of Bouguer's constant."""
        return z0 * z0 / ((1 - z0) * (1 + z0))

    @staticmethod
    def speed_squared(z: Any) -> Any:
        """v^2 = 1 - z^2."""
        return (1 - z) * (1 + z)

    @staticmethod
    def height(m: Arithmetic, z0: Any, sine2: Any, cosine2: Any) -> Any:
        """z at psi."""
        return m.sqrt(z0 * z0 * sine2 + cosine2)

    @staticmethod
    def squares(z0: Any, below: Any, above: Any) -> tuple[Any, Any]:
        """sin^2 and cos^2 of psi/2 where 1 - z and z - z0 are these parts of 1 - z0."""
        z = z0 + (1 - z0) * above
        return below * (1 + z) / (1 + z0), above * (z + z0) / (1 + z0)

    @staticmethod
    def rates(m: Arithmetic, z0: Any, sine2: Any, cosine2: Any) -> tuple[Any, Any]:
        """dphi/dpsi = z0 (1 - z^2)/(2 z^2) and dtau/dpsi = sqrt(1 - z0^2)/2."""
        depth = (1 - z0) * (1 + z0)
        return z0 * depth * sine2 / (2 * (z0 * z0 * sine2 + cosine2)), m.sqrt(depth) / 2

    @staticmethod
    def climb(m: Arithmetic, z0: Any, z: Any) -> Any:
        """-dz/dtau over sin(psi/2) cos(psi/2): sqrt(1 - z0^2)/z."""
        return m.sqrt((1 - z0) * (1 + z0)) / z

    @staticmethod
    def excess(m: Arithmetic, z0: Any, sine2: Any, cosine2: Any) -> Any:
        """(z^2/v^2 - kappa) sin^2(psi/2) = cos^2(psi/2)/(1 - z0^2): by how much Bouguer's constant can grow."""
        del m, sine2
        return cosine2 / ((1 - z0) * (1 + z0))

    @staticmethod
    def motion(m: Arithmetic, z: Any, kappa: Any) -> tuple[Any, Any]:
        """z'' = -z + kappa (1 - z^4)/z^3 and phi' = sqrt(kappa) (1 - z^2)/z^2."""
        square = z * z
        depth = (1 - z) * (1 + z)
        return kappa * depth * (1 + square) / (square * z) - z, m.sqrt(kappa) * depth / square

    @staticmethod
    def energy(z: Any, z_rate: Any, kappa: Any) -> Any:
        """E = z'^2 + kappa (1 - z^2)^2/z^2 + z^2: 1 along the exact motion."""
        across = (1 - z) * (1 + z) / z
        return z_rate * z_rate + kappa * across * across + z * z

    @staticmethod
    def rate_squared(z0: Any) -> Any:
        """A bound on |dz''/dz| over z0 <= z <= 1: 1 + kappa (1 + 3/z0^4)."""
        return 1 + (z0 * z0 + 3 / (z0 * z0)) / ((1 - z0) * (1 + z0))

    @staticmethod
    def slowness(m: Arithmetic, z: Any) -> Any:
        """sqrt(1 - z^2)/v = 1: on a straight line the body oscillates as a pendulum of small amplitude."""
        del m
        return 1 + 0 * z

    @staticmethod
    def pull(z: Any) -> Any:
        """The acceleration towards the centre over z: 1."""
        return 1 + 0 * z

    @staticmethod
    def singular(m: Arithmetic, z0: Any) -> tuple[tuple[Any, Any], ...]:
        """cos^2(psi/2), real and imaginary part, where the rates are singular: z = 0."""
        del m
        return ((-z0 * z0 / ((1 - z0) * (1 + z0)), 0 * z0),)


UNIFORM_BALL = UniformBall()


class Hypocycloid(Extremal):
    """phi = atan(z0 tan(psi/2)) - z0 psi/2 and tau = sqrt(1 - z0^2) psi/2."""

    field: Field = UNIFORM_BALL

    @cached_property
    def pace(self) -> Any:
        """tau over psi/2: sqrt(1 - z0^2)."""
        return self.m.sqrt((1 - self.z0) * (1 + self.z0))

    @cached_property
    def half_angle(self) -> Any:
        """(pi/2) (1 - z0): half of what the circle of radius (1 - z0)/2 rolls off in one turn."""
        return self.m.pi() * (1 - self.z0) / 2

    @property
    def dhalf_angle_dz0(self) -> Any:
        return -self.m.pi() / 2

    @cached_property
    def descent_time(self) -> Any:
        return self.m.pi() * self.pace / 2

    def angle(self, sine: Any, cosine: Any) -> Any:
        return self.m.atan2(self.z0 * sine, cosine) - self.z0 * self.m.atan2(sine, cosine)

    def time(self, sine: Any, cosine: Any) -> Any:
        return self.pace * self.m.atan2(sine, cosine)

    def psi_at(self, tau: Any) -> Any:
        return 2 * tau / self.pace
