"""The page docs/third-party.md, of the table that ``make interop`` prints: python tests/interop/page.py < TABLE."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from interop.methods import EXPLAINED, METHODS, TABLES

HEAD = """# What methods of other packages claim, and what is measured

Claims are those of each package: of its documentation, its names and its attributes.
The table is laid out as `make interop` prints it; [interop.md](interop.md) says how a method becomes what is judged.
Of {count} methods {good} hold all that their packages claim of them; what is no PASS is explained below the table.
Of {tables} it is the table of coefficients that is judged, marched by a loop of the tests: {packages}.

| package | method | claim | verdict | measured |
|---|---|---|---|---|
"""


def page(lines: list[str]) -> str:
    """The document, of the lines of the table."""
    bad = {(package, name) for package, name, _ in EXPLAINED}
    good = sum((one.package, one.name) not in bad for one in METHODS)
    reasons = [f"- {package} {name}: {reason}" for (package, name, _), reason in EXPLAINED.items()]
    told = "\n".join(dict.fromkeys(reasons))
    tables = [one.package for one in METHODS if one.builder in TABLES]
    packages = ", ".join(f"{tables.count(package)} of {package}" for package in dict.fromkeys(tables))
    head = HEAD.format(count=len(METHODS), good=good, tables=len(tables), packages=packages)
    return f"{head}{chr(10).join(lines)}\n\n{told}\n"


if __name__ == "__main__":
    sys.stdout.write(page([line.rstrip() for line in sys.stdin if line.startswith("| ")]))
