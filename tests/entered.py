"""Which files of the project a command enters: those of which a function is called while nothing is being imported.

python tests/entered.py            how many, for each of the commands below
python tests/entered.py WORDS ...  the files of one command, such as: compare pendulum --n 128
"""

from __future__ import annotations

import contextlib
import io
import os
import shlex
import subprocess
import sys
import tempfile
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from types import CodeType, FrameType

ROOT = Path(__file__).parents[1]
COMMANDS = {
    "compare pendulum": "compare pendulum --n 128,256 --methods rk4,verlet",
    "compare score": "compare score tests/compare/snippets/c.csv --theta0 1",
    "compare check": "compare.check",
    "reference build": "reference build --config {grid} --out {out} --jobs 1 --quiet",
    "reference at": "reference at pendulum --theta0 1 --t 10",
}
GRID = """[[group]]
path = "pendulum/dimensionless"
g = 1
length = 1
amplitude = [1]
time = [0, 1, 2]
"""


def entered(words: list[str]) -> list[str]:
    """The files that a command enters, by their paths in the project."""
    codes: set[CodeType] = set()

    def note(frame: FrameType, event: str, _argument: Any) -> None:
        if event == "call" and frame.f_code not in codes and not importing(frame):
            codes.add(frame.f_code)

    sys.setprofile(note)
    try:
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            if words == ["compare.check"]:
                import_module("compare").check(euler, order=1)
            else:
                code = import_module(f"{words[0]}.__main__").main(words[1:])
                assert code == 0, f"{' '.join(words)} ended with {code}"
    finally:
        sys.setprofile(None)
    paths = {Path(code.co_filename) for code in codes}
    found = {path.relative_to(ROOT) for path in paths if path.is_relative_to(ROOT)}
    return sorted(str(path) for path in found if path.parts[0] in {"reference", "compare"})


def importing(frame: FrameType | None) -> bool:
    """Whether the body of a module of ours is being run."""
    while frame is not None:
        if frame.f_code.co_name == "<module>" and frame.f_globals.get("__name__") != "__main__":
            return True
        frame = frame.f_back
    return False


def euler(f: Any, y: Any, h: Any) -> Any:
    """What is checked."""
    return y + h * f(y)


def main() -> None:
    """Print what one command enters, or how many files each of the list does, in a process of its own."""
    os.chdir(ROOT)
    sys.path.insert(0, str(ROOT))
    if sys.argv[1:]:
        sys.stdout.write("\n".join(entered(sys.argv[1:])) + "\n")
        return
    with tempfile.TemporaryDirectory() as scratch:
        grid, out = Path(scratch, "grid.toml"), Path(scratch, "out.h5")
        grid.write_text(GRID, encoding="utf-8")
        for name, words in COMMANDS.items():
            asked = shlex.split(words.format(grid=grid, out=out))
            done = subprocess.run([sys.executable, __file__, *asked], capture_output=True, text=True, check=True)
            files = done.stdout.split()
            homes = sorted({Path(file).parts[2] for file in files if file.startswith("reference/problems/")})
            sys.stdout.write(f"{name:18s}{len(files):4d} files; of problems: {', '.join(homes)}\n")


if __name__ == "__main__":
    main()
