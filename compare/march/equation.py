"""A problem's equation bound to one arithmetic: the ``System`` that a method steps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from compare.march.aspects import conserves
from compare.methods.order.algebraic import Q
from reference.arithmetic.compiler import hy
from reference.arithmetic.dual import Dual, DualArithmetic
from reference.arithmetic.namespaces import BALL, NUMPY, Heyoka
from reference.arithmetic.series import jet

if TYPE_CHECKING:
    from fractions import Fraction

    from flint import arb

    from compare.march.precision import Precision
    from compare.methods.kinds.protocol import State
    from compare.methods.order.algebraic import Coefficient, Enclosed
    from reference.problem import Problem

__all__ = ["BoundSystem", "FormatArithmetic", "plain_system"]


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

    ``level`` is the invariant at the start of the march; where a problem has none, the level stands for it.
    """

    def __init__(self, problem: Problem, m: Any, parameters: dict[str, Any], fmt: Precision, level: Any) -> None:
        self.dimension = len(problem.state_names)
        self.positions: int = getattr(problem, "positions", 0)
        self.level = level
        self._problem: Any = problem
        self._m = m
        self._duals = DualArithmetic(m, self.dimension)
        self._parameters = parameters
        self._fmt = fmt
        self._numbers: dict[Coefficient | Enclosed, Any] = {}
        self.tiny = self.number(fmt.tiny)

    def number(self, value: Coefficient | Enclosed) -> Any:
        if value not in self._numbers:
            rounded = self._fmt.number(value)
            self._numbers[value] = hy.expression(rounded) if isinstance(self._m, Heyoka) else rounded
        return self._numbers[value]

    def derivative(self, y: State) -> State:
        return tuple(self._problem.derivative(self._m, y, self._parameters))

    def velocity(self, momenta: State) -> State:
        return tuple(self._problem.velocity(self._m, momenta, self._parameters))

    def force(self, positions: State) -> State:
        return tuple(self._problem.force(self._m, positions, self._parameters))

    def jet(self, y: State, order: int) -> list[State]:
        return jet(self._m, lambda m, state: self._problem.derivative(m, state, self._parameters), y, order)

    def invariant(self, y: State) -> Any:
        return self.level if not conserves(self._problem) else self._problem.invariant(self._m, y, self._parameters)

    def jacobian(self, y: State) -> tuple[State, ...]:
        return tuple(
            self._slopes(rate) for rate in self._problem.derivative(self._duals, self._variables(y), self._parameters)
        )

    def gradient(self, y: State) -> State:
        return self._slopes(self._problem.invariant(self._duals, self._variables(y), self._parameters))

    def _variables(self, y: State) -> list[Dual]:
        return [self._duals.variable(value, place) for place, value in enumerate(y)]

    def _slopes(self, found: Any) -> State:
        """The slopes of a number by each component, the integer 0 for one that is always zero."""
        if not isinstance(found, Dual):
            return (0,) * self.dimension
        return tuple(0 if self._is_zero(slope) else slope for slope in found.slopes)

    def _is_zero(self, slope: Any) -> bool:
        if isinstance(slope, hy.expression):
            return slope in (hy.expression(0.0), hy.expression(self._fmt.number(Q(0))))
        return np.ndim(slope) == 0 and bool(slope == 0)


def plain_system(problem: Problem, fmt: Precision, parameters: np.ndarray) -> BoundSystem:
    """The equation over NumPy arrays of a format, one lane a column of the parameter rows."""
    values = dict(zip(problem.parameters, parameters[2:], strict=True))
    return BoundSystem(problem, FormatArithmetic(fmt), values, fmt, parameters[1])
