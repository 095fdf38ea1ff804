"""The options of ``python -m compare check``, without what takes time to import."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.baseline import add_baseline
from compare.options import inputs_given, inputs_offered
from reference.command.terminal import one_of
from reference.command.values import positive
from reference.problems.families import find_family

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from reference.family import Family

__all__ = ["add_options", "options"]

FORMATS = ("text", "json", "junit", "sarif")
FORMS = ("step", "timed", "separable", "integrator")


def add_options(parser: argparse.ArgumentParser, families: Sequence[Family]) -> None:
    """Add them to a parser, the inputs of the families among them."""
    parser.add_argument("step", metavar="MODULE:STEP", help="the function, in a module or in FILE.py:STEP")
    parser.add_argument("--order", metavar="P", help="claim this order")
    parser.add_argument("--backward", action="store_true", help="claim this order for negative steps too")
    parser.add_argument("--symplectic", action="store_true", help="claim that it is symplectic")
    parser.add_argument("--reversible", action="store_true", help="claim that it is reversible")
    parser.add_argument("--conserves", action="store_true", help="claim that it keeps every invariant")
    parser.add_argument(
        "--form",
        type=one_of("form", FORMS),
        metavar="FORM",
        help="step (f, y, h), timed (f, t, y, h), separable (q, p, force, h), integrator (f, y0, t)",
    )
    parser.add_argument(
        "--problem",
        metavar="NAME",
        help="family of what it is tried on, its inputs as options (default: the pendulum released at 1 rad)",
    )
    inputs_offered(families, parser)
    parser.add_argument("--exact", action="store_true", help="take numbers as written, not as doubles")
    parser.add_argument("--seconds", metavar="S", help="give up after so long (default 60)")
    parser.add_argument("--format", type=one_of("format", FORMATS), default="text", help=", ".join(FORMATS))
    add_baseline(parser)


def options(known: argparse.Namespace, families: Sequence[Family]) -> dict[str, Any]:
    """What was given, as the arguments of ``compare.check``, the function still by name."""
    given: dict[str, Any] = {
        "step": known.step,
        "order": None if known.order is None else positive(known.order, "order"),
        "backward": known.backward or None,
        "symplectic": known.symplectic or None,
        "reversible": known.reversible or None,
        "conserves": known.conserves or None,
        "form": known.form,
    }
    if known.problem is not None:
        family = find_family(known.problem)
        inputs = inputs_given(family, known, families)
        if len(several := inputs.get(family.comparison.varied, ())) > 1:
            raise ValueError(f"--{family.comparison.varied} has {len(several)} values; a check is on one.")
        given["problem"] = {"family": known.problem, "inputs": {name: _plain(value) for name, value in inputs.items()}}
    if known.seconds is not None:
        given["seconds"] = positive(known.seconds, "seconds")
    return given


def _plain(value: Any) -> Any:
    """A value of an input as JSON has it: an exact number as the fraction that it is."""
    if isinstance(value, tuple):
        return [_plain(part) for part in value]
    return value if isinstance(value, (str, float, int)) else str(value)
