"""The brachistochrone in the field of a point mass, as a problem: exact parameters, proven answers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from reference.arithmetic.namespaces import BALL
from reference.declaration import Form
from reference.problem import APART
from reference.problems.polar.bodies import body_of
from reference.problems.polar.carlson import Carlson
from reference.problems.polar.central import CentralBrachistochrone
from reference.problems.polar.equations import POINT_MASS
from reference.problems.polar.orbits import PointMassOrbits
from reference.problems.polar.quantities import ROWS
from reference.problems.polar.series import EQUAL, Limit, deep, shallow

if TYPE_CHECKING:
    from collections.abc import Callable
    from fractions import Fraction

    from reference.declaration import Row
    from reference.orbits import Orbits
    from reference.problems.polar.equations import Field

__all__ = ["PolarBrachistochrone"]


@dataclass(frozen=True, repr=False)
class PolarBrachistochrone(CentralBrachistochrone):
    """The curve of fastest descent in an inverse-square field, from rest at radius r0 and angle 0.

    Args:
        z0: the lowest point over r0, 0 < z0 < 1; the path goes through it and back up to z = 1.
        end: or the end (R, PHI): its radius over r0, 0 < R <= 1, and its angle in rad, 0 < PHI < 2 pi/3.
        r0: the radius of the release in m, for rows in m and s.
        gm: G M in m^3/s^2; both or neither.
        body: instead of ``gm`` the name of a body: "earth", G M = 3.986004e14 m^3/s^2 (the nominal value of IAU 2015
            Resolution B3), or "thesis-earth", the product of the thesis' G and M, which is 5.4e-6 larger.

    Each number is exact: a float at its binary64 value, a string or Fraction as the rational it spells.  Times are in
    units of sqrt(r0^3/(2 G M)).  All mass is taken to be in a point at the centre: a path below the surface of a real
    body is an idealisation.

    The state in tau is that of z'' = -1/(2 z^2) + kappa (2 z^-5 - 3 z^-4 + z^-3), phi' = sqrt(kappa) (1 - z)/z^3, which
    falls through z0 and comes to rest at z = 1 after two descent times.  There the curve of fastest descent ends; the
    equation goes on, down again, with that period in z and another 2 half_angle in phi, and so does ``state``.

    Raises:
        ValueError: a parameter is outside its range or not finite, or no smooth extremal reaches the end.
        TypeError: a parameter is no real number.
    """

    gm: Fraction | None

    name: ClassVar[str] = "polar"
    rows: ClassVar[tuple[Row, ...]] = ROWS
    field: ClassVar[Field] = POINT_MASS
    extremal = Carlson
    form: ClassVar[Form] = Form(
        "time",
        "in time",
        "z'' = -1/(2 z^2) + kappa (2 z^-5 - 3 z^-4 + z^-3), phi' = sqrt(kappa) (1 - z)/z^3, from rest at z = 1",
    )

    def __init__(
        self, z0: Any = None, end: Any = None, r0: Any = None, gm: Any = None, body: str | None = None
    ) -> None:
        known = body_of(body, gm, "gm")
        gm = gm if known is None else known.value
        if (r0 is None) != (gm is None):
            raise ValueError("r0 and gm, or r0 and body, are accepted together: both or neither.")
        self._set_positive("r0", r0)
        self._set_positive("gm", gm)
        object.__setattr__(self, "body", body)
        self._set_path(z0, end)

    def __repr__(self) -> str:
        return f"PolarBrachistochrone({self._spelled('r0', 'gm')})"

    def orbits(self) -> Orbits:
        return PointMassOrbits(self)

    @property
    def unit(self) -> tuple[Fraction, Fraction] | None:
        """r0 and r0^3/(2 G M)."""
        if self.r0 is None or self.gm is None:
            return None
        return self.r0, self.r0**3 / (2 * self.gm)

    def limit(self, order: int, m: Any = BALL) -> Limit:
        """half_angle and descent_time by ``order`` terms about the nearer limit, z0 -> 0 or z0 -> 1, with bounds.

        In balls at the precision of ``flint.ctx``, or in another arithmetic.

        Raises:
            ValueError: ``order`` is not an integer from 1 to 1000.
        """
        kappa = self.closed_form(m).kappa
        return (deep if kappa < m.number(EQUAL) else shallow)(m, kappa, order)

    def neighbour(self, rounding: Callable[[Fraction], Fraction], epsilon: Fraction) -> PolarBrachistochrone:
        """The path whose lowest point is higher by 2^-36 of its distance to 0 or 1, or by 16 roundings."""
        z0 = self._lowest()
        shift = max(min(z0, 1 - z0) * APART, 16 * epsilon * z0)
        return PolarBrachistochrone(rounding(z0 + shift), r0=self.r0, gm=self.gm)
