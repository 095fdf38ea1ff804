"""Proven flows of few bits against values of twice as many, over all problems of the package that have a flow.

    python tests/benchmarks/soundness.py [PART]

PART of each motion is looked at, a tenth if none is given.  The tests keep a short version of it.
"""

from __future__ import annotations

import sys
from fractions import Fraction

from reference.flow_problem import FlowProblem
from reference.problems.families import FAMILIES
from reference.routes.proven_flow import ProvenFlow

FEW, MANY = (70, 95, 120), 240
TIMES = 32
STEPS = 20_000
COMPONENTS = 12
"""Of larger problems a twentieth of the part is looked at."""


def outside(problem: FlowProblem, end: Fraction) -> tuple[int, int]:
    """How many balls there are, and how many do not hold their value."""
    times = [end * k / TIMES for k in range(1, TIMES + 1)]
    many = ProvenFlow(problem, MANY, STEPS)
    values = [many.at(t) for t in times]
    balls = wrong = 0
    for bits in FEW:
        few = ProvenFlow(problem, bits, STEPS)
        for t, exact in zip(times, values, strict=True):
            for ball, value in zip(few.at(t), exact, strict=True):
                balls += 1
                wrong += not ball.contains(value)
    return balls, wrong


def main() -> None:
    """Print the counts."""
    part = Fraction(sys.argv[1]) if sys.argv[1:] else Fraction(1, 10)
    all_balls = all_wrong = 0
    for family in FAMILIES:
        if isinstance(family.problem, type) and issubclass(family.problem, FlowProblem):
            problem = family.problem()
            large = len(problem.state_names) > COMPONENTS
            balls, wrong = outside(problem, problem.end * part / (20 if large else 1))
            all_balls, all_wrong = all_balls + balls, all_wrong + wrong
            print(f"{family.name:20s} {balls:6d} balls, {wrong} do not hold their value", flush=True)
    print(f"{all_balls} balls, {all_wrong} do not hold their value")


if __name__ == "__main__":
    main()
