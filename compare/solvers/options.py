"""The options of ``python -m compare solvers``, without what takes time to import."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.baseline import add_baseline
from compare.options import inputs_given, inputs_offered
from compare.show.render import FORMATS
from compare.solvers.regression import ERROR_FACTOR
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
    parser.add_argument(
        "--problem",
        action="append",
        metavar="NAME",
        help=f"family of problems, as is each name right behind 'solvers' (default {USUAL}); of several there is one "
        "table",
    )
    inputs_offered(families, parser)
    parser.add_argument(
        *("--t-end", "--t"),
        metavar="T",
        help="the last time in s, or in the problem's unit (default 10, or the problem's own); T,T of several",
    )
    parser.add_argument("--rtol", **several, help="tolerances (default 1e-3, 1e-5, ... 1e-11); may repeat")
    parser.add_argument("--solvers", **several, help="solvers or packages by name (default all); may repeat")
    parser.add_argument("--max-evaluations", metavar="N", help="granted for one answer (default 150000)")
    parser.add_argument("--exact", action="store_true", help="take numbers as written: decimals, or fractions")
    add_baseline(parser, f"{ERROR_FACTOR:g}")
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
    """What was given, as arguments of ``compare.solvers.study.study``; of several problems those of each, as "several".

    Raises:
        ValueError: an option cannot be read, is another family's, or has no meaning for several problems.
    """
    chosen = [find_family(name) for name in known.problem or [USUAL]]
    given: dict[str, Any] = {}
    for name, read in (("rtol", values.number), ("solvers", values.text)):
        if getattr(known, name) is not None:
            given[name] = values.several(name, getattr(known, name), read)
    if known.max_evaluations is not None:
        given["max_evaluations"] = values.whole(known.max_evaluations, "max-evaluations", "number of evaluations")
    ends = _ends(known, len(chosen))
    asked = [
        {"problem": family, **inputs_given(family, known, families), **given, **end}
        for family, end in zip(chosen, ends, strict=True)
    ]
    if len(asked) == 1:
        return asked[0]
    return {"several": asked}


def _ends(known: argparse.Namespace, count: int) -> list[dict[str, Any]]:
    """The last time of each problem, where it is given.

    Raises:
        ValueError: there are neither one nor as many as problems.
    """
    if known.t_end is None:
        return [{}] * count
    read = values.as_written if known.exact else values.number
    ends = [{"t_end": read(piece.strip(), "t-end")} for piece in known.t_end.split(",")]
    if len(ends) not in {1, count}:
        accepted = "one is" if count == 1 else f"one, or {count} are"
        raise ValueError(f"--t-end has {len(ends)} times; {accepted} accepted.")
    return ends if len(ends) == count else ends * count
