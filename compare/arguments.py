"""The command line's words as values: what was asked for, or one sentence on what is wrong with it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from compare import reading
from compare.judge import options as judge
from compare.report import options as report
from compare.solvers import options as solvers
from compare.submission import options as submission
from compare.table import FORMATS
from reference.terminal import Parser, one_of

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable, Sequence

__all__ = ["COMMANDS", "Request", "parse"]

COMMANDS = {
    "pendulum": "score integrators on the pendulum: error against N, observed order, energy drift",
    "list": "list the methods: family, order, stages, source",
    "show": "show a method: its tableau or its flows, its proven order, its properties",
    "report": "one page of work and precision: methods and solvers over problems and amplitudes",
    "solvers": "score other people's solvers: error against tolerance, evaluations and seconds, events",
    "score": "judge a file of numbers from any code against the proven truth",
    "check": "measure whether your integrator is what it claims to be",
}

_OPTIONS: dict[str, tuple[str | None, str]] = {
    "--theta0": ("A,B", "amplitudes in rad, between 0 and pi (default 1); may repeat"),
    "--g": ("G", "gravity in m/s^2 (default 9.81)"),
    "--length": ("L", "length in m (default 1)"),
    "--t-end": ("T", "end of the march in s (default 10)"),
    "--methods": ("A,B", "methods by name (default twelve; see 'list'); may repeat"),
    "--n": ("N,M", "numbers of steps (default 128, 256, ... 1048576); may repeat"),
    "--exact": (None, "take numbers as written: decimals, or fractions such as 1/3"),
    "--precision": ("P", "float32, float64 (default), longdouble, float128 or mp:BITS"),
    "--format": ("FORM", f"{', '.join(FORMATS)} (default text)"),
    "--out": ("DIR", "also write the tables, in the chosen format, into this folder"),
    "--plots": (None, "also draw PNG and SVG figures (into DIR, or ./horologium-pendulum)"),
    "--quiet": (None, "nothing on stderr but errors; the tables are printed as ever"),
}
_ROOMS: dict[str, Any] = {"solvers": solvers, "report": report, "check": judge}
"""Commands whose options stand in a room of their own."""
_ACCEPTED = {"pendulum": tuple(_OPTIONS), "list": ("--format",)}
_LISTS = ("--theta0", "--methods", "--n")
_SHOWN = tuple(form for form in FORMATS if form != "csv")
_SHOWN_HELP = f"{', '.join(_SHOWN)} (default text)"
_EPILOG = (
    "A number is read as binary64, as in a program, or with --exact as written.  "
    "A mistake is one sentence on stderr and exit code 2."
)


@dataclass(frozen=True)
class Request:
    """What a command line asks for.

    Attributes:
        command: one of COMMANDS.
        options: arguments of the study, only those that were given; the fields of a submission; the method
            shown; or the arguments of a check.
        form: one of the table formats.
        out: a folder for the results, or None.
        plots: whether figures are drawn.
        quiet: whether stderr stays silent but for errors.
    """

    command: str
    options: dict[str, Any]
    form: str
    out: str | None
    plots: bool
    quiet: bool


def parse(words: Sequence[str]) -> Request:
    """Read a command line.

    Raises:
        ValueError: it cannot be read; the sentence says what is accepted.
    """
    if not words:
        raise ValueError(f"no command is given; {_alternatives(tuple(COMMANDS))} is accepted.")
    known = _parser(words).parse_args(words)
    read: dict[str, Callable[[argparse.Namespace], dict[str, Any]]]
    read = {"pendulum": _study_options, "score": submission.options, "show": _shown_method}
    read |= {command: room.options for command, room in _ROOMS.items()}
    return Request(
        command=known.command,
        options=read[known.command](known) if known.command in read else {},
        form=known.format,
        out=getattr(known, "out", None),
        plots=getattr(known, "plots", False),
        quiet=getattr(known, "quiet", False),
    )


def _parser(words: Sequence[str] = ("score",)) -> Parser:
    """The parser of a command line; what takes time to import is left out where the words do not need it."""
    parser = Parser(prog="python -m compare", description="Score integrators.", epilog=_EPILOG)
    commands = parser.add_subparsers(dest="command", metavar="COMMAND")
    for command, text in COMMANDS.items():
        one = commands.add_parser(command, help=text, description=text, epilog=_EPILOG)
        if command == "score":
            submission.add_options(one, with_families=words[0] == command)
        if command in _ROOMS:
            _ROOMS[command].add_options(one)
        if command == "show":
            one.add_argument("method", metavar="NAME", help="a method by its name or an alias; see 'list'")
            one.add_argument(
                "--format", type=one_of("format", _SHOWN), default="text", metavar="FORM", help=_SHOWN_HELP
            )
        for option in _ACCEPTED.get(command, ()):
            _add(one, option)
    return parser


def _add(parser: argparse.ArgumentParser, option: str) -> None:
    metavar, text = _OPTIONS[option]
    if option == "--format":
        parser.add_argument(option, type=one_of("format", FORMATS), default="text", metavar=metavar, help=text)
    elif metavar is None:
        parser.add_argument(option, action="store_true", help=text)
    else:
        parser.add_argument(option, action="append" if option in _LISTS else "store", metavar=metavar, help=text)


def _shown_method(known: argparse.Namespace) -> dict[str, Any]:
    return {"method": known.method}


def _study_options(known: argparse.Namespace) -> dict[str, Any]:
    number = reading.as_written if known.exact else reading.number
    given: dict[str, Any] = {
        name: reading.several(name, getattr(known, name), read)
        for name, read in (("theta0", number), ("methods", reading.text), ("n", reading.whole))
        if getattr(known, name) is not None
    }
    for name in ("g", "length", "t_end"):
        if getattr(known, name) is not None:
            given[name] = number(getattr(known, name), name.replace("_", "-"))
    if known.precision is not None:
        given["precision"] = known.precision
    return given


def _alternatives(names: Sequence[str]) -> str:
    return " or ".join(filter(None, (", ".join(names[:-1]), names[-1])))
