"""A whole study from a cold process, against the same job in scalar C and in numba.

The job: Euler, symplectic Euler, Verlet, RK4, Yoshida 4 and Yoshida 6 in N = 2^7 ... 2^20 steps at 16 amplitudes; the
largest error over 128 times and the largest energy error over every step.  Each time is that of one process from its
start to its end, as a user would run it: ours compiles its steps, computes and proves its own truth and tells the
rounding floors apart, in as many processes as the command line takes; C is compiled before and numba in its process,
and both are handed the truth.

Run ``python tests/benchmarks/whole_job.py [PYTHON]``, where PYTHON is an interpreter that has numba (this one if it is
not given); where there is none, C alone is measured.  ROUNDS times in turn; the ratios are medians.  Nothing is
asserted but that all did the same job.
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import tempfile
import time
from importlib import import_module
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

METHODS = ("euler", "symplectic_euler", "verlet", "rk4", "yoshida4", "yoshida6")
AMPLITUDES = tuple(0.1 + 0.19 * k for k in range(16))
COUNTS = tuple(2**k for k in range(7, 21))
SAMPLES = 128
ROUNDS = 3
HERE = Path(__file__).parent


def ours(out: Path) -> None:
    """The job by this package."""
    from reference.command.executors import processes

    with processes(max((os.cpu_count() or 1) - 1, 1)) as executor:
        executor.submit(import_module, "compare.study")  # as the command line does
        from compare.scored import score_all
        from reference import Pendulum

        scored = score_all([Pendulum(amplitude) for amplitude in AMPLITUDES], METHODS, COUNTS, executor=executor)
    pairs = [
        (cell.max_error, drift.max_drift_above_rest) for cell, drift in zip(scored.cells, scored.drifts, strict=True)
    ]
    np.array(pairs).tofile(out)


def truth() -> np.ndarray:
    """The amplitudes, then for each the exact angle at 128 times."""
    from fractions import Fraction

    from reference import Pendulum

    times = [Fraction(10 * (k + 1), SAMPLES) for k in range(SAMPLES)]
    angles = [Pendulum(amplitude).state(times)[:, 0] for amplitude in AMPLITUDES]
    return np.concatenate([AMPLITUDES, *angles])


def clocked(words: Sequence[str]) -> tuple[float, float]:
    """Seconds on the clock and seconds of all processors that a command takes, with nothing compiled before."""
    with tempfile.TemporaryDirectory() as cache:
        before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        subprocess.run(words, check=True, env={**os.environ, "XDG_CACHE_HOME": cache})
        seconds, after = time.perf_counter() - begin, resource.getrusage(resource.RUSAGE_CHILDREN)
    return seconds, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def commands(folder: Path, numba_python: str) -> dict[str, list[str]]:
    """What is measured, by name; each command writes its results to the file named last."""
    given, binary = str(folder / "given"), str(folder / "whole_job")
    subprocess.run(["cc", "-O3", "-march=native", "-o", binary, str(HERE / "whole_job.c"), "-lm"], check=True)
    truth().tofile(given)
    found = {
        "ours": [sys.executable, __file__, "--ours", str(folder / "ours")],
        "scalar C": [binary, given, str(folder / "scalar C")],
    }
    if subprocess.run([numba_python, "-c", "import numba"], check=False, capture_output=True).returncode:
        print(f"numba is not installed for {numba_python}: C alone is measured")
        return found
    found["numba"] = [numba_python, str(HERE / "whole_job_numba.py"), given, str(folder / "numba")]
    return found


def agree(folder: Path, name: str) -> bool:
    """Whether a job found what ours did, wherever rounding does not decide: to a hundredth."""
    mine, its = np.fromfile(folder / "ours"), np.fromfile(folder / name)
    large = mine > 1e-9
    return mine.shape == its.shape and bool(np.all(np.abs(its / mine - 1)[large] < 1e-2))


def main(words: Sequence[str]) -> None:
    """Print the table."""
    if words[:1] == ["--ours"]:
        ours(Path(words[1]))
        return
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        jobs = commands(folder, words[0] if words else sys.executable)
        rounds = [{job: clocked(command) for job, command in jobs.items()} for _ in range(ROUNDS)]
        print(f"{'job':18s}{'seconds':>9s}{'processor s':>13s}{'as long as ours':>17s}  same numbers")
        for job in jobs:
            seconds, processor = (median(found[job][i] for found in rounds) for i in (0, 1))
            ratio = median(found[job][0] / found["ours"][0] for found in rounds)
            print(f"{job:18s}{seconds:9.2f}{processor:13.2f}{ratio:17.2f}  {'yes' if agree(folder, job) else 'NO'}")


if __name__ == "__main__":
    main(sys.argv[1:])
