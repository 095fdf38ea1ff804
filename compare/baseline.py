"""An earlier answer of a command, held against the one that it gives now: what is worse, and what is better.

A command declares which quantities of its JSON count, and of each which way is worse (``Gate``); the rest is here.
The file is read, and never written.
"""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, NoReturn, Protocol

from compare.show.page import Lines, Page, fields_of
from compare.show.render import render
from compare.show.text_table import Column, Grid, Table
from reference.names import short

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable, Iterable, Iterator, Mapping

__all__ = [
    "Baseline",
    "Change",
    "Comparison",
    "Entry",
    "Gate",
    "Large",
    "Rounding",
    "Small",
    "Standing",
    "add_baseline",
    "asked_margin",
    "document_of",
    "noted",
    "opened",
    "with_comparison",
]


class Measure(Protocol):
    """Which way a quantity is worse, and by how much it may differ; better is worse the other way round."""

    def accepts(self, value: Any) -> bool:
        """Whether it can be a value of the quantity."""

    def worse(self, was: Any, now: Any) -> bool:
        """Whether it is worse now."""

    def shown(self, value: Any) -> str:
        """The value as readers take it."""


class _Number:
    def accepts(self, value: Any) -> bool:
        """Whether it is a finite number."""
        return type(value) in {int, float} and math.isfinite(value)

    def shown(self, value: float) -> str:
        """To two digits; a whole number as it is."""
        return str(value) if isinstance(value, int) else f"{value:.2g}"


@dataclass(frozen=True)
class Small(_Number):
    """A number that may grow by a factor; up to ``least`` it is as good as that."""

    factor: float
    least: float = 0.0

    def worse(self, was: float, now: float) -> bool:
        """Whether it grew by more."""
        return now > self.factor * max(was, self.least)


@dataclass(frozen=True)
class Large(_Number):
    """A number that may fall by a margin; from ``enough`` on it is as good as that."""

    margin: float
    enough: float = math.inf

    def worse(self, was: float, now: float) -> bool:
        """Whether it fell by more."""
        return now < min(was, self.enough) - self.margin

    def shown(self, value: float) -> str:
        """To two decimals."""
        return f"{value:.2f}"


@dataclass(frozen=True)
class Rounding(_Number):
    """A number that is rounding up to a level and must stay so, within a factor; others are of no account."""

    level: float
    factor: float

    def worse(self, was: float, now: float) -> bool:
        """Whether it was rounding and is not."""
        return was <= self.level and now > self.factor * self.level


@dataclass(frozen=True)
class Standing:
    """One of some words, from the worst to the best."""

    words: tuple[str, ...]

    def accepts(self, value: Any) -> bool:
        """Whether it is one of them."""
        return value in self.words

    def worse(self, was: str, now: str) -> bool:
        """Whether the word now stands before the one that was."""
        return self.words.index(now) < self.words.index(was)

    def shown(self, value: str) -> str:
        """The word."""
        return value


class Entry(NamedTuple):
    """A quantity of an answer.

    Attributes:
        of: what it is a quantity of, in words; when that is in an answer no more, it is worse.
        quantity: its name.
        value: None where there is none; what one of two answers lacks is not compared.
        measure: which way it is worse.
    """

    of: str
    quantity: str
    value: Any
    measure: Measure


@dataclass(frozen=True)
class Gate:
    """What a command declares of its JSON.

    Attributes:
        command: its words.
        facts: from the document to what must be the same in both, such as the problem, by name.
        entries: from the document and the factor by which errors may grow to its quantities.
    """

    command: str
    facts: Callable[[Any], Mapping[str, Any]]
    entries: Callable[[Any, float | None], Iterable[Entry]]


class Change(NamedTuple):
    """What is worse or better; ``was`` and ``now`` as the documents have them, or whether it is there."""

    of: str
    quantity: str
    was: Any
    now: Any
    shown: tuple[str, str]

    def __str__(self) -> str:
        return f"{self.of}: {self.quantity} was {self.shown[0]}, is {self.shown[1]}"


PRESENT = "present"
THERE: tuple[Any, Any] = ("yes", "no")


@dataclass(frozen=True)
class Comparison:
    """Two answers of a command, the earlier one from a file.

    Attributes:
        file: its name.
        worse, better: what is, beyond the margins.
        same: how many quantities are neither.
        new: what only the later answer has.
    """

    file: str
    worse: tuple[Change, ...]
    better: tuple[Change, ...]
    same: int
    new: tuple[str, ...]

    @property
    def holds(self) -> bool:
        """Whether nothing is worse."""
        return not self.worse

    @property
    def title(self) -> str:
        """How many are what, in one line."""
        new = f", {len(self.new)} new" if self.new else ""
        told = f"{len(self.worse)} worse, {len(self.better)} better, {self.same} as before{new}"
        return f"Against the baseline {short(self.file)}: {told}"

    @property
    def told(self) -> tuple[tuple[str, Change], ...]:
        """Every change with its word."""
        return (*(("worse", one) for one in self.worse), *(("better", one) for one in self.better))

    @property
    def lines(self) -> Iterator[str]:
        """The title and a line for each change."""
        yield f"{self.title}."
        yield from (f"{word}: {one}" for word, one in self.told)

    @property
    def table(self) -> Table:
        """The same for readers."""
        columns = (Column("", left=True), Column("of", left=True), Column("quantity", left=True))
        rows = tuple((word, one.of, one.quantity, *one.shown) for word, one in self.told)
        grid = Grid((*columns, Column("was"), Column("is")), rows)
        return Table("baseline", self.title, (grid,) if rows else ())

    @property
    def data(self) -> Lines:
        """The same for programs."""
        listed = {
            name: Lines([{"of": one.of, "quantity": one.quantity, "was": one.was, "is": one.now} for one in changes])
            for name, changes in (("worse", self.worse), ("better", self.better))
        }
        head = {name: value for name, value in fields_of(self).items() if name not in listed}
        return Lines({**head, "holds": self.holds, **listed})


@dataclass(frozen=True)
class Baseline:
    """An earlier answer of a command, from a file.

    Attributes:
        file: its name.
        gate: what counts of it.
        factor: by which errors may grow, or None for the command's own.
        facts: what must be the same now.
        found: its quantities by what they are of, and by name.
    """

    file: str
    gate: Gate
    factor: float | None
    facts: Mapping[str, Any]
    found: Mapping[str, Mapping[str, Entry]]

    def refuse_another(self, facts: Mapping[str, Any]) -> None:
        """Refuse an answer to another question; some of its facts will do.

        Raises:
            ValueError: one differs.
        """
        for name, now in facts.items():
            was = self.facts.get(name)
            if was != now:
                raise ValueError(
                    f"the baseline '{short(self.file)}' is of {short(name)} = {_told(was)}, and this answer of "
                    f"{_told(now)}; one of the same is accepted."
                )

    def against(self, document: Any) -> Comparison:
        """What is worse and better in an answer.

        Raises:
            ValueError: it answers another question.
        """
        facts = self.gate.facts(document)
        self.refuse_another({**dict.fromkeys(self.facts), **facts})
        now = _by_name(self.gate.entries(document, self.factor))
        worse: list[Change] = []
        better: list[Change] = []
        same = 0
        for of, quantities in self.found.items():
            if of not in now:
                worse.append(Change(of, PRESENT, *THERE, shown=THERE))
                continue
            for name in (name for name in quantities if name in now[of]):
                before, after, measure = quantities[name].value, now[of][name].value, quantities[name].measure
                change = Change(of, name, before, after, (measure.shown(before), measure.shown(after)))
                if measure.worse(before, after):
                    worse.append(change)
                elif measure.worse(after, before):
                    better.append(change)
                else:
                    same += 1
        new = tuple(of for of in now if of not in self.found)
        return Comparison(self.file, tuple(worse), tuple(better), same, new)


def _told(fact: Any) -> str:
    return "none" if fact is None else short(json.dumps(fact, ensure_ascii=False))


def opened(file: str, gate: Gate, factor: float | None = None, out: str | None = None) -> Baseline:
    """Read an earlier answer of the command of a gate, which writes into the folder ``out``, if that is given.

    Raises:
        FileNotFoundError: there is no such file.
        IsADirectoryError: it is a folder.
        ValueError: it is no JSON, or no answer of this command, or may be written over.
    """
    path = Path(file)
    if path.is_dir():
        raise IsADirectoryError(f"the baseline '{short(file)}' is a folder; a file is accepted.")
    if not path.exists():
        raise FileNotFoundError(f"there is no baseline '{short(file)}'; a file is accepted.")
    if out is not None and path.resolve().parent == Path(out).resolve():
        raise ValueError(
            f"the baseline '{short(file)}' lies in the folder that is written, and would be lost; one elsewhere is "
            "accepted."
        )
    document = _document(file, path.read_bytes())
    try:
        return Baseline(file, gate, factor, gate.facts(document), _by_name(gate.entries(document, factor)))
    except (LookupError, TypeError, AttributeError, ValueError, ArithmeticError):
        raise ValueError(
            f"the baseline '{short(file)}' is no answer of this command; what 'python -m compare {gate.command}' "
            "prints with --format json is accepted."
        ) from None


def _document(file: str, content: bytes) -> Any:
    """The JSON of a file.

    Raises:
        ValueError: it is none.
    """
    if not content.strip():
        raise ValueError(
            f"the baseline '{short(file)}' is empty, as a shell makes the file of '> FILE' before a command reads it; "
            "JSON is accepted."
        )
    try:
        return json.loads(content, parse_constant=_refuse)
    except (ValueError, RecursionError):
        raise ValueError(f"the baseline '{short(file)}' is damaged; JSON is accepted.") from None


def _refuse(word: str) -> NoReturn:
    raise ValueError(word)


def _by_name(entries: Iterable[Entry]) -> dict[str, dict[str, Entry]]:
    """The quantities that have a value, by what they are of.

    Raises:
        ValueError: a value is none that its quantity can have.
    """
    found: dict[str, dict[str, Entry]] = {}
    for entry in entries:
        quantities = found.setdefault(entry.of, {})
        if entry.value is not None:
            if not entry.measure.accepts(entry.value):
                raise ValueError(entry.quantity)
            quantities[entry.quantity] = entry
    return found


def document_of(page: Page) -> Any:
    """The JSON of a page, as a program reads it."""
    return json.loads(render(page, "json"))


def noted(data: Any, found: Comparison) -> Any:
    """What the JSON form holds with the comparison in it; a list has no place for it."""
    return Lines({**data.entries, "baseline": found.data}) if isinstance(data.entries, dict) else data


def with_comparison(page: Page, found: Comparison) -> Page:
    """The page with the comparison at its end."""
    return Page(
        name=page.name,
        blocks=lambda form, width: [*page.blocks(form, width), found.table],
        data=lambda: noted(page.data(), found),
        sheets=page.sheets,
        widths=page.widths,
        between=page.between,
        indent=page.indent,
    )


def add_baseline(parser: argparse.ArgumentParser, margin: str = "") -> None:
    """Add its options to a parser; ``margin`` says by which factor errors may grow, where they count."""
    parser.add_argument(
        "--baseline",
        metavar="FILE",
        help="hold the answer against an earlier one, printed with --format json: exit code 1 where it is worse",
    )
    if margin:
        parser.add_argument("--margin", metavar="F", help=f"factor by which an error may grow (default {margin})")


def asked_margin(known: argparse.Namespace) -> float | None:
    """The factor that was given.

    Raises:
        ValueError: it is no number of at least 1, or there is no baseline.
    """
    text = getattr(known, "margin", None)
    if text is None:
        return None
    if known.baseline is None:
        raise ValueError("--margin is of a baseline, and none is given; --baseline FILE is accepted with it.")
    try:
        factor = float(text)
    except ValueError:
        factor = math.nan
    if not 1 <= factor < math.inf:
        raise ValueError(f"--margin is '{short(text)}'; a number of at least 1 is accepted.")
    return factor
