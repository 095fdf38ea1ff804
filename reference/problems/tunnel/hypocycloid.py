"""The hypocycloid in closed form, in any arithmetic: elementary functions alone."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from reference.once import cached_property
from reference.problems.polar.extremal import Extremal
from reference.problems.tunnel.equations import UNIFORM_BALL

if TYPE_CHECKING:
    from reference.problems.polar.equations import Field

__all__ = ["Hypocycloid"]


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
