"""Nothing is silently zero where the processor takes subnormal numbers for zero."""

from __future__ import annotations

from fractions import Fraction

import pytest
from underflow_mode import in_the_mode, tails

from reference.arithmetic.binary64 import parts
from reference.arithmetic.underflow import is_gradual, require_gradual

STATES = """
import numpy as np
from fractions import Fraction
from reference import *
answer = [bits(problem.state(times, limbs=3)) for problem, times in (
    (Pendulum(1e-300), [0.1, 0.7]),
    (Pendulum("1e-320"), [0.1, 0.7]),
    (Pendulum(5e-324, omega0=3e-310), [0.0, 0.3]),
    (Pendulum(0.1, g="1e-300"), [1e-5, 1.0]),
    (LinearPendulum(1e-305), [0.1, 0.7]),
    (CycloidalPendulum(1e-310), [0.1, 0.7]),
    (Pendulum(1.0), [5e-324, 1e-310, 0.5]),
    (Pendulum(1.0), of_bits([71362, 1], "f4")),
    (Pendulum(1.0), np.array([1e-310, 0.25])),
)]
answer += [bits(Pendulum(1e-310).certified("state", Fraction(1, 3)).limbs(3))]
answer += [Pendulum(1e-310).certified("state", Fraction(1, 3)).digits(20)]
answer += [bits(float(Pendulum(1e-310).certified("state", 1)))]
"""
INPUTS = """
import numpy as np
from reference.arithmetic.exact import as_number, exact, exact_array
values = [5e-324, -1e-310, np.float64(3e-320), of_bits([1], "f4")[0], of_bits([3], "f2")[0], 0.1]
answer = [str(exact(value)) for value in values]
answer += [str(exact(as_number(exact(value)))) for value in values]
answer += [list(map(str, exact_array(array)[0])) for array in (
    np.array([1e-310, 0.5]), of_bits([71362], "f4"), of_bits([3], "f2"), of_bits([1, 2], "f8").astype(">f8"),
    [5e-324, "1e-310"],
)]
"""
BUILT = """
import h5py, io, sys
import numpy as np
from reference.dataset.build import build
from reference.problems.pendulum import family as groups
from reference.dataset.plan import Plan
from reference.layout import Group
from reference.dataset.reader import load
from forgery import marked
from reference.dataset.verify import verify
inputs = {"amplitude": [0.5, 2.0], "time": [0.0, 1e-310, 1e299, 2.5e300]}
plan = Plan("core", (Group(groups.LONG, {"g": 1e-300, "length": 1e300}, inputs),))
build(plan, "tiny.h5")
found = load("tiny.h5")
omega = found["pendulum/long/omega"]
answer = [found.attrs["fingerprint"], bits(omega.value), bits(omega.tail), [proof.first for proof in verify("tiny.h5")]]
answer += [found["pendulum/long/time"].attrs[name] for name in ("decimal", "hex")]
"""
FORGED = """
import h5py
import numpy as np
from forgery import marked
from reference.dataset.verify import verify
with h5py.File("tiny.h5", "r+", libver=("v110", "v110")) as file:
    tail = file["pendulum/long/omega_tail"]
    forged = tail[...].view(np.uint64)
    sizes = forged & ((1 << 63) - 1)
    least = np.argwhere((sizes != 0) & (sizes < 1 << 52))[0]
    forged[tuple(least)] ^= 1
    tail[...] = forged.view(np.float64)
    marked(file, signed_zeros=False)
import os
os.unlink("SHA256SUMS")
answer = [proof.first for proof in verify("tiny.h5") if not proof.holds]
"""
REFUSED = """
import contextlib, io
from reference.__main__ import main as reference_main
from compare.__main__ import main as compare_main
import compare
from reference import Pendulum
from reference.arithmetic.underflow import UnderflowModeError
answer = []
for main, words in ((reference_main, ["at", "pendulum", "--theta0", "1e-310", "--json"]), (compare_main, ["methods"])):
    with contextlib.redirect_stderr(io.StringIO()) as said:
        answer.append([main(words), said.getvalue()])
for asked in (
    lambda: compare.check(lambda f, y, h: y + h * f(y)),
    lambda: compare.score(Pendulum(1.0), [0.0], [[1.0, 0.0]]),
    lambda: compare.error_vs_n(Pendulum(1.0), ["rk4"], n=[64]),
    lambda: compare.energy_drift(Pendulum(1.0), ["rk4"], n=[64]),
):
    try:
        answer.append(str(asked()))
    except UnderflowModeError as refusal:
        answer.append(str(refusal))
"""
SENTENCE = (
    "needs subnormal numbers, which the processor here takes for zero, as fast-math libraries set it to do; "
    "a thread or a process where that is not set is accepted."
)


def test_the_mode_is_seen_and_threads_that_are_started_have_it_too():
    seen = """
import threading
from reference.arithmetic.underflow import is_gradual
answer = [is_gradual(), 1e-310 * 1.0 == 0.0]
thread = threading.Thread(target=lambda: answer.append(is_gradual()))
thread.start()
thread.join()
"""
    assert in_the_mode(seen) == [False, True, False]
    assert in_the_mode(seen, mode=False) == [True, False, True]
    assert is_gradual()
    require_gradual("this test")


def test_subnormal_limbs_are_the_exact_ones():
    assert in_the_mode("answer = tails(1000)") == tails(1000)


def test_tiny_numbers_have_subnormal_limbs_that_leave_less_than_half_of_the_last_bit():
    """By rational arithmetic alone, on the bits that the process with the mode gave."""
    code = "from fractions import Fraction\nfrom reference.arithmetic.limbs import exact_limbs\n"
    code += "answer = [bits(exact_limbs(Fraction(1, 3 << shift), 3)) for shift in range(900, 1080, 7)]"
    for shift, limbs in zip(range(900, 1080, 7), in_the_mode(code), strict=True):
        rest = Fraction(1, 3 << shift)
        for mantissa, exponent in map(parts, limbs):
            rest -= mantissa * Fraction(2) ** exponent
            assert abs(rest) <= Fraction(2) ** (exponent - 1)


@pytest.mark.parametrize("asked", [STATES, INPUTS], ids=["states", "inputs"])
def test_values_and_inputs_are_the_same_as_without_the_mode(asked):
    assert in_the_mode(asked) == in_the_mode(asked, mode=False)


def test_a_file_is_built_and_proven_again_as_without_the_mode(tmp_path):
    (tmp_path / "in").mkdir()
    (tmp_path / "out").mkdir()
    built = in_the_mode(BUILT, folder=tmp_path / "in")
    assert built == in_the_mode(BUILT, mode=False, folder=tmp_path / "out")
    assert any(0 < size & ~(1 << 63) < 1 << 52 for size in built[2])
    assert built[3] == ["", ""]
    assert built[4].split()[1] == "1e-310"
    (wrong,) = in_the_mode(FORGED, folder=tmp_path / "in")
    assert "is stored as" in wrong
    assert "e-3" in wrong


def test_where_floats_decide_the_mode_is_refused_in_one_sentence():
    *commands, check, score, errors, drift = in_the_mode(REFUSED)
    assert commands == [[2, f"error: the command line {SENTENCE}\n"]] * 2
    assert check == f"a check {SENTENCE}"
    assert score == f"a score {SENTENCE}"
    assert errors == drift == f"a comparison {SENTENCE}"


LAID_OUT = """
from reference import *
from reference.arithmetic.underflow import UnderflowModeError
answer, number = [], Pendulum("1e-310").certified("state", 0)
for spec in ("", ">30", "g", ".3%", ".5e", ".400f", ".3g"):
    try:
        answer.append(format(number, spec))
    except UnderflowModeError as refusal:
        answer.append(str(refusal))
"""


def test_a_subnormal_number_is_laid_out_from_its_own_digits_or_refused():
    proven, nearest = ["1.00000e-310", f"0.{'0' * 309}1{'0' * 90}", "1e-310"], ["1e-310", f"{'1e-310':>30}", "1e-310"]
    assert in_the_mode(LAID_OUT, mode=False) == [*nearest, "0.000%", *proven]
    refused = [f"theta in the format '{spec}' {SENTENCE}" for spec in ("", ">30", "g", ".3%")]
    assert in_the_mode(LAID_OUT) == [*refused, *proven]
