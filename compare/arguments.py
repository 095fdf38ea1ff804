"""The command line's words as values: what was asked for, or one sentence on what is wrong with it."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import takewhile
from typing import TYPE_CHECKING, Any

from compare.baseline import asked_margin
from compare.claims import options as claims
from compare.files import options as files
from compare.options import FamilyOptions, families_of
from compare.report import options as report
from compare.show.render import FORMATS
from compare.solvers import options as solvers
from compare.sources.errata import options as errata
from compare.sources.published import options as published
from reference.command.terminal import Parser, one_of
from reference.named import is_own

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from reference.family import Family

__all__ = ["COMMANDS", "Request", "parse", "parser_for"]

COMMANDS = {
    "list": "list the methods: family, order, stages, source",
    "show": "show a method: its tableau or its flows, its proven order, its properties",
    "report": "one page of work and precision: methods and solvers over problems and amplitudes",
    "published": "the tables that two sources print: published, reproduced, exact",
    "errata": "what two sources print wrong, what is right, and whether its check confirms it",
    "solvers": "score other people's solvers: error against tolerance, evaluations and seconds, events",
    "score": "judge a file of numbers from any code against the proven truth",
    "check": "measure whether your integrator is what it claims to be",
}
"""Besides these every family of problems has a command, in which methods are scored on it."""
_OPTIONS: dict[str, Any] = {
    "solvers": solvers,
    "report": report,
    "check": claims,
    "errata": errata,
    "published": published,
    "score": files,
}
"""Where the options of a command stand."""
_OF_A_PROBLEM = frozenset({"solvers", "score", "check"})
"""Commands that take --problem, and the inputs of its family."""
_SHOWN = tuple(form for form in FORMATS if form != "csv")
_FORMATS_HELP, _SHOWN_HELP = f"{', '.join(FORMATS)} (default text)", f"{', '.join(_SHOWN)} (default text)"
_MISTAKE = "A mistake is one sentence on stderr and exit code 2."
_EPILOG = f"A number is read as binary64, as in a program, or with --exact as written.  {_MISTAKE}"
_WITHOUT_NUMBERS = frozenset({"list", "show", "report", "published", "errata", "check"})
"""Commands that take no exact numbers."""


@dataclass(frozen=True)
class Request:
    """What a command line asks for.

    Attributes:
        command: one of COMMANDS, or that of a family.
        family: the family of the problems that methods are scored on, or None.
        options: arguments of the study, only those that were given; the fields of a submission; the method
            shown; or the arguments of a check.
        form: one of the table formats.
        out: a folder for the results, or None.
        plots: whether figures are drawn.
        quiet: whether stderr stays silent but for errors.
        baseline: the file of an earlier answer that this one is held against, or None.
        margin: the factor by which errors may grow, or None for the command's own.
    """

    command: str
    family: Family | None
    options: dict[str, Any]
    form: str
    out: str | None
    plots: bool
    quiet: bool
    baseline: str | None
    margin: float | None


def parse(words: Sequence[str]) -> Request:
    """Read a command line.

    Raises:
        ValueError: it cannot be read; the sentence says what is accepted.
    """
    if not words:
        names = [command for command, family in _families().items() if family.has_closed_form]
        raise ValueError(f"no command is given; {_alternatives((*names, *COMMANDS, 'a flow'))} is accepted.")
    words = _with_problems(words)
    known = parser_for(words).parse_args(words)
    family = getattr(known, "family", None)
    if family is not None:
        options = FamilyOptions(family).options(known)
    elif known.command in _OPTIONS:
        options = _OPTIONS[known.command].options(known, *_asked(words))
    else:
        options = _shown_method(known) if known.command == "show" else {}
    return Request(
        command=known.command if family is None else family.comparison.command,
        family=family,
        options=options,
        form=known.format,
        out=getattr(known, "out", None),
        plots=getattr(known, "plots", False),
        quiet=getattr(known, "quiet", False),
        baseline=getattr(known, "baseline", None),
        margin=asked_margin(known),
    )


def _with_problems(words: Sequence[str]) -> list[str]:
    """The words, with --problem before each name of a problem that stands right behind ``solvers``."""
    first, rest = words[0], list(words[1:])
    names = list(takewhile(lambda word: not word.startswith("-"), rest)) if first == "solvers" else []
    return [first, *(word for name in names for word in ("--problem", name)), *rest[len(names) :]]


def _asked(words: Sequence[str]) -> tuple[tuple[Family, ...], ...]:
    """The families whose inputs a command takes, where it takes those of any."""
    return (families_of(words),) if words[0] in _OF_A_PROBLEM else ()


def _families(word: str = "") -> dict[str, Family]:
    """The families by their commands; one of the user's own by the word that says where it is."""
    from reference.problems.families import FAMILIES, find_family

    if is_own(word):
        return {word: find_family(word)}
    return {family.comparison.command: family for family in FAMILIES}


def parser_for(words: Sequence[str]) -> Parser:
    """The parser of a command line; what takes time to import is left out where its words do not need it."""
    families = {} if words[0] in COMMANDS else _families(words[0])
    flows = [command for command, family in families.items() if not family.has_closed_form]
    described = f"Score integrators, also on these flows, by their names: {', '.join(flows)}."
    parser = Parser(prog="python -m compare", description=described if flows else "Score integrators.", epilog=_EPILOG)
    commands = parser.add_subparsers(dest="command", metavar="COMMAND")
    for command, family in families.items():
        told = family.comparison.help
        listed: dict[str, Any] = {"help": told} if family.has_closed_form else {}
        one = commands.add_parser(command, **listed, description=told, epilog=_EPILOG)
        if command == words[0]:
            FamilyOptions(family).add_options(one)
        one.set_defaults(family=family)
    for command, told in COMMANDS.items():
        epilog = _MISTAKE if command in _WITHOUT_NUMBERS else _EPILOG
        one = commands.add_parser(command, help=told, description=told, epilog=epilog)
        if command == words[0] and command in _OPTIONS:
            _OPTIONS[command].add_options(one, *_asked(words))
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
