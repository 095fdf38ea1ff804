"""The options of ``python -m compare score``, without what takes time to import."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from compare.baseline import add_baseline
from compare.files.columns import asked_columns
from compare.files.limits import ERROR_FACTOR, Limits
from compare.files.lines import Passed
from compare.show.render import FORMATS
from reference.command.terminal import one_of
from reference.command.values import positive
from reference.names import short
from reference.problems.families import USUAL

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from reference.family import Family

__all__ = ["add_options", "options"]

FORMS = (*FORMATS, "html")
SHOWN_ROWS = 24
SETTINGS = (
    *("file", "problem", "columns", "skip", "comment", "rows", "exact", "min_digits", "max_error"),
    *("baseline", "margin", "format", "quiet", "command"),
)


def add_options(parser: argparse.ArgumentParser, families: Sequence[Family]) -> None:
    """Add them to a parser, the inputs of the families among them."""
    parser.add_argument("file", metavar="FILE", help="CSV, JSON, NPY, NPZ or HDF5; - reads text from standard input")
    parser.add_argument("--problem", default=USUAL, metavar="NAME", help=f"family of problems (default {USUAL})")
    parser.add_argument("--columns", metavar="A,B,C", help="the file's names of the time and the state")
    parser.add_argument("--skip", metavar="N", help="lines of a text before its table begins")
    parser.add_argument("--comment", metavar="C", help="what begins a comment, besides #, %% and !")
    parser.add_argument("--rows", metavar="N", help=f"rows shown at most (default {SHOWN_ROWS}; CSV shows all)")
    parser.add_argument("--exact", action="store_true", help="take parameters and times as written, not as doubles")
    parser.add_argument("--min-digits", metavar="D", help="exit code 1 where a row has fewer correct digits on scale")
    parser.add_argument("--max-error", metavar="E", help="exit code 1 where a row has a larger error")
    add_baseline(parser, f"{ERROR_FACTOR:g}")
    parser.add_argument("--format", type=one_of("format", FORMS), default="text", help=", ".join(FORMS))
    parser.add_argument("--quiet", action="store_true", help="nothing on stderr but errors")
    texts: dict[str, str] = {}
    for family in families:
        for wanted in family.inputs:
            if not wanted.over:
                default = "" if wanted.default is None else f" (default {wanted.default})"
                units = f", {wanted.units}" if wanted.units else ""
                texts.setdefault(wanted.name, f"{wanted.help}{units}{default}")
    for name, text in texts.items():
        parser.add_argument(f"--{name}", metavar=name.upper(), help=text)


def options(known: argparse.Namespace, families: Sequence[Family]) -> dict[str, Any]:
    """What was given, as the fields of a ``Submission``."""
    del families
    return {
        "file": known.file,
        "family": known.problem,
        "inputs": {name: text for name, text in vars(known).items() if name not in SETTINGS and text is not None},
        "exact": known.exact,
        "columns": None if known.columns is None else asked_columns(known.columns),
        "passed": Passed(
            0 if known.skip is None else _count(known.skip, "--skip"),
            "" if known.comment is None else _mark(known.comment),
        ),
        "rows": SHOWN_ROWS if known.rows is None else _count(known.rows, "--rows"),
        "form": known.format,
        "limits": Limits(
            None if known.min_digits is None else positive(known.min_digits, "min-digits"),
            None if known.max_error is None else positive(known.max_error, "max-error"),
        ),
    }


def _count(text: str, option: str) -> int:
    count = int(text) if text.isascii() and text.isdigit() and len(text) < 10 else 0
    if not count:
        raise ValueError(f"{option} is '{short(text)}'; a positive integer is accepted.")
    return count


def _mark(text: str) -> str:
    mark = text.strip()
    if not mark or re.match(r"[+−-]?[.,]?(?:\d|$)", mark):  # a row may begin so
        raise ValueError(f"--comment is '{short(text)}'; what begins a comment is accepted, such as ';' or '//'.")
    return mark
