"""How the packages hang together."""

from __future__ import annotations

import ast
import importlib
import inspect
import subprocess
import sys
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

import reference
from reference.problems.families import FAMILIES

ROOT = Path(__file__).parents[1]
PACKAGES = ("reference", "compare")
SOURCES = sorted(path for package in PACKAGES for path in (ROOT / package).rglob("*.py"))


def module_name(path: Path) -> str:
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = [module_name(path) for path in SOURCES if path.name != "__main__.py"]


@cache
def imports(path: Path) -> set[str]:
    """The absolute names of all modules that a file imports, wherever it does."""
    found: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: a relative import"
            found.add(str(node.module))
            found |= {f"{node.module}.{alias.name}" for alias in node.names}
        elif isinstance(node, ast.Call) and "import" in ast.unparse(node.func):
            found |= {str(argument.value) for argument in node.args if isinstance(argument, ast.Constant)}
    return found


def id_of(path: Path) -> str:
    return str(path.relative_to(ROOT))


def test_there_are_sources_in_both_packages():
    assert {path.relative_to(ROOT).parts[0] for path in SOURCES} == set(PACKAGES)
    assert len(SOURCES) > 20


@pytest.mark.parametrize("path", [path for path in SOURCES if path.is_relative_to(ROOT / "reference")], ids=id_of)
def test_the_reference_never_imports_what_is_compared_with_it(path):
    assert not {name for name in imports(path) if name.split(".")[0] == "compare"}


@pytest.mark.parametrize("path", SOURCES, ids=id_of)
def test_nothing_imports_a_command_line(path):
    assert not {name for name in imports(path) if name.endswith("__main__")}


@pytest.mark.parametrize("path", SOURCES, ids=id_of)
def test_only_the_dataset_knows_the_file_format(path):
    if not path.is_relative_to(ROOT / "reference" / "dataset"):
        assert not {name for name in imports(path) if name.split(".")[0] == "h5py"}


WRITERS = {"render.py": ("csv.writer", "DictWriter"), "text_table.py": ("toprule", "rjust", "textasciitilde")}
"""What lays out tables, and the one module of compare/show that has it."""


@pytest.mark.parametrize("path", [path for path in SOURCES if path.is_relative_to(ROOT / "compare")], ids=id_of)
def test_tables_are_written_in_one_place(path):
    text = path.read_text(encoding="utf-8")
    for home, words in WRITERS.items():
        assert path == ROOT / "compare" / "show" / home or not [word for word in words if word in text]


@pytest.mark.parametrize("path", SOURCES, ids=id_of)
def test_nothing_imports_the_tests(path):
    """But the plugin, which pytest itself imports."""
    named = {"tests", "pytest", "hypothesis", "independent"}
    allowed = {"pytest"} if path == ROOT / "compare" / "pytest_plugin.py" else set()
    assert {name.split(".")[0] for name in imports(path)} & named <= allowed


@pytest.mark.parametrize("name", MODULES)
def test_every_public_thing_says_what_it_is(name):
    module = importlib.import_module(name)
    assert module.__doc__, f"{name} has no docstring"
    for public in getattr(module, "__all__", ()):
        value = getattr(module, public)
        if inspect.isclass(value) or inspect.isfunction(value):
            assert inspect.getdoc(value), f"{name}.{public} has no docstring"


@pytest.mark.parametrize("name", MODULES)
def test_every_name_that_a_module_promises_is_there(name):
    module = importlib.import_module(name)
    missing = [public for public in getattr(module, "__all__", ()) if not hasattr(module, public)]
    assert not missing


LAYERS = (
    ("reference.names", "reference.once", "reference.packages", "reference.version"),
    ("reference.named",),
    ("reference.arithmetic",),
    ("reference.constants", "reference.row_domains", "compare.methods"),
    ("reference.declaration", "reference.input_condition", "reference.orbits", "reference.state_bounds"),
    ("reference.routes",),
    ("reference.certified",),
    ("reference.problem",),
    ("reference.consistency",),
    ("reference.layout",),
    ("reference.family",),
    ("reference.flow_problem",),
    ("reference.flow_families",),
    ("reference.flow",),
    ("reference.command",),
    ("reference.problems",),
    ("reference.dataset",),
    ("reference",),
    ("compare.march",),
    ("compare.measure",),
    ("compare.show", "compare.scored"),
    ("compare.controlled",),
    ("compare.options", "compare.study", "compare.baseline"),
    ("compare.claims", "compare.files", "compare.solvers", "compare.sources"),
    ("compare.report",),
    ("compare",),
    ("compare.arguments", "compare.pytest_plugin"),
    ("compare.__main__", "reference.__main__"),
)
"""Rooms, folders or modules beside them, in the order in which the work goes: each imports of those above it alone."""
ROOMS = {room: layer for layer, rooms in enumerate(LAYERS) for room in rooms}


def room_of(name: str) -> str:
    """The folder or module that a dotted name lies in: the package itself for what it holds by name."""
    second = ".".join(name.split(".")[:2])
    return second if second in ROOMS else name.split(".", maxsplit=1)[0]


def test_every_source_has_its_room():
    known = {name.partition(".")[0]: name for name in ROOMS}
    assert set(known) == set(PACKAGES)
    for path in SOURCES:
        name = ".".join(path.relative_to(ROOT).with_suffix("").parts[:2])
        assert name in ROOMS or name.endswith(".__init__"), f"{path} lies in no room"


@pytest.mark.parametrize("path", SOURCES, ids=id_of)
def test_a_room_imports_only_of_those_before_it(path):
    name = ".".join(path.relative_to(ROOT).with_suffix("").parts)
    room = room_of(name.removesuffix(".__init__"))
    for other in {room_of(found) for found in imports(path) if found.split(".")[0] in PACKAGES} - {room}:
        assert ROOMS[other] < ROOMS[room], f"{path} imports {other}"


def test_no_modules_import_each_other_in_a_circle():
    """Neither for annotations, nor within functions."""
    known = set(MODULES)
    graph = {module_name(path): (imports(path) & known) - {module_name(path)} for path in SOURCES}
    try:
        tuple(TopologicalSorter(graph).static_order())
    except CycleError as error:
        pytest.fail(" imports ".join(reversed(error.args[1])))


@pytest.mark.parametrize("package", PACKAGES)
def test_importing_a_package_leaves_the_slow_libraries_for_later(package):
    slow = "('matplotlib', 'xarray', 'h5py', 'scipy', 'rich')"
    code = f"import sys, {package}; print([name for name in {slow} if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


FAMILY_NAMES = {word for family in FAMILIES for word in (family.name, family.comparison.command)}
JUDGES = [path for path in SOURCES if path.is_relative_to(ROOT / "compare") and "sources" not in path.parts]


@pytest.mark.parametrize("path", JUDGES, ids=id_of)
def test_no_judge_names_a_family(path):
    """What a score must know of a problem is declared by the problem: none asks for its name or its class."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    homes = {name for name in imports(path) if name.startswith("reference.problems.")}
    assert {name for name in homes if not name.startswith("reference.problems.families")} == set()
    classes = {name for name, home in reference._HOMES.items() if home.startswith("reference.problems.")}
    for node in ast.walk(tree):
        if isinstance(node, ast.Name):
            assert node.id not in classes, f"line {node.lineno} names {node.id}"
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            assert node.value not in FAMILY_NAMES, f"line {node.lineno} names {node.value}"
        if isinstance(node, ast.Compare) and isinstance(node.left, ast.Attribute):
            told = ast.unparse(node.left)
            assert not told.endswith("problem.name"), f"line {node.lineno} asks for {told}"
        if isinstance(node, ast.Call) and ast.unparse(node.func) == "getattr" and len(node.args) == 3:
            assert "problem" not in ast.unparse(node.args[0]), f"line {node.lineno} reads a problem with a default"
