"""The pendulum from any start, as a problem: exact parameters, proven answers."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar

from reference.problem import APART
from reference.problems.pendulum.approximations import LindstedtSolution, PeriodSeries, lindstedt, period_series
from reference.problems.pendulum.equations import through_the_bottom
from reference.problems.pendulum.events import Events, events
from reference.problems.pendulum.orbits import Librations, Rotations, Small
from reference.problems.pendulum.simple import SimplePendulum

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.arithmetic.protocols import Arithmetic
    from reference.input_condition import InputCondition
    from reference.orbits import Orbits
    from reference.problems.pendulum.bounds import PendulumBounds

__all__ = ["Pendulum"]

PI = Fraction(math.pi)


class Pendulum(SimplePendulum):
    """The pendulum theta'' = -(g/length) sin theta, released from rest or set going.

    Args:
        theta0: angle of the start in rad; without ``omega0`` the amplitude, 0 < theta0 < pi.
        g: acceleration of gravity in m/s^2, positive.
        length: length in m, positive.
        omega0: angular velocity of the start in rad/s; if None the pendulum is released from rest.

    Each is exact: a float at its binary64 value, a string or Fraction as the rational it spells.

    Raises:
        ValueError: a parameter is outside its range or not finite.
        TypeError: a parameter is no real number.
    """

    event_words: ClassVar[str] = "passages through the bottom"

    def neighbour(self, rounding: Callable[[Fraction], Fraction], epsilon: Fraction) -> Pendulum:
        """The pendulum whose start is nearer to rest by 2^-36 of its way to 0 or pi, or by 16 roundings."""
        size = abs(self.theta0)
        shift = max(min(size, abs(PI - size)) * APART, 16 * epsilon * size)
        slower = 1 - max(APART, 16 * epsilon)
        moved = self.theta0 - shift if self.theta0 > 0 else self.theta0 + shift
        return Pendulum(rounding(moved), self.g, self.length, rounding(self.omega0 * slower))

    def orbits(self) -> Orbits | None:
        kinds = {"libration": Librations, "rotation": Rotations, "rest": Small}
        return kinds[self.motion](self) if self.motion in kinds else None

    @property
    def lacks_of_orbits(self) -> str:
        lacks = {
            "separatrix": "The separatrix has no period, and so neither phase nor amplitude errors.",
            "rotation": "A rotation has no amplitude.",
            "rest": "At rest there is no phase.",
        }
        return lacks.get(self.motion, "")

    def state_bounds(self) -> PendulumBounds | None:
        """Of librations and rotations."""
        from reference.problems.pendulum.bounds import PendulumBounds

        if self.motion not in {"libration", "rotation"}:
            return None
        return PendulumBounds(self, rotates=self.motion == "rotation")

    def input_condition(self) -> InputCondition:
        from reference.problems.pendulum.input_condition import pendulum_condition

        return pendulum_condition(self)

    def passages(self, until: float) -> tuple[str, int] | None:
        """The passages through the bottom."""
        return ("zero_crossing", len(self.events(until).zero_crossings)) if self.serves("zero_crossing") else None

    def event(self, m: Arithmetic, y: Sequence[Any]) -> Any:
        """sin(theta/2), zero at the bottom in whichever turn."""
        return through_the_bottom(m, y)

    def period_series(self, order: int) -> PeriodSeries:
        """The series of a released pendulum's period in its amplitude, up to theta0^(2 order), and its proven error.

        Raises:
            ValueError: the pendulum is not released from rest, or ``order`` is not an integer from 0 to 100.
        """
        return period_series(self, order)

    def lindstedt(self, order: int) -> LindstedtSolution:
        """The solution of Lindstedt and Poincare of a released pendulum, up to theta0^(2 order + 1), and its errors.

        Raises:
            ValueError: the pendulum is not released from rest, or ``order`` is not an integer from 0 to 100.
        """
        return lindstedt(self, order)

    def events(self, until: Any) -> Events:
        """The passages through the bottom and the turning points in (0, until].

        Raises:
            ValueError: ``until`` is negative or not finite, or the events before it are more than MAX_EVENTS.
        """
        return events(self, until)
