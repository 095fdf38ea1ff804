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

NUMBERS = ("order", "dense", "estimate", "stiff", "tolerance", "events", "gradients")
FORMATS = ("text", "json", "junit", "sarif")
FORMS = ("step", "timed", "separable", "gradient", "integrator", "own", "own-timed", "own-separable")


def add_options(parser: argparse.ArgumentParser, families: Sequence[Family]) -> None:
    """Add them to a parser, the inputs of the families among them."""
    named = "the function, in a module, in FILE.py:STEP, or in a library FILE.so:STEP"
    parser.add_argument("step", metavar="MODULE:STEP", nargs="?", help=named)
    parser.add_argument(
        "--process", metavar="COMMAND", help="in its place: a program that reads lines of h and y, and writes the new y"
    )
    parser.add_argument("--order", metavar="P", help="claim this order")
    parser.add_argument("--backward", action="store_true", help="claim this order for negative steps too")
    parser.add_argument("--symplectic", action="store_true", help="claim that it is symplectic")
    parser.add_argument("--reversible", action="store_true", help="claim that it is reversible")
    parser.add_argument("--conserves", action="store_true", help="claim that it keeps every invariant")
    parser.add_argument("--dense", metavar="P", help="claim dense output of this order, which --interpolant gives")
    parser.add_argument("--interpolant", metavar="MODULE:NAME", help="the function (f, y, h, theta) of dense output")
    parser.add_argument("--estimate", metavar="P", help="claim that it gives (y, error), of a method of this order")
    parser.add_argument("--stiff", metavar="P", help="claim this order on a stiff equation")
    parser.add_argument("--tolerance", metavar="POWER", help="claim errors that go with this power of rtol, 1 mostly")
    parser.add_argument("--events", metavar="E", help="of a function (f, event, t_span, y0): claim all events to E")
    parser.add_argument("--gradients", metavar="E", help="of a function (y0, parameters, t): claim derivatives to E")
    parser.add_argument(
        "--form",
        type=one_of("form", FORMS),
        metavar="FORM",
        help="step (f, y, h), timed (f, t, y, h), separable (q, p, force, h), gradient (q, p, grad_V, h), integrator "
        "(f, y0, t); of an equation of its own: own (y, h), own-timed (t, y, h), own-separable (q, p, h)",
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
    if (known.step is None) == (known.process is None):
        raise ValueError("a function MODULE:STEP or --process COMMAND is accepted, one of both.")
    numbers = {name: getattr(known, name) for name in NUMBERS}
    given: dict[str, Any] = {
        "step": known.step,
        "backward": known.backward or None,
        "symplectic": known.symplectic or None,
        "reversible": known.reversible or None,
        "conserves": known.conserves or None,
        "interpolant": known.interpolant,
        "form": known.form,
        **{name: None if text is None else positive(text, name) for name, text in numbers.items()},
    }
    if known.process is not None:
        given["process"] = known.process
    _hold_alone(given)
    if known.problem is not None:
        family = find_family(known.problem)
        inputs = inputs_given(family, known, families)
        if len(several := inputs.get(family.comparison.varied, ())) > 1:
            raise ValueError(f"--{family.comparison.varied} has {len(several)} values; a check is on one.")
        given["problem"] = {"family": known.problem, "inputs": {name: _plain(value) for name, value in inputs.items()}}
    if known.seconds is not None:
        given["seconds"] = positive(known.seconds, "seconds")
    return given


def _hold_alone(given: dict[str, Any]) -> None:
    """Refuse claims of a step beside those of events or of derivatives.

    Raises:
        ValueError: there are some.
    """
    for alone in ("events", "gradients"):
        others = [name for name, value in given.items() if value is not None and name not in {"step", alone}]
        if given[alone] is not None and others:
            raise ValueError(f"--{alone} is claimed of what is no step; it is accepted without --{others[0]}.")


def _plain(value: Any) -> Any:
    """A value of an input as JSON has it: an exact number as the fraction that it is."""
    if isinstance(value, tuple):
        return [_plain(part) for part in value]
    return value if isinstance(value, (str, float, int)) else str(value)
