"""The thesis' second listing of section 3.1 as it is printed, and which of its names nothing defines."""

from __future__ import annotations

import ast
import builtins
from pathlib import Path

from compare.sources.errata.evidence import THESIS, Erratum

__all__ = ["LISTINGS", "undefined"]

LISTING = Path(__file__).with_name("thesis_listing.txt").read_text(encoding="utf-8")
"""From J. Šalinović's thesis, CC BY 4.0, unchanged."""
CORRECTED = LISTING.replace("y4[", "y[").replace("h = (2.1)/600", "G = 9.81  # g/R, in 1/s^2\nh = (2.1)/600")


def undefined(text: str) -> frozenset[str]:
    """The names that a program reads and nothing in it gives a value: no assignment, import, argument or definition."""
    read: set[str] = set()
    given = set(dir(builtins))
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Name):
            (read if isinstance(node.ctx, ast.Load) else given).add(node.id)
        elif isinstance(node, ast.arg):
            given.add(node.arg)
        elif isinstance(node, ast.FunctionDef):
            given.add(node.name)
        elif isinstance(node, ast.alias):
            given.add(node.asname or node.name)
    return frozenset(read - given)


def _defines_its_names(text: str) -> bool:
    return not undefined(text)


LISTINGS = (
    Erratum(
        THESIS, "section 3.1, second listing",
        f"the program of the motion reads {' and '.join(sorted(undefined(LISTING)))}, which nothing in it defines",
        "its state is y, so that y[0] and y[1] are meant; G is g/R, 9.81 s⁻² for R = 1 m (in the first listing G is "
        "the list of errors)",
        "The printed program is parsed, and the names that it reads are held against those that it defines.",
        "None: the whole program, which is not printed, must have had both.",
        (LISTING, CORRECTED), (LISTING.replace("y4[", "y["), LISTING.replace("(G/", "(9.81/")), _defines_its_names,
    ),
)  # fmt: skip
