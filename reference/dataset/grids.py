"""A plan of the user's own, from a TOML file: which groups, which parameters, which numbers on the axes.

    [[group]]
    path = "/pendulum/libration"
    g = 9.81
    length = 1
    amplitude = [0.5, 1.0]
    time = { start = 0, stop = 10, count = 1001 }
    event = 8
    taylor_elements = 100

A number is the binary64 number that it spells; a range's are start + k (stop - start)/(count - 1), exact before they
are rounded once; a whole number in the place of labels stands for 0, 1, ...; a name in the place of a label for its
number.
``taylor_elements`` may bound how many arguments of a block, from the first, the Taylor route is asked for.
"""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import TYPE_CHECKING, Any

from reference.arithmetic.exact import exact
from reference.dataset.catalogue import LAYOUTS, YOUR_OWN, layouts_of, spelled
from reference.dataset.plan import Plan
from reference.layout import Group
from reference.names import is_grid_file, said, short, unknown

if TYPE_CHECKING:
    from collections.abc import Sequence
    from fractions import Fraction

    from reference.family import Family
    from reference.layout import Coordinate, Layout

__all__ = ["MAX_NUMBERS", "plan_from"]

MAX_NUMBERS = 10_000_000
"""Numbers on one axis."""
MAX_LABEL = 2**31 - 1
RANGE = ("start", "stop", "count")
BESIDES = ("path", "taylor_elements")


def plan_from(path: str, families: Sequence[Family | str] = ()) -> Plan:
    """The plan that a TOML file describes; its profile is the name of the file.

    It may name groups of ``families`` that are not ours, each a Family, or its name as MODULE:NAME or FILE.py:NAME.

    Raises:
        ValueError: the file is not there, is not named or written as TOML, or a group, parameter or input in it is
            missing, unknown, twice there or not acceptable, or a family is.
        FileNotFoundError, ImportError: the module of a family cannot be imported.
        TypeError: ``path`` is no text, or ``families`` hold something else.
    """
    if not isinstance(path, str):
        raise TypeError(f"the grid file is of type {type(path).__name__}; its name as text is accepted.")
    if not is_grid_file(Path(path).name):
        raise ValueError(f"the grid file is '{short(path)}'; a printable name that ends with .toml is accepted.")
    try:
        asked = tomllib.loads(Path(path).read_text(encoding="utf-8"), parse_float=str)
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "it is no text in UTF-8"
        raise ValueError(f"the grid file '{path}' cannot be read: {reason}.") from None
    except tomllib.TOMLDecodeError as error:
        raise ValueError(f"the grid file '{path}' is no TOML: {error}.") from None
    tables = asked.pop("group", [])
    if asked or not isinstance(tables, list) or not tables or not all(isinstance(table, dict) for table in tables):
        raise ValueError(f"the grid file '{path}' must hold one table [[group]] or more, and nothing else.")
    own = layouts_of(families)
    layouts = {layout.path.strip("/"): layout for layout in (*own, *LAYOUTS)}
    groups = tuple(_group(table, layouts) for table in tables)
    paths = [group.layout.path for group in groups]
    for twice in paths:
        if paths.count(twice) > 1:
            raise ValueError(f"the group {twice} is there {paths.count(twice)} times; once is accepted.")
    return Plan(Path(path).name, groups, spelled(families) if any(group.layout in own for group in groups) else ())


def _group(table: dict[str, Any], layouts: dict[str, Layout]) -> Group:
    name = table.get("path")
    if not isinstance(name, str) or name.strip("/") not in layouts:
        raise ValueError(f"{unknown('group', str(name), layouts)[:-1]}; {YOUR_OWN}.")
    layout = layouts[name.strip("/")]
    given = {key: value for key, value in table.items() if key not in BESIDES}
    wanted = {coordinate.name: coordinate for coordinate in (*layout.parameters, *layout.given)}
    for key in given:
        if key not in wanted:
            raise ValueError(unknown(f"the input of {layout.path},", key, wanted))
    for key in wanted:
        if key not in given:
            raise ValueError(f"{layout.path} has no '{key}'; it needs {', '.join(wanted)}.")
    where = f"{layout.path}/"
    parameters = {asked.name: _number(where + asked.name, given[asked.name]) for asked in layout.parameters}
    inputs = {asked.name: _numbers(where, asked, given[asked.name]) for asked in layout.given}
    bound = _count(f"{where}taylor_elements", table["taylor_elements"]) if "taylor_elements" in table else None
    group = Group(layout, parameters, inputs, bound)
    for block in group.blocks():
        block.check()
    return group


def _number(name: str, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, str)):
        raise ValueError(f"{name} is {said(value)}; a number is accepted.")  # noqa: TRY004 (the file has a wrong value)
    number = exact(value, name)
    if isinstance(value, str) and "/" in value:
        raise ValueError(f"{name} is '{short(value)}', a fraction; a stored input is a binary64 number, as a decimal.")
    return _stored(name, number, str(value))


def _stored(name: str, number: Fraction, told: str) -> float:
    """The binary64 number nearest to this one.

    Raises:
        ValueError: there is none.
    """
    try:
        return float(number) + 0.0
    except OverflowError:
        raise ValueError(f"{name} is {short(told)}, which is beyond the range of binary64.") from None


def _numbers(where: str, asked: Coordinate, value: Any) -> list[Any]:
    """The numbers on one axis: listed, in a range, or for labels counted or named."""
    name = where + asked.name
    if asked.whole or asked.meanings:
        return _labels(name, asked, value)
    if isinstance(value, dict):
        return _range(name, value)
    return [_number(name, number) for number in (value if isinstance(value, list) else [value])]


def _labels(name: str, asked: Coordinate, value: Any) -> list[int]:
    listed = value if isinstance(value, list) else list(range(_count(name, value)))
    labels = [asked.meanings.index(label) if label in asked.meanings else label for label in listed]
    for label in labels:
        whole = isinstance(label, int) and not isinstance(label, bool)
        if isinstance(label, str) or (asked.meanings and not (whole and label in range(len(asked.meanings)))):
            raise ValueError(unknown(name, str(label), asked.meanings))
        if not whole or not 0 <= label <= MAX_LABEL:
            raise ValueError(f"{name} is {said(label)}; an integer from 0 to {MAX_LABEL} is accepted.")
    return labels


def _range(name: str, value: dict[str, Any]) -> list[float]:
    if sorted(value) != sorted(RANGE):
        raise ValueError(f"{name} has {', '.join(sorted(value)) or 'nothing'}; a range has {', '.join(RANGE)}.")
    count = _count(name, value["count"])
    start, stop = (exact(value[end], f"{name}, its {end}") for end in ("start", "stop"))
    step = (stop - start) / max(1, count - 1)
    return [_stored(name, start + k * step, f"from {value['start']} to {value['stop']}") for k in range(count)]


def _count(name: str, value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 1 <= value <= MAX_NUMBERS:
        raise ValueError(f"{name} has the count {said(value)}; an integer from 1 to {MAX_NUMBERS} is accepted.")
    return value
