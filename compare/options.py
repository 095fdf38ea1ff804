"""The options of the commands that score methods on a family, from what the family declares of its inputs."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from compare.measure.wanted import DEFAULT_SCORES, SCORES
from compare.show.render import FORMATS
from reference.command.terminal import one_of
from reference.command.values import as_written, number, pair, several, text, whole
from reference.family import LEAST_N
from reference.names import short, unknown

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable, Sequence

    from reference.family import End, Family

__all__ = [
    "NONE",
    "FamilyOptions",
    "controlled_given",
    "controlled_offered",
    "families_of",
    "inputs_given",
    "inputs_offered",
    "methods_given",
    "methods_offered",
]

SEVERAL: dict[str, Any] = {"action": "append", "metavar": "A,B"}
NONE = ("none",)
"""What asks for no method, or for no solver."""


def families_of(words: Sequence[str]) -> tuple[Family, ...]:
    """The families whose inputs a command line may have: those that it names with --problem.

    One that names none may have those of all families with a closed form; but a check is then of the usual problem,
    and none is imported for it.

    Raises:
        ValueError: there is none of a name.
        FileNotFoundError, ImportError: the user's module that it names cannot be imported.
    """
    if words[0] == "check" and not any(word.startswith("--problem") for word in words):
        return ()
    from reference.problems.families import FAMILIES, find_family

    following = [after for word, after in pairwise(words) if word == "--problem" and not after.startswith("-")]
    names = [*following, *(word.partition("=")[2] for word in words if word.startswith("--problem="))]
    return tuple(map(find_family, names)) or tuple(family for family in FAMILIES if family.has_closed_form)


def inputs_offered(families: Sequence[Family], parser: argparse.ArgumentParser) -> None:
    """Add the inputs of families to a parser, each name once."""
    offered: dict[str, str] = {}
    for family in families:
        comparison = family.comparison
        for name in (comparison.varied, *comparison.inputs):
            if name not in offered:
                wanted, varies = family.input(name), name == comparison.varied
                units = f", in {wanted.units}" if wanted.units not in {"", "1"} else ""
                default = ", ".join(map(_typed, comparison.values)) if varies else wanted.default
                default = f" (default {default})" if default and "(default" not in wanted.help else ""
                offered[name] = f"{wanted.help}{units}{default}{'; may repeat' if varies else ''}"
                metavar = "X,Y" if wanted.kind == "pair" else "A,B" if varies else name.upper()
                parser.add_argument(
                    f"--{name}", action="append", metavar=metavar, help=offered[name].replace("%", "%%")
                )


def methods_offered(parser: argparse.ArgumentParser, default: str) -> None:
    """Add the options that choose methods, the user's own among them."""
    told = f"methods by name (default {default}; see 'list'), or all, or none; may repeat"
    parser.add_argument("--methods", **SEVERAL, help=told)
    own = "a function of your own beside them, FILE.py:STEP: (f, y, h), (f, t, y, h), (q, p, force, h) or (f, y0, t); "
    parser.add_argument("--method", action="append", metavar="MODULE:STEP", help=f"{own}may repeat")
    order = "the order that it claims, or of several --method each one's"
    parser.add_argument("--claims", action="append", metavar="P,Q", help=order)


def methods_given(known: argparse.Namespace) -> dict[str, Any]:
    """The methods that were asked for, by name, and the user's own as they are; nothing where none is named.

    Raises:
        ValueError, FileNotFoundError, ImportError: one of the user's own is not there, or is no method.
    """
    named = None if known.methods is None else several("methods", known.methods, text)
    if known.method is None:
        if known.claims is not None:
            raise ValueError("--claims is the order of a function of your own; --method MODULE:STEP says which.")
        return {} if named is None else {"methods": () if named == NONE else named}
    from compare.methods import DEFAULT, own_methods

    pieces = [piece.strip() for word in known.claims or () for piece in word.split(",")]
    own = own_methods(known.method, [_order(piece) for piece in pieces])
    return {"methods": (*(DEFAULT if named is None else () if named == NONE else named), *own)}


def controlled_offered(parser: argparse.ArgumentParser, *, tolerances: bool = True) -> None:
    """Add the options that choose embedded pairs with a controlled step; and their tolerances."""
    told = "embedded pairs by name, or all, that march with a controlled step beside the methods; may repeat"
    parser.add_argument("--adaptive", **SEVERAL, help=told)
    told = "controllers of their steps: i, pi, pid (the default), h211pi, h211b, h312b, h321; may repeat"
    parser.add_argument("--controllers", **SEVERAL, help=told)
    if tolerances:
        parser.add_argument("--rtol", **SEVERAL, help="their tolerances (default 1e-3, 1e-4, ... 1e-11); may repeat")
        parser.add_argument("--atol", **SEVERAL, help="absolute ones, one or as many as of rtol (default as rtol)")
        parser.add_argument("--max-attempts", metavar="N", help="at a step that a march is granted (default 200000)")


def controlled_given(known: argparse.Namespace) -> dict[str, Any]:
    """What was asked of pairs with a controlled step, as arguments of ``compare.controlled.controlled``.

    Raises:
        ValueError: one cannot be read, or no pair is named.
    """
    readers: dict[str, Callable[[str, str], Any]] = {"adaptive": text, "controllers": text, "rtol": number}
    readers["atol"] = number
    given: dict[str, Any] = {
        name: several(name, getattr(known, name), read)
        for name, read in readers.items()
        if getattr(known, name) is not None
    }
    if known.max_attempts is not None:
        given["max_attempts"] = whole(known.max_attempts, "max-attempts", "number of attempts")
    if given and "adaptive" not in given:
        option = next(iter(given)).replace("_", "-")
        raise ValueError(f"--{option} is of pairs with a controlled step; --adaptive says which.")
    return given


def _order(piece: str) -> int:
    if not piece.isdecimal() or not int(piece):
        raise ValueError(f"--claims '{short(piece)}' is no order; a positive integer is accepted.")
    return int(piece)


def _typed(value: Any) -> str:
    return ",".join(f"{part:g}" for part in value) if isinstance(value, tuple) else str(value)


def inputs_given(family: Family, known: argparse.Namespace, offered: Sequence[Family]) -> dict[str, Any]:
    """The family's inputs that were given, as values.

    Raises:
        ValueError: an input of another family was given, or one cannot be read.
    """
    own = (family.comparison.varied, *family.comparison.inputs)
    others = {name for other in offered for name in (other.comparison.varied, *other.comparison.inputs)}
    for name in sorted(others - set(own)):
        if getattr(known, name) is not None:
            raise ValueError(unknown("option", f"--{name}", [f"--{accepted}" for accepted in own]))
    return {
        name: _value(family, name, getattr(known, name), exact=known.exact)
        for name in own
        if getattr(known, name) is not None
    }


def _value(family: Family, name: str, words: list[str], *, exact: bool) -> Any:
    """The words of an input: as several values where it varies, else the last of them as a value."""
    wanted, varies = family.input(name), name == family.comparison.varied
    read = as_written if exact else number
    if wanted.kind == "pair":
        pairs = tuple(pair(word, name, read) for word in words)
        return pairs if varies else pairs[-1]
    reader: Callable[[str, str], Any] = text if wanted.kind == "text" else read
    return several(name, words, reader) if varies else reader(words[-1], name)


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
        inputs_offered([self.family], parser)
        if self._forms:
            told = f"{', '.join(self._forms)}; default all; may repeat"
            parser.add_argument("--form", **SEVERAL, help=f"forms of the equations: {told}")
        for name, end in self._ends.items():
            parser.add_argument(f"--{name.replace('_', '-')}", metavar=name.partition("_")[0].upper(), help=end.help)
        methods_offered(parser, "twelve")
        powers = f"{LEAST_N}, {2 * LEAST_N}, ... {comparison.largest}"
        parser.add_argument("--n", **SEVERAL, help=f"numbers of steps (default {powers}); may repeat")
        controlled_offered(parser)
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
        given = inputs_given(self.family, known, [self.family])
        for name in self._ends:
            if getattr(known, name) is not None:
                given[name] = (as_written if known.exact else number)(getattr(known, name), name.replace("_", "-"))
        readers: dict[str, Callable[[str, str], Any]] = {"n": whole, "scores": text}
        readers |= {"form": text} if self._forms else {}
        for name, read in readers.items():
            if getattr(known, name) is not None:
                given[name] = several(name, getattr(known, name), read)
        given |= methods_given(known) | controlled_given(known)
        if known.precision is not None:
            given["precision"] = known.precision
        if known.compensated:
            given["compensated"] = "beside"
        return given
