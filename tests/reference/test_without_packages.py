"""One proven number takes neither NumPy nor h5py, heyoka, matplotlib or SciPy; what takes one says so."""

from __future__ import annotations

import json
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import pytest

import reference
from reference.__main__ import main
from reference.packages import required

ROOT = Path(__file__).parents[2]
OPTIONAL = ("numpy", "h5py", "heyoka", "matplotlib", "scipy")
REFUSE = f"""
import sys
class Refuse:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {OPTIONAL}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)
sys.meta_path.insert(0, Refuse())
"""
PROBLEMS = (
    "Pendulum(1)",
    "Pendulum(theta0=0, omega0=7)",
    "Pendulum(theta0=0, omega0=2, g=1)",
    "LinearPendulum('0.1')",
    "Cycloid(3, 1)",
    "Tautochrone(angle=1)",
    "CycloidalPendulum(1)",
    "CycloidArc()",
    *(f"Descent({name!r})" for name in ("line", "quartic", "circular_arc", "quarter_ellipse", "cycloid")),
    "Descent('2 - cos(x)', start=2, end=0)",
    "PolarBrachistochrone(z0='0.01')",
    "PolarBrachistochrone(z0=0.25, r0=10, gm=2)",
    "PolarBrachistochrone(end=['1/2', Fraction(5, 4)])",
    "Tunnel(z0=0.3)",
)
NUMBERS = """
def numbers(made):
    found = {}
    for row in made.rows:
        for argument in (None, 1, "3/4"):
            try:
                value = made.certified(row.name, argument, len(row.quantities) - 1)
            except (ValueError, TypeError):  # no argument of this row's
                continue
            told = value.digits(40), value.limbs(), float(value), repr(value)
            found[f"{row.name} {argument}"] = [str(one) for one in told]
    return found
"""
COMMANDS = (
    "pendulum --theta0 1 --t 10",
    "pendulum --theta0 0.1 --omega0 1/3 --t 2 --exact --digits 30",
    "pendulum --theta0 1 --t 10 --format json",
    "linear --theta0 1 --t 10",
    "cycloid --end 2,1 --fraction 0.5",
    "tautochrone --angle 1 --t 1",
    "descent --curve cubic --t 0.5",
    "polar --z0 0.2 --tau 1",
    "polar --end 0.5,1 --body earth --r0 7e6 --t 100 --format json",
    "tunnel --z0 0.2 --psi 1",
)
NEEDS_NUMPY = "numpy is not installed, and {} needs it; 'pip install numpy' provides it."
NEEDS_HEYOKA = "heyoka is not installed, and Taylor's method needs it; 'pip install heyoka' provides it."


def program(code: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=False)


def without(code: str) -> subprocess.CompletedProcess[str]:
    """A program run where none of the packages can be imported."""
    return program(REFUSE + code)


def command_without(words: list[str]) -> subprocess.CompletedProcess[str]:
    return without(f"from reference.__main__ import main; sys.exit(main({words!r}))")


@pytest.fixture(scope="module")
def proven_without():
    made = f"{{text: numbers(eval(text)) for text in {PROBLEMS!r}}}"
    done = without(
        f"import json\nfrom fractions import Fraction\nfrom reference import *\n{NUMBERS}\nprint(json.dumps({made}))"
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.parametrize("text", PROBLEMS)
def test_a_number_is_the_same_without_them(proven_without, text):
    names: dict = {**{name: getattr(reference, name) for name in reference.__all__}, "Fraction": Fraction}
    exec(NUMBERS, names)  # noqa: S102 - the very lines that the other process runs
    found = names["numbers"](eval(text, names))  # noqa: S307
    assert len(found) >= 4
    assert found == proven_without[text]


@pytest.mark.parametrize("words", COMMANDS)
def test_the_command_line_prints_the_same_without_them(words, capsys):
    asked = ["at", *words.split()]
    assert main(asked) == 0
    done = command_without(asked)
    assert (done.returncode, done.stderr, done.stdout) == (0, "", capsys.readouterr().out)


@pytest.mark.parametrize("words", [["--help"], ["at", "--help"], ["at", "polar", "--help"], ["build", "--help"]])
def test_help_takes_none_of_them(words):
    done = command_without(words)
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("words", [["at", "pendulum", "--theta0", "4", "--t", "1"], ["at", "polar", "--end", "9,1"]])
def test_a_mistake_is_the_same_sentence_without_them(words, capsys):
    assert main(words) == 2
    done = command_without(words)
    assert (done.returncode, done.stderr, done.stdout) == (2, capsys.readouterr().err, "")


@pytest.mark.parametrize(
    ("asked", "sentence"),
    [
        ("Pendulum(1).state(1)", NEEDS_NUMPY.format("an array of values")),
        ("Pendulum(1).along('state', [1, 2])", NEEDS_NUMPY.format("an array of values")),
        ("Cycloid(3, 1).curve(0.5)", NEEDS_NUMPY.format("an array of values")),
        ("Descent('cubic').rate()", NEEDS_NUMPY.format("an array of values")),
        ("Pendulum(1).period().routes", NEEDS_HEYOKA),
        ("Tunnel(z0=0.5).by_route('taylor', 'state', [1], 30)", NEEDS_HEYOKA),
        ("load()", NEEDS_NUMPY.format("a dataset")),
    ],
)
def test_what_needs_one_says_so(asked, sentence):
    done = without(
        f"from reference import *\ntry:\n    {asked}\nexcept ModuleNotFoundError as error:\n    print(error)"
    )
    assert (done.stdout, done.stderr) == (f"{sentence}\n", "")


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["at", "pendulum", "--theta0", "1", "--t", "1", "--routes"], NEEDS_HEYOKA),
        (["build"], NEEDS_NUMPY.format("a dataset")),
        (["verify", "data/horologium-core.h5"], NEEDS_NUMPY.format("a dataset")),
        (["show", "data/horologium-core.h5"], NEEDS_NUMPY.format("a dataset")),
        (["cite"], NEEDS_NUMPY.format("a dataset")),
        (["datasheet"], NEEDS_NUMPY.format("a dataset")),
    ],
)
def test_a_command_that_needs_one_ends_in_that_sentence(words, sentence):
    done = command_without(words)
    assert (done.returncode, done.stderr, done.stdout) == (2, f"error: {sentence}\n", "")


def test_a_dataset_names_the_package_that_is_missing():
    code = "import sys; sys.modules['h5py'] = None; from reference.__main__ import main; sys.exit(main(['cite']))"
    done = program(code)
    sentence = "h5py is not installed, and a dataset needs it; 'pip install h5py' provides it."
    assert (done.returncode, done.stderr, done.stdout) == (2, f"error: {sentence}\n", "")


def test_other_routes_than_taylors_agree_without_them():
    asked = "agreement(Pendulum(1), 'period', [None], 'quadrature')[0].digits >= 45"
    code = f"from reference import Pendulum\nfrom reference.routes.agreement import agreement\nprint({asked})"
    assert without(code).stdout == "True\n"


def test_what_is_no_number_is_refused_as_such_without_numpy():
    told = """
from reference.arithmetic.exact import exact, exact_array
for value in (True, 1j, None, b"1", float("nan"), "x", [1, "y"], (1, True)):
    try:
        print(exact_array(value) if isinstance(value, (list, tuple)) else exact(value))
    except (TypeError, ValueError) as error:
        print(error)
"""
    assert without(told).stdout == program(told).stdout != ""


def test_importing_the_reference_and_proving_a_number_imports_none_of_them():
    code = f"""
import sys, reference
def imported(): print([name for name in {OPTIONAL} if name in sys.modules])
imported()
from reference import *
imported()
print(format(Pendulum(1).period(), ".20f"), Pendulum(1).period().fixed(9))
PolarBrachistochrone(end=("1/2", 1)).certified("state", 1).limbs()
imported()
"""
    assert program(code).stdout == "[]\n[]\n2.13913760055868879057 2.139137601\n[]\n"


def test_a_package_that_lacks_another_names_that_one(tmp_path, monkeypatch):
    (tmp_path / "lacking_package.py").write_text("import no_such_package_anywhere.part\n")
    monkeypatch.syspath_prepend(tmp_path)
    sentence = "^no_such_package_anywhere is not installed; 'pip install no_such_package_anywhere' provides it[.]$"
    with pytest.raises(ModuleNotFoundError, match=sentence):
        required("lacking_package")
    with pytest.raises(ModuleNotFoundError, match=r"'pip install horologium\[xarray\]' provides it[.]$"):
        required("no_such_package_anywhere", install="horologium[xarray]")
