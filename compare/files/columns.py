"""Which columns of a file are the time and the state.

Other names of the time and the state, as programs give them: of the same letter, or a derivative by its function.

Units as tables name them: which are those of the truth, and by what others are to be multiplied.
"""

from __future__ import annotations

import csv
import re
import shlex
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, NamedTuple

from compare.show.render import csv_text
from reference.names import LENGTH, SHOWN, short

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

__all__ = ["DATASETS", "USUAL", "Columns", "Unit", "asked_columns", "named", "option", "unit"]

TIMES = frozenset({
    "time", "times", "zeit", "temps", "tiempo", "tempo", "tid", "tijd", "x_value",
})  # fmt: skip
"""What the column of t is called: by words of several languages, and by LabVIEW."""
LETTERS = {"theta": "θϑ", "omega": "ω", "phi": "φϕ", "tau": "τ"}
RATES = {"omega": "theta", "angular_velocity": "angle", "arc_rate": "arc", "place_rate": "place", "z_rate": "z"}
"""The names of derivatives, and of what they are derivatives."""
DERIVED = (
    "der({0})", "d({0})/dt", "d({0},t)", "diff({0},t)", "diff({0}(t),t)", "diff({0}(t), t)", "d{0}/dt",
    "d{0}_dt", "d{0}dt", "{0}dot", "{0}_dot", "{0} dot", "{0}'", "{0}′", "{0}’", "{0}'(t)", "{0}(t)'", "{0}̇",
    "{0}_prime", "{0}prime", "dot({0})", "dot_{0}", "derivative({0})", "derivative({0}(t), t)",
)  # fmt: skip


@cache
def same_as(name: str, wanted: tuple[str, ...]) -> frozenset[str]:
    """The other names, in small letters, of the one called ``name`` among those of the time and the state."""
    found = set(TIMES) if name == "t" else set()
    letters = {*LETTERS.get(name, "")}
    found |= letters | {f"{each}(t)" for each in (name, *letters)}
    function = RATES.get(name, "")
    if function in wanted:
        spellings = (function, *LETTERS.get(function, ""))
        found |= {form.format(each) for form in DERIVED for each in spellings}
    return frozenset(each.casefold() for each in found)


SECONDS = {
    "s": "1", "sec": "1", "secs": "1", "second": "1", "seconds": "1", "sek": "1", "sekunden": "1", "secondes": "1",
    "ms": "0.001", "msec": "0.001", "millisecond": "0.001", "milliseconds": "0.001",
    "us": "1e-6", "µs": "1e-6", "usec": "1e-6", "microsecond": "1e-6", "microseconds": "1e-6",
    "ns": "1e-9", "nanosecond": "1e-9", "nanoseconds": "1e-9",
    "min": "60", "minute": "60", "minutes": "60", "h": "3600", "hr": "3600", "hour": "3600", "hours": "3600",
    "day": "86400", "days": "86400",
}  # fmt: skip
RADIANS = {
    "rad": "1", "rads": "1", "radian": "1", "radians": "1", "mrad": "0.001", "µrad": "1e-6", "urad": "1e-6",
    "krad": "1000",
    "deg": "pi/180", "degs": "pi/180", "degree": "pi/180", "degrees": "pi/180", "°": "pi/180", "º": "pi/180",
    "grad": "pi/200", "gon": "pi/200", "arcmin": "pi/10800", "arcsec": "pi/648000",
    "rev": "2*pi", "revs": "2*pi", "turn": "2*pi", "turns": "2*pi", "cycles": "2*pi",
}  # fmt: skip
METRES = {"m": "1", "metre": "1", "metres": "1", "meter": "1", "meters": "1", "mm": "0.001", "cm": "0.01", "km": "1000"}
BASES = {"s": SECONDS, "rad": RADIANS, "m": METRES}
WHOLE = {
    "rpm": ("rad s-1", "pi/30"),
    "1": ("1", "1"),
    "hz": ("rad s-1", "2*pi"),
}
"""Units that are no quotient of the others."""
LONGEST = 80
"""Characters of a name that says its unit."""
OVER = "|".join(sorted(SECONDS, key=len, reverse=True))
RECIPROCALS = {"1": "1", "0.001": "1000", "1e-6": "1e6", "1e-9": "1e9"}
"""What a factor below is above."""
INVERSE = re.compile(rf"1?(?:/|per)(?P<over>{OVER})|(?P<inverse>{OVER})-1")
QUOTIENT = re.compile(rf"(?P<of>\D+?)(?:(?:/|per)(?P<over>{OVER})|(?P<inverse>{OVER})-1)")
BRACKETS = re.compile(r"(?P<name>.*?)\s*(?:\[(?P<square>[^][]*)\]|\((?P<round>[^()]*)\)|\{(?P<brace>[^{}]*)\})")
QUANTITY = re.compile(r"(?P<name>(?:[^][(){}/,]|\([^()]*\)|\[[^][]*\])+?)\s*[/,]\s*(?P<unit>.+)")
"""A quantity and its unit as ISO 80000 writes them, theta/rad; or after a comma."""
SUFFIX = re.compile(
    r"(?P<name>.+?)_(?:in_)?(?P<unit>s|sec|ms|us|ns|min|m?rad|deg(?:rees)?|(?:m?rad|deg|m)_(?:per_)?s|mm|cm)"
)


class Unit(NamedTuple):
    """What is measured, in its unit of the truth such as "rad s-1", and the factor that leads to that."""

    of: str
    factor: str


def unit(text: str) -> Unit | None:
    """The unit that a text names, with its brackets or without; None where it is none that is known."""
    if len(text) > LONGEST:
        return None
    bare = text.strip().strip("[](){}<>").strip().casefold().replace("μ", "µ")
    for old, new in (("⁻¹", "-1"), ("−", "-"), ("^(-1)", "-1"), ("^", ""), ("{", ""), ("}", "")):
        bare = bare.replace(old, new)
    bare = re.sub(r"[\s·⋅*.]+", "", bare)
    if bare in WHOLE:
        return Unit(*WHOLE[bare])
    for base, names in BASES.items():
        if bare in names:
            return Unit(base, names[bare])
    return _quotient(bare)


def _quotient(bare: str) -> Unit | None:
    """The unit that is another over a time; None where it is none that is known."""
    if match := INVERSE.fullmatch(bare):
        return Unit("s-1", _over("1", match))
    match = QUOTIENT.fullmatch(bare)
    for base, names in BASES.items():
        if match and match["of"] in names:
            return Unit(f"{base} s-1", _over(names[match["of"]], match))
    return None


def _over(factor: str, match: re.Match[str]) -> str:
    """A factor over that of the time which a quotient names."""
    divisor = SECONDS[match["over"] or match["inverse"]]
    if divisor not in RECIPROCALS:
        return f"{factor}/{divisor}"
    times = RECIPROCALS[divisor]
    return factor if times == "1" else times if factor == "1" else f"{factor}*{times}"


def split_name(name: str) -> Iterator[tuple[str, str]]:
    """A column's name as it may be meant: without and with what it says of its unit, "" where it says none."""
    if len(name) > LONGEST:
        yield name, ""
        return
    match = BRACKETS.fullmatch(name)
    if match and match["name"]:
        yield match["name"], match["square"] or match["round"] or match["brace"] or ""
    yield name, ""
    for pattern in (QUANTITY, SUFFIX):
        match = pattern.fullmatch(name)
        text = match["unit"].replace("_per_", "/").replace("_", "/") if match else ""
        if match and unit(text):
            yield match["name"], text


def named(found: Unit, text: str) -> str:
    """How a unit that a text names is spoken of."""
    return "degrees" if found.factor == "pi/180" else text.strip().strip("[](){}<>").strip()


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
    return "--columns " + shlex.quote(csv_text([map(short, names)]).removesuffix("\n"))


def asked_columns(text: str) -> tuple[str, ...]:
    """The names of ``--columns t,theta,omega``; one that has a comma stands in double quotes."""
    try:
        names = tuple(name.strip() for name in next(csv.reader([text], skipinitialspace=True), []))
    except csv.Error:
        names = ()
    if not names or not all(names):
        raise ValueError(f"--columns is '{short(text)}'; names with commas between them are accepted.")
    return names
