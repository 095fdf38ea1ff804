"""Wall time of the commands as whole processes: cold (no compiled code on disk) and warm.

Run ``python tests/benchmarks/commands.py``.  Beside the seconds stands the ratio to ``python -c "import heyoka"`` taken
in turn with it, which says more than the seconds do on a machine that is shared; nothing is asserted.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from statistics import median

ROUNDS = 5
BASE = [sys.executable, "-c", "import heyoka"]
MODULE = [sys.executable, "-m"]
AT = [*MODULE, "reference", "at", "pendulum", "--theta0", "1", "--t", "10", "--digits", "50", "--format", "json"]
STUDY = [*MODULE, "compare", "pendulum"]


def seconds(command: list[str], cache: Path) -> float:
    """Time one process whose compiled code is kept in ``cache``."""
    environment = {**os.environ, "XDG_CACHE_HOME": str(cache), "HOME": str(cache)}
    begin = time.perf_counter()
    subprocess.run(command, env=environment, check=True, stdout=subprocess.DEVNULL)
    return time.perf_counter() - begin


def measured(name: str, command: list[str], *, cold: bool) -> str:
    """One line: the medians over ROUNDS pairs."""
    with tempfile.TemporaryDirectory() as folder:
        seconds(command, Path(folder) / "warm")
        pairs = []
        for i in range(ROUNDS):
            cache = Path(folder) / (f"cold{i}" if cold else "warm")
            cache.mkdir(exist_ok=True)
            pairs.append((seconds(command, cache), seconds(BASE, cache)))
    ratio = median(ours / base for ours, base in pairs)
    return f"{name:32s} {median(ours for ours, _ in pairs):7.2f} s {ratio:7.1f}"


def main() -> None:
    """Print the table."""
    print(f"{'command':32s} {'median':>9s} {'ratio':>7s}   ({ROUNDS} pairs, {os.cpu_count()} cores)")
    print(measured("compare pendulum, cold", STUDY, cold=True))
    print(measured("compare pendulum, warm", STUDY, cold=False))
    print(measured("reference at pendulum", AT, cold=False))
    with tempfile.TemporaryDirectory() as folder:
        build = [*MODULE, "reference", "build", "--quiet", "--out", str(Path(folder) / "core.h5")]
        print(measured("reference build, core profile", build, cold=True))


if __name__ == "__main__":
    main()
