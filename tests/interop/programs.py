"""The programs in other languages of docs/interop.md, built and judged as it says; ``make interop`` names this file.

A compiler that is missing is a failure.  What is in UNTRIED is never run.
"""

from __future__ import annotations

import json
import math
import shlex
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import compare
from compare.__main__ import main
from compare.methods.own.forms import loaded

SNIPPETS = Path(__file__).parents[1] / "compare" / "snippets"
PROGRAMS = {
    "step.c": ("gcc step.c -o step -lm", "./step"),
    "step.rs": ("rustc step.rs", "./step"),
    "step.js": ("", "node step.js"),
}
"""How each is made, and what is judged."""
LIBRARY = ("gcc -shared -fPIC -O2 rk4.c -o rk4.so", "rk4.so:rk4")
UNTRIED = {"step.jl"}


@pytest.fixture(params=PROGRAMS)
def program(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """The command of one that was made."""
    made, command = PROGRAMS[request.param]
    shutil.copy(SNIPPETS / request.param, tmp_path)
    monkeypatch.chdir(tmp_path)
    if made:
        subprocess.run(shlex.split(made), check=True)
    return command


def test_every_program_of_the_page_is_tried_but_for_those_that_are_named() -> None:
    assert {*PROGRAMS, *UNTRIED} == {path.name for path in SNIPPETS.glob("step.*")}


def test_a_program_takes_the_step_that_it_is_said_to_take(program: str) -> None:
    """Stormer's and Verlet's, by the same operations: to the last bit, but for what a language's sine differs by."""
    h, theta, omega = 0.125, 1.0, 0.5
    middle = omega - h / 2 * 9.81 * math.sin(theta)
    new = theta + h * middle
    expected = [new, middle - h / 2 * 9.81 * math.sin(new)]
    assert compare.Process(program)(np.array([theta, omega]), h) == pytest.approx(expected, rel=4e-16)


def test_a_program_holds_the_claims_of_the_page(program: str, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["--process", program, "--problem", "pendulum", "--order", "2", "--symplectic", "--reversible"]
    assert main(["check", *words, "--format", "json"]) == 0
    assert {one["standing"] for one in json.loads(capsys.readouterr().out)["verdicts"]} == {"PASS"}


def test_the_library_of_the_page_is_of_order_four(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.copy(SNIPPETS / "rk4.c", tmp_path)
    monkeypatch.chdir(tmp_path)
    subprocess.run(shlex.split(LIBRARY[0]), check=True)
    compare.check(loaded(LIBRARY[1]), order=4).assert_holds()
    with pytest.raises(ValueError, match="has no function nothing; one that it exports is accepted"):
        loaded("rk4.so:nothing")
