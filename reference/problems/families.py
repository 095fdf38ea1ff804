"""The families of problems that there are, each declared where its equations stand."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from reference.family import Family
from reference.named import named
from reference.names import unknown
from reference.problems.cycloid import family as cycloid
from reference.problems.descent import family as descent
from reference.problems.pendulum import family as pendulum
from reference.problems.polar import family as polar
from reference.problems.tunnel import family as tunnel

if TYPE_CHECKING:
    from reference.problem import Problem

__all__ = ["FAMILIES", "USUAL", "find_family", "usual_problem"]

FAMILIES = (
    pendulum.FAMILY,
    pendulum.LINEAR_FAMILY,
    cycloid.FAMILY,
    cycloid.TAUTOCHRONE_FAMILY,
    descent.FAMILY,
    polar.FAMILY,
    tunnel.FAMILY,
)


USUAL = FAMILIES[0].name
"""The family of what is tried where none is named."""


def usual_problem() -> Problem:
    """The problem that an integrator is tried on where none is named: the first value of the usual family."""
    family = FAMILIES[0]
    return family.problem(**{family.comparison.varied: family.comparison.values[0]})


@cache
def find_family(name: str) -> Family:
    """The family of this name, or one of the user's own: MODULE:NAME or FILE.py:NAME.

    Raises:
        ValueError: there is none.
        FileNotFoundError, ImportError: the user's module cannot be imported.
    """
    if ":" in name:
        found: Family = named(name, "family", "FAMILY", lambda value: isinstance(value, Family))
        return found
    known = {family.name: family for family in FAMILIES}
    if name not in known:
        raise ValueError(unknown("problem", name, known))
    return known[name]
