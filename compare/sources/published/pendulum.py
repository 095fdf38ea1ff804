"""What the report's tables print: energies, periods and angles of the pendulum, by methods and by formulas.

A march of a pendulum with cubic Hermite interpolation between its steps, as the sources read theirs.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache, partial
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from compare.march.lanes import Lane
from compare.march.march import march
from compare.march.precision import precision
from compare.methods import find
from compare.sources.published.number import Enclosed, Exact, double
from reference import LinearPendulum, Pendulum
from reference.arithmetic.namespaces import BALL, NUMPY
from reference.problems.pendulum.equations import energy

if TYPE_CHECKING:
    from collections.abc import Callable

    from compare.sources.published.number import Number
    from compare.sources.published.source import Column, Table
    from reference.arithmetic.protocols import ElementaryArithmetic

__all__ = ["EXACT", "REPRODUCED", "dense", "expansion"]

State = tuple[float, float]
BISECTIONS = 60
"""A step halved so often is no wider than a rounding."""


@dataclass(frozen=True)
class Dense:
    """States (angle, velocity) at the times 0, h, 2 h, ..., with their rates."""

    h: float
    states: tuple[State, ...]
    rates: tuple[State, ...]

    def at(self, t: float) -> State:
        """The state at a time, each component by the cubic through its values and rates at both ends of the step."""
        step = min(int(t / self.h), len(self.states) - 2)
        theta, omega = (self._between(component, step, t / self.h - step) for component in (0, 1))
        return theta, omega

    def first_passage(self) -> float:
        """The first time at which the angle falls through zero.

        Raises:
            ValueError: it does not.
        """
        for step, (before, after) in enumerate(pairwise(self.states)):
            if before[0] > 0 >= after[0]:
                low, high = 0.0, 1.0
                for _ in range(BISECTIONS):
                    middle = (low + high) / 2
                    low, high = (middle, high) if self._between(0, step, middle) > 0 else (low, middle)
                return (step + high) * self.h
        raise ValueError(f"the angle does not pass zero in {len(self.states) - 1} steps; a longer march is accepted.")

    def _between(self, component: int, step: int, part: float) -> float:
        """Hermite's cubic at a part of a step."""
        y0, y1 = (state[component] for state in self.states[step : step + 2])
        d0, d1 = (rate[component] for rate in self.rates[step : step + 2])
        rest = 1 - part
        return (
            rest * rest * ((1 + 2 * part) * y0 + part * self.h * d0)
            + part * part * ((1 + 2 * rest) * y1 - rest * self.h * d1)
        )  # fmt: skip


@lru_cache(maxsize=32)
def dense(problem: Pendulum, method: str, step: Fraction, end: Fraction) -> Dense:
    """March a pendulum in doubles, in steps of one size, to ``end`` or beyond it by less than a step."""
    fmt = precision("float64")
    h, n = fmt.round(step), -(-end // step)
    (found,) = march(find(method), [Lane(problem, n, h, tuple(range(1, n + 1)))], fmt)
    start = tuple(float(value) for value in problem.start)
    states = [start, *map(tuple, found.states.tolist())]
    parameters: dict[str, Any] = problem.parameters_in(NUMPY)
    rates = (tuple(map(float, problem.derivative(NUMPY, 0, state, parameters))) for state in states)
    return Dense(float(h), tuple(states), tuple(rates))  # type: ignore[arg-type]


LAST_TIME = Fraction(10)
"""The report's marches end after 10 s."""
PASSAGE_WITHIN = Fraction(1)
"""Every pendulum of table 9 first passes the bottom within so many seconds, by any method."""
ROUTE_DIGITS = 30


def expansion(m: ElementaryArithmetic, t: Any, theta0: Any, g: Any, length: Any) -> Any:
    """The angle by the report's equation (4.14), as printed there, with its frequency of section 4.

    omega = omega0/sqrt(1 + a^2/8 + 5 a^4/512); the coefficients of a^5 are (61, -60, -1)/184320.
    """
    second, fourth = theta0**2, theta0**4
    turned = m.sqrt(g / length) / m.sqrt(1 + second / 8 + 5 * fourth / 512) * t
    first, third, fifth = (m.cos(n * turned) for n in (1, 3, 5))
    return theta0 * (first + second / 192 * (third - first) + fourth / 184320 * (61 * first - 60 * third - fifth))


def _pendulum(table: Table, row: str) -> Pendulum:
    """The pendulum of a row, which gives the amplitude where the table has none."""
    return Pendulum(**{"theta0": row, **table.parameters})


def _linear(table: Table, row: str) -> LinearPendulum:
    return LinearPendulum(**{"theta0": row, **table.parameters})


def _march(table: Table, column: Column, row: str, end: Fraction) -> Dense:
    return dense(_pendulum(table, row), column.method, column.step, end)


def _energy(table: Table, column: Column, row: str) -> Number:
    """E of the interpolated state."""
    pendulum = _pendulum(table, row)
    theta, omega = _march(table, column, row, LAST_TIME).at(float(row))
    return double(float(energy(NUMPY, theta, omega, float(pendulum.g), float(pendulum.length))))


def _period(table: Table, column: Column, row: str) -> Number:
    """Four times the first passage through the bottom."""
    return double(4 * _march(table, column, row, PASSAGE_WITHIN).first_passage())


def _integral(table: Table, _column: Column, row: str) -> Number:
    """The period by quadrature of the elliptic integral."""
    found = _pendulum(table, row).by_route("quadrature", "period", [None], ROUTE_DIGITS)
    if found is None:
        raise ArithmeticError(f"the period at {table.row_name} = {row} has no quadrature.")
    return Exact(found[0][0])


def _angle(table: Table, column: Column, row: str) -> Number:
    """The interpolated angle."""
    return double(_march(table, column, row, LAST_TIME).at(float(row))[0])


def _expansion(table: Table, _column: Column, row: str) -> Number:
    numbers = [Fraction(text) for text in (row, *(table.parameters[name] for name in ("theta0", "g", "length")))]
    return Enclosed(lambda: expansion(BALL, *map(BALL.number, numbers)), f"equation (4.14) at t = {row}")


REPRODUCED: dict[str, dict[str, Callable[[Table, Column, str], Number]]] = {
    "table8": {"energy": _energy},
    "table9": {
        "march": _period,
        "series": lambda table, _, row: _pendulum(table, row).period_series(2).period,
        "integral": _integral,
        "linear": lambda table, _, row: _linear(table, row).period(),
    },
    "table12": {
        "linear": lambda table, _, row: _linear(table, row).certified("state", Fraction(row)),
        "expansion": _expansion,
        "march": _angle,
    },
}
"""What computes the entries, by the table and by what its columns are computed by."""


def _exact(row_name: str, table: Table, _column: Column, row: str) -> Number:
    pendulum = _pendulum(table, row)
    return pendulum.certified(row_name, Fraction(row) if pendulum.row(row_name).over == "time" else None)


EXACT = {"table8": partial(_exact, "energy"), "table9": partial(_exact, "period"), "table12": partial(_exact, "state")}
"""What the pendulum itself does."""
