"""The Taylor route: heyoka's adaptive Taylor method in MPFR arithmetic, on the equation of motion alone.

A problem declares in ``by_flow`` how each of its rows is read of a flow: along it, at its events, or when a function of
the state reaches a value.  The flow is that of the problem's own equation, or of another one that it declares, where
the motion is regular in another variable or its start is.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from reference.arithmetic import quadrature as mpmath_quadrature
from reference.arithmetic.dual import Dual, DualArithmetic
from reference.arithmetic.namespaces import MPMATH
from reference.once import cached_property
from reference.routes import quadrature
from reference.routes.flow import Flow, within_steps

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.declaration import Equation
    from reference.routes.flow import Event

    Of = Callable[["TaylorRoute"], Equation]
    Number = Any
    Reading = Callable[["TaylorRoute", str, Sequence[Any]], Sequence[Any]]
    """The values of a row at its arguments, each a tuple or one number, of Fractions or of mpmath's numbers."""

__all__ = ["Along", "Crossings", "Passages", "Period", "Reached", "TaylorRoute", "reaches", "taylor_route"]

GUARD_BITS = 16
AFTER = 1e-9
"""Part of a proven time for which an event is still looked for."""


class TaylorRoute:
    """Each row of a problem as it declares it to be read of a flow, in numbers of ``bits`` bits."""

    m = MPMATH

    def __init__(self, problem: Any, bits: int) -> None:
        self.problem, self.bits = problem, bits
        self._once: dict[str, list[tuple[Fraction, ...]]] = {}

    def rows(self, row: str, arguments: Sequence[Any]) -> list[tuple[Fraction, ...]]:
        """The values of a row.

        Raises:
            ValueError: the problem does not declare how the row is read of a flow.
        """
        if row not in self._once:
            reading = self.problem.by_flow.get(row)
            if reading is None:
                raise ValueError(
                    f"{row} of {self.problem!r} is not declared for the Taylor route; "
                    "a reading in by_flow or a reason in the row's lacks is accepted."
                )
            found = [_values(values) for values in reading(self, row, arguments)]
            if list(arguments) != [None]:
                return found
            self._once[row] = found
        return self._once[row]

    def value(self, row: str) -> Number:
        """The number of a row that takes no argument."""
        ((value,),) = self.rows(row, [None])
        return self.m.number(value)

    @cached_property
    def quadrature(self) -> Any:
        """The solution by the quadrature route, of which what an argument or an end is can be asked."""
        return self.problem.quadrature_form()

    @cached_property
    def parameters(self) -> dict[str, Number]:
        """The problem's parameters."""
        return {name: self.m.number(value) for name, value in self.problem.parameters.items()}

    def flow(self, of: Of | None = None) -> Flow:
        """The flow of the problem's equation, or of another."""
        return Flow(self.problem if of is None else of(self), self.bits)

    def states(
        self, times: Sequence[Any], of: Of | None = None, by: tuple[str, ...] = (), order: int = 1
    ) -> list[tuple[Fraction, ...]]:
        """``Flow.at``, kept for a while: more than one row is read of the same states."""
        return _states(self, tuple(_fraction(time) for time in times), of, by, order)

    def guesses(self, row: str, arguments: Sequence[Any]) -> list[Fraction]:
        """The first quantity of a row by quadrature, to half of the bits."""
        found = quadrature.rows(self.problem.quadrature_form, row, arguments, self.bits // 2 + GUARD_BITS)
        return [values[0] for values in found]

    def corrected(
        self, passed: Callable[..., Any], values: Sequence[Number], guesses: Sequence[Any], of: Of | None = None
    ) -> list[Number]:
        """When passed(m, y, problem) is each of the values, by Newton's step from guesses good to half of the bits."""
        equation = self.problem if of is None else of(self)
        p = {name: self.m.number(value) for name, value in equation.parameters.items()}
        duals, found = DualArithmetic(self.m, 1), list[Any]()
        for value, guess, state in zip(values, guesses, self.states(guesses, of), strict=True):
            t, y = self.m.number(_fraction(guess)), [self.m.number(component) for component in state]
            rates = equation.derivative(self.m, t, y, p)
            moving = [Dual(x, (rate,)) for x, rate in zip(y, rates, strict=True)]
            reached = passed(duals, moving, self.problem)
            found.append(t + (value - reached.value) / reached.slopes[0])
        return found


@lru_cache(maxsize=8)
def taylor_route(problem: Any, bits: int) -> TaylorRoute:
    """The route of a problem, kept for a while: what its rows share is then computed once."""
    return TaylorRoute(problem, bits)


@lru_cache(maxsize=8)
def _states(
    route: TaylorRoute, times: tuple[Fraction, ...], of: Of | None, by: tuple[str, ...], order: int
) -> list[tuple[Fraction, ...]]:
    return route.flow(of).at(times, by, order)


def _fraction(value: Any) -> Fraction:
    """A Fraction, or one of mpmath's numbers as the rational that it is."""
    return value if isinstance(value, Fraction) else mpmath_quadrature.to_fraction(value)


def _values(found: Any) -> tuple[Fraction, ...]:
    return tuple(_fraction(value) for value in (found if isinstance(found, (tuple, list)) else (found,)))


@dataclass(frozen=True)
class Along:
    """A row that is read of the state, at(route, argument) being where on the flow.

    Attributes:
        read: (route, state) -> values, the derivatives after the state; without it the state, or of its derivatives
            ``by`` starts and parameters those of the last order.
        at: where on the flow an argument is; without it at the argument.
        of: of which equation the flow is; without it of the problem's.
        by: starts and parameters by which derivatives are taken, up to ``order``.
    """

    read: Callable[[TaylorRoute, Sequence[Number]], Any] | None = None
    at: Callable[[TaylorRoute, Any], Any] | None = None
    of: Of | None = None
    by: tuple[str, ...] = ()
    order: int = 1

    def __call__(self, route: TaylorRoute, row: str, arguments: Sequence[Any]) -> Sequence[Any]:
        del row
        times = arguments if self.at is None else [self.at(route, argument) for argument in arguments]
        states = route.states(times, self.of, self.by, self.order)
        if self.read is not None:
            return [self.read(route, [route.m.number(value) for value in state]) for state in states]
        known = math.comb(len(self.by) + self.order - 1, len(self.by)) if self.by else 0
        return [state[known * len(route.problem.start) :] for state in states]


@dataclass(frozen=True)
class Crossings:
    """A row over an index: the times at which event(m, y) crosses zero, ``per_period`` times in each period.

    That is a number, or a function of the problem where its kind of motion decides.
    """

    event: Event
    per_period: int | Callable[[Any], int]

    def __call__(self, route: TaylorRoute, row: str, arguments: Sequence[int]) -> Sequence[Any]:
        del row
        until = route.problem.cycle() * (max(arguments) + 1.01) / self.count(route.problem)
        times = route.flow().zeros(self.event, until)
        return [times[index] for index in arguments]

    def count(self, problem: Any) -> int:
        """How many crossings there are in a period."""
        return self.per_period if isinstance(self.per_period, int) else self.per_period(problem)


@dataclass(frozen=True)
class Period(Crossings):
    """The period, from one crossing to the next."""

    def __call__(self, route: TaylorRoute, row: str, arguments: Sequence[Any]) -> Sequence[Any]:
        del arguments
        first, second = super().__call__(route, row, (0, 1))
        return [(second - first) * self.count(route.problem)]


@dataclass(frozen=True)
class Passages:
    """A row over an index: the times at which the problem's ``event`` crosses zero, sought to just after its proof."""

    def __call__(self, route: TaylorRoute, row: str, arguments: Sequence[int]) -> Sequence[Any]:
        until = float(self.last(route.problem, row, arguments))
        times = route.flow().zeros(route.problem.event, until * (1 + AFTER))
        if max(arguments) >= len(times):
            raise ArithmeticError(f"heyoka finds {len(times)} of {row} of {route.problem!r} up to t = {until:.10g}.")
        return [times[index] for index in arguments]

    @staticmethod
    def last(problem: Any, row: str, arguments: Sequence[int]) -> Fraction:
        """The time of the last of them."""
        return Fraction(float(problem.certified(row, max(arguments))))


@dataclass(frozen=True)
class Reached:
    """A row of when passed(m, y, problem) is the argument, or ``to`` where there is none.

    The guess is the row's own first quantity by quadrature.  ``read`` (route, time, state) gives the row's values;
    without it it is that time alone.  A start that is at the argument is there at once.
    """

    passed: Callable[[Any, Sequence[Any], Any], Any]
    to: Fraction = Fraction(0)
    of: Of | None = None
    read: Callable[[TaylorRoute, Number, Sequence[Number]], Any] | None = None

    def __call__(self, route: TaylorRoute, row: str, arguments: Sequence[Any]) -> Sequence[Any]:
        m, problem, later = route.m, route.problem, list(arguments)
        if list(arguments) != [None]:
            start = self.passed(m, [m.number(value) for value in problem.start], problem)
            later = [argument for argument in arguments if m.number(argument) != start]
        values = [m.number(self.to if argument is None else argument) for argument in later]
        moments = route.corrected(self.passed, values, route.guesses(row, later), self.of)
        known = dict(zip(later, moments, strict=True))
        times = [known.get(argument, m.number(Fraction(0))) for argument in arguments]
        if self.read is None:
            return times
        states = ([m.number(value) for value in state] for state in route.states(times, self.of))
        return [self.read(route, time, state) for time, state in zip(times, states, strict=True)]


def reaches(problem: Any, row: str, arguments: Sequence[Any]) -> bool:
    """Whether the problem's own flow is at all arguments of a row, none negative, after at most STEPS steps.

    Of a row that is read of another equation, or elsewhere, the problem itself knows.
    """
    reading = problem.by_flow.get(row)
    if isinstance(reading, Crossings):
        last = -1 if isinstance(reading, Period) else max(arguments)
        time = Fraction(problem.cycle() * (last + 2))
    elif isinstance(reading, Passages):
        time = reading.last(problem, row, arguments)
    elif isinstance(reading, Along) and reading.at is None and reading.of is None:
        if min(arguments) < 0:
            return False
        time = max(arguments)
    else:
        return True
    return within_steps(problem, time)
