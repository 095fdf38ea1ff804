"""The tables of docs/problems.md, of what the problems declare: ``python tests/problems_page.py`` prints them."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
PROBLEMS = ("problem", "what it is", "equation", "components", "to t", "conserved", "level of difficulty", "source")
SOURCES = ("", "source")


def tables() -> str:
    """The problems that are proven by their flows, and their sources by number."""
    from reference.problems.families import FAMILIES

    kinds: list[tuple[str, Any]] = [(one.help, one.problem) for one in FAMILIES if not one.has_closed_form]
    sources = list(dict.fromkeys(kind.source for _, kind in kinds))
    found = [_row(PROBLEMS), _row([":--"] * len(PROBLEMS))]
    for told, kind in kinds:
        conserved = ", ".join(one.name for one in kind.invariants) or "nothing"
        size, end, number = len(kind.space.components), f"{float(kind.t_end):g}", sources.index(kind.source) + 1
        found.append(
            _row((f"`{kind.name}`", told, f"`{kind.equation}`", size, end, conserved, kind.difficulty, number))
        )
    numbered = [_row((number, source)) for number, source in enumerate(sources, start=1)]
    return "\n".join([*found, "", _row(SOURCES), _row([":--"] * len(SOURCES)), *numbered, ""])


def _row(cells: Any) -> str:
    return f"| {' | '.join(str(cell).replace('|', chr(92) + '|') for cell in cells)} |"


if __name__ == "__main__":
    sys.path.insert(0, str(ROOT))
    sys.stdout.write(tables())
