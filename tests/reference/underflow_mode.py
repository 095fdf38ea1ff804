"""The mode in which a processor takes subnormal numbers for zero, set as a library built with fast-math sets it.

Run as a program, it sets the mode in a process of its own and answers there, in bits, what a test asks.
"""

from __future__ import annotations

import ctypes
import json
import mmap
import platform
import random
import struct
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import numpy as np
from flint import arb

from reference.arithmetic.limbs import exact_limbs, interval, limbs, of_ball
from reference.arithmetic.precision import ctx

ROOT = Path(__file__).parents[2]
SETS_THE_MODE = {
    # stmxcsr [rsp-8]; mov eax, [rsp-8]; or eax, 0x8040 (FTZ, DAZ); mov [rsp-8], eax; ldmxcsr [rsp-8]; ret
    "x86_64": "0fae5c24f8 8b4424f8 0d40800000 894424f8 0fae5424f8 c3",
    # mrs x0, fpcr; movz x1, 0x100, lsl 16 (FZ); orr x0, x0, x1; msr fpcr, x0; ret
    "aarch64": "00443bd5 0120a0d2 000001aa 00441bd5 c0035fd6",
}
SPELT = {"AMD64": "x86_64", "arm64": "aarch64"}


def set_mode() -> None:
    """Take subnormal numbers for zero in this thread, and in those that it starts."""
    machine = platform.machine()
    code = bytes.fromhex(SETS_THE_MODE[SPELT.get(machine, machine)])
    page = mmap.mmap(-1, mmap.PAGESIZE, prot=mmap.PROT_READ | mmap.PROT_WRITE | mmap.PROT_EXEC)
    page.write(code)
    ctypes.CFUNCTYPE(None)(ctypes.addressof(ctypes.c_char.from_buffer(page)))()


def bits(values) -> list[int]:
    """Numbers by their bits."""
    return [int.from_bytes(struct.pack("<d", value), "little") for value in np.ravel(np.asarray(values)).tolist()]


def in_the_mode(code: str, *, mode: bool = True, folder: Path | None = None):
    """What ``answer`` is after the code, run in a process of its own with the mode set, or not."""
    done = subprocess.run(
        [sys.executable, "-B", __file__, "mode" if mode else "none"],
        input=code,
        capture_output=True,
        text=True,
        cwd=folder or ROOT,
        env={"PYTHONPATH": f"{ROOT}:{ROOT / 'tests' / 'reference'}"},
        check=False,
    )
    assert done.returncode == 0, done.stderr  # -B: bytecode with literals read as zero would outlive the process
    return json.loads(done.stdout.splitlines()[-1])


def of_bits(whole: list[int], kind: str) -> np.ndarray:
    """An array of floats by their bits."""
    return np.array(whole, dtype=f"u{np.dtype(kind).itemsize}").view(kind)


def tails(count: int, seed: int = 5) -> list[list[int]]:
    """Three limbs, by their bits, of random numbers whose limbs are subnormal, as rationals, intervals and balls."""
    source, found = random.Random(seed), []
    for _ in range(count):
        size, exponent = source.getrandbits(159) | 1 << 158, -1074 - source.randrange(-2, 160)
        value = source.choice([-1, 1]) * size * Fraction(2) ** exponent
        with ctx.workprec(400):
            ball = arb(value.numerator) / value.denominator
            found.append(bits(exact_limbs(value, 3)))
            found += [bits(each) for each in (limbs(interval(ball), 3), of_ball(ball, 3)) if each is not None]
    return found


def main() -> None:
    """Set the mode, run what comes in and print its answer."""
    code = compile(sys.stdin.read(), "asked", "exec")  # its literals are read before the mode is set
    if sys.argv[1] == "mode":
        set_mode()
    known: dict[str, object] = {"bits": bits, "of_bits": of_bits, "tails": tails}
    exec(code, known)  # noqa: S102 - a test's own code
    print(json.dumps(known["answer"]))  # noqa: T201


if __name__ == "__main__":
    main()
