"""The command line's words as values: what was asked for, or one sentence on what is wrong with it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from compare.claims import options as claims
from compare.files import options as files
from compare.report import options as report
from compare.show.render import FORMATS
from compare.solvers import options as solvers
from compare.sources.errata import options as errata
from compare.sources.published import options as published
from compare.studies import options as studies
from reference.command.terminal import Parser, one_of

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable, Sequence

__all__ = ["COMMANDS", "Request", "parse"]

COMMANDS = {
    "pendulum": "score integrators on the pendulum: error against N, observed order, energy drift",
    "brachistochrone": "score them on the cycloid of quickest descent: as a motion, and as a curve dx/dy",
    "tautochrone": "score them on Huygens' pendulum: by its angle, and by its arc length",
    "descent": "score them on the descent along a curve without friction",
    "polar": "score them on the brachistochrone of a point mass: in time, in z and in psi",
    "list": "list the methods: family, order, stages, source",
    "show": "show a method: its tableau or its flows, its proven order, its properties",
    "report": "one page of work and precision: methods and solvers over problems and amplitudes",
    "published": "the tables that two sources print: published, reproduced, exact",
    "errata": "what two sources print wrong, what is right, and whether its check confirms it",
    "solvers": "score other people's solvers: error against tolerance, evaluations and seconds, events",
    "score": "judge a file of numbers from any code against the proven truth",
    "check": "measure whether your integrator is what it claims to be",
}

_ROOMS: dict[str, Any] = {
    **studies.ROOMS,
    "solvers": solvers,
    "report": report,
    "check": claims,
    "errata": errata,
    "published": published,
}
"""Commands whose options stand in a room of their own."""
_SHOWN = tuple(form for form in FORMATS if form != "csv")
_FORMATS_HELP, _SHOWN_HELP = f"{', '.join(FORMATS)} (default text)", f"{', '.join(_SHOWN)} (default text)"
_MISTAKE = "A mistake is one sentence on stderr and exit code 2."
_EPILOG = f"A number is read as binary64, as in a program, or with --exact as written.  {_MISTAKE}"
_NUMBERS = frozenset({*studies.ROOMS, "solvers", "score"})
"""Commands that take exact numbers."""


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
    read = {"score": files.options, "show": _shown_method}
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
        epilog = _EPILOG if command in _NUMBERS else _MISTAKE
        one = commands.add_parser(command, help=text, description=text, epilog=epilog)
        if command == "score":
            files.add_options(one, with_families=words[0] == command)
        if command in _ROOMS:
            _ROOMS[command].add_options(one)
        if command == "show":
            one.add_argument("method", metavar="NAME", help="a method by its name or an alias; see 'list'")
            one.add_argument(
                "--format", type=one_of("format", _SHOWN), default="text", metavar="FORM", help=_SHOWN_HELP
            )
        if command == "list":
            one.add_argument(
                "--format", type=one_of("format", FORMATS), default="text", metavar="FORM", help=_FORMATS_HELP
            )
    return parser


def _shown_method(known: argparse.Namespace) -> dict[str, Any]:
    return {"method": known.method}


def _alternatives(names: Sequence[str]) -> str:
    return " or ".join(filter(None, (", ".join(names[:-1]), names[-1])))
