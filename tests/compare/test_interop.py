"""The page docs/interop.md shows what ``make interop`` runs, in a few lines each, and the lists of it agree."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest
from interop.methods import EXPLAINED, METHODS
from interop.programs import LIBRARY, PROGRAMS, SNIPPETS, UNTRIED

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "interop.md").read_text(encoding="utf-8")
FOUND = (ROOT / "docs" / "third-party.md").read_text(encoding="utf-8")
LONGEST = 5
"""Lines of a recipe, beside its imports and its claims."""
LONGER = {"REBOUND": 7}
"""Those that are longer, of which the page says why."""


@pytest.mark.parametrize("source", ["rk4.c", *PROGRAMS, *UNTRIED])
def test_the_page_shows_the_program_as_it_is(source):
    blocks = re.findall(r"```\w+\n(.*?)```", PAGE, re.DOTALL)
    assert (SNIPPETS / source).read_text(encoding="utf-8") in blocks


def test_the_page_has_the_commands_that_are_run_and_names_the_program_that_is_not():
    claims = "--problem pendulum --order 2 --symplectic --reversible"
    for made, command in PROGRAMS.values():
        judged = f"python -m compare check --process {command if ' ' not in command else repr(command)} {claims}"
        assert (f"{made} && {judged}" if made else judged).replace("'", '"') in PAGE
    made, judged = LIBRARY
    assert f"{made}\npython -m compare check {judged} --order 4" in PAGE
    assert {"step.jl"} == UNTRIED
    assert "The program in Julia is never run by the tests" in PAGE


def recipes() -> list[tuple[str, str]]:
    """The heading and the lines of each example in Python."""
    parts = re.split(r"^## (.*)$", PAGE, flags=re.MULTILINE)
    found = zip(parts[1::2], parts[2::2], strict=True)
    return [(name, code) for name, part in found for code in re.findall(r"```python\n(.*?)```", part, re.DOTALL)]


def test_a_recipe_is_a_few_lines_beside_its_imports_and_its_claims():
    """Decorators, settings and what is made beforehand among them."""
    counts: dict[str, list[int]] = {}
    for name, code in recipes():
        lines = [line for line in code.splitlines() if line.strip() and not re.match(r"(import|from) ", line)]
        claims = [line for line in lines if line.startswith("compare.check(")]
        assert lines[-1] in claims
        assert all(line.endswith(".assert_holds()") for line in claims)
        counts.setdefault(name, []).append(len(lines) - len(claims))
    assert {name: max(found) for name, found in counts.items() if max(found) > LONGEST} == LONGER


def test_the_packages_of_the_page_the_list_and_the_extra_are_the_same():
    headed = {name.lower() for name, _ in recipes()}
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
