"""The problem on which claims are tried: a motion in time, the usual one where none is named."""

from __future__ import annotations

from typing import Any

from reference.consistency import consistent
from reference.problem import Problem
from reference.problems.families import usual_problem

__all__ = ["motion"]


def motion(problem: Any) -> Problem:
    """A problem whose state at a time is proven; the usual one if it is None.

    Raises:
        TypeError: it is no problem.
        ValueError: it is a curve, or has no such row.
    """
    if problem is None:
        return usual_problem()
    if not isinstance(problem, Problem):
        raise TypeError(
            f"problem is {problem!r}; a problem with positions and momenta, such as Pendulum(1.0), is accepted."
        )
    accepted = "a motion in time, such as Pendulum(1.0), is accepted."
    if problem.space.along is not None:
        raise ValueError(f"problem is {problem!r}, a curve along {problem.space.along}; {accepted}")
    if not problem.serves("state") or problem.row("state").over in {"once", "index"}:
        raise ValueError(f"problem is {problem!r}, without a state at a time; {accepted}")
    consistent(problem)
    return problem
