"""What a pendulum says of its expansions in the amplitude: exact coefficients, proven values and proven errors."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from reference.arithmetic.exact import exact
from reference.problems.pendulum import series
from reference.problems.pendulum.expansion import LindstedtMotion, PendulumSeries

if TYPE_CHECKING:
    from fractions import Fraction

    from reference.certified import Certified
    from reference.problems.pendulum.problem import Pendulum

__all__ = ["LindstedtSolution", "PeriodSeries", "lindstedt", "period_series"]


def period_series(pendulum: Pendulum, order: int) -> PeriodSeries:
    """The series of the period up to theta0^(2 order).

    Raises:
        ValueError: the pendulum is not released from rest at 0 < theta0 < pi, or the order is not served.
    """
    return PeriodSeries(_released(pendulum), order, series.period_series(order))


def lindstedt(pendulum: Pendulum, order: int) -> LindstedtSolution:
    """The solution of Lindstedt and Poincare up to theta0^(2 order + 1).

    Raises:
        ValueError: the pendulum is not released from rest at 0 < theta0 < pi, or the order is not served.
    """
    found = series.lindstedt(order)
    return LindstedtSolution(_released(pendulum), order, found.frequency_squared, found.harmonics)


def _released(pendulum: Pendulum) -> Pendulum:
    if pendulum.kind != "release" or pendulum.theta0 < 0 or pendulum.turns:
        raise ValueError(
            f"{pendulum!r} is not released from rest at 0 < theta0 < pi; one that is has expansions in its amplitude."
        )
    return pendulum


@dataclass(frozen=True)
class PeriodSeries:
    """The period's series in the amplitude a, up to a^(2 order).

    Attributes:
        pendulum: of which pendulum.
        order: the number of terms after the first.
        coefficients: of a^0, a^2, ... in T/T0, T0 = 2 pi sqrt(l/g), exact.
    """

    pendulum: Pendulum
    order: int
    coefficients: tuple[Fraction, ...]

    @property
    def period(self) -> Certified:
        """The series' period in s."""
        return self._problem.certified("period_series", self.order)

    @property
    def error(self) -> Certified:
        """Its relative error."""
        return self._problem.certified("period_series_error", self.order)

    @property
    def _problem(self) -> PendulumSeries:
        return PendulumSeries(self.pendulum.theta0, self.pendulum.g, self.pendulum.length)


@dataclass(frozen=True)
class LindstedtSolution:
    """The solution of Lindstedt and Poincare, theta up to a^(2 order + 1), its frequency up to a^(2 order).

    Attributes:
        pendulum: of which pendulum.
        order: the number of corrections.
        frequency_squared: the coefficients of a^0, a^2, ... in w^2 l/g, exact.
        harmonics: for a^1, a^3, ... the coefficients by m of cos(m w t), exact.
    """

    pendulum: Pendulum
    order: int
    frequency_squared: tuple[Fraction, ...]
    harmonics: tuple[series.Harmonics, ...]

    def angle(self, t: Any) -> Certified:
        """The angle at the exact time t (s), in rad."""
        return self._motion.certified("lindstedt_angle", exact(t, "t"))

    def error(self, t: Any) -> Certified:
        """Its error at the exact time t (s), in rad."""
        return self._motion.certified("lindstedt_angle_error", exact(t, "t"))

    @property
    def error_after_a_period(self) -> Certified:
        """Its error when the pendulum is back at its start, in rad."""
        return self._series.certified("lindstedt_error", self.order)

    @property
    def error_at_the_crossing(self) -> Certified:
        """Its error when the pendulum first hangs at the bottom, in rad."""
        return self._series.certified("lindstedt_crossing_error", self.order)

    @property
    def _motion(self) -> LindstedtMotion:
        return LindstedtMotion(self.pendulum.theta0, self.pendulum.g, self.pendulum.length, self.order)

    @property
    def _series(self) -> PendulumSeries:
        return PendulumSeries(self.pendulum.theta0, self.pendulum.g, self.pendulum.length)
