"""Count misrounded limbs over random states: the package against two independent computations at three times its bits.

    python tests/benchmarks/misrounded.py [STATES]        (default 20000, in about a minute)

Amplitudes are drawn from (0.001, pi - 1e-9), a third of them close to either end, times from [0, 10^6] s.
"""

from __future__ import annotations

import math
import random
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "reference"))

from independent import correct_limbs, landen_states, mpmath_states

from reference import Pendulum

BITS = 3 * 159
TIMES_EACH = (20, 180)
"""States of one pendulum at once: few are computed each by itself, many by the chart of the orbit."""


def amplitude(rng: random.Random) -> float:
    """One amplitude: uniform, near 0.001 or near pi, each as likely."""
    return rng.choice(
        (
            lambda: rng.uniform(0.001, math.pi - 1e-9),
            lambda: 0.001 * 10 ** rng.uniform(0, 2),
            lambda: math.pi - 10 ** rng.uniform(-9, -1),
        )
    )()


def main(states: int) -> int:
    """Print the count; 0 where nothing is misrounded, else 1."""
    rng = random.Random(1673)
    limbs = misrounded = 0
    start = time.perf_counter()
    for i in range(-(-2 * states // sum(TIMES_EACH))):
        theta0, g, length = amplitude(rng), rng.choice((9.81, 1.0, 9.80665, 1.62)), rng.choice((1.0, 0.25, 0.1, 3.7))
        times = [rng.uniform(0, 1e6) for _ in range(TIMES_EACH[i % 2])]
        found = Pendulum(theta0, g, length).state(times, limbs=3).tolist()
        elliptic = mpmath_states(theta0, g, length, times, BITS + 160)
        landen = landen_states(theta0, g, length, times, BITS)
        for route in (elliptic, landen):
            for state, proven in zip(route, found, strict=True):
                for value, row in zip(state, proven, strict=True):
                    limbs += 3
                    misrounded += sum(a != b for a, b in zip(correct_limbs(value, 3), row, strict=True))
    seconds = time.perf_counter() - start
    print(f"{limbs // 2} limbs of {limbs // 12} states, each compared twice: {misrounded} misrounded ({seconds:.0f} s)")
    return int(misrounded > 0)


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else 20_000))
