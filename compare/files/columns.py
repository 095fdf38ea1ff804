"""Which columns of a file are the time and the state."""

from __future__ import annotations

import csv
import io
import shlex
from dataclasses import dataclass
from typing import TYPE_CHECKING

from compare.files.synonyms import same_as
from compare.files.units import named, split_name, unit
from reference.names import LENGTH, SHOWN, short

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["DATASETS", "USUAL", "Columns", "asked_columns", "option"]

DATASETS = "datasets"
"""What the columns of an HDF5 file are called; their names are paths."""
MANY = 4096
"""Columns among which names are looked for only as they are written, in each line that may be a header."""
USUAL = "y"
"""What an array of all states is called by those who integrate."""


@dataclass(frozen=True)
class Columns:
    """The time and the state by name, and what the file calls them where the user said so.

    Attributes:
        wanted: "t" and the names of the state's numbers.
        asked: the file's names of the same, or their numbers from 1; or two names, of the times and of an array of all
            states; or None.
        units: the units of the same, such as "s" and "rad s-1", or "" where they are not known.
    """

    wanted: tuple[str, ...]
    asked: tuple[str, ...] | None = None
    units: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        asked = [name for name in self.asked or () if not name.isdecimal()]
        twice = next((name for name in asked if asked.count(name) > 1), None)
        if twice is not None:
            raise ValueError(f"--columns names {short(twice)} twice; each column once is accepted.")
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
    def _letters(self) -> str:
        """The option with a letter for each name."""
        return f"--columns {','.join('ABCDEFGH'[: len(self.wanted)])}"

    @property
    def _accepted(self) -> str:
        return f"{len(self.asked or ())} columns; {len(self.wanted)} are accepted, for {self._list}"

    def named_by(self, found: Sequence[str]) -> bool:
        """Whether these names of a text file's columns have all that are wanted, once or more often, by name."""
        if len(found) > MANY:
            return set(self.names) <= set(found)
        return all(where for where, _ in self._by_name(found, "columns"))

    def among(self, found: Sequence[str], kind: str = "columns") -> list[int]:
        """Where the wanted columns are among the names that a file has: as they are written, or but for case and units,
        or by another name of the same; or where numbers were asked for and are no names, there.

        A dataset is called by its path, or by the last part of it.

        Raises:
            ValueError: one is missing or there twice, or is in other units; the sentence says what there is.
        """
        names = [name.strip() for name in found]
        places: list[int] = []
        pairs = list(zip(self.names, self._where(found, kind), strict=True))
        complete = all(where for _, (where, _) in pairs)
        for name, (where, direct) in pairs:
            if not where or not (complete or direct):
                raise ValueError(self._missing(name, names, kind))
            if len(where) > 1:
                raise ValueError(self._several(name, [names[i] for i in where], names, kind))
            places += where
        self.refuse_units([_last(names[place]) if kind == DATASETS else names[place] for place in places])
        return places

    def _where(self, found: Sequence[str], kind: str) -> list[tuple[list[int], bool]]:
        """The places at which each of the names may be, and whether it is there by its own name, or number."""
        places = self._by_name(found, kind)
        numbers = self._numbers(len(found)) if kind in {"columns", "fields"} else []
        if numbers and not any(where for where, _ in places):
            return [([number - 1], True) for number in numbers]
        return places

    def _by_name(self, found: Sequence[str], kind: str) -> list[tuple[list[int], bool]]:
        exact = [name.strip() for name in found]
        last = [_last(name) for name in exact] if kind == DATASETS else exact
        whole = exact if self.asked or set(self.names) <= set(exact) else last  # the root's t is no group's
        bare = [{part.casefold() for part, _ in split_name(name)} for name in last]
        places: list[tuple[list[int], bool]] = []
        for name in self.names:
            where = (
                _places(name, whole) or _places(name, last) or [i for i, b in enumerate(bare) if name.casefold() in b]
            )
            other = [] if where or self.asked else [i for i, b in enumerate(bare) if b & same_as(name, self.wanted)]
            places.append((where or other, bool(where)))
        return places

    def _numbers(self, count: int) -> list[int]:
        """The numbers that were asked for, where all are of one of ``count`` columns."""
        asked = self.asked or ()
        numbers = [int(name) for name in asked if name.isascii() and name.isdecimal() and len(name) < 10]
        return numbers if len(numbers) == len(asked) and all(1 <= number <= count for number in numbers) else []

    def refuse_units(self, texts: Sequence[str], *, alone: bool = False) -> None:
        """Refuse columns in other units than the truth's: ``texts`` are their names, or their units ``alone``.

        Raises:
            ValueError: one is in degrees, or milliseconds, or others that are known.
        """
        for i, text in enumerate(texts):
            said = [text] if alone or ("/" in text and unit(text)) else [part for _, part in split_name(text) if part]
            known = [(part, found) for part in said if (found := unit(part))]
            if not known:
                continue
            part, found = known[0]
            wanted = self.units[i] if i < len(self.units) else "" if found.factor == "1" else found.of
            if found.of == wanted.replace("rad s-1", "s-1").replace("rad", "1"):
                found = found._replace(of=wanted)  # a radian is 1
            if found == (wanted, "1"):
                continue
            column = f"the column {short(text)}" if not alone else f"{self.wanted[i]}, with the units {short(text)},"
            if found.factor != "1" and wanted == found.of:
                accepted = "radians are" if wanted == "rad" or found.factor == "pi/180" else f"{wanted} is"
                raise ValueError(
                    f"{column} is in {short(named(found, part))}; {accepted} accepted, so multiply by {found.factor}."
                )
            if wanted and wanted != found.of:
                raise ValueError(f"{column} is in {short(named(found, part))}; {wanted} is accepted.")

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
        names = option(self._ordered(found, kind)) if len(found) == len(self.wanted) else self._letters
        two = " (or A,B where B has all states)" if kind in {"arrays", DATASETS} else ""
        return f"{sentence}, and {self._list} are needed; {names} would say which they are{two}."

    def _ordered(self, found: Sequence[str], kind: str) -> list[str]:
        """The names of as many columns as are wanted: what is known of them in its place, the others in their order."""
        known = {i: where[0] for i, (where, _) in enumerate(self._where(found, kind)) if len(where) == 1}
        others = iter([place for place in range(len(found)) if place not in set(known.values())])
        places = [known[i] if i in known else next(others) for i in range(len(found))]
        numbered = kind == "columns" and not typed(found)
        return [str(place + 1) if numbered else found[place] for place in places]

    def _several(self, name: str, which: Sequence[str], found: Sequence[str], kind: str) -> str:
        sentence = f"there are {len(which)} {kind} called {short(name)}; one is accepted"
        if kind != DATASETS:
            return f"{sentence}."
        group = which[0].removesuffix(which[0].rpartition("/")[2])
        names = self.wanted if {f"{group}{each}" for each in self.wanted} <= set(found) else (self.wanted[0], USUAL)
        paths = [f"{group}{each}" for each in names]
        example = option(paths) if set(paths) <= set(found) else self._letters
        return f"{sentence}, and there are {_listed(found)}; {example} would say which by their paths."


def _last(path: str) -> str:
    """The last part of a dataset's path; its units may have a slash too."""
    name, bracket, units = path.partition("(") if path.endswith(")") else path.partition("[")
    return f"{name.rpartition('/')[2]}{bracket}{units}"


def _places(name: str, known: Sequence[str]) -> list[int]:
    return [i for i, other in enumerate(known) if other == name]


def _listed(names: Sequence[str]) -> str:
    return ", ".join(map(short, names[:SHOWN])) + (", ..." if len(names) > SHOWN else "")


def typed(names: Sequence[str]) -> bool:
    """Whether names can be typed, and shown as they are."""
    return all(name and name.isprintable() and len(name) <= LENGTH for name in names)


def option(names: Sequence[str]) -> str:
    """``--columns`` with these names as a shell takes them."""
    buffer = io.StringIO()
    csv.writer(buffer, lineterminator="").writerow([short(name) for name in names])
    return f"--columns {shlex.quote(buffer.getvalue())}"


def asked_columns(text: str) -> tuple[str, ...]:
    """The names of ``--columns t,theta,omega``; one that has a comma stands in double quotes."""
    try:
        names = tuple(name.strip() for name in next(csv.reader([text], skipinitialspace=True), []))
    except csv.Error:
        names = ()
    if not names or not all(names):
        raise ValueError(f"--columns is '{short(text)}'; names with commas between them are accepted.")
    return names
