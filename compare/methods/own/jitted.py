"""The right-hand side for steps that numba compiles: compiled code calls back to it."""

from __future__ import annotations

import sys
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["is_jitted", "jitted"]


def is_jitted(function: Any) -> bool:
    """Whether numba compiles a function, so that it takes compiled functions alone."""
    numba = sys.modules.get("numba")
    while numba is not None and function is not None:
        if isinstance(function, numba.core.dispatcher.Dispatcher):
            return True
        function = getattr(function, "__wrapped__", None)
    return False


def jitted(field: Callable[..., Any]) -> Any:
    """f(y) or f(t, y) as a compiled function; there is one, so that a step is compiled once, of the latest field."""
    relay, current = _relay()
    current.clear()
    current.append(field)
    return relay


@cache
def _relay() -> tuple[Callable[..., Any], list[Callable[..., Any]]]:
    import numba

    current: list[Callable[..., Any]] = []

    def rates(t: Any, y: Any) -> np.ndarray:
        return np.ascontiguousarray(current[0](y) if t is None else current[0](t, y), dtype=np.float64)

    @numba.njit  # type: ignore[untyped-decorator]
    def f(first: Any, second: Any = None) -> Any:
        if second is None:
            with numba.objmode(found="float64[:]"):
                found = rates(None, first)
        else:
            with numba.objmode(found="float64[:]"):
                found = rates(first, second)
        return found

    return f, current
