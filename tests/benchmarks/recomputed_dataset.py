"""Count misrounded elements of the core dataset: random ones of every variable, each computed again in another way.

    python tests/benchmarks/recomputed_dataset.py [EACH]   (default 240 of most variables: ten thousand and more)

The other way shares no formula with the package where a second one exists, and works at three times the precision.
"""

from __future__ import annotations

import functools
import random
import sys
import time
from collections import Counter
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "reference"))

from sampled import elements, misrounded

import reference

load = functools.cache(reference.load)


def wrong(name: str, index: tuple[int, ...]) -> tuple[str, str]:
    """The group of an element, and what is wrong with it."""
    dataset = load()
    return name.rpartition("/")[0], misrounded(dataset, dataset[name], index)


def main(each: int) -> int:
    """Print the counts; 0 where nothing is misrounded, else 1."""
    start = time.perf_counter()
    chosen = [(variable.name, index) for variable, index in elements(load(), each, random.Random(1656))]
    counted: Counter[str] = Counter()
    faults = []
    with ProcessPoolExecutor() as pool:
        for group, fault in pool.map(wrong, *zip(*chosen, strict=True), chunksize=50):
            counted[group] += 1
            faults += [fault] if fault else []
    for group, count in counted.items():
        print(f"{group}: {count} elements")
    print(*faults, sep="\n")
    print(f"{len(chosen)} elements of three limbs: {len(faults)} misrounded ({time.perf_counter() - start:.0f} s)")
    return int(bool(faults))


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else 240))
