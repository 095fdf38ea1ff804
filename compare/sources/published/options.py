"""The options of ``python -m compare published``, without what takes time to import.

``published figures --out DIR`` draws the figures of both sources, ``published thesis-figure-8`` one of them; without
names every table of both is printed.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from compare.show.render import FORMATS
from compare.sources.published.source import figures, solutions, tables
from reference.command.terminal import one_of
from reference.names import unknown

if TYPE_CHECKING:
    import argparse

__all__ = ["ALL", "FIGURES", "add_options", "options"]

ALL = "all"
"""The name that prints every table, as no name does."""

FIGURES = "figures"
"""The name that draws every figure, beside those of tables and of single figures."""
DEFAULT_FOLDER = "horologium-figures"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add them to a parser."""
    parser.add_argument(
        "names",
        nargs="*",
        metavar="NAME",
        help="table8, table9, table12, figure7, curves or all (default all); a solution that the literature prints: "
        f"{', '.join(table.name for table in solutions())}; figures to draw every figure, or the name of one, such as "
        "thesis-figure-8",
    )
    parser.add_argument("--out", metavar="DIR", help=f"folder of the figures (default ./{DEFAULT_FOLDER})")
    parser.add_argument("--quiet", action="store_true", help="nothing on stderr but errors")
    parser.add_argument(
        "--format",
        type=one_of("format", FORMATS),
        default="text",
        metavar="FORM",
        help=f"{', '.join(FORMATS)} (default text)",
    )


def options(known: argparse.Namespace) -> dict[str, Any]:
    """What was given: the names of the tables, those of the figures, and the folder of these if there are any.

    Raises:
        ValueError: a name is unknown; a folder is given, but no figures are drawn; or a format, but no tables printed.
    """
    names = [_known(name) for name in known.names]
    every, all_tables = [figure.name for figure in figures()], [table.name for table in tables()]
    drawn = [name for name in names if name == FIGURES or name in every]
    printed = [name for name in names if name not in drawn]
    if known.out is not None and not drawn:
        raise ValueError(f"--out is the folder of the figures; it is accepted with the name {FIGURES!r}.")
    if drawn and not printed and known.format != "text":
        raise ValueError(
            f"--format is that of the tables; {', '.join(names)} names figures alone, so that it is accepted with the "
            "name of a table besides."
        )
    return {
        "names": tuple(all_tables if ALL in printed else printed),
        "drawn": tuple(every if FIGURES in drawn else dict.fromkeys(drawn)),
        "figures": (known.out or DEFAULT_FOLDER) if drawn else None,
    }


def _known(given: str) -> str:
    """The name that is meant: letters may be large, and blanks and hyphens stand anywhere or nowhere.

    Raises:
        ValueError: it is unknown.
    """
    known = (*tables(), *solutions())
    shown, drawn = [table.name for table in known], [figure.name for figure in figures()]
    by_item = {_letters(table.item): table.name for table in known}
    meant = by_item | {_letters(name): name for name in (*shown, ALL, FIGURES, *drawn)}
    if _letters(given) not in meant:
        sentence = unknown("table or figure", given, [*shown, ALL, FIGURES], drawn)
        raise ValueError(f"{sentence.removesuffix('.')}, and the name of one figure: {', '.join(drawn)}.")
    return meant[_letters(given)]


def _letters(name: str) -> str:
    """What a name is told by."""
    return re.sub(r"[\s_-]+", "", name.casefold())
