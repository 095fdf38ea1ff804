"""A step in a shared library, called through ctypes by the convention of C.

typedef void (*rhs)(double t, const double *y, double *dydt);
void step(rhs f, int n, double t, double h, const double *y, double *ynew);
"""

from __future__ import annotations

import ctypes
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["SUFFIXES", "of_library"]

SUFFIXES = (".so", ".dylib", ".dll")
NUMBERS = ctypes.POINTER(ctypes.c_double)
RATES = ctypes.CFUNCTYPE(None, ctypes.c_double, NUMBERS, NUMBERS)


def of_library(file: str, name: str) -> Callable[[Any, Any, Any, Any], np.ndarray]:
    """The step (f, t, y, h) that a function of a library is.

    Raises:
        FileNotFoundError: there is no such file.
        ImportError: it is no library that can be loaded.
        ValueError: it has no such function.
    """
    path = Path(file).resolve()
    if not path.exists():
        raise FileNotFoundError(f"there is no file '{file}'.")
    try:
        library = ctypes.CDLL(str(path))
    except OSError as error:
        raise ImportError(f"'{file}' cannot be loaded: {error}.") from None
    try:
        function = library[name]
    except AttributeError:
        raise ValueError(f"'{file}' has no function {name}; one that it exports is accepted.") from None
    function.restype = None
    function.argtypes = [RATES, ctypes.c_int, ctypes.c_double, ctypes.c_double, NUMBERS, NUMBERS]

    def step(f: Any, t: Any, y: Any, h: Any) -> np.ndarray:
        start = np.ascontiguousarray(y)
        if start.dtype != np.float64 or start.ndim != 1:
            raise TypeError("a library takes doubles alone.")
        found, raised = np.empty(len(start)), []

        def rates(time: float, state: Any, slopes: Any) -> None:
            given, wanted = (np.ctypeslib.as_array(place, start.shape) for place in (state, slopes))
            try:
                wanted[:] = f(time, given.copy())
            except BaseException as error:  # noqa: BLE001 - no exception goes through C: it is raised after it
                raised.append(error)
                wanted[:] = np.nan

        function(RATES(rates), len(start), t, h, start.ctypes.data_as(NUMBERS), found.ctypes.data_as(NUMBERS))
        if raised:
            raise raised[0]
        return found

    step.__name__ = name
    return step
