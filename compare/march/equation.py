"""A problem's equation bound to one arithmetic: the ``System`` that a method steps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from compare.march.autonomous import clock_of
from compare.methods.order.algebraic import Q
from reference.arithmetic.compiler import hy
from reference.arithmetic.dual import Dual, DualArithmetic
from reference.arithmetic.namespaces import BALL, NUMPY, Heyoka, Term
from reference.arithmetic.series import jet
from reference.problem import NO_TIME

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from fractions import Fraction

    from flint import arb

    from compare.march.precision import Precision
    from compare.methods.kinds.protocol import State
    from compare.methods.order.algebraic import Coefficient, Enclosed
    from reference.problem import Problem

__all__ = ["BoundSystem", "FormatArithmetic", "plain_system"]

TIME = "time at which the step begins"
"""A symbol that no compiled block has a value for: what depends on it cannot be traced."""


class FormatArithmetic:
    """NumPy arrays of one format: its constants are the format's, since wide arrays refuse Python's floats."""

    def __init__(self, fmt: Precision) -> None:
        self._fmt = fmt

    def __getattr__(self, name: str) -> Any:
        """The functions, which are those of NumPy."""
        return getattr(NUMPY, name)

    def number(self, value: Fraction) -> Any:
        return self._fmt.number(value)

    def pi(self) -> Any:
        return self._fmt.number(_Pi())

    def power(self, x: Any, exponent: Fraction) -> Any:
        return x ** self._fmt.number(exponent)


class _Pi:
    """pi, to be rounded to any format."""

    @staticmethod
    def ball() -> arb:
        return BALL.pi()


class BoundSystem:
    """A problem's equation in one arithmetic, its parameters numbers of that arithmetic.

    ``initial`` are the invariants at the start of the march; ``time`` is that at which a step begins, to be set by who
    knows it, where it does not stand in the state.  What was evaluated is counted in ``calls``.

    Raises:
        ValueError: the equation depends on the time, which stands outside of its state.
    """

    def __init__(
        self, problem: Problem, m: Any, parameters: dict[str, Any], fmt: Precision, initial: Sequence[Any]
    ) -> None:
        if not problem.autonomous:
            raise ValueError(f"{problem!r} depends on the time; compare.march.autonomous makes it a component.")
        self.dimension = len(problem.state_names)
        self.positions = problem.positions
        self.clock = clock_of(problem)
        self.time: Any = hy.expression(TIME) if isinstance(m, Heyoka) else 0.0
        self.equation = problem.structure
        self.calls = 0
        self.initial = tuple(initial)
        self._problem: Any = problem
        self._m = m
        self._duals = DualArithmetic(m, self.dimension)
        self._parameters = dict(zip(parameters, self._read(parameters.values()), strict=True))
        self._fmt = fmt
        self._numbers: dict[Coefficient | Enclosed, Any] = {}
        self.tiny = self.number(fmt.tiny)

    def number(self, value: Coefficient | Enclosed) -> Any:
        if value not in self._numbers:
            rounded = self._fmt.number(value)
            self._numbers[value] = hy.expression(rounded) if isinstance(self._m, Heyoka) else rounded
        return self._numbers[value]

    def _read(self, values: Iterable[Any]) -> Sequence[Any]:
        """Numbers as the equation reads them: symbols as terms."""
        return self._m.terms(values) if isinstance(self._m, Heyoka) else tuple(values)

    def derivative(self, y: State) -> State:
        self.calls += 1
        return _plain(self._problem.derivative(self._m, NO_TIME, self._read(y), self._parameters))

    def velocity(self, momenta: State) -> State:
        return _plain(self._problem.velocity(self._m, self._read(momenta), self._parameters))

    def force(self, positions: State) -> State:
        self.calls += 1
        return _plain(self._problem.force(self._m, NO_TIME, self._read(positions), self._parameters))

    def force_along(self, positions: State, direction: State) -> State:
        """By dual numbers: of symbols, the derivative in symbols, which is compiled with the step."""
        moving = [Dual(q, (slope,)) for q, slope in zip(self._read(positions), self._read(direction), strict=True)]
        found = self._problem.force(DualArithmetic(self._m, 1), NO_TIME, moving, self._parameters)
        return _plain(rate.slopes[0] if isinstance(rate, Dual) else self.number(Q(0)) for rate in found)

    def jet(self, y: State, order: int) -> list[State]:
        found = jet(
            self._m,
            lambda m, state: self._problem.derivative(m, NO_TIME, state, self._parameters),
            self._read(y),
            order,
        )
        return list(map(_plain, found))

    @property
    def initial_invariant(self) -> Any:
        """The first invariant at the start."""
        return self.initial[0]

    def invariant(self, y: State) -> Any:
        return self.invariants(y)[0]

    def invariants(self, y: State) -> tuple[Any, ...]:
        """Every invariant at a state."""
        declared = self._problem.invariants
        state = self._read(y)
        return _plain(getattr(self._problem, one.value)(self._m, state, self._parameters) for one in declared)

    def jacobian(self, y: State) -> tuple[State, ...]:
        return tuple(
            self._slopes(rate)
            for rate in self._problem.derivative(self._duals, NO_TIME, self._variables(y), self._parameters)
        )

    def gradient(self, y: State) -> State:
        return self.gradients(y)[0]

    def gradients(self, y: State) -> tuple[State, ...]:
        """The slopes of every invariant."""
        variables, declared = self._variables(y), self._problem.invariants
        found = (getattr(self._problem, one.value)(self._duals, variables, self._parameters) for one in declared)
        return tuple(map(self._slopes, found))

    def _variables(self, y: State) -> list[Dual]:
        return [self._duals.variable(value, place) for place, value in enumerate(self._read(y))]

    def _slopes(self, found: Any) -> State:
        """The slopes of a number by each component, the integer 0 for one that is always zero."""
        if not isinstance(found, Dual):
            return (0,) * self.dimension
        return tuple(0 if self._is_zero(slope) else slope for slope in _plain(found.slopes))

    def _is_zero(self, slope: Any) -> bool:
        if isinstance(slope, hy.expression):
            return slope in (hy.expression(0.0), hy.expression(self._fmt.number(Q(0))))
        return np.ndim(slope) == 0 and bool(slope == 0)


def _plain(values: Iterable[Any]) -> State:
    """What an equation makes of what it reads: expressions of terms, and other numbers as they are."""
    return tuple(value.expression if isinstance(value, Term) else value for value in values)


def plain_system(problem: Problem, fmt: Precision, parameters: np.ndarray) -> BoundSystem:
    """The equation over NumPy arrays of a format, one lane a column of the parameter rows: h, initial, parameters."""
    initial, values = parameters[1 : 1 + len(problem.invariants)], parameters[1 + len(problem.invariants) :]
    named = dict(zip(problem.parameters, values, strict=True))
    return BoundSystem(problem, FormatArithmetic(fmt), named, fmt, tuple(initial))
