"""The options of ``python -m compare published``, without what takes time to import."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.rendering import FORMATS
from reference.terminal import one_of

if TYPE_CHECKING:
    import argparse

__all__ = ["add_options", "options"]


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add them to a parser."""
    parser.add_argument("names", nargs="*", metavar="NAME", help="table8, table9, table12, figure7 (default all)")
    parser.add_argument(
        "--format",
        type=one_of("format", FORMATS),
        default="text",
        metavar="FORM",
        help=f"{', '.join(FORMATS)} (default text)",
    )


def options(known: argparse.Namespace) -> dict[str, Any]:
    """What was given: the names of the tables."""
    return {"names": tuple(known.names)}
