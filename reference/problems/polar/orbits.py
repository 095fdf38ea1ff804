"""Orbits in central fields: z = r/r0 as it goes up and down between two turning points, while phi goes on.

The invariant of a state, with the problem's own kappa, gives the turning points: half of their distance is the
amplitude.  The phase is the time since the lowest point in periods of that orbit.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from flint import arb

from reference.arithmetic.calculus import enclosed_zero
from reference.arithmetic.namespaces import BALL
from reference.arithmetic.precision import ctx
from reference.orbits import NOWHERE, Place
from reference.problems.polar.equations import POINT_MASS
from reference.problems.polar.radial import RadialOscillation

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction

    from reference.problem import Problem

__all__ = ["CentralOrbits", "PointMassOrbits", "TunnelOrbits"]

STEPS = 400
"""Of Newton's method, whose steps near a double zero halve the distance only."""


class CentralOrbits:
    """The exact motion begins at its highest point, z = 1, half a period after a lowest one."""

    def __init__(self, problem: Problem) -> None:
        form: Any = problem.closed_form(BALL)
        self._problem, self.z0 = problem, form.z0
        self._parameters = {name: BALL.number(value) for name, value in problem.parameters.items()}
        self.kappa: arb = self._parameters["kappa"]
        self._frequency = 1 / (2 * form.descent_time)

    def truth(self, t: Fraction) -> Place:
        """The phase t/T after the release, and (1 - z0)/2."""
        return Place(arb(0.5) + BALL.number(t) * self._frequency, (1 - self.z0) / 2)

    def place(self, y: Sequence[arb]) -> Place:
        """Phase and amplitude of a state (z, z', phi), of which phi has no part in it."""
        raise NotImplementedError

    def _energy(self, y: Sequence[arb]) -> arb:
        found: arb = self._problem.invariant(BALL, y, self._parameters)
        return found


class TunnelOrbits(CentralOrbits):
    """Through a uniform ball z^2 is harmonic: (z^2)'' = 2 (E + 2 kappa) - 4 (1 + kappa) z^2, at every energy E."""

    def place(self, y: Sequence[arb]) -> Place:
        """With z^2 = c - A cos(2 pi phase): (z+ - z-)/2 = A/(z+ + z-), and z+ z- is the same at every energy."""
        z, rate = y[0], y[1]
        if not z > 0:
            return NOWHERE
        centre = (self._energy(y) + 2 * self.kappa) / (2 * (1 + self.kappa))
        below, across = centre - z * z, z * rate / (1 + self.kappa).sqrt()
        size = (below * below + across * across).sqrt()
        amplitude = size / (2 * (centre + (self.kappa / (1 + self.kappa)).sqrt())).sqrt()
        return Place(arb.atan2(across, below) / (2 * arb.pi()) if size > 0 else None, amplitude)


class PointMassOrbits(CentralOrbits):
    """About a point mass z'^2 = (E - 1) + w - kappa w^2 (1 + w)^2, w = (1 - z)/z: bound in the well where E < 2.

    The well of the exact motion is the only one where kappa <= 3 sqrt(3); above, the right-hand side has a hump, the
    zero of its slope with -0.79 < w < -1/2, beyond which there is another.
    """

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem)
        self._deepest = (1 - self.z0) / self.z0
        root = arb(3).sqrt()
        self._bends = (root - 3) / 6, -(root + 3) / 6
        angle = -3 * root / self.kappa
        self._hump = -arb(0.5) - (2 * arb.pi() / 3 - angle.acos() / 3).cos() / root if angle > -1 else arb(-1)

    def place(self, y: Sequence[arb]) -> Place:
        """Phase and amplitude of a state that is bound, and in the well."""
        z, rate, excess = y[0], y[1], self._energy(y) - 1
        if not (z > 0 and excess < 1):
            return NOWHERE
        w = POINT_MASS.speed_squared(z)
        if not (w > self._hump and self._square(self._hump, excess) < 0):
            return NOWHERE
        lowest, highest = self._zero(self._deepest, excess), self._zero(self._above(excess), excess)
        if not lowest > highest:  # no state moves so little, and no ball tells them apart
            return NOWHERE
        orbit = RadialOscillation(self.kappa, excess, lowest, highest)
        since = orbit.since_highest(w, rate) / (2 * orbit.half_period)
        return Place(arb(0.5) + (since if rate < 0 else -since), orbit.amplitude)

    def _square(self, w: arb, excess: arb) -> arb:
        """z'^2."""
        return excess + w - self.kappa * (w * (1 + w)) ** 2

    def _slope(self, w: arb) -> arb:
        """d(z'^2)/dw."""
        return 1 - 2 * self.kappa * w * (1 + w) * (1 + 2 * w)

    def _above(self, excess: arb) -> arb:
        """Whence Newton's method goes straight to the highest point: by the signs where the curvature of z'^2 turns.

        z'^2 rises with w there, is concave above the first bend and below the second, and convex between them; at
        w = -(E - 1) it is not positive.
        """
        first, second = self._bends
        if excess <= 0:
            return arb(0)
        if self._square(first, excess) <= 0:
            return (-excess).max(first)
        return first if self._hump > second or self._square(second, excess) <= 0 else -excess

    def _zero(self, start: arb, excess: arb) -> arb:
        """The turning point that Newton's method leads to; no number where none is proven."""
        w, near = start.mid(), self._deepest * arb(2) ** (-ctx.prec // 2)
        for _ in range(STEPS):
            step = (self._square(w, excess) / self._slope(w)).mid()
            w = (w - step).mid()
            if not abs(step) > near:
                break
        return enclosed_zero(w, self._square(w, excess), self._slope(w), self._slope)
