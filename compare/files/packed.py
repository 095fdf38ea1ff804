"""States in one array beside the times, of shape [rows, state] or [state, rows], as SciPy's solvers give them."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

from compare.files.columns import DATASETS, USUAL, option
from reference.names import SHOWN, short

if TYPE_CHECKING:
    from collections.abc import Mapping

    from compare.files.columns import Columns

__all__ = ["flat", "packed", "rows_first", "sized"]


def packed(columns: Columns, shapes: Mapping[str, tuple[int, ...]], kind: str) -> tuple[str, str] | None:
    """The names of the array of times and of the array of states; None where the columns are arrays of their own.

    ``shapes`` has the shapes of the arrays by their names, which are paths where ``kind`` is "datasets".  The states
    are those that were asked for, or are called "y", or are the only array of their shape.

    Raises:
        ValueError: there are several arrays that may be the states, or those that were asked for are not there.
    """
    time, *state = columns.wanted
    if columns.packed:
        names = list(shapes)
        first, second = (names[place] for place in columns.among(names, kind))
        return first, second
    last = [name.rpartition("/")[2] for name in shapes] if kind == DATASETS else list(shapes)
    if columns.asked is not None or set(state) & set(last):
        return None
    if {time, USUAL} <= set(shapes):
        return time, USUAL
    count = Counter(last)
    known = {part: name for part, name in zip(last, shapes, strict=True) if count[part] == 1}
    if time not in known:
        return None
    if USUAL in known:
        return known[time], known[USUAL]
    tables = [name for name, shape in shapes.items() if len(shape) == 2 and len(state) in shape and name != known[time]]
    if len(tables) > 1:
        raise ValueError(
            f"there are {len(tables)} {kind} that may hold {', '.join(state)}: "
            f"{', '.join(map(short, tables[:SHOWN]))}; one called {USUAL} is accepted, or one for each "
            f"of the state's numbers, or {option([known[time], tables[0]])} would say which it is."
        )
    return (known[time], tables[0]) if tables else None


def flat(shape: tuple[int, ...]) -> tuple[int, ...]:
    """The shape of a column: of a matrix of one row or one column too, as MATLAB has no other."""
    return (max(shape),) if len(shape) == 2 and 1 in shape else shape


def sized(count: int) -> str:
    """A number of bytes, in words."""
    return f"{short(str(count))} byte{'' if count == 1 else 's'}"


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
            f"{short(name)} has the shape {shape}; ({rows}, {width}) or ({width}, {rows}) is accepted, with {which} at "
            f"each of the {rows} times."
        )
    if rows == width:
        raise ValueError(
            f"{short(name)} has the shape {shape}, and there are {rows} times, so that rows and columns cannot be told "
            f"apart; an array for each of {which} is accepted."
        )
    return shape == (rows, width)
