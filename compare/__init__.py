"""Integrators scored against the proven reference."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from compare.claims.asserting import (
        assert_conserves,
        assert_dense,
        assert_estimate,
        assert_order,
        assert_reversible,
        assert_stiff_order,
        assert_symplectic,
        assert_tolerance,
    )
    from compare.claims.checking import check
    from compare.claims.events import assert_events, check_events
    from compare.claims.gradients import assert_gradients, check_gradients
    from compare.claims.process import Process
    from compare.controlled import error_vs_rtol
    from compare.files.asserting import assert_score
    from compare.files.score import score
    from compare.methods.own.step_function import method
    from compare.scored import energy_drift, error_vs_n

__all__ = [
    "Process",
    "assert_conserves",
    "assert_dense",
    "assert_estimate",
    "assert_events",
    "assert_gradients",
    "assert_order",
    "assert_reversible",
    "assert_score",
    "assert_stiff_order",
    "assert_symplectic",
    "assert_tolerance",
    "check",
    "check_events",
    "check_gradients",
    "energy_drift",
    "error_vs_n",
    "error_vs_rtol",
    "method",
    "score",
]

_HOMES = {
    "Process": "compare.claims.process",
    "assert_conserves": "compare.claims.asserting",
    "assert_dense": "compare.claims.asserting",
    "assert_estimate": "compare.claims.asserting",
    "assert_events": "compare.claims.events",
    "assert_gradients": "compare.claims.gradients",
    "assert_order": "compare.claims.asserting",
    "assert_reversible": "compare.claims.asserting",
    "assert_stiff_order": "compare.claims.asserting",
    "assert_score": "compare.files.asserting",
    "assert_symplectic": "compare.claims.asserting",
    "assert_tolerance": "compare.claims.asserting",
    "check": "compare.claims.checking",
    "check_events": "compare.claims.events",
    "check_gradients": "compare.claims.gradients",
    "energy_drift": "compare.scored",
    "error_vs_n": "compare.scored",
    "error_vs_rtol": "compare.controlled",
    "method": "compare.methods.own.step_function",
    "score": "compare.files.score",
}


def __getattr__(name: str) -> Any:
    """The public functions, imported when first asked for: the command line's help needs none of them."""
    if name in _HOMES:
        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f"module 'compare' has no attribute {name!r}")
