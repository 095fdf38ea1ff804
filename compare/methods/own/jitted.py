"""A right-hand side for what numba and JAX compile: compiled code calls back to Python.

numba asks a value for its type, and is told that of a compiled function which hands its question to the latest of the
kind: so one is compiled, whoever is given it, at whatever depth of a user's code.  JAX traces the equation itself.
"""

from __future__ import annotations

import ctypes
import sys
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import TracebackType

__all__ = ["is_traced", "numba_type", "raised_within", "settled", "told_jax"]

_RAISED: list[BaseException] = []
"""What Python raised below compiled code, which has no way for it."""


class CallbackError(Exception):
    """What compiled code raises where Python raised something below it."""


class raised_within:  # noqa: N801 - a context, as a function is one
    """Run compiled code: what Python raised below it is raised, in the place of what came of it."""

    def __enter__(self) -> None:
        _RAISED.clear()

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if _RAISED and isinstance(error, Exception):
            raise _RAISED[0] from None


def is_traced(value: Any) -> bool:
    """Whether it is one of JAX's arrays, or of their tracers."""
    return type(value).__module__.partition(".")[0] in {"jax", "jaxlib"}


def settled(found: Any) -> Any:
    """What a function returned, once JAX has it."""
    jax = sys.modules.get("jax")
    return found if jax is None else jax.block_until_ready(found)


def told_jax(numbers: Callable[[], np.ndarray], count: int) -> Any:
    """So many numbers that Python is asked for whenever compiled code comes to this place."""
    import jax
    import jax.numpy as jnp
    from jax.experimental import io_callback

    dtype = jnp.result_type(float)

    def asked() -> np.ndarray:
        try:
            return numbers().astype(dtype)
        except BaseException as error:
            _RAISED.append(error)
            raise

    return io_callback(asked, jax.ShapeDtypeStruct((count,), dtype))


def numba_type(function: Callable[..., Any]) -> Any:
    """The type that numba takes a function of a state, or of a time and a state, for."""
    import numba

    kind: Any = type(function)
    relay, latest = _relay(kind)
    latest[:] = [function]
    return numba.typeof(relay)


CALLED: Any = ctypes.CFUNCTYPE(ctypes.c_int, *[ctypes.c_ssize_t] * 4, *[ctypes.c_void_p] * 3)
"""int call(times, axes, rows, size, const double *t, const double *y, double *dydt): not 0 where Python raised."""


@cache
def _relay(kind: Any) -> tuple[Callable[..., Any], list[Callable[..., Any]]]:  # noqa: ARG001 - there is one for each
    """A compiled function of any of the arguments that Python takes, and whom it asks."""
    import numba

    latest: list[Callable[..., Any]] = []
    rates = _compiled_call(latest)

    def asked(first: Any, second: Any) -> Any:
        """f(y), f(t, y) or f(y, t), and a force of an array or of one number."""

    def of_number(first: Any, second: Any) -> Any:  # noqa: ARG001 - these have the arguments of what they are
        return rates(np.empty(0), np.array([first]))[0]

    def of_state(first: Any, second: Any) -> Any:  # noqa: ARG001
        return rates(np.empty(0), first)

    def of_time_and_state(first: Any, second: Any) -> Any:
        return rates(np.atleast_1d(np.asarray(first)), second)

    def of_state_and_time(first: Any, second: Any) -> Any:
        return rates(np.atleast_1d(np.asarray(second)), first)

    @numba.extending.overload(asked)  # type: ignore[untyped-decorator]
    def _(first: Any, second: Any) -> Any:
        number = isinstance(first, numba.types.Number)
        if isinstance(second, (numba.types.NoneType, numba.types.Omitted)):
            return of_number if number else of_state
        second_axes = 0 if isinstance(second, numba.types.Number) else getattr(second, "ndim", 1)
        return of_time_and_state if number or getattr(first, "ndim", 1) < second_axes else of_state_and_time

    @numba.njit  # type: ignore[untyped-decorator]
    def relay(first: Any, second: Any = None) -> Any:
        return asked(first, second)

    return relay, latest


def _compiled_call(latest: list[Callable[..., Any]]) -> Callable[..., Any]:
    """rates(t, y) of a state or of lanes of them, which calls Python; with no times it is told none."""
    import numba

    @CALLED  # type: ignore[untyped-decorator]
    def call(times: int, axes: int, rows: int, size: int, *places: int) -> int:
        sizes = zip((times, size, size), places, strict=True)
        t, y, slopes = (np.ctypeslib.as_array((ctypes.c_double * n).from_address(place)) for n, place in sizes)
        shape = (rows, *(size // rows,) * (axes - 1))
        told = [t.copy() if times > 1 else t[0]] if times else []
        try:
            slopes.reshape(shape)[:] = latest[0](*told, y.reshape(shape).copy())
        except BaseException as error:  # noqa: BLE001 - no exception goes through compiled code: it is raised after it
            _RAISED.append(error)
            return 1
        return 0

    @numba.njit  # type: ignore[untyped-decorator]
    def rates(t: Any, y: Any) -> Any:
        time, state = t.astype(np.float64), np.asarray(y).astype(np.float64)
        found = np.empty_like(state)
        places = time.ctypes.data, state.ctypes.data, found.ctypes.data
        if call(time.size, state.ndim, len(state), state.size, *places):
            raise CallbackError
        return found

    compiled: Callable[..., Any] = rates
    return compiled
