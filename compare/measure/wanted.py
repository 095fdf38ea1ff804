"""Which scores there are, by the names that the command line takes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from reference.names import unknown

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["DEFAULT_SCORES", "EXTRAS", "SCORES", "chosen_scores"]

SCORES = {
    "error": "error against N, with the observed order",
    "norms": "largest, last and root-mean-square error of place and velocity, correct digits, work",
    "work": "evaluations for an error, of fixed and of controlled steps; what those with a controlled step gave",
    "drift": "drift of the energy or another invariant",
    "phase": "the error as one of phase and one of amplitude",
    "growth": "how errors and drift grow with time: bounded, as a root of t, as t, ...",
    "period": "the method's own period, from one passage through the bottom to the next",
    "defects": "how far a step is from keeping area, and a march from running backwards",
}
DEFAULT_SCORES = ("error", "drift")
EXTRAS = ("phase", "growth", "period", "defects")
"""Scores with records of their own, which are not always there."""


def chosen_scores(names: Sequence[str]) -> tuple[str, ...]:
    """The scores of these names, each once, in the order in which they are shown.

    Raises:
        ValueError: one is unknown.
    """
    for name in names:
        if name not in SCORES:
            raise ValueError(unknown("score", str(name), SCORES))
    return tuple(name for name in SCORES if name in names)
