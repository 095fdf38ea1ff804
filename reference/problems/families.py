"""The families of problems that there are, each declared where its equations stand.

A module of this folder, or ``family.py`` in a folder of it, declares a family by holding it, or several as its tuple
``FAMILIES``: no list names it.
"""

from __future__ import annotations

from functools import cache
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from reference.family import Family
from reference.flow import flow_from
from reference.flow_families import flow_family
from reference.flow_problem import FlowProblem
from reference.named import EQUATION, named
from reference.names import unknown

if TYPE_CHECKING:
    from reference.problem import Problem

__all__ = ["FAMILIES", "USUAL", "find_family", "stiff_problem", "usual_problem"]

FIRST = ("pendulum", "cycloid", "descent", "polar", "tunnel")
"""The order of the dataset; what is added later follows by its name."""


def _declared() -> tuple[Family, ...]:
    """The families of this folder, each once, in order.

    Raises:
        ValueError: two of them have the same name or the same command.
    """
    here = Path(__file__).parent
    homes = {path.stem: path.stem for path in here.glob("*.py") if path.stem not in {"__init__", Path(__file__).stem}}
    homes |= {path.parent.name: f"{path.parent.name}.family" for path in here.glob("*/family.py")}
    later = sorted(set(homes) - set(FIRST))
    found: list[Family] = []
    for name in (*FIRST, *later):
        module = import_module(f"{__package__}.{homes[name]}")
        held = (*vars(module).values(), *getattr(module, "FAMILIES", ()))
        found += [one for one in held if isinstance(one, Family) and one not in found]
    for names in ([one.name for one in found], [one.comparison.command for one in found]):
        for name in names:
            if names.count(name) > 1:
                raise ValueError(f"{names.count(name)} families of {here} are called '{name}'; one is accepted.")
    return tuple(found)


FAMILIES = _declared()


USUAL = FAMILIES[0].name
"""The family of what is tried where none is named."""


STIFF = "prothero-robinson"
"""The family of a stiff equation whose solution is known."""


def usual_problem() -> Problem:
    """The problem that an integrator is tried on where none is named: the first value of the usual family."""
    family = FAMILIES[0]
    return family.problem(**{family.comparison.varied: family.comparison.values[0]})


def stiff_problem(rate: int) -> Problem:
    """The problem on which orders are reduced: a smooth solution that others approach as e^(rate t)."""
    return find_family(STIFF).problem(rate)


@cache
def find_family(name: str) -> Family:
    """The family of this name or command, or a user's own: MODULE:NAME, FILE.py:NAME, or FILE.toml of an equation.

    Raises:
        ValueError: there is none.
        FileNotFoundError, ImportError: the user's module cannot be imported.
    """
    if name.endswith(EQUATION):
        return flow_from(Path(name))
    if ":" in name:
        found = named(name, "family", "FAMILY", lambda value: isinstance(value, (Family, FlowProblem)))
        return flow_family(type(found), name) if isinstance(found, FlowProblem) else found
    known = {family.name: family for family in FAMILIES}
    found = known.get(name) or next((family for family in FAMILIES if family.comparison.command == name), None)
    if found is None:
        raise ValueError(unknown("problem", name, known))
    return found
