"""The options of ``python -m compare errata``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.show.render import FORMATS
from reference.command.terminal import one_of

if TYPE_CHECKING:
    import argparse

__all__ = ["add_options", "options"]


def add_options(parser: argparse.ArgumentParser) -> None:
    """Add them to a parser."""
    words = f"{', '.join(FORMATS)} (default text)"
    parser.add_argument("--format", type=one_of("format", FORMATS), default="text", metavar="FORM", help=words)


def options(known: argparse.Namespace) -> dict[str, Any]:
    """None of its own."""
    del known
    return {}
