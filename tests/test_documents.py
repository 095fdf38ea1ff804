"""The documents say what is true: their examples run, their commands exist, their numbers agree."""

from __future__ import annotations

import argparse
import doctest
import os
import re
import shlex
import subprocess
import sys
import tomllib
from importlib import import_module
from pathlib import Path

import pytest
from problems_page import tables

import reference
from reference.dataset.schema import RELEASED
from reference.named import with_equations
from reference.problems.families import FAMILIES

ROOT = Path(__file__).parents[1]
DOCUMENTS = sorted([*ROOT.glob("*.md"), *(ROOT / "docs").glob("*.md"), *(ROOT / "data").glob("*.md")])
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
COMMAND = re.compile(r"python3? -m ((?:reference|compare)(?![.\w])[^`\n|&]*)")
TARGET = re.compile(r"\bmake ([a-z]+)\b(?=`|\n)")
LINK = re.compile(r"\]\((?!https?:)([^)#\s]+)")


def text_of(path: Path) -> str:
    return path.read_text(encoding="utf-8")


def id_of(path: Path) -> str:
    return str(path.relative_to(ROOT))


def commands() -> list[str]:
    """Every ``python -m reference|compare ...`` of the documents, once."""
    return sorted({match.strip() for path in DOCUMENTS for match in COMMAND.findall(text_of(path))})


def subcommands(package: str) -> set[str]:
    """The names of a command line's commands, as argparse knows them."""
    return set(_choices(_parser([package])))


def _parser(words: list[str]) -> argparse.ArgumentParser:
    """The parser that a command line comes to, by its package and the words after it."""
    package, *rest = words
    if package == "reference":
        return import_module("reference.__main__")._parser(rest)
    return import_module("compare.arguments").parser_for([*rest, "pendulum"])


def _choices(parser: argparse.ArgumentParser) -> dict[str, argparse.ArgumentParser]:
    actions = [action for action in parser._actions if isinstance(action, argparse._SubParsersAction)]
    return dict(actions[0].choices) if actions else {}


def parser_of(words: list[str]) -> argparse.ArgumentParser:
    """The parser that reads the options of a command, found by walking down its subcommands."""
    parser = _parser(words)
    for word in words[1:]:
        choices = _choices(parser)
        if not choices:
            break
        assert word in choices, f"there is no command {word}; there are {sorted(choices)}"
        parser = choices[word]
    return parser


def run(arguments: list[str], **options) -> subprocess.CompletedProcess[str]:
    environment = {name: value for name, value in os.environ.items() if name != "COLUMNS"}
    return subprocess.run(arguments, cwd=ROOT, capture_output=True, text=True, check=False, env=environment, **options)


@pytest.mark.parametrize("path", DOCUMENTS, ids=id_of)
def test_python_examples_give_what_they_show(path, monkeypatch):
    monkeypatch.chdir(ROOT)
    assert doctest.testfile(str(path), module_relative=False, encoding="utf-8").failed == 0


def cells(line: str) -> list[str]:
    """The words of a line; below 1e-12, where processors differ, an error and its mark or order are one word."""
    return re.sub(r"\S+e-1[3-9] (\*|[\d.]+)|\S+ \*", "rounding", line).split()


def matches(shown: str, printed: str) -> bool:
    """Equal words, but numbers to a few per cent: near the floor, the last digits belong to the processor."""
    pairs = list(zip(cells(shown), cells(printed), strict=False))
    return len(cells(shown)) == len(cells(printed)) and all(
        a == b or ("." in a and "." in b and float(a) == pytest.approx(float(b), rel=0.05)) for a, b in pairs
    )


def test_the_tables_on_the_first_screen_are_what_the_command_prints():
    blocks = re.findall(r"```\n(.*?)```", text_of(ROOT / "README.md"), re.DOTALL)
    assert blocks[0] == "make run\n"
    printed = run([sys.executable, "-m", "compare", "pendulum", "--quiet"]).stdout.splitlines()
    shown = blocks[1].rstrip("\n").splitlines()
    assert len(shown) > 15
    begin = next(i for i, line in enumerate(printed) if line == shown[0])
    for line, other in zip(shown, printed[begin:], strict=False):
        assert matches(line, other), line


def test_the_readme_and_the_page_on_truth_have_examples():
    parse = doctest.DocTestParser().get_examples
    assert len(parse(text_of(ROOT / "README.md"))) >= 4
    assert len(parse(text_of(ROOT / "docs" / "truth.md"))) >= 3


@pytest.mark.parametrize("command", commands())
def test_every_command_in_the_documents_can_be_parsed(command):
    package, *rest = shlex.split(command)
    words = [package, *with_equations(rest)]
    parser = parser_of(words)
    known = {option for action in parser._actions for option in action.option_strings}
    assert {word.partition("=")[0] for word in words if word.startswith("--")} <= known


@pytest.mark.parametrize("package", ["reference", "compare"])
def test_every_command_is_documented(package):
    """The command of a flow is its name, which stands in the table of problems."""
    documented = {words[1] for words in map(shlex.split, commands()) if words[0] == package and len(words) > 1}
    flows = {family.comparison.command for family in FAMILIES if not family.has_closed_form}
    assert subcommands(package) - flows <= documented


@pytest.mark.parametrize("package", ["reference", "compare"])
def test_every_command_has_help(package, capsys):
    main = import_module(f"{package}.__main__").main
    for name in subcommands(package):
        with pytest.raises(SystemExit) as ended:
            main([name, "--help"])
        assert ended.value.code == 0
        assert f"python -m {package} {name}" in capsys.readouterr().out


def test_the_tables_of_problems_are_what_they_declare():
    assert tables() in text_of(ROOT / "docs" / "problems.md")


@pytest.mark.parametrize("path", DOCUMENTS, ids=id_of)
def test_every_make_target_that_is_named_exists(path):
    makefile = text_of(ROOT / "Makefile")
    for target in TARGET.findall(text_of(path)):
        assert re.search(rf"^{target}:", makefile, re.MULTILINE), target


@pytest.mark.parametrize("path", DOCUMENTS, ids=id_of)
def test_links_lead_somewhere(path):
    for link in LINK.findall(text_of(path)):
        assert (path.parent / link).exists(), link


@pytest.mark.parametrize("path", [path for path in DOCUMENTS if path.parent.name == "docs"], ids=id_of)
def test_prose_has_one_sentence_a_line(path):
    """A table's rows are no prose."""
    prose = re.sub(r"```.*?```", "", text_of(path), flags=re.DOTALL)
    for line in (line for line in prose.splitlines() if not line.startswith("| ")):
        assert not re.search(r"[a-z)`]\. [A-Z]", line), line


def test_the_version_is_the_same_everywhere():
    version = PROJECT["version"]
    assert reference.__version__ == version
    assert re.search(rf"^version: {re.escape(version)}$", text_of(ROOT / "CITATION.cff"), re.MULTILINE)
    assert f"## [{version}]" in text_of(ROOT / "CHANGELOG.md")


def test_the_citation_file_has_what_its_format_requires():
    text = text_of(ROOT / "CITATION.cff")
    keys = dict(re.findall(r"^([a-z-]+):[ ]?(.*)$", text, re.MULTILINE))
    assert keys["cff-version"] == "1.2.0"
    assert {"title", "message", "authors", "version", "license", "type"} <= keys.keys()
    assert keys["type"] in {"software", "dataset"}
    assert keys["license"] == "BSD-3-Clause"  # one: readers such as Zenodo's take no list
    assert keys["date-released"] == RELEASED[keys["version"]]


def test_the_changelog_keeps_its_format():
    text = text_of(ROOT / "CHANGELOG.md")
    headings = re.findall(r"^## (.*)$", text, re.MULTILINE)
    assert headings[0] == "[Unreleased]"
    assert all(re.fullmatch(r"\[\d+\.\d+\.\d+\]( - \d{4}-\d{2}-\d{2})?", heading) for heading in headings[1:])
    kinds = {"Added", "Changed", "Deprecated", "Removed", "Fixed", "Security", "Data"}
    assert set(re.findall(r"^### (.*)$", text, re.MULTILINE)) <= kinds


def test_both_licences_are_given():
    text = text_of(ROOT / "LICENSE")
    assert "BSD 3-Clause License" in text
    assert "https://creativecommons.org/licenses/by/4.0/legalcode" in text
    assert PROJECT["license"] == "BSD-3-Clause AND CC-BY-4.0"


def test_make_alone_prints_help():
    done = run(["make", "--no-print-directory"])
    assert done.returncode == 0
    for target in ("run", "test", "setup", "data", "bench", "clean"):
        assert f"make {target} " in done.stdout


@pytest.mark.parametrize(
    ("python", "said"),
    [("/no/such/python", "which is no program"), ("false", "Python 3.11 or newer is needed"), ("", "No Python 3.11")],
)
def test_make_says_which_python_it_needs(tmp_path, python, said):
    done = run(["make", "--no-print-directory", "setup", f"PYTHON={python}", f"VENV={tmp_path / 'venv'}"])
    assert done.returncode == 2
    assert said in done.stderr
    assert not (tmp_path / "venv").exists()


def test_make_clean_removes_the_environment_that_it_set_up_and_no_other_folder(tmp_path):
    (tmp_path / "Makefile").write_text(text_of(ROOT / "Makefile"))
    names = ("ours", "my files", "files", "linked", "my")
    for name in (*names, "reference", "compare", "tests"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "notes").write_text("mine")
    (tmp_path / "ours" / ".installed").touch()
    (tmp_path / "linked" / ".installed").touch()
    (tmp_path / "link").symlink_to("linked")
    for name in ("my files", "link", "files/", ".."):
        done = run(["make", "-C", str(tmp_path), "clean", f"VENV={name}"])
        assert "was not set up by make; it stays." in done.stderr
        assert all((tmp_path / kept / "notes").exists() for kept in names)
    assert run(["make", "-C", str(tmp_path), "clean", "VENV=ours"]).returncode == 0
    assert [name for name in names if not (tmp_path / name).exists()] == ["ours"]
