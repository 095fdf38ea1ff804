"""What CONTRIBUTING teaches is done, in a copy of the tree: a method and a problem, a file each."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
GUIDE = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def tree(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of both packages."""
    copy = tmp_path_factory.mktemp("tree")
    for package in ("reference", "compare"):
        shutil.copytree(ROOT / package, copy / package, ignore=shutil.ignore_patterns("__pycache__"))
    return copy


def ran(tree: Path, *words: str) -> str:
    environment = {**os.environ, "PYTHONPATH": str(tree)}
    done = subprocess.run(
        [sys.executable, "-m", *words], cwd=tree, env=environment, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stderr) == (0, ""), done.stderr
    return done.stdout


def test_a_method_is_one_file_that_is_touched(tree: Path) -> None:
    (table,) = re.findall(r"```python\n(HEUN3 = .*?)```", GUIDE, re.DOTALL)
    home = tree / "compare" / "methods" / "explicit.py"
    text = home.read_text(encoding="utf-8")
    assert text.count("EXPLICIT = (\n    ") == 1
    home.write_text(text.replace("EXPLICIT = (\n    ", f"{table}\nEXPLICIT = (\n    HEUN3, "), encoding="utf-8")
    assert "heun3" in ran(tree, "compare", "list")
    shown = json.loads(ran(tree, "compare", "show", "heun3", "--format", "json"))
    assert shown["proven_order"] == shown["order"] == 3
    words = ("--methods", "heun3,rk4", "--n", "256,512,1024,2048", "--format", "json")
    orders = json.loads(ran(tree, "compare", "pendulum", *words))["tables"]["order"]
    fitted = {row["method"]: row["fitted_order"] for row in orders}
    assert fitted["heun3"] == pytest.approx(3, abs=0.05)


def test_a_problem_is_one_file_that_is_added(tree: Path) -> None:
    shutil.copy(ROOT / "docs" / "duffing.py", tree / "reference" / "problems" / "duffing.py")
    words = ("--a", "1", "--t", "2.5", "--digits", "20", "--format", "json")
    value = json.loads(ran(tree, "reference", "at", "duffing", *words))
    assert value["period"].startswith("4.76802202910246080")
    orders = json.loads(
        ran(tree, "compare", "duffing", "--methods", "verlet,rk4", "--n", "256,512,1024,2048", "--format", "json")
    )["tables"]["order"]
    assert {row["method"]: round(row["fitted_order"]) for row in orders} == {"verlet": 2, "rk4": 4}
    assert "duffing" in ran(tree, "compare", "--help")


@pytest.mark.parametrize("path", re.findall(r"`((?:compare|reference|tests|docs)/[\w/.]+\.py)`", GUIDE))
def test_every_file_that_is_named_is_there(path: str) -> None:
    assert (ROOT / path).is_file() or Path(path).stem == "NAME"
