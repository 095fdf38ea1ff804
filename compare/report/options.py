"""The options of ``python -m compare report``, without what takes time to import."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from compare.baseline import add_baseline
from compare.options import NONE, controlled_offered, methods_given, methods_offered
from compare.report.regression import ERROR_FACTOR
from compare.show.render import FORMATS
from compare.solvers.regression import ERROR_FACTOR as FACTOR_OF_SOLVERS
from reference.command import values
from reference.command.terminal import one_of

if TYPE_CHECKING:
    import argparse

__all__ = ["DEFAULT_FOLDER", "add_options", "options"]

DEFAULT_FOLDER = "horologium-report"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add them to a parser."""
    several: dict[str, Any] = {"action": "append", "metavar": "A,B"}
    told = "families of problems (default: those with a closed form; flows by their names); may repeat"
    parser.add_argument("--problems", **several, help=told)
    parser.add_argument(
        "--amplitudes",
        **several,
        help="how far from rest they start, or curves of descents by name (default: each family's own)",
    )
    methods_offered(parser, "a dozen")
    controlled_offered(parser, tolerances=False)
    parser.add_argument("--solvers", **several, help="solvers or packages by name (default all), or none; may repeat")
    parser.add_argument("--n", **several, help="numbers of steps (default 128, 256, ... 131072); may repeat")
    parser.add_argument("--rtol", **several, help="tolerances (default 1e-3, 1e-4, ... 1e-13); may repeat")
    parser.add_argument(
        "--t-end", metavar="T", help="the last time in s (default 10); curves and descents end where they do"
    )
    parser.add_argument("--max-evaluations", metavar="N", help="granted to a solver for one answer (default 200000)")
    parser.add_argument("--jobs", metavar="N", help="how many at a time (default: all processors)")
    parser.add_argument("--executor", default="process", metavar="NAME", help="process, dask:ADDRESS or mpi")
    add_baseline(parser, f"{ERROR_FACTOR:g}, of solvers {FACTOR_OF_SOLVERS:g}")
    parser.add_argument(
        "--format",
        type=one_of("format", FORMATS),
        default="text",
        metavar="FORM",
        help=f"of what is printed: {', '.join(FORMATS)} (default text)",
    )
    parser.add_argument(
        "--out",
        default=DEFAULT_FOLDER,
        metavar="DIR",
        help=f"the folder of the page, its figures and its numbers (default ./{DEFAULT_FOLDER})",
    )
    parser.add_argument("--quiet", action="store_true", help="nothing on stderr but errors")


def options(known: argparse.Namespace) -> dict[str, Any]:
    """What was given: "plan", the arguments of ``compare.report.run.plan``, and those of ``run``."""
    given: dict[str, Any] = {
        name: values.several(name, getattr(known, name), read)
        for name, read in (
            ("problems", values.text),
            ("amplitudes", _amplitude),
            ("adaptive", values.text),
            ("controllers", values.text),
            ("solvers", values.text),
            ("n", values.whole),
            ("rtol", values.number),
        )
        if getattr(known, name) is not None
    }
    if "controllers" in given and "adaptive" not in given:
        raise ValueError("--controllers is of pairs with a controlled step; --adaptive says which.")
    given |= {"solvers": ()} if given.get("solvers") == NONE else {}
    given |= methods_given(known)
    if known.t_end is not None:
        given["t_end"] = values.number(known.t_end, "t-end")
    if known.max_evaluations is not None:
        given["max_evaluations"] = values.whole(known.max_evaluations, "max-evaluations", "number of evaluations")
    jobs = os.cpu_count() or 1 if known.jobs is None else values.whole(known.jobs, "jobs", "number of processes")
    return {"plan": given, "jobs": jobs, "executor": known.executor}


def _amplitude(piece: str, name: str) -> float | str:
    """A number, or the name of a curve."""
    return piece if piece.replace("_", "").isalpha() else values.number(piece, name)
