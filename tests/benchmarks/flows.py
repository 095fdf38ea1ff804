"""Processor time of proven flows, beside that of heyoka at the same digits in MPFR arithmetic, which proves nothing.

    python tests/benchmarks/flows.py [NAME[:INPUT=NUMBER,...][@TIME] ...]

without names all problems of the package that are proven by their flow, to where their march ends.  A proof is that of
DIGITS digits of each component, from nothing; heyoka's is compiled before.  Nothing is asserted.
"""

from __future__ import annotations

import sys
import time
from fractions import Fraction
from statistics import median
from typing import TYPE_CHECKING

from reference.flow_problem import FlowProblem
from reference.problems.families import FAMILIES, find_family
from reference.routes import proven_flow
from reference.routes.flow import Flow

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

DIGITS = 48
BITS = 160
"""Of DIGITS digits."""
ROUNDS, LONG = 3, 5
"""A proof is repeated so often, but for one that takes so many seconds."""


def named(word: str) -> tuple[FlowProblem, Fraction]:
    """The problem that a word names, and the time."""
    word, _, at = word.partition("@")
    name, _, given = word.partition(":")
    inputs = dict(part.split("=") for part in given.split(",")) if given else {}
    problem = find_family(name).problem(**inputs)
    assert isinstance(problem, FlowProblem)
    return problem, Fraction(at) if at else problem.end


def asked() -> Iterator[tuple[FlowProblem, Fraction]]:
    """The problems that the command line names, or all."""
    if sys.argv[1:]:
        yield from map(named, sys.argv[1:])
        return
    for family in FAMILIES:
        if isinstance(family.problem, type) and issubclass(family.problem, FlowProblem):
            problem = family.problem()
            yield problem, problem.end


def seconds(work: Callable[[], object]) -> float:
    """Processor time of some work."""
    begin = time.process_time()
    work()
    return time.process_time() - begin


def forgotten() -> None:
    """Forget every flow, and what it lost."""
    for known in (proven_flow._flows, proven_flow._losses, proven_flow._horizons):
        known.cache_clear()


def measured(problem: FlowProblem, end: Fraction) -> str:
    """One line of the table."""
    size = len(problem.state_names)

    def proof() -> None:
        forgotten()
        for place in range(size):
            problem.certified("state", end, place).digits(DIGITS)

    first = seconds(proof)
    flow = list(proven_flow._flows(problem).values())[-1]
    steps, lost = len(flow.pieces(1)), proven_flow.lost(problem, end)
    run = Flow(problem, BITS + lost)
    run.at([end / 1024])
    rounds = ROUNDS if first < LONG else 0
    pairs = [(seconds(proof), seconds(lambda: run.at([end]))) for _ in range(rounds)]
    pairs = pairs or [(first, seconds(lambda: run.at([end])))]
    ours, ratio = median(own for own, _ in pairs), median(own / other for own, other in pairs)
    return f"{problem!r:40s} {float(end):9g} {size:3d} {ours:9.2f} {flow.bits:5d} {steps:6d} {lost:5d} {ratio:8.1f}"


def main() -> None:
    """Print the table."""
    print(f"{'problem':40s} {'t':>9s} {'n':>3s} {'seconds':>9s} {'bits':>5s} {'steps':>6s} {'lost':>5s} {'ratio':>8s}")
    for problem, end in asked():
        print(measured(problem, end), flush=True)


if __name__ == "__main__":
    main()
