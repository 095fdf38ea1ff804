"""Which columns of a file are the time and the state."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from reference.names import SHOWN, short

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["DATASETS", "USUAL", "Columns", "asked_columns"]

DATASETS = "datasets"
"""What the columns of an HDF5 file are called; their names are paths."""
USUAL = "y"
"""What an array of all states is called by those who integrate."""

UNITS = re.compile(r"\s*[\[(](.*)[\])]$")
"""Units after a column's name, such as "theta (rad)" or "t [s]"."""
DEGREES = re.compile(r"deg|°", re.IGNORECASE)


@dataclass(frozen=True)
class Columns:
    """The time and the state by name, and what the file calls them where the user said so.

    Attributes:
        wanted: "t" and the names of the state's numbers.
        asked: the file's names of the same, or their numbers from 1 where the file has no header; or two names, of
            the times and of an array of all states; or None.
    """

    wanted: tuple[str, ...]
    asked: tuple[str, ...] | None = None

    def __post_init__(self) -> None:
        if self.asked is not None and len(self.asked) not in {2, len(self.wanted)}:
            raise ValueError(
                f"--columns names {self._accepted}; or 2 of an NPZ or HDF5 file, for {self.wanted[0]} and an array of "
                "all states."
            )

    @property
    def packed(self) -> bool:
        """Whether what was asked for are the times and an array of all states."""
        return self.asked is not None and len(self.asked) == 2 != len(self.wanted)

    def refuse_packed(self) -> None:
        """Raise where a file cannot have all states in one array.

        Raises:
            ValueError: they were asked for.
        """
        if self.packed:
            raise ValueError(f"--columns names {self._accepted}.")

    @property
    def names(self) -> tuple[str, ...]:
        """The names to look for."""
        return self.asked or self.wanted

    @property
    def _list(self) -> str:
        return ", ".join(self.wanted)

    @property
    def _accepted(self) -> str:
        return f"{len(self.asked or ())} columns; {len(self.wanted)} are accepted, for {self._list}"

    def among(self, found: Sequence[str], kind: str = "columns") -> list[int]:
        """Where the wanted columns are among the names that a file has: as they are written, or but for case and units.

        A dataset is called by its path, or by the last part of it.

        Raises:
            ValueError: one is missing or there twice, or is in degrees; the sentence says what there is.
        """
        exact = [name.strip() for name in found]
        last = [name.rpartition("/")[2] for name in exact] if kind == DATASETS else exact
        whole = exact if self.asked or set(self.names) <= set(exact) else last  # the root's t is no group's
        bare = [UNITS.sub("", name).casefold() for name in exact]
        if kind == DATASETS:
            bare = [name.rpartition("/")[2] for name in bare]
        places: list[int] = []
        for name in self.names:
            where = _places(name, whole) or _places(name, last) or _places(name.casefold(), bare)
            if not where:
                raise ValueError(self._missing(name, exact, kind))
            if len(where) > 1:
                raise ValueError(self._several(name, [exact[i] for i in where], exact, kind))
            units = UNITS.search(exact[where[0]])
            if units and DEGREES.search(units[1]):
                raise ValueError(
                    f"the column {short(exact[where[0]])} is in degrees; radians are accepted, so multiply by pi/180."
                )
            places += where
        return places

    def without_header(self, count: int, hint: str = "") -> list[int]:
        """Where the wanted columns are in a file without names: in order, or at the numbers that were asked for.

        ``hint`` is added to the sentence on a wrong number of columns.

        Raises:
            ValueError: there are more or fewer columns than are wanted, or a number is beyond the last.
        """
        if self.asked is None:
            if count != len(self.wanted):
                raise ValueError(
                    f"there are {count} columns without a header; {len(self.wanted)} are accepted ({self._list}), "
                    "or a header with these names, or --columns with their numbers, such as --columns 1,2,3"
                    f"{hint}."
                )
            return list(range(count))
        for name in self.asked:
            if not (name.isdecimal() and 1 <= int(name) <= count):
                raise ValueError(
                    f"the column '{short(name)}' is not there: the file has no header, and {count} columns; "
                    f"numbers from 1 to {count} are accepted."
                )
        return [int(name) - 1 for name in self.asked]

    def _missing(self, name: str, found: Sequence[str], kind: str) -> str:
        sentence = f"there is no {kind.removesuffix('s')} {short(name)}: the {kind} are {_listed(found) or 'none'}"
        if self.asked is not None:
            return f"{sentence}."
        names = ",".join(map(short, found)) if len(found) == len(self.wanted) else "A,B,C"
        two = " (or A,B where B has all states)" if kind in {"arrays", DATASETS} else ""
        return f"{sentence}, and {self._list} are needed; '--columns {names}' would say which they are{two}."

    def _several(self, name: str, which: Sequence[str], found: Sequence[str], kind: str) -> str:
        sentence = f"there are {len(which)} {kind} called {short(name)}; one is accepted"
        if kind != DATASETS:
            return f"{sentence}."
        group = which[0].removesuffix(which[0].rpartition("/")[2])
        names = self.wanted if {f"{group}{each}" for each in self.wanted} <= set(found) else (self.wanted[0], USUAL)
        paths = [f"{group}{each}" for each in names]
        example = ",".join(map(short, paths)) if set(paths) <= set(found) else "A,B,C"
        return f"{sentence}, and there are {_listed(found)}; '--columns {example}' would say which by their paths."


def _places(name: str, known: Sequence[str]) -> list[int]:
    return [i for i, other in enumerate(known) if other == name]


def _listed(names: Sequence[str]) -> str:
    return ", ".join(map(short, names[:SHOWN])) + (", ..." if len(names) > SHOWN else "")


def asked_columns(text: str) -> tuple[str, ...]:
    """The names of ``--columns t,theta,omega``."""
    names = tuple(name.strip() for name in text.split(","))
    if not all(names):
        raise ValueError(f"--columns is '{short(text)}'; names with commas between them are accepted.")
    return names
