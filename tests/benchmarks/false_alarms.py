"""How often sound integrators fail, which is never to be, and how often slips are caught.

    python tests/benchmarks/false_alarms.py [COUNT] [SEED]

COUNT random sound configurations (methods, problems, forms, tolerances) and as many random slips, 200 if none is given.
The tests keep a short version of it.
"""

from __future__ import annotations

import random
import sys
import time
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "compare"))

import sound_and_slipped

import compare
from compare.claims.frames import MisuseError


def verdict(made: sound_and_slipped.Made) -> tuple[str, str, float]:
    """PASS, FAIL, NOT ESTABLISHED or REFUSED, in words, and the seconds that it took."""
    begun = time.perf_counter()
    try:
        found = compare.check(
            made.function, **{name: value for name, value in made.claims.items() if value is not None}
        )
    except MisuseError as error:
        return "REFUSED", str(error), time.perf_counter() - begun
    standing = {True: "PASS", False: "FAIL", None: "NOT ESTABLISHED"}[found.claims_hold]
    return standing, " | ".join(map(str, found.verdicts)), time.perf_counter() - begun


def main() -> None:
    """Print what is not as it should be, and the counts."""
    count = int(sys.argv[1]) if sys.argv[1:] else 200
    seed = int(sys.argv[2]) if sys.argv[2:] else 20261130
    for what, make, wanted in (("sound", sound_and_slipped.sound, "PASS"), ("slip", sound_and_slipped.slipped, "FAIL")):
        r = random.Random(f"{seed} {what}")
        counts: dict[str, Counter[str]] = {}
        seconds = []
        for _ in range(count):
            made = make(r)
            standing, words, took = verdict(made)
            seconds.append(took)
            kind = made.slip.partition(":")[0] or made.form
            counts.setdefault(kind, Counter())[standing] += 1
            if standing != wanted:
                print(f"{what}  {standing}  {made.told}\n    {words}", flush=True)
        for kind, found in sorted(counts.items()):
            print(f"{what:6s} {kind:12s} {dict(found)}")
        seconds.sort()
        total = sum(counts.values(), Counter())
        print(f"{what}: {dict(total)}; a verdict takes {seconds[len(seconds) // 2]:.2f} s, {seconds[-1]:.1f} s at most")


if __name__ == "__main__":
    main()
