"""The options of ``python -m compare check``, without what takes time to import."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from reference.command.terminal import one_of
from reference.names import short

if TYPE_CHECKING:
    import argparse

__all__ = ["add_options", "options"]

FORMATS = ("text", "json")
FORMS = ("step", "timed", "separable", "integrator")


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add them to a parser."""
    parser.add_argument("step", metavar="MODULE:STEP", help="the function, in a module or in FILE.py:STEP")
    parser.add_argument("--order", metavar="P", help="claim this order")
    parser.add_argument("--symplectic", action="store_true", help="claim that it is symplectic")
    parser.add_argument("--reversible", action="store_true", help="claim that it is reversible")
    parser.add_argument(
        "--form",
        type=one_of("form", FORMS),
        metavar="FORM",
        help="step (f, y, h), timed (f, t, y, h), separable (q, p, force, h), integrator (f, y0, t)",
    )
    parser.add_argument("--seconds", metavar="S", help="give up after so long (default 60)")
    parser.add_argument("--format", type=one_of("format", FORMATS), default="text", help="text (default) or json")


def options(known: argparse.Namespace) -> dict[str, Any]:
    """What was given, as the arguments of ``compare.check``, the function still by name."""
    given: dict[str, Any] = {
        "step": known.step,
        "order": None if known.order is None else _positive("order", known.order),
        "symplectic": known.symplectic or None,
        "reversible": known.reversible or None,
        "form": known.form,
    }
    if known.seconds is not None:
        given["seconds"] = _positive("seconds", known.seconds)
    return given


def _positive(name: str, text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0 < value < math.inf:
        raise ValueError(f"--{name} is '{short(text)}'; a positive number is accepted.")
    return value
