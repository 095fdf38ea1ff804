"""The report's figures: the pendulum from 1 rad, by what stands for NDSolve and by Euler's method, over the exact one.

Methods and step sizes are those of the columns of its tables; how the automatic steps were chosen is not told.
"""

from __future__ import annotations

from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from compare.sources.figures.drawing import Drawing, curve
from compare.sources.published.entry import reproduce
from compare.sources.published.pendulum import dense, expansion
from compare.sources.published.source import tables
from reference import LinearPendulum, Pendulum
from reference.arithmetic.namespaces import NUMPY
from reference.problems.pendulum.equations import energy

if TYPE_CHECKING:
    from compare.sources.published.source import Column, Table

__all__ = ["figure2", "figure3", "figure4", "figure5", "figure6", "figure7", "figure10", "figure11"]

LAST_TIME = Fraction(10)
"""The report's marches end after 10 s."""
TIMES = np.arange(801) / 80
SWING = Pendulum("1", "9.81", "1")
AMPLITUDES = np.linspace(0.001, 1.501, 76)
"""From the first row of table 9 to its last."""
TIME, ANGLE, VELOCITY = "time t [s]", "angle y [rad]", "angular velocity dy/dt [rad/s]"
EXACT = "exact"
AUTOMATIC = "The automatic method and its steps are not told; this one's energy errs as much."
NESTED = "Rings within one another are columns of table 9 that agree to less than a ring."
RINGS = (18.0, 15.0, 12.0, 9.5, 7.0, 5.0)
"""Sizes in points of the open markers of the columns, so that those which coincide are all seen."""
LISTED = "The step size is that which reproduces table 9."


def _table(name: str) -> Table:
    return next(table for table in tables() if table.name == name)


def _column(table: str, name: str) -> Column:
    return next(column for column in _table(table).columns if column.name == name)


def _march(table: str, name: str) -> tuple[str, np.ndarray, np.ndarray]:
    """What a column's method is and its steps; the times; and the states there."""
    column = _column(table, name)
    found = dense(SWING, column.method, column.step, LAST_TIME)
    label = f"{column.method}, h = {float(column.step):g} s"
    return label, found.h * np.arange(len(found.states)), np.array(found.states)


_automatic = partial(_march, "table8", "NDSolve")
_euler = partial(_march, "table9", "Euler")


def _energies(states: np.ndarray) -> Any:
    """E of each state in J, of 1 kg and 1 m."""
    return energy(NUMPY, states[:, 0], states[:, 1], float(SWING.g), float(SWING.length))


def _against_time(item: str, title: str, march: tuple[str, np.ndarray, np.ndarray], note: str) -> Drawing:
    label, times, states = march
    exact = curve(EXACT, TIMES, SWING.state(TIMES)[:, 0], behind=True)
    return Drawing(item, title, TIME, ANGLE, (exact, curve(label, times, states[:, 0])), note=note)


def _portrait(item: str, title: str, march: tuple[str, np.ndarray, np.ndarray], note: str) -> Drawing:
    label, _, states = march
    orbit = SWING.state(TIMES)
    exact = curve(EXACT, orbit[:, 0], orbit[:, 1], behind=True)
    return Drawing(item, title, ANGLE, VELOCITY, (exact, curve(label, states[:, 0], states[:, 1])), note=note)


def figure2() -> Drawing:
    """The angle over 10 s: periodic."""
    return _against_time("report figure 2", "angle against time", _automatic(), AUTOMATIC)


def figure3() -> Drawing:
    """The orbit in the phase plane: closed."""
    return _portrait("report figure 3", "phase portrait", _automatic(), AUTOMATIC)


def figure4() -> Drawing:
    """The energy's change over 10 s, that of the start being -g cos 1 J: about 1e-7 J."""
    label, times, states = _automatic()
    exact = curve(EXACT, [0.0, float(LAST_TIME)], [0.0, 0.0], behind=True)
    change = curve(label, times, _energies(states) - float(SWING.energy()))
    return Drawing(
        "report figure 4",
        "conservation of energy, equation (3.4)",
        TIME,
        "change of energy E − E₀ [J]",
        (exact, change),
        note=AUTOMATIC,
    )


def figure5() -> Drawing:
    """The angle by Euler's method: it gains energy, and swings over the top."""
    return _against_time("report figure 5", "angle against time by Euler's method", _euler(), LISTED)


def figure6() -> Drawing:
    """The orbit of Euler's method: it spirals outwards."""
    return _portrait("report figure 6", "phase portrait of Euler's method", _euler(), LISTED)


def figure7() -> Drawing:
    """The energy by Euler's method: it grows."""
    label, times, states = _euler()
    exact = curve(EXACT, [0.0, float(LAST_TIME)], [float(SWING.energy())] * 2, behind=True)
    grown = curve(label, times, _energies(states))
    return Drawing("report figure 7", "energy by Euler's method", TIME, "energy E [J]", (exact, grown), note=LISTED)


def figure10() -> Drawing:
    """The period against the amplitude: the columns of table 9, over the exact one."""
    table, g, length = _table("table9"), str(SWING.g), str(SWING.length)
    periods = [float(Pendulum(amplitude, g, length).period()) for amplitude in AMPLITUDES]
    (found,) = reproduce([table.name])
    amplitudes = [float(row) for row in table.rows]
    shown = [
        curve(column.name, amplitudes, _reproduced(found.entries, column.name), points=True, ring=ring)
        for column, ring in zip(table.columns, RINGS, strict=True)
    ]
    exact = curve(EXACT, AMPLITUDES, periods, behind=True)
    return Drawing(
        "report figure 10",
        "period against amplitude",
        "amplitude y₀ [rad]",
        "period T [s]",
        (exact, *shown),
        note=NESTED,
    )


def _reproduced(entries: Any, column: str) -> list[float]:
    return [float(entry.reproduced) for entry in entries if entry.column == column]


def figure11() -> Drawing:
    """The angle by the linear equation and by the approximation (4.14), over the exact one."""
    parameters = [float(value) for value in SWING.parameters.values()]
    by_series = expansion(NUMPY, TIMES, float(SWING.start[0]), *parameters)
    linear = LinearPendulum("1", *SWING.parameters.values()).state(TIMES)[:, 0]
    curves = (
        curve(EXACT, TIMES, SWING.state(TIMES)[:, 0], behind=True),
        curve("linear equation", TIMES, linear),
        curve("approximation (4.14)", TIMES, by_series),
    )
    return Drawing("report figure 11", "angle by three kinds of solution", TIME, ANGLE, curves)
