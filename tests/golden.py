"""What every command prints and what the public functions give, kept before a change and held against it after.

    python tests/golden.py record FOLDER     before; runs everything, a file a command
    python tests/golden.py compare FOLDER    after; prints what differs, exit code 1 where anything does

What is recorded is of one machine and one state of the code: it is not kept in the repository.
Seconds, paths of scratch folders and the bytes of pictures are left out.
"""

from __future__ import annotations

import argparse
import difflib
import itertools
import os
import re
import shlex
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).parents[1]
FORMATS = ("text", "markdown", "csv", "latex", "json")
SHORT = "--n 64,128,256,512 --methods euler,rk4,verlet,gauss4,ab4,dop853"
STUDIES = {
    "pendulum": ("--theta0 0.5,3", "--theta0 0.5 --omega0 7", "--theta0 1/3 --exact --t-end 5/2"),
    "brachistochrone": ("", "--form motion", "--end 2,1"),
    "tautochrone": ("", "--angle 0.3,2"),
    "descent": ("", "--curve 2*(x/pi)**2 --start pi --end 0"),
    "polar": ("", "--z0 0.2,0.9", "--form z"),
}
AT = (
    "pendulum --theta0 1 --t 10",
    "pendulum --theta0 1 --omega0 7 --t 2.5",
    "pendulum --theta0 0 --t 1",
    "linear --theta0 1 --t 10",
    "cycloid --end 2,1 --fraction 0.5",
    "tautochrone --angle 1 --t 1",
    "descent --curve quartic --t 0.5",
    "descent --curve 2*(x/pi)**4 --start pi --end 0 --fraction 0.25",
    "polar --z0 0.2 --tau 1",
    "polar --end 0.5,1",
    "polar --z0 0.2 --r0 6378136.6 --body earth --t 100",
    "tunnel --z0 0.2 --tau 1",
)
REFUSED = (
    "-m reference",
    "-m reference at pendulum --theta0 1",
    "-m reference at pendulum --theta0 x --t 1",
    "-m reference at pendulums",
    "-m reference at polar --z0 2 --tau 1",
    "-m reference at descent --curve 1/x --start 1 --end 0",
    "-m reference show nowhere.h5",
    "-m reference verify README.md",
    "-m reference build --profile cores",
    "-m compare",
    "-m compare pendulum --methods rk5",
    "-m compare pendulum --n 0",
    "-m compare pendulum --theta0 4",
    "-m compare polar --z0 1.5",
    "-m compare show nothing",
    "-m compare solvers --solvers nothing",
    "-m compare check nowhere:step --order 4",
    "-m compare score nowhere.csv --theta0 1",
    "-m compare report --problems nothing",
    "-m compare published table1",
)
VALUES = """
import compare, reference
from fractions import Fraction as Q
from reference import *
p = Pendulum(theta0=1.0)
motions = [p, Pendulum(0.5, omega0=7), LinearPendulum(1.0), Tautochrone(1.0, radius=1), Cycloid(2, 1),
           CycloidalPendulum(1.0), Descent("cubic"), PolarBrachistochrone("0.2"), Tunnel("0.2")]
for problem in motions:
    print(repr(problem))
    for row in problem.rows:
        argument = {"once": None, "index": 1}.get(row.over, Q(1, 2))
        for i, quantity in enumerate(row.quantities):
            try:
                print(row.name, quantity.name, problem.certified(row.name, argument, i).digits(30))
            except (ValueError, ArithmeticError) as error:
                print(row.name, quantity.name, error)
print(p.state([0, 1, 2.5], limbs=3).tolist())
print(p.events(until=3))
print(sorted(reference.__all__), sorted(compare.__all__))
print(reference.load().fingerprint)
"""


def commands() -> list[str]:
    """The arguments of Python, one line a run."""
    found = [f"-m compare {name} {SHORT}" for name in STUDIES]
    found += [
        f"-m compare {name} {SHORT} {options} --format {form}"
        for name, variants in STUDIES.items()
        for options, form in itertools.product(variants, ("text", "json"))
    ]
    found += [
        f"-m compare {name} --n 128,1024 --methods rk4,verlet --format {form}" for name in STUDIES for form in FORMATS
    ]
    scores = "error,norms,drift,phase,growth,period,defects"
    found += [f"-m compare {name} --n 256,1024,4096 --methods rk4,verlet,gauss4 --scores {scores}" for name in STUDIES]
    found += [
        f"-m compare pendulum {SHORT} --precision {kind}" for kind in ("float32", "longdouble", "float128", "mp:100")
    ]
    found += [f"-m compare pendulum {SHORT} --compensated", "-m compare pendulum"]
    found += [f"-m compare {command} --format {form}" for command in ("list", "errata") for form in ("text", "json")]
    found += [
        f"-m compare show {name}" for name in ("rk4", "dop853", "yoshida6", "gauss6", "bdf2", "taylor8", "stormer4")
    ]
    found += [f"-m compare published {name} --format {form}" for name in ("all", "table9") for form in ("text", "json")]
    found += [f"-m compare score tests/compare/snippets/{name} --theta0 1" for name in ("c.csv", "fortran.txt")]
    found += ["-m compare score tests/compare/snippets/r.csv --theta0 1 --format json"]
    found += [f"-m reference at {line} --format {form}" for line in AT for form in ("text", "json")]
    found += [f"-m reference at {line} --digits 20 --routes" for line in AT[:4]]
    found += [
        "-m reference show data/horologium-core.h5",
        "-m reference cite",
        "-m reference datasheet data/horologium-core.h5",
    ]
    found += ["-m reference show data/horologium-core.h5 pendulum/libration/theta"]
    found += [f"-m {module} --help" for module in ("reference", "reference at", "compare")]
    found += [f"-m compare {name} --help" for name in (*STUDIES, "list", "show", "report", "solvers", "score", "check")]
    return list(dict.fromkeys([*found, *REFUSED]))


def ran(arguments: list[str]) -> str:
    """Exit code and both outputs of one run, without what differs from run to run."""
    environment = {**os.environ, "COLUMNS": "150", "NO_COLOR": "1", "PYTHONPATH": str(ROOT)}
    done = subprocess.run(
        [sys.executable, *arguments], cwd=ROOT, env=environment, capture_output=True, text=True, check=False
    )
    text = f"exit code {done.returncode}\n--- stdout\n{done.stdout}\n--- stderr\n{done.stderr}"
    text = text.replace(tempfile.gettempdir(), "TMP").replace(str(ROOT), "ROOT")
    return re.sub(r"\b\d+\.\d+ s(econds)?\b(?= |$)", "SECONDS", text)


def runs() -> dict[str, list[str]]:
    """Every run by the name of its file."""
    named = {re.sub(r"[^\w.,=-]+", "_", line)[:180]: shlex.split(line) for line in commands()}
    return {**named, "values": ["-c", VALUES]}


def main() -> int:
    """Record or compare; the exit code."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=("record", "compare"))
    parser.add_argument("folder", type=Path)
    asked = parser.parse_args()
    asked.folder.mkdir(parents=True, exist_ok=True)
    different, everything = 0, runs()
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for name, text in zip(everything, pool.map(ran, everything.values()), strict=True):
            path = asked.folder / f"{name}.txt"
            if asked.what == "record":
                path.write_text(text, encoding="utf-8")
                continue
            before = path.read_text(encoding="utf-8") if path.exists() else ""
            if text != before:
                different += 1
                sys.stdout.writelines(
                    line + "\n"
                    for line in difflib.unified_diff(
                        before.splitlines(), text.splitlines(), name, "now", lineterm="", n=1
                    )
                )
    sys.stdout.write(f"{len(everything)} runs, {different} different\n")
    return int(different > 0)


if __name__ == "__main__":
    sys.exit(main())
