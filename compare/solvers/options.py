"""The options of ``python -m compare solvers``, without what takes time to import."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.options import inputs_given, inputs_offered
from compare.show.render import FORMATS
from reference.command import values
from reference.command.terminal import one_of
from reference.problems.families import USUAL, find_family

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from reference.family import Family

__all__ = ["add_options", "options"]


def add_options(parser: argparse.ArgumentParser, families: Sequence[Family]) -> None:
    """Add them to a parser, the inputs of the families among them."""
    several: dict[str, Any] = {"action": "append", "metavar": "A,B"}
    parser.add_argument("--problem", default=USUAL, metavar="NAME", help=f"family of problems (default {USUAL})")
    inputs_offered(families, parser)
    parser.add_argument("--t-end", metavar="T", help="the last time in s, or in the problem's unit (default 10)")
    parser.add_argument("--rtol", **several, help="tolerances (default 1e-3, 1e-5, ... 1e-11); may repeat")
    parser.add_argument("--solvers", **several, help="solvers or packages by name (default all); may repeat")
    parser.add_argument("--max-evaluations", metavar="N", help="granted for one answer (default 150000)")
    parser.add_argument("--exact", action="store_true", help="take numbers as written: decimals, or fractions")
    parser.add_argument(
        "--format",
        type=one_of("format", FORMATS),
        default="text",
        metavar="FORM",
        help=f"{', '.join(FORMATS)} (default text)",
    )
    parser.add_argument("--out", metavar="DIR", help="also write the tables, in the chosen format, into this folder")
    parser.add_argument(
        "--plots", action="store_true", help="also draw PNG and SVG figures (into DIR, or ./horologium-solvers)"
    )
    parser.add_argument("--quiet", action="store_true", help="nothing on stderr but errors")


def options(known: argparse.Namespace, families: Sequence[Family]) -> dict[str, Any]:
    """What was given, as arguments of ``compare.solvers.study.study``."""
    family = find_family(known.problem)
    given: dict[str, Any] = {"problem": family, **inputs_given(family, known, families)}
    for name, read in (("rtol", values.number), ("solvers", values.text)):
        if getattr(known, name) is not None:
            given[name] = values.several(name, getattr(known, name), read)
    if known.t_end is not None:
        given["t_end"] = (values.as_written if known.exact else values.number)(known.t_end, "t-end")
    if known.max_evaluations is not None:
        given["max_evaluations"] = values.whole(known.max_evaluations, "max-evaluations", "number of evaluations")
    return given
