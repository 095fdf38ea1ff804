"""Examples of docs/interop.md in other languages run, and that page and the list of other packages' methods agree."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import tomllib
from pathlib import Path

import pytest
from interop.methods import EXPLAINED, METHODS

from compare.__main__ import main

ROOT = Path(__file__).parents[2]
SNIPPETS = Path(__file__).parent / "snippets"
PAGE = (ROOT / "docs" / "interop.md").read_text(encoding="utf-8")
FOUND = (ROOT / "docs" / "third-party.md").read_text(encoding="utf-8")
PROGRAMS = {
    "step.c": ("gcc -o step step.c -lm", "./step"),
    "step.rs": ("rustc step.rs", "./step"),
    "step.js": ("", "node step.js"),
    "step.jl": ("", "julia step.jl"),
    "rk4.c": ("gcc -shared -fPIC -O2 -o rk4.so rk4.c", "rk4.so:rk4"),
}
"""How each is made, and what is judged."""
LONGEST = 5
"""Lines of a function that turns a method into what is judged."""


def needed(source: str) -> str:
    made, judged = PROGRAMS[source]
    return (made or judged).split()[0]


@pytest.mark.parametrize("source", PROGRAMS)
def test_the_page_shows_the_program_as_it_is(source):
    blocks = re.findall(r"```\w+\n(.*?)```", PAGE, re.DOTALL)
    assert (SNIPPETS / source).read_text(encoding="utf-8") in blocks


@pytest.mark.parametrize("source", [source for source in PROGRAMS if shutil.which(needed(source))])
def test_a_program_of_the_page_holds_its_claims(source, tmp_path, monkeypatch, capsys):
    made, judged = PROGRAMS[source]
    shutil.copy(SNIPPETS / source, tmp_path)
    monkeypatch.chdir(tmp_path)
    if made:
        subprocess.run(made.split(), check=True)
    words = [judged, "--order", "4"]
    if source != "rk4.c":
        words = ["--process", judged, "--problem", "pendulum", "--order", "2", "--symplectic", "--reversible"]
    assert main(["check", *words, "--format", "json"]) == 0
    assert {one["standing"] for one in json.loads(capsys.readouterr().out)["verdicts"]} == {"PASS"}


def examples() -> list[str]:
    return re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)


def test_every_example_of_python_is_a_few_lines_and_ends_with_a_claim():
    for example in examples():
        assert example.splitlines()[-1].startswith("compare.check(")
        assert example.splitlines()[-1].endswith(".assert_holds()")
        for function in re.findall(r"^(?:@.*\n)?def .*\n(?:    .*\n)+", example, re.MULTILINE):
            assert len([line for line in function.splitlines() if not line.startswith("@")]) <= LONGEST


def test_the_packages_of_the_page_the_list_and_the_extra_are_the_same():
    headed = {heading.lower() for heading in re.findall(r"^## (\w+)$", PAGE, re.MULTILINE)}
    extra = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["optional-dependencies"]
    asked = {re.match(r"[\w-]+", line)[0] for line in extra["interop"]}
    listed = {method.package for method in METHODS}
    assert listed == headed
    assert listed <= asked


def rows() -> dict[tuple[str, str, str], str]:
    """The verdict of each package, method and claim in the table of docs/third-party.md."""
    cells = [
        [cell.strip() for cell in line.strip("|").split("|")] for line in FOUND.splitlines() if line.startswith("| ")
    ]
    found = {(row[0].split()[0], row[1], row[2].split()[0]): row[3] for row in cells if len(row) == 5}
    del found["package", "method", "claim"]
    return found


def test_the_table_has_every_claim_of_the_list_and_explains_what_is_no_pass():
    found = rows()
    claimed = {(one.package, one.name, claim) for one in METHODS for claim in one.claims}
    assert claimed == set(found)
    assert {key for key, verdict in found.items() if verdict != "PASS"} == set(EXPLAINED)
    for (package, name, _), reason in EXPLAINED.items():
        assert f"- {package} {name}: {reason}" in FOUND


def test_the_table_is_counted_right():
    standing = [{claim: rows()[one.package, one.name, claim] for claim in one.claims} for one in METHODS]
    good = sum(set(one.values()) == {"PASS"} for one in standing)
    assert len(METHODS) >= 80
    assert good >= 60
    assert f"Of {len(METHODS)} methods {good} hold all that their packages claim of them" in FOUND
