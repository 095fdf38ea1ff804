"""The groups that a dataset can hold, and the profiles that put numbers on them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from reference.dataset.plan import Plan
from reference.names import unknown
from reference.problems.families import FAMILIES

if TYPE_CHECKING:
    from collections.abc import Callable

    from reference.layout import Group, Layout

__all__ = ["LAYOUTS", "PROFILES", "plan"]

LAYOUTS: tuple[Layout, ...] = tuple(layout for family in FAMILIES for layout in family.layouts)


def core() -> tuple[Group, ...]:
    """The grids of the dataset that ships with the package."""
    return tuple(group for family in FAMILIES for group in family.core())


def full() -> tuple[Group, ...]:
    """The same groups with finer and larger grids, more than fifty times the size."""
    return tuple(group for family in FAMILIES for group in family.full())


PROFILES: dict[str, Callable[[], tuple[Group, ...]]] = {"core": core, "full": full}


def plan(profile: str = "core") -> Plan:
    """The plan of a profile.

    Raises:
        ValueError: there is no profile of this name.
    """
    if profile not in PROFILES:
        raise ValueError(unknown("profile", profile, PROFILES))
    return Plan(profile, PROFILES[profile]())
