"""Verlet and Yoshida 6 over 10^3 ... 10^6 periods at 64 amplitudes: seconds, memory, and errors against the truth.

Run ``python tests/benchmarks/long_run.py [POWER]``: up to 10^POWER periods (6 if it is not given).  Every lane takes
the same number of steps in each of its own periods, and is compared with the proven state at 128 times up to the end.
The memory is the most that a process of its own holds: it is that of compiled code, which is longer in longer runs up
to a bound, and does not grow with the steps taken.  Nothing is asserted.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import time
from fractions import Fraction

import numpy as np

from compare.march.march import march
from compare.march.precision import precision
from compare.measure.truth import Course
from compare.methods import find
from reference import Pendulum

FLOAT64 = precision("float64")
STEPS = {"verlet": 64, "yoshida6": 32}
"""Steps a period."""
AMPLITUDES = tuple(Fraction(k, 22) for k in range(1, 65))


def courses(periods: int, steps: int) -> list[Course]:
    """A lane for each amplitude, over so many of its own periods, each rounded to a double."""
    problems = [Pendulum(amplitude) for amplitude in AMPLITUDES]
    return [
        Course(problem, periods * steps, periods * Fraction(float(problem.period())), FLOAT64) for problem in problems
    ]


def line(name: str, periods: int) -> str:
    """March one method so far, and say how it went."""
    asked = courses(periods, STEPS[name])
    begin = time.perf_counter()
    found = march(find(name), [course.lane for course in asked], FLOAT64)
    seconds = time.perf_counter() - begin
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    begin = time.perf_counter()
    errors = [np.max(np.abs(course.errors(one.states)[:, 0])) for course, one in zip(asked, found, strict=True)]
    proving = time.perf_counter() - begin
    drifts = [one.max_drifts[0] / course.scales[0] for course, one in zip(asked, found, strict=True)]
    each = seconds / (asked[0].n * len(asked)) * 1e9
    return (
        f"{name:10s}{periods:9d}{asked[0].n:11d}{seconds:9.2f}{each:9.2f}{proving:9.2f}{memory:6.0f}"
        f"  {np.median(errors):.1e} {max(errors):.1e}, {np.median(drifts):.1e} {max(drifts):.1e}"
    )


def main(words: list[str]) -> None:
    """Print a line for each method and length, each from a process of its own."""
    if words[:1] == ["--line"]:
        print(line(words[1], int(words[2])))
        return
    print(f"{'method':10s}{'periods':>9s}{'steps':>11s}{'march s':>9s}{'ns/step':>9s}{'truth s':>9s}{'MB':>6s}", end="")
    print("  largest error in rad, energy error (medians, largest)", flush=True)
    for name in STEPS:
        for power in range(3, int(words[0]) + 1 if words else 7):
            subprocess.run([sys.executable, __file__, "--line", name, str(10**power)], check=True)


if __name__ == "__main__":
    main(sys.argv[1:])
