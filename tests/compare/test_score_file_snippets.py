"""The programs in docs/score.md: each stands beside the table that it printed, and each table can be judged."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

from compare.__main__ import main

ROOT = Path(__file__).parents[2]
SNIPPETS = Path(__file__).parent / "snippets"
PRINTED = {
    "verlet.c": "c.csv",
    "verlet.f90": "fortran.txt",
    "verlet.m": "octave.csv",
    "verlet.R": "r.csv",
    "verlet.rs": "rust.csv",
    "verlet.js": "javascript.csv",
    "verlet.py": "python.csv",
    "verlet.jl": "python.csv",  # Julia writes the same shortest decimals as Python
}


def test_every_snippet_has_a_table_and_every_table_a_snippet():
    steps = {*SNIPPETS.glob("step.*"), SNIPPETS / "rk4.c"}  # of docs/interop.md
    assert {path.name for path in {*SNIPPETS.iterdir()} - steps} == set(PRINTED) | set(PRINTED.values())


@pytest.mark.parametrize("source", PRINTED)
def test_the_document_shows_the_program_as_it_is(source):
    blocks = re.findall(r"```\w+\n(.*?)```", (ROOT / "docs" / "score.md").read_text(encoding="utf-8"), re.DOTALL)
    assert (SNIPPETS / source).read_text(encoding="utf-8") in blocks


@pytest.mark.parametrize("table", sorted(set(PRINTED.values())))
def test_the_table_that_a_program_printed_is_judged(table, capsys):
    assert main(["score", str(SNIPPETS / table), "--theta0", "1", "--format", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["rows"], found["worst_row"], found["times"]) == (65, 35, "binary64")
    assert found["max_error"] == pytest.approx(9.47700e-4, rel=1e-5)
    assert found["max_phase_error"] == pytest.approx(3.37837e-4, rel=1e-5)


def test_the_document_shows_the_summary_that_is_printed(capsys):
    assert main(["score", str(SNIPPETS / "python.csv"), "--theta0", "1"]) == 0
    assert capsys.readouterr().out.splitlines()[-1] in (ROOT / "docs" / "score.md").read_text(encoding="utf-8")


def test_the_python_program_prints_its_table():
    done = subprocess.run(
        [sys.executable, SNIPPETS / "verlet.py"], capture_output=True, text=True, check=True, cwd=SNIPPETS
    )
    printed, kept = (re.split(r"[,\n]", text) for text in (done.stdout, (SNIPPETS / "python.csv").read_text()))
    assert printed[:6] == kept[:6]
    assert [float(word) for word in printed[3:-1]] == pytest.approx([float(word) for word in kept[3:-1]], abs=1e-13)
