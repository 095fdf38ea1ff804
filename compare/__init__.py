"""Integrators scored against the proven reference."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from compare.claims.checking import check
    from compare.files.score import score
    from compare.methods.step_function import method
    from compare.scored import energy_drift, error_vs_n

__all__ = ["check", "energy_drift", "error_vs_n", "method", "score"]

_HOMES = {
    "check": "compare.claims.checking",
    "energy_drift": "compare.scored",
    "error_vs_n": "compare.scored",
    "method": "compare.methods.step_function",
    "score": "compare.files.score",
}


def __getattr__(name: str) -> Any:
    """The public functions, imported when first asked for: the command line's help needs none of them."""
    if name in _HOMES:
        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f"module 'compare' has no attribute {name!r}")
