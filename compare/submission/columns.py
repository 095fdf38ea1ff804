"""Which columns of a file are the time and the state."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from reference.names import SHOWN, short

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["Columns", "asked_columns"]

UNITS = re.compile(r"\s*[\[(](.*)[\])]$")
"""Units after a column's name, such as "theta (rad)" or "t [s]"."""
DEGREES = re.compile(r"deg|°", re.IGNORECASE)


@dataclass(frozen=True)
class Columns:
    """The time and the state by name, and what the file calls them where the user said so.

    Attributes:
        wanted: "t" and the names of the state's numbers.
        asked: the file's names of the same, or their numbers from 1 where the file has no header; or None.
    """

    wanted: tuple[str, ...]
    asked: tuple[str, ...] | None = None

    def __post_init__(self) -> None:
        if self.asked is not None and len(self.asked) != len(self.wanted):
            raise ValueError(
                f"--columns names {len(self.asked)} columns; {len(self.wanted)} are accepted, for {self._list}."
            )

    @property
    def names(self) -> tuple[str, ...]:
        """The names to look for."""
        return self.asked or self.wanted

    @property
    def _list(self) -> str:
        return ", ".join(self.wanted)

    def among(self, found: Sequence[str], kind: str = "columns") -> list[int]:
        """Where the wanted columns are among the names that a file has: as they are written, or but for case and units.

        Raises:
            ValueError: one is missing or there twice, or is in degrees; the sentence says what there is.
        """
        exact = [name.strip() for name in found]
        bare = [UNITS.sub("", name).casefold() for name in exact]
        places: list[int] = []
        for name in self.names:
            where = [i for i, known in enumerate(exact) if known == name]
            where = where or [i for i, known in enumerate(bare) if known == name.casefold()]
            if not where:
                raise ValueError(self._missing(name, exact, kind))
            if len(where) > 1:
                raise ValueError(f"there are {len(where)} {kind} called {name}; one is accepted.")
            units = UNITS.search(exact[where[0]])
            if units and DEGREES.search(units[1]):
                raise ValueError(
                    f"the column {exact[where[0]]} is in degrees; radians are accepted, so multiply by pi/180."
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
        shown = ", ".join(short(other) for other in found[:SHOWN]) + (", ..." if len(found) > SHOWN else "")
        sentence = f"there is no {kind.removesuffix('s')} {name}: the {kind} are {shown or 'none'}"
        if self.asked is not None:
            return f"{sentence}."
        names = ",".join(found) if len(found) == len(self.wanted) else "A,B,C"
        return f"{sentence}, and {self._list} are needed; '--columns {names}' would say which they are."


def asked_columns(text: str) -> tuple[str, ...]:
    """The names of ``--columns t,theta,omega``."""
    names = tuple(name.strip() for name in text.split(","))
    if not all(names):
        raise ValueError(f"--columns is '{short(text)}'; names with commas between them are accepted.")
    return names
