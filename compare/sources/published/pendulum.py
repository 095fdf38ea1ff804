"""What the report's tables print: energies, periods and angles of the pendulum, by methods and by formulas."""

from __future__ import annotations

from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING, Any

from compare.sources.published.dense import Dense, dense
from compare.sources.published.number import Enclosed, Exact, double
from reference import LinearPendulum, Pendulum
from reference.arithmetic.namespaces import BALL, NUMPY
from reference.problems.pendulum.equations import energy

if TYPE_CHECKING:
    from collections.abc import Callable

    from compare.sources.published.number import Number
    from compare.sources.published.source import Column, Table
    from reference.arithmetic.protocols import ElementaryArithmetic

__all__ = ["EXACT", "REPRODUCED", "expansion"]

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
