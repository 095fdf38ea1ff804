"""The options of ``python -m compare published``, without what takes time to import.

``published figures --out DIR`` draws the figures of both sources, ``published thesis-figure-8`` one of them; without
names every table is printed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.published.source import figures
from compare.rendering import FORMATS
from reference.terminal import one_of

if TYPE_CHECKING:
    import argparse

__all__ = ["FIGURES", "add_options", "options"]

FIGURES = "figures"
"""The name that draws every figure, beside those of tables and of single figures."""
DEFAULT_FOLDER = "horologium-figures"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add them to a parser."""
    parser.add_argument(
        "names",
        nargs="*",
        metavar="NAME",
        help="table8, table9, table12, figure7, curves (default all); figures to draw them, or thesis-figure-8 for one",
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
        ValueError: a folder is given, but no figures are drawn.
    """
    every = [figure.name for figure in figures()]
    asked = [name for name in known.names if name == FIGURES or name in every]
    if known.out is not None and not asked:
        raise ValueError(f"--out is the folder of the figures; it is accepted with the name {FIGURES!r}.")
    return {
        "names": tuple(name for name in known.names if name not in asked),
        "drawn": tuple(every if FIGURES in asked else dict.fromkeys(asked)),
        "figures": (known.out or DEFAULT_FOLDER) if asked else None,
    }
