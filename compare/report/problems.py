"""The problems that a report covers: those that the families declare, or that a user's own family does."""

from __future__ import annotations

from typing import TYPE_CHECKING

from reference.named import is_own
from reference.names import unknown
from reference.problems.families import FAMILIES, find_family

if TYPE_CHECKING:
    from reference.family import Reported

__all__ = ["Amplitude", "reported", "reported_by"]

Amplitude = float | str
"""What tells a problem from others of its kind: a number, or the name of a curve."""


def reported(names: list[str] | None = None) -> dict[str, Reported]:
    """What is reported, by what a worker finds it by: of these names, or of all families with a closed form.

    A name is that of one kind of problems, or MODULE:NAME or FILE.py:NAME of a family of the user's own.

    Raises:
        ValueError: there is none of a name.
        FileNotFoundError, ImportError: the user's module that it names cannot be imported.
    """
    if names is None:
        return {one.name: one for family in FAMILIES if family.has_closed_form for one in family.reported}
    known = {one.name: one for family in FAMILIES for one in family.reported}
    found: dict[str, Reported] = {}
    for name in names:
        if is_own(name):
            found |= {f"{name}:{one.name}": one for one in find_family(name).reported}
        elif name in known:
            found[name] = known[name]
        else:
            raise ValueError(unknown("problem", name, known))
    return found


def reported_by(key: str) -> Reported:
    """What ``reported`` gave by this key."""
    home, colon, _ = key.rpartition(":")
    return reported([home] if colon else [key])[key]
