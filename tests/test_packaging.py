"""What is built is what is meant to be: both packages, the core dataset, and nothing else."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tarfile
import tomllib
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
REQUIREMENT = re.compile(r"^([A-Za-z0-9][A-Za-z0-9._-]*?)(?:[<>=!~\[; ].*)?$")


def build(kind: str, source: Path, into: Path) -> Path:
    subprocess.run([sys.executable, "-m", "hatchling", "build", "-t", kind, "-d", str(into)], cwd=source, check=True)
    (built,) = into.iterdir()
    return built


def run_python(code: str, path: Path, folder: Path) -> str:
    environment = {**os.environ, "PYTHONPATH": str(path)}
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=folder, env=environment, capture_output=True, text=True, check=True
    )
    return done.stdout.strip()


@pytest.fixture(scope="module")
def wheel(tmp_path_factory) -> Path:
    return build("wheel", ROOT, tmp_path_factory.mktemp("wheel"))


@pytest.fixture(scope="module")
def sdist(tmp_path_factory) -> Path:
    return build("sdist", ROOT, tmp_path_factory.mktemp("sdist"))


def test_the_extras_that_sentences_offer_exist_with_what_they_promise():
    paths = [path for package in ("reference", "compare") for path in (ROOT / package).rglob("*.py")]
    offered = {name for path in paths for name in re.findall(r"horologium\[(\w+)\]", path.read_text("utf-8"))}
    extras = PROJECT["optional-dependencies"]
    assert {"cluster", "xarray"} <= offered <= set(extras)
    assert [REQUIREMENT.match(line)[1] for line in extras["cluster"]] == ["dask", "mpi4py"]
    assert "xarray>=2024.10" in extras["xarray"]  # the first with DataTree


def names_in(wheel: Path) -> set[str]:
    with zipfile.ZipFile(wheel) as archive:
        return set(archive.namelist())


def test_the_wheel_holds_every_module_and_the_dataset(wheel):
    names = names_in(wheel)
    modules = {str(p.relative_to(ROOT)) for package in ("reference", "compare") for p in (ROOT / package).rglob("*.py")}
    assert modules <= names
    assert {"reference/py.typed", "compare/py.typed"} <= names
    assert {"reference/data/horologium-core.h5", "reference/data/SHA256SUMS"} <= names


def test_the_wheel_holds_nothing_else(wheel):
    for name in names_in(wheel):
        top = name.split("/")[0]
        assert top in {"reference", "compare", f"horologium-{PROJECT['version']}.dist-info"}
        assert not re.search(r"__pycache__|\.pyc$|\.partial|(^|/)tests?(/|$)|(^|/)\.", name), name


def test_the_licence_goes_with_the_wheel(wheel):
    names = names_in(wheel)
    assert f"horologium-{PROJECT['version']}.dist-info/licenses/LICENSE" in names


def test_the_installed_dataset_is_the_one_of_the_checkout(wheel):
    with zipfile.ZipFile(wheel) as archive:
        for name in ("horologium-core.h5", "SHA256SUMS"):
            assert archive.read(f"reference/data/{name}") == (ROOT / "data" / name).read_bytes()


def test_the_packages_work_from_the_wheel_alone(wheel, tmp_path):
    installed, elsewhere = tmp_path / "installed", tmp_path / "elsewhere"
    elsewhere.mkdir()
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(installed)
    code = (
        "import reference, compare; from pathlib import Path; "
        "value = reference.load()['pendulum/libration/period'].value; "
        "print(Path(reference.__file__).parents[1], value.dtype, bool((value > 0).all()))"
    )
    assert run_python(code, installed, elsewhere) == f"{installed} float64 True"


def test_a_wheel_built_from_the_sdist_is_the_same(wheel, sdist, tmp_path):
    with tarfile.open(sdist) as archive:
        archive.extractall(tmp_path, filter="data")
    (source,) = (path for path in tmp_path.iterdir() if path.is_dir())
    assert not list(source.rglob("*.pyc"))
    assert {path.name for path in source.iterdir()} >= {"Makefile", "constraints.txt", "tests", "docs", "data"}
    again = build("wheel", source, tmp_path / "again")
    assert again.read_bytes() == wheel.read_bytes()


def test_every_direct_dependency_is_pinned_exactly():
    lines = [line.split("#")[0].strip() for line in (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()]
    pins = [line for line in lines if line]
    assert all(re.fullmatch(r"[A-Za-z0-9._-]+==[0-9][A-Za-z0-9.]*", pin) for pin in pins)
    pinned = {pin.split("==")[0].lower().replace("_", "-") for pin in pins}
    assert len(pinned) == len(pins)
    wanted = [*PROJECT["dependencies"], *PROJECT["optional-dependencies"]["test"]]
    assert {REQUIREMENT.match(line)[1].lower().replace("_", "-") for line in wanted} <= pinned


def test_every_dependency_has_a_lower_bound():
    extras = [line for extra in PROJECT["optional-dependencies"].values() for line in extra]
    assert all(">=" in line for line in [*PROJECT["dependencies"], *extras])


def test_the_command_line_scripts_exist():
    for target in PROJECT["scripts"].values():
        module, function = target.split(":")
        assert run_python(f"import {module} as m; print(callable(m.{function}))", ROOT, ROOT) == "True"
