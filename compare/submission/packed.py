"""States in one array beside the times, of shape [rows, state] or [state, rows], as SciPy's solvers give them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from reference.names import SHOWN, short

if TYPE_CHECKING:
    from collections.abc import Mapping

    from compare.submission.columns import Columns

__all__ = ["packed", "rows_first"]

USUAL = "y"
"""What the array of the states is called by those who integrate; one of another name is taken if it is the only one."""


def packed(columns: Columns, shapes: Mapping[str, tuple[int, ...]]) -> tuple[str, str] | None:
    """The names of the array of times and of the array of states; None where the columns are arrays of their own.

    ``shapes`` has the shapes of the arrays by their names.

    Raises:
        ValueError: there are several arrays that may be the states.
    """
    time, *state = columns.wanted
    if columns.asked is not None or time not in shapes or any(name in shapes for name in state):
        return None
    tables = [name for name, shape in shapes.items() if len(shape) == 2 and len(state) in shape]
    if USUAL in shapes:
        return time, USUAL
    if len(tables) > 1:
        raise ValueError(
            f"there are {len(tables)} arrays that may hold {', '.join(state)}: "
            f"{', '.join(map(short, tables[:SHOWN]))}; one called {USUAL} is accepted, or one for each "
            "of the state's numbers."
        )
    return (time, tables[0]) if tables else None


def rows_first(columns: Columns, name: str, shape: tuple[int, ...], times: tuple[int, ...]) -> bool:
    """Whether the array of states is of shape [rows, state], else it is [state, rows]; ``times`` is the times' shape.

    Raises:
        ValueError: it is neither, or may be both.
    """
    time, *state = columns.wanted
    width, which = len(state), ", ".join(state)
    if len(times) != 1:
        raise ValueError(f"{time} has the shape {times}; one number for each time is accepted.")
    rows = times[0]
    if shape not in {(rows, width), (width, rows)}:
        raise ValueError(
            f"{name} has the shape {shape}; ({rows}, {width}) or ({width}, {rows}) is accepted, with {which} at each "
            f"of the {rows} times."
        )
    if rows == width:
        raise ValueError(
            f"{name} has the shape {shape}, and there are {rows} times, so that rows and columns cannot be told apart; "
            f"an array for each of {which} is accepted."
        )
    return shape == (rows, width)
