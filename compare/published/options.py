"""The options of ``python -m compare published``, without what takes time to import.

``published figures --out DIR`` draws the figures of both sources; without names every table is printed.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.rendering import FORMATS
from reference.terminal import one_of

if TYPE_CHECKING:
    import argparse

__all__ = ["FIGURES", "add_options", "options"]

FIGURES = "figures"
"""The name that draws the figures of both sources, beside those of tables."""
DEFAULT_FOLDER = "horologium-figures"


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add them to a parser."""
    parser.add_argument(
        "names",
        nargs="*",
        metavar="NAME",
        help="table8, table9, table12, figure7 (default all), or figures to draw them",
    )
    parser.add_argument(
        "--out", metavar="DIR", help=f"folder of the figures, as PNG and SVG (default ./{DEFAULT_FOLDER})"
    )
    parser.add_argument("--quiet", action="store_true", help="nothing on stderr but errors")
    parser.add_argument(
        "--format",
        type=one_of("format", FORMATS),
        default="text",
        metavar="FORM",
        help=f"{', '.join(FORMATS)} (default text)",
    )


def options(known: argparse.Namespace) -> dict[str, Any]:
    """What was given: the names of the tables, and the folder of the figures if they are drawn.

    Raises:
        ValueError: a folder is given, but no figures are drawn.
    """
    drawn = FIGURES in known.names
    if known.out is not None and not drawn:
        raise ValueError(f"--out is the folder of the figures; it is accepted with the name {FIGURES!r}.")
    return {
        "names": tuple(name for name in known.names if name != FIGURES),
        "figures": (known.out or DEFAULT_FOLDER) if drawn else None,
    }
