"""Throughput of a march over lanes on one thread, against a scalar C loop compiled here with -O3 -march=native.

Run ``python tests/benchmarks/march_against_c.py``: the two in turn, ROUNDS times; the ratio is the median of the pairs.
Each line is the same work on both sides: plain steps, or steps with the energy error of each followed to its maximum.
The lanes' sine is inlined, as it is in long marches of many lanes, or the vector library's, as it is in short ones.
"fast-math" is the library's sine where the compiler may change the order of sums, as no march here lets it (the inlined
one rounds by adding a large number and taking it away, which fast-math leaves out); C stays as it is.
Nothing is asserted.
"""

from __future__ import annotations

import ctypes
import subprocess
import tempfile
import time
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np

from compare.march.precision import precision
from compare.march.trace import compile_block
from compare.methods import find
from reference import Pendulum

C_SOURCE = r"""
#include <math.h>

#define RK4_STEP \
    double k1 = v, a1 = -(g / l) * sin(q); \
    double k2 = v + h / 2 * a1, a2 = -(g / l) * sin(q + h / 2 * k1); \
    double k3 = v + h / 2 * a2, a3 = -(g / l) * sin(q + h / 2 * k2); \
    double k4 = v + h * a3, a4 = -(g / l) * sin(q + h * k3); \
    q += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4); \
    v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);

#define VERLET_STEP \
    v += h / 2 * a; \
    q += h * v; \
    a = -(g / l) * sin(q); \
    v += h / 2 * a;

#define FOLLOW \
    double s = sin(q / 2), off = fabs(v * v / 2 + 2 * (g / l) * s * s - e); \
    if (off > most) most = off;

#define MARCH(NAME, BEFORE, STEP, THEN) \
    double NAME(double *state, double h, double g, double l, long n) { \
        double q = state[0], v = state[1], s0 = sin(q / 2), e = v * v / 2 + 2 * (g / l) * s0 * s0, most = 0; \
        BEFORE \
        for (long i = 0; i < n; i++) { STEP THEN } \
        state[0] = q; state[1] = v; \
        return most + e * 0; \
    }

MARCH(rk4, , RK4_STEP, )
MARCH(rk4_drift, , RK4_STEP, FOLLOW)
MARCH(verlet, double a = -(g / l) * sin(q);, VERLET_STEP, )
MARCH(verlet_drift, double a = -(g / l) * sin(q);, VERLET_STEP, FOLLOW)
"""
ROUNDS = 15
C_STEPS = 300_000
LANES = {"rk4": 2048, "verlet": 4096}
STEPS, BATCH = 32, 32
"""As in long marches of many lanes."""
LANE_STEPS = 6_000_000


def compiled_c(folder: Path) -> ctypes.CDLL:
    """The loops above as a shared library."""
    source, library = folder / "loops.c", folder / "loops.so"
    source.write_text(C_SOURCE)
    subprocess.run(
        ["cc", "-O3", "-march=native", "-shared", "-fPIC", "-o", str(library), str(source), "-lm"], check=True
    )
    return ctypes.CDLL(str(library))


def c_nanoseconds(loop: Any) -> float:
    """Time of one step of the C loop."""
    state = (ctypes.c_double * 2)(1.0, 0.0)
    loop.argtypes = [ctypes.c_void_p, ctypes.c_double, ctypes.c_double, ctypes.c_double, ctypes.c_long]
    loop.restype = ctypes.c_double
    begin = time.perf_counter()
    loop(state, 1e-5, 9.81, 1.0, C_STEPS)
    return (time.perf_counter() - begin) / C_STEPS * 1e9


class Lanes:
    """A compiled block and the arrays it works on."""

    def __init__(self, name: str, *, drift: bool, arithmetic: str) -> None:
        count = LANES[name]
        how = {"drift": drift, "inline_sine": arithmetic == "inlined", "fast_math": arithmetic == "fast-math"}
        self.block = compile_block(find(name), Pendulum(1.0), precision("float64"), STEPS, "last", BATCH, **how)
        self.lanes = np.zeros((4, count))
        self.lanes[0] = np.linspace(0.1, 3.0, count)
        self.parameters = np.array([[1e-5], [0.0], [9.81], [1.0]]) * np.ones(count)
        self.out = np.empty_like(self.lanes)
        self.calls = LANE_STEPS // (STEPS * count)

    def nanoseconds(self) -> float:
        """Time of one step of one lane."""
        begin = time.perf_counter()
        for _ in range(self.calls):
            self.block(self.lanes, self.parameters, self.out)
        return (time.perf_counter() - begin) / (self.calls * STEPS * self.lanes.shape[1]) * 1e9


def main() -> None:
    """Print the table."""
    print(f"{'method':8s}{'work':18s}{'sine':12s}{'C ns/step':>10s}{'lanes ns/step':>15s}{'ratio':>7s}")
    with tempfile.TemporaryDirectory() as folder:
        library = compiled_c(Path(folder))
        for name in LANES:
            for drift in (False, True):
                loop = getattr(library, f"{name}_drift" if drift else name)
                for arithmetic in ("inlined", "library", "fast-math"):
                    lanes = Lanes(name, drift=drift, arithmetic=arithmetic)
                    lanes.nanoseconds(), c_nanoseconds(loop)
                    pairs = [(c_nanoseconds(loop), lanes.nanoseconds()) for _ in range(ROUNDS)]
                    work = "steps and energy" if drift else "steps"
                    ratio = median(c / ours for c, ours in pairs)
                    times = f"{median(c for c, _ in pairs):10.2f}{median(ours for _, ours in pairs):15.3f}"
                    print(f"{name:8s}{work:18s}{arithmetic:12s}{times}{ratio:7.1f}")


if __name__ == "__main__":
    main()
