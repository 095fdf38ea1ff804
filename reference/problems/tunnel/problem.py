"""The fastest tunnel through a planet of uniform density, as a problem: what can be asked of it, and its parameters."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from reference.arithmetic.exact import exact, rational_root
from reference.problem import APART
from reference.problems.polar.bodies import body_of
from reference.problems.polar.central import CentralBrachistochrone
from reference.problems.polar.orbits import TunnelOrbits
from reference.problems.polar.quantities import Definitions, rows_of
from reference.problems.tunnel.equations import UNIFORM_BALL, Hypocycloid

if TYPE_CHECKING:
    from collections.abc import Callable
    from fractions import Fraction

    from reference.declaration import Row
    from reference.orbits import Orbits
    from reference.problems.polar.equations import Field

__all__ = ["ROWS", "Tunnel"]

ROWS = rows_of(
    Definitions(
        height="z^2 = (1 + z0^2)/2 + ((1 - z0^2)/2) cos(psi)",
        phi="phi = atan(z0 tan(psi/2)) - z0 psi/2, continuous in psi",
        tau="tau = sqrt(1 - z0^2) psi/2",
        rate="z'' = -z + kappa (1 - z^4)/z^3, phi' = sqrt(kappa) (1 - z^2)/z^2",
        kappa="kappa = z0^2/(1 - z0^2)",
        half_angle="(pi/2) (1 - z0)",
        descent_time="(pi/2) sqrt(1 - z0^2), in units of sqrt(r0/g)",
        time_unit="sqrt(r0/g)",
        setting="the density the same everywhere",
    )
)


@dataclass(frozen=True, repr=False)
class Tunnel(CentralBrachistochrone):
    """The curve of fastest descent through a planet of uniform density, from rest at its surface: a hypocycloid.

    Args:
        z0: the lowest point over the planet's radius r0, 0 < z0 < 1; the tunnel goes on to the surface.
        end: or the end (R, PHI): its radius over r0, 0 < R <= 1, and its angle in rad, 0 < PHI < pi.
        r0: the radius in m, for rows in m and s.
        g: gravity at the surface in m/s^2; both or neither.
        body: instead of ``g`` the name of a body: g = G M/r0^2, with "earth" the nominal G M = 3.986004e14 m^3/s^2 of
            IAU 2015 Resolution B3, with "thesis-earth" the product of the thesis' G and M, which is 5.4e-6 larger.

    Each number is exact: a float at its binary64 value, a string or Fraction as the rational it spells.  Times are in
    units of sqrt(r0/g).  A real planet is denser inside: the uniform one is an idealisation.

    The state in tau is that of z'' = -z + kappa (1 - z^4)/z^3, phi' = sqrt(kappa) (1 - z^2)/z^2, which comes to rest at
    the surface after two descent times.  There the tunnel ends; the equation goes on, down again, with that period in
    z and another 2 half_angle in phi, and so does ``state``.

    Raises:
        ValueError: a parameter is outside its range or not finite, or no smooth extremal reaches the end.
        TypeError: a parameter is no real number.
    """

    g: Fraction | None

    name: ClassVar[str] = "tunnel"
    rows: ClassVar[tuple[Row, ...]] = ROWS
    field: ClassVar[Field] = UNIFORM_BALL
    extremal = Hypocycloid

    def __init__(self, z0: Any = None, end: Any = None, r0: Any = None, g: Any = None, body: str | None = None) -> None:
        known = body_of(body, g, "g")
        if (r0 is None) != (g is None and known is None):
            raise ValueError("r0 and g, or r0 and body, are accepted together: both or neither.")
        self._set_positive("r0", r0)
        self._set_positive("g", g if known is None else known.value / exact(r0, "r0") ** 2)
        object.__setattr__(self, "body", body)
        self._set_path(z0, end)

    def __repr__(self) -> str:
        return f"Tunnel({self._spelled('r0', 'g')})"

    def orbits(self) -> Orbits:
        return TunnelOrbits(self)

    @property
    def equation(self) -> str:
        """Of z and phi, from rest at the surface."""
        return "z'' = -z + kappa (1 - z^4)/z^3, phi' = sqrt(kappa) (1 - z^2)/z^2, from rest at z = 1"

    @property
    def unit(self) -> tuple[Fraction, Fraction] | None:
        """r0 and r0/g."""
        return None if self.r0 is None or self.g is None else (self.r0, self.r0 / self.g)

    def exact_row(self, row: str, argument: Any) -> tuple[Fraction | None, ...] | None:
        """Besides, times at a rational psi, where sqrt(1 - z0^2) and the unit of time make them rational."""
        if row in {"curve", "si_curve"} and self.z0 is not None and argument != 0:
            squared = (1 - self.z0**2) * (1 if row == "curve" or self.unit is None else self.unit[1])
            pace = rational_root(squared)
            time = None if pace is None else pace * argument / 2
            return (None, None, time) if row == "curve" else (None, time)
        return super().exact_row(row, argument)

    def neighbour(self, rounding: Callable[[Fraction], Fraction], epsilon: Fraction) -> Tunnel:
        """The tunnel whose lowest point is higher by 2^-36 of its distance to 0 or 1, or by 16 roundings."""
        z0 = self._lowest()
        shift = max(min(z0, 1 - z0) * APART, 16 * epsilon * z0)
        return Tunnel(rounding(z0 + shift), r0=self.r0, g=self.g)
