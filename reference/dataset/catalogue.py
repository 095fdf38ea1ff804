"""The groups that a dataset can hold, and the profiles that put numbers on them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from reference.dataset.plan import Plan
from reference.names import unknown
from reference.problems.cycloid import family as cycloid
from reference.problems.descent import family as descent
from reference.problems.pendulum import family as pendulum
from reference.problems.polar import family as polar

if TYPE_CHECKING:
    from collections.abc import Callable

    from reference.family import Group, Layout

__all__ = ["LAYOUTS", "PROFILES", "plan"]

FAMILIES = (pendulum, cycloid, descent, polar)
LAYOUTS: tuple[Layout, ...] = tuple(layout for family in FAMILIES for layout in family.LAYOUTS)


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
