"""Integrators scored against the proven reference."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from compare.scoring import energy_drift, error_vs_n

__all__ = ["energy_drift", "error_vs_n"]


def __getattr__(name: str) -> Any:
    """The public functions, imported when first asked for: the command line's help needs none of them."""
    if name in __all__:
        return getattr(import_module("compare.scoring"), name)
    raise AttributeError(f"module 'compare' has no attribute {name!r}")
