"""Packages that one proven number does without: imported where they are used, and named where they are missing."""

from __future__ import annotations

from importlib import import_module
from typing import Any

__all__ = ["required"]


def required(package: str, by: str = "", install: str = "") -> Any:
    """The package, imported; ``by`` says what needs it, and ``install`` what provides it if not its own name.

    Raises:
        ModuleNotFoundError: it, or a package that it needs itself, is not installed.
    """
    try:
        return import_module(package)
    except ModuleNotFoundError as error:
        missing = str(error.name).partition(".")[0]
        need = f", and {by} needs it" if by else ""
        raise ModuleNotFoundError(
            f"{missing} is not installed{need}; 'pip install {install or missing}' provides it.", name=error.name
        ) from None
