"""Integrators scored against the proven reference."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from compare.claims.asserting import assert_conserves, assert_order, assert_reversible, assert_symplectic
    from compare.claims.checking import check
    from compare.files.asserting import assert_score
    from compare.files.score import score
    from compare.methods.step_function import method
    from compare.scored import energy_drift, error_vs_n

__all__ = [
    "assert_conserves",
    "assert_order",
    "assert_reversible",
    "assert_score",
    "assert_symplectic",
    "check",
    "energy_drift",
    "error_vs_n",
    "method",
    "score",
]

_HOMES = {
    "assert_conserves": "compare.claims.asserting",
    "assert_order": "compare.claims.asserting",
    "assert_reversible": "compare.claims.asserting",
    "assert_score": "compare.files.asserting",
    "assert_symplectic": "compare.claims.asserting",
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
