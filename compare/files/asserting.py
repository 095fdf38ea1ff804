"""A score as an assertion of a test: nothing where its limits hold, else an AssertionError that says what is missed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.files.limits import NONE, Limits
from compare.files.score import score

if TYPE_CHECKING:
    from compare.files.record import Score
    from reference.problem import Problem

__all__ = ["assert_score"]


def assert_score(
    problem: Problem, t: Any, y: Any, min_digits: float | None = None, max_error: float | None = None
) -> Score:
    """Return the score of a trajectory that has the correct digits, on scale, or the errors that are asked for.

    Args:
        problem: as of ``compare.score``, with ``t`` and ``y``.
        t: the times.
        y: the states.
        min_digits: the fewest correct digits on scale of a row.
        max_error: the largest error of a row.

    Raises:
        AssertionError: a limit does not hold.
        ValueError: there is no limit, one is no positive number, or more digits are asked for than the numbers hold;
            or as ``compare.score``.
        TypeError: as ``compare.score``.
    """
    limits = Limits(min_digits, max_error)
    if limits == NONE:
        raise ValueError("nothing is asked of the score; min_digits or max_error is accepted.")
    found = score(problem, t, y)
    if not limits.holds(found):
        raise AssertionError(f"{found.problem}: {limits.sentence(found)}")
    return found
