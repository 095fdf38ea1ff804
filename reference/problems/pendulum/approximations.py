"""A released pendulum's expansions in powers of its amplitude: exact coefficients, proven values and proven errors."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any, ClassVar

from reference.arithmetic.exact import as_number, exact
from reference.arithmetic.namespaces import MPMATH
from reference.declaration import ClosedForm, Row
from reference.once import cached_property
from reference.problem import Problem
from reference.problems.pendulum import contour, series
from reference.problems.pendulum.quantities import LINDSTEDT_ROWS, SERIES_ROWS
from reference.problems.pendulum.simple import SimplePendulum
from reference.routes.taylor import taylor_route

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from reference.arithmetic.protocols import EllipticArithmetic
    from reference.certified import Certified
    from reference.routes.taylor import Reading, TaylorRoute

__all__ = ["LindstedtMotion", "LindstedtSolution", "PendulumSeries", "PeriodSeries", "lindstedt", "period_series"]


@dataclass(frozen=True, repr=False)
class Expansion(Problem):
    """A released pendulum, of which the expansions in powers of its amplitude are asked."""

    theta0: Fraction
    g: Fraction
    length: Fraction

    def __init__(self, theta0: Any, g: Any = 9.81, length: Any = 1.0) -> None:
        for name, value in (("theta0", theta0), ("g", g), ("length", length)):
            object.__setattr__(self, name, exact(value, name))
        _ = self.pendulum

    @cached_property
    def pendulum(self) -> SimplePendulum:
        """The pendulum itself."""
        return SimplePendulum(self.theta0, self.g, self.length)

    def _spelled(self) -> str:
        return ", ".join(f"{name}={as_number(getattr(self, name))!r}" for name in ("theta0", "g", "length"))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self._spelled()})"

    def closed_form(self, m: EllipticArithmetic) -> Expanded:
        """The exact coefficients against the closed form."""
        return self.expanded(m, self.pendulum.closed_form(m), series)

    def quadrature_form(self) -> Expanded:
        """Coefficients from Cauchy's integrals against mpmath's elliptic functions and integrals."""
        return self.expanded(MPMATH, self.pendulum.quadrature_form(), contour)

    def within_taylor(self, row: str, arguments: Sequence[Any]) -> bool:
        """Whether the pendulum's own state is within."""
        del row
        return self.pendulum.within_taylor("state", arguments)

    def expanded(self, m: Any, motion: Any, source: Any) -> Expanded:
        """The rows in an arithmetic: of which motion, and where the coefficients come from."""
        raise NotImplementedError

    def _lost(self, power: int) -> int:
        """Bits lost to a difference of about (theta0/4)^power."""
        ratio = 4 / self.theta0
        return power * max(0, ratio.numerator.bit_length() - ratio.denominator.bit_length()) + 8


class Expanded(ClosedForm):
    """Expansions of a ``motion``, whose values are of the arithmetic ``m``, with the coefficients of a ``source``."""

    def __init__(self, m: Any, motion: Any, source: Any, amplitude: Fraction, order: int = 0) -> None:
        self.m, self._motion, self._source, self._amplitude, self._order = m, motion, source, amplitude, order

    def _angle(self, order: int, t: Any) -> Any:
        solution = self._source.lindstedt(order)
        square = self._amplitude**2
        if sum(c * square**j for j, c in enumerate(solution.frequency_squared)) <= 0:
            raise ValueError(
                f"order is {order}; at theta0 = {as_number(self._amplitude)} the frequency's expansion to this order "
                "is not positive, and there is no such motion."
            )
        return solution.angle(self.m, self._motion.theta0, self._motion.g, self._motion.length, t)

    def period_series(self, order: int) -> Any:
        """T_n in s."""
        ratio = series.polynomial(self.m, self._source.period_series(order), self._motion.theta0**2)
        return 2 * self.m.pi() / self._motion.w * ratio

    def period_series_error(self, order: int) -> Any:
        """T_n/T - 1."""
        return self.period_series(order) / self._motion.period - 1

    def lindstedt_error(self, order: int) -> Any:
        """theta_n(T) - theta0."""
        return self._angle(order, self._motion.period) - self._motion.theta0

    def lindstedt_crossing_error(self, order: int) -> Any:
        """theta_n(T/4), where theta is zero."""
        return self._angle(order, self._motion.period / 4)

    def lindstedt_angle(self, t: Any) -> Any:
        """theta_n(t)."""
        return self._angle(self._order, t)

    def lindstedt_angle_error(self, t: Any) -> Any:
        """theta_n(t) - theta(t)."""
        return self._angle(self._order, t) - self._motion.state(t)[0]


class Integrated:
    """The motion by the flow of the pendulum's equation: its period, and its state at the times that are asked for."""

    def __init__(self, route: TaylorRoute, times: Sequence[Fraction] = ()) -> None:
        pendulum, m = route.problem.pendulum, route.m
        self._route = taylor_route(pendulum, route.bits)
        self.theta0, self.g, self.length = (m.number(value) for value in (pendulum.theta0, pendulum.g, pendulum.length))
        self.w = m.sqrt(self.g / self.length)
        self._states = {m.number(t): state for t, state in zip(times, self._route.rows("state", times), strict=True)}

    @cached_property
    def period(self) -> Any:
        return self._route.value("period")

    def state(self, t: Any) -> list[Any]:
        return [self._route.m.number(value) for value in self._states[t]]


def by_period(route: TaylorRoute, row: str, orders: Sequence[int]) -> list[tuple[Any, ...]]:
    """The exact coefficients against the flow's period."""
    return route.problem.expanded(route.m, Integrated(route), series).rows(row, orders)  # type: ignore[no-any-return]


def by_state(route: TaylorRoute, row: str, times: Sequence[Fraction]) -> list[tuple[Any, ...]]:
    """The same against the flow's states."""
    return route.problem.expanded(route.m, Integrated(route, times), series).rows(row, times)  # type: ignore[no-any-return]


class PendulumSeries(Expansion):
    """The expansions of a pendulum released from rest at theta0, order by order, and their errors.

    Args:
        theta0: amplitude in rad, 0 < theta0 < pi.
        g: acceleration of gravity in m/s^2, positive.
        length: length in m, positive.

    Raises:
        ValueError: a parameter is outside its range or not finite.
        TypeError: a parameter is no real number.
    """

    name: ClassVar[str] = "pendulum series"
    rows: ClassVar[tuple[Row, ...]] = SERIES_ROWS
    by_flow: ClassVar[Mapping[str, Reading]] = dict.fromkeys(
        ("period_series_error", "lindstedt_error", "lindstedt_crossing_error"), by_period
    )

    def expanded(self, m: Any, motion: Any, source: Any) -> Expanded:
        return Expanded(m, motion, source, self.theta0)

    def exact_row(self, row: str, argument: Any) -> None:
        """No value is known to be rational."""

    def working_bits(self, arguments: Sequence[Any]) -> int:
        return self._lost(4 * max(arguments, default=0) + 5)


@dataclass(frozen=True, repr=False)
class LindstedtMotion(Expansion):
    """The solution of Lindstedt and Poincare to one order, at any time, and its error.

    Args:
        theta0: amplitude in rad, 0 < theta0 < pi.
        g: acceleration of gravity in m/s^2, positive.
        length: length in m, positive.
        order: powers up to theta0^(2 order + 1) are kept.

    Raises:
        ValueError: a parameter is outside its range or not finite.
        TypeError: a parameter is no real number.
    """

    order: int

    name: ClassVar[str] = "Lindstedt-Poincare solution"
    rows: ClassVar[tuple[Row, ...]] = LINDSTEDT_ROWS
    by_flow: ClassVar[Mapping[str, Reading]] = {"lindstedt_angle_error": by_state}

    def __init__(self, theta0: Any, g: Any = 9.81, length: Any = 1.0, order: int = 1) -> None:
        super().__init__(theta0, g, length)
        object.__setattr__(self, "order", series.checked(order))

    def __repr__(self) -> str:
        return f"LindstedtMotion({self._spelled()}, order={self.order})"

    def expanded(self, m: Any, motion: Any, source: Any) -> Expanded:
        return Expanded(m, motion, source, self.theta0, self.order)

    def exact_row(self, row: str, argument: Any) -> tuple[Fraction] | None:
        """The start; at any other time a sum of cosines of algebraic numbers, which is transcendental (Lindemann)."""
        if argument != 0:
            return None
        return (self.theta0,) if row == "lindstedt_angle" else (Fraction(0),)

    def working_bits(self, arguments: Sequence[Any]) -> int:
        return self.pendulum.working_bits(arguments) + self._lost(2 * self.order + 3)


def period_series(pendulum: SimplePendulum, order: int) -> PeriodSeries:
    """The series of the period up to theta0^(2 order).

    Raises:
        ValueError: the pendulum is not released from rest at 0 < theta0 < pi, or the order is not served.
    """
    return PeriodSeries(_released(pendulum), order, series.period_series(order))


def lindstedt(pendulum: SimplePendulum, order: int) -> LindstedtSolution:
    """The solution of Lindstedt and Poincare up to theta0^(2 order + 1).

    Raises:
        ValueError: the pendulum is not released from rest at 0 < theta0 < pi, or the order is not served.
    """
    found = series.lindstedt(order)
    return LindstedtSolution(_released(pendulum), order, found.frequency_squared, found.harmonics)


def _released(pendulum: SimplePendulum) -> SimplePendulum:
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

    pendulum: SimplePendulum
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

    pendulum: SimplePendulum
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
