"""Certified pendulum states of 48 digits against mpmath's elliptic functions at 50 digits.

Run ``python tests/benchmarks/states.py``: the two in turn, ROUNDS times; the ratio is the median of the pairs.  A state
is the angle and the angular velocity to three limbs, proven correctly rounded, tables included; on the other side stand
sn, cn and dn of one argument by ``mpmath.ellipfun``, of which a state is yet to be made.  Nothing is asserted.
"""

from __future__ import annotations

import math
import random
import time
from statistics import median
from typing import TYPE_CHECKING

import numpy as np
from mpmath import mp

from reference import Pendulum

if TYPE_CHECKING:
    from collections.abc import Callable

ROUNDS = 9
STATES, ARGUMENTS = 5000, 100
DIGITS = 50
PENDULUMS = {
    "released at 1 rad": Pendulum(1.0),
    "released at 3 rad": Pendulum(3.0),
    "released at pi - 1e-9": Pendulum(math.pi - 1e-9),
    "rotation": Pendulum(0.3, omega0=7),
}
SPANS = (10.0, 1e6)


def microseconds(work: Callable[[], object], count: int) -> float:
    """Time of one of ``count``."""
    begin = time.perf_counter()
    work()
    return (time.perf_counter() - begin) / count * 1e6


def elliptic(parameter: mp.mpf, arguments: list[mp.mpf]) -> None:
    """mpmath's three functions at each argument."""
    for u in arguments:
        for name in ("sn", "cn", "dn"):
            mp.ellipfun(name, u, m=parameter)


def main() -> None:
    """Print the table."""
    rng = random.Random(1673)
    print(f"{'pendulum':24s}{'times up to':>12s}{'mpmath us':>11s}{'state us':>10s}{'ratio':>7s}")
    for name, pendulum in PENDULUMS.items():
        for span in SPANS:
            times = np.array([rng.uniform(0, span) for _ in range(STATES)])
            with mp.workdps(DIGITS):
                modulus = mp.mpf(pendulum.certified("modulus").digits(DIGITS))
                parameter = min(modulus, 1 / modulus) ** 2
                arguments = [mp.sqrt(mp.mpf(9.81)) * mp.mpf(t) for t in times[:ARGUMENTS].tolist()]
                pairs = [
                    (
                        microseconds(lambda u=arguments, m=parameter: elliptic(m, u), ARGUMENTS),
                        microseconds(lambda t=times, p=pendulum: p.state(t, limbs=3), STATES),
                    )
                    for _ in range(ROUNDS)
                ]
            ratio = median(theirs / ours for theirs, ours in pairs)
            theirs, ours = (median(side) for side in zip(*pairs, strict=True))
            print(f"{name:24s}{span:12g}{theirs:11.1f}{ours:10.2f}{ratio:7.1f}")


if __name__ == "__main__":
    main()
