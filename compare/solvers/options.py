"""The options of ``python -m compare solvers``, without what takes time to import."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.show.render import FORMATS
from reference.command import values
from reference.command.terminal import one_of

if TYPE_CHECKING:
    import argparse

__all__ = ["add_options", "options"]


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add them to a parser."""
    several: dict[str, Any] = {"action": "append", "metavar": "A,B"}
    parser.add_argument("--theta0", **several, help="amplitudes in rad, between 0 and pi (default 1); may repeat")
    parser.add_argument("--g", metavar="G", help="gravity in m/s^2 (default 9.81)")
    parser.add_argument("--length", metavar="L", help="length in m (default 1)")
    parser.add_argument("--t-end", metavar="T", help="the last time in s (default 10)")
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


def options(known: argparse.Namespace) -> dict[str, Any]:
    """What was given, as arguments of ``compare.solvers.study.study``."""
    number = values.as_written if known.exact else values.number
    given: dict[str, Any] = {
        name: values.several(name, getattr(known, name), read)
        for name, read in (("theta0", number), ("rtol", values.number), ("solvers", values.text))
        if getattr(known, name) is not None
    }
    for name in ("g", "length", "t_end"):
        if getattr(known, name) is not None:
            given[name] = number(getattr(known, name), name.replace("_", "-"))
    if known.max_evaluations is not None:
        given["max_evaluations"] = values.whole(known.max_evaluations, "max-evaluations", "number of evaluations")
    return given
