"""The groups that a dataset can hold, and the profiles that put numbers on them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from reference.dataset.plan import Plan
from reference.dataset.schema import LIMB, PROVENANCE
from reference.family import Family
from reference.named import is_own
from reference.names import NAME_LENGTH, short, unknown
from reference.problems.families import FAMILIES, find_family

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from reference.layout import Group, Layout

__all__ = ["LAYOUTS", "PROFILES", "YOUR_OWN", "is_family_name", "layouts_of", "plan", "spelled"]

LAYOUTS: tuple[Layout, ...] = tuple(layout for family in FAMILIES for layout in family.layouts)
YOUR_OWN = "groups of your own families are accepted where --family, in Python families=, names these"


def core() -> tuple[Group, ...]:
    """The grids of the dataset that ships with the package."""
    return tuple(group for family in FAMILIES for group in family.core())


def full() -> tuple[Group, ...]:
    """The same groups with finer and larger grids, more than fifty times the size."""
    return tuple(group for family in FAMILIES for group in family.full())


PROFILES: dict[str, Callable[[], tuple[Group, ...]]] = {"core": core, "full": full}


def plan(profile: str = "core", families: Sequence[Family | str] = ()) -> Plan:
    """The plan of a profile; with ``families`` that of theirs alone.

    Raises:
        ValueError: there is no profile of this name, no family of one, or it has no groups in the profile.
        FileNotFoundError, ImportError: the module of a family cannot be imported.
        TypeError: ``families`` holds something else.
    """
    if profile not in PROFILES:
        raise ValueError(unknown("profile", profile, PROFILES))
    if not families:
        return Plan(profile, PROFILES[profile]())
    _ = layouts_of(families)  # refuses those that cannot stand in one file
    found: list[Group] = []
    for family in _given(families):
        groups = family.core() if profile == "core" else family.full()
        if not groups:
            raise ValueError(f"the family {short(family.name)} declares no groups of the profile {profile}.")
        found += groups
    return Plan(profile, tuple(found), spelled(families))


def layouts_of(families: Sequence[Family | str]) -> tuple[Layout, ...]:
    """The layouts of those families that are not ours, which a file can hold beside LAYOUTS.

    Raises:
        ValueError: there is no such family, or one of its groups has the place of another.
        FileNotFoundError, ImportError: the module of a family cannot be imported.
        TypeError: ``families`` holds something else.
    """
    taken = [f"/{LIMB}", f"/{PROVENANCE}", *(layout.path for layout in LAYOUTS)]
    found: list[Layout] = []
    for layout in (layout for family in _given(families) if family not in FAMILIES for layout in family.layouts):
        for other in taken:
            if f"{layout.path}/".startswith(f"{other}/") or other.startswith(f"{layout.path}/"):
                raise ValueError(f"the group {layout.path} has the place of {other}; another path is accepted.")
        taken.append(layout.path)
        found.append(layout)
    return tuple(found)


def is_family_name(name: str) -> bool:
    """Whether a file may say that a family of this name was given: one of ours, or HOME:NAME, of printable letters."""
    ours = name in {family.name for family in FAMILIES}
    return ours or (is_own(name) and name.isprintable() and len(name) <= NAME_LENGTH)


def spelled(families: Sequence[Family | str]) -> tuple[str, ...]:
    """How a command names these families: without the folder of a file, as it is told of a grid file."""
    names = (one for one in families if isinstance(one, str))
    return tuple(dict.fromkeys(Path(name).name if ".py:" in name else name for name in names))


def _given(families: Sequence[Family | str]) -> list[Family]:
    """The families, each once."""
    if isinstance(families, (str, Family)):
        raise TypeError(f"families is of type {type(families).__name__}; a list of families or names is accepted.")
    found: list[Family] = []
    for one in families:
        if not isinstance(one, (str, Family)):
            raise TypeError(f"one of the families is of type {type(one).__name__}; a Family or its name is accepted.")
        family = one if isinstance(one, Family) else find_family(one)
        if family not in found:
            found.append(family)
    return found
