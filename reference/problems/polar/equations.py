"""The field of a point mass and its brachistochrones, each equation written once.

Lengths in units of the radius r0 of the release, times in units of sqrt(r0^3/(2 G M)): z = r/r0, and the speed is
v^2 = (1 - z)/z.  The extremal with the lowest point z0 keeps Bouguer's constant z^2 phi'/v^2 = sqrt(kappa), and

    z = z0 sin^2(psi/2) + cos^2(psi/2),     0 <= psi <= 2 pi: from the release through z0 and back up to z = 1.

With dz/dpsi = -sqrt((1 - z) (z - z0)) no rate below is singular at either end.  (In the thesis' (1.42) the middle term
of Q lacks its z: J. Šalinović, Problem brahistokrone u nehomogenom gravitacijskom polju, University of Split 2022.)
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

if TYPE_CHECKING:
    from reference.arithmetic.protocols import Arithmetic

__all__ = ["POINT_MASS", "End", "Field", "PointMass"]


class Field(Protocol):
    """A law of force: the equations of its brachistochrones, as ``PointMass`` states them."""

    sweep: Fraction
    beyond: str

    def __hash__(self) -> int: ...
    def kappa(self, z0: Any) -> Any: ...
    def speed_squared(self, z: Any) -> Any: ...
    def height(self, m: Arithmetic, z0: Any, sine2: Any, cosine2: Any) -> Any: ...
    def squares(self, z0: Any, below: Any, above: Any) -> tuple[Any, Any]: ...
    def rates(self, m: Arithmetic, z0: Any, sine2: Any, cosine2: Any) -> tuple[Any, Any]: ...
    def climb(self, m: Arithmetic, z0: Any, z: Any) -> Any: ...
    def excess(self, m: Arithmetic, z0: Any, sine2: Any, cosine2: Any) -> Any: ...
    def motion(self, m: Arithmetic, z: Any, kappa: Any) -> tuple[Any, Any]: ...
    def energy(self, z: Any, z_rate: Any, kappa: Any) -> Any: ...
    def rate_squared(self, z0: Any) -> Any: ...
    def slowness(self, m: Arithmetic, z: Any) -> Any: ...
    def pull(self, z: Any) -> Any: ...
    def singular(self, m: Arithmetic, z0: Any) -> tuple[tuple[Any, Any], ...]: ...


class End(NamedTuple):
    """Where an extremal ends: the exact radius and angle, and whether it has passed its lowest point by then."""

    radius: Fraction
    angle: Fraction
    after: bool


class PointMass:
    """Inverse-square gravity; the arithmetic ``m`` comes first, ``sine2`` and ``cosine2`` are squares for psi/2."""

    sweep = Fraction(2, 3)
    """The total angle of an extremal from rest to rest, in units of pi, as z0 -> 0: all sweep less."""
    beyond = "2 pi/3"

    @staticmethod
    def kappa(z0: Any) -> Any:
        """kappa = z0^3/(1 - z0), the square of Bouguer's constant."""
        return z0**3 / (1 - z0)

    @staticmethod
    def speed_squared(z: Any) -> Any:
        """v^2 = (1 - z)/z."""
        return (1 - z) / z

    @staticmethod
    def quadratic(z0: Any, z: Any) -> Any:
        """Q = (1 - z0) z^2 + z0 (1 - z0) z + z0^2, so that z^3 - kappa (1 - z) = (z - z0) Q/(1 - z0)."""
        return (1 - z0) * z * (z + z0) + z0 * z0

    @staticmethod
    def height(m: Arithmetic, z0: Any, sine2: Any, cosine2: Any) -> Any:
        """z at psi."""
        del m
        return z0 * sine2 + cosine2

    @staticmethod
    def squares(z0: Any, below: Any, above: Any) -> tuple[Any, Any]:
        """sin^2 and cos^2 of psi/2 where 1 - z and z - z0 are these parts of 1 - z0."""
        del z0
        return below, above

    @classmethod
    def rates(cls, m: Arithmetic, z0: Any, sine2: Any, cosine2: Any) -> tuple[Any, Any]:
        """dphi/dpsi = z0^(3/2) (1 - z)/(z sqrt(Q)) and dtau/dpsi = z^2 sqrt((1 - z0)/Q)."""
        z = cls.height(m, z0, sine2, cosine2)
        root = m.sqrt(cls.quadratic(z0, z))
        return z0 * m.sqrt(z0) * (1 - z0) * sine2 / (z * root), z * z * m.sqrt(1 - z0) / root

    @classmethod
    def climb(cls, m: Arithmetic, z0: Any, z: Any) -> Any:
        """-dz/dtau over sin(psi/2) cos(psi/2): sqrt((1 - z0) Q)/z^2."""
        return m.sqrt((1 - z0) * cls.quadratic(z0, z)) / (z * z)

    @classmethod
    def excess(cls, m: Arithmetic, z0: Any, sine2: Any, cosine2: Any) -> Any:
        """(z^2/v^2 - kappa) sin^2(psi/2) = cos^2(psi/2) Q/(1 - z0): by how much Bouguer's constant can grow."""
        return cosine2 * cls.quadratic(z0, cls.height(m, z0, sine2, cosine2)) / (1 - z0)

    @staticmethod
    def motion(m: Arithmetic, z: Any, kappa: Any) -> tuple[Any, Any]:
        """z'' = -1/(2 z^2) + kappa (2 z^-5 - 3 z^-4 + z^-3) and phi' = sqrt(kappa) (1 - z)/z^3."""
        inverse = 1 / z
        cubed = inverse * inverse * inverse
        turn = kappa * cubed * (2 * inverse - 1) * (inverse - 1)
        return turn - inverse * inverse / 2, m.sqrt(kappa) * (1 - z) * cubed

    @staticmethod
    def energy(z: Any, z_rate: Any, kappa: Any) -> Any:
        """E = 1 + z'^2 + kappa (1 - z)^2/z^4 - (1 - z)/z: 1 along the exact motion."""
        across = (1 - z) / (z * z)
        return z_rate * z_rate + kappa * across * across + (2 - 1 / z)

    @staticmethod
    def rate_squared(z0: Any) -> Any:
        """A bound on |dz''/dz| over z0 <= z <= 1.

        dz''/dz = z^-3 - kappa (10 z^-6 - 12 z^-5 + 3 z^-4): both parts are positive and fall with z, and at z0 the
        second is the larger.
        """
        return (10 - 12 * z0 + 3 * z0 * z0) / (z0**3 * (1 - z0))

    @staticmethod
    def slowness(m: Arithmetic, z: Any) -> Any:
        """sqrt(1 - z^2)/v = sqrt(z (1 + z)): the time of a straight line, where its circle stands for its length."""
        return m.sqrt(z * (1 + z))

    @staticmethod
    def pull(z: Any) -> Any:
        """The acceleration towards the centre over z: 1/(2 z^3)."""
        return 1 / (2 * z * z * z)

    @staticmethod
    def singular(m: Arithmetic, z0: Any) -> tuple[tuple[Any, Any], ...]:
        """cos^2(psi/2), real and imaginary part, where the rates are singular: z = 0, and Q = 0."""
        depth = 1 - z0
        return (-z0 / depth, 0 * z0), (-3 * z0 / (2 * depth), z0 * m.sqrt((3 + z0) / depth) / (2 * depth))


POINT_MASS = PointMass()
