"""The options of the commands that score methods on a family, from what the family declares of its inputs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from compare.measure.wanted import DEFAULT_SCORES, SCORES
from compare.show.render import FORMATS
from reference.command.terminal import one_of
from reference.command.values import as_written, number, pair, several, text, whole

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable

    from reference.family import End, Family, Input

__all__ = ["FamilyOptions", "inputs_given", "inputs_offered"]

LEAST_N = 128
SEVERAL: dict[str, Any] = {"action": "append", "metavar": "A,B"}


def inputs_offered(family: Family, parser: argparse.ArgumentParser, known: set[str] | None = None) -> None:
    """Add a family's inputs, of which one may be given several times, to a parser that has the ``known`` ones."""
    comparison = family.comparison
    for name in (comparison.varied, *comparison.inputs):
        wanted = family.input(name)
        if known is not None and name in known:
            continue
        varies = name == comparison.varied
        units = f", in {wanted.units}" if wanted.units not in {"", "1"} else ""
        default = ", ".join(map(_typed, comparison.values)) if varies else wanted.default
        told = f"{wanted.help}{units}{f' (default {default})' if default else ''}{'; may repeat' if varies else ''}"
        parser.add_argument(
            f"--{name}",
            action="append" if varies else "store",
            metavar="X,Y" if wanted.kind == "pair" else "A,B" if varies else name.upper(),
            help=told.replace("%", "%%"),
        )


def _typed(value: Any) -> str:
    return ",".join(f"{part:g}" for part in value) if isinstance(value, tuple) else str(value)


def inputs_given(family: Family, known: argparse.Namespace) -> dict[str, Any]:
    """The family's inputs that were given, as values."""
    comparison = family.comparison
    found = {}
    for name in (comparison.varied, *comparison.inputs):
        words = getattr(known, name)
        if words is not None:
            found[name] = _value(family.input(name), words, exact=known.exact)
    return found


def _value(wanted: Input, words: Any, *, exact: bool) -> Any:
    """The words of an input as a value, or as several where there is a list of them."""
    read = as_written if exact else number
    if wanted.kind == "pair":
        return tuple(pair(word, wanted.name, read) for word in words)
    reader: Callable[[str, str], Any] = text if wanted.kind == "text" else read
    return several(wanted.name, words, reader) if isinstance(words, list) else reader(words, wanted.name)


@dataclass(frozen=True)
class FamilyOptions:
    """The options of a family's command."""

    family: Family

    @property
    def _ends(self) -> dict[str, End]:
        return {marching.end.name: marching.end for _, marching in self.family.comparison.forms}

    @property
    def _forms(self) -> list[str]:
        return [name for name, _ in self.family.comparison.forms if name]

    def add_options(self, parser: argparse.ArgumentParser) -> None:
        """Add them to a parser."""
        comparison = self.family.comparison
        inputs_offered(self.family, parser)
        if self._forms:
            told = f"{', '.join(self._forms)}; default all; may repeat"
            parser.add_argument("--form", **SEVERAL, help=f"forms of the equations: {told}")
        for name, end in self._ends.items():
            parser.add_argument(f"--{name.replace('_', '-')}", metavar=name.partition("_")[0].upper(), help=end.help)
        parser.add_argument(
            "--methods", **SEVERAL, help="methods by name (default twelve; see 'list'), or all; may repeat"
        )
        powers = f"{LEAST_N}, {2 * LEAST_N}, ... {comparison.largest}"
        parser.add_argument("--n", **SEVERAL, help=f"numbers of steps (default {powers}); may repeat")
        scores = f"{', '.join(SCORES)} (default {', '.join(DEFAULT_SCORES)})"
        parser.add_argument("--scores", **SEVERAL, help=f"what is shown: {scores}; may repeat")
        flags = {
            "exact": "take numbers as written: decimals, or fractions such as 1/3",
            "compensated": "beside each method the same with compensated summation",
            "plots": f"also draw PNG and SVG figures (into DIR, or ./horologium-{comparison.command})",
            "quiet": "nothing on stderr but errors; the tables are printed as ever",
        }
        precision = "float32, float64 (default), longdouble, float128 or mp:BITS"
        parser.add_argument("--precision", metavar="P", help=precision)
        shown = f"{', '.join(FORMATS)} (default text)"
        parser.add_argument("--format", type=one_of("format", FORMATS), default="text", metavar="FORM", help=shown)
        into = "also write the tables, in the chosen format, into this folder"
        parser.add_argument("--out", metavar="DIR", help=into)
        for name, told in flags.items():
            parser.add_argument(f"--{name}", action="store_true", help=told)

    def options(self, known: argparse.Namespace) -> dict[str, Any]:
        """The arguments of the study, only those that were given."""
        given = inputs_given(self.family, known)
        for name in self._ends:
            if getattr(known, name) is not None:
                given[name] = (as_written if known.exact else number)(getattr(known, name), name.replace("_", "-"))
        readers: dict[str, Callable[[str, str], Any]] = {"methods": text, "n": whole, "scores": text}
        readers |= {"form": text} if self._forms else {}
        for name, read in readers.items():
            if getattr(known, name) is not None:
                given[name] = several(name, getattr(known, name), read)
        if known.precision is not None:
            given["precision"] = known.precision
        if known.compensated:
            given["compensated"] = "beside"
        return given
