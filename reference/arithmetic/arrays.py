"""NumPy, and its arrays of binary64 numbers by their bits."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from reference.arithmetic.binary64 import PLACES, SIGN
from reference.packages import required

if TYPE_CHECKING:
    import numpy as np
else:
    np = required("numpy", by="an array of values")

__all__ = ["in_order", "is_negative_zero", "np", "unsigned_zeros", "with_subnormals"]


def with_subnormals(values: np.ndarray) -> bool:
    """Whether an array of float16, float32 or float64 holds a subnormal number."""
    places, width = PLACES[values.itemsize]
    bits = values.astype(values.dtype.newbyteorder("=")).view(f"u{values.itemsize}")
    fields, sizes = (bits >> places) & ((1 << width) - 1), bits & ((1 << places) - 1)
    return bool(np.any((fields == 0) & (sizes != 0)))


def is_negative_zero(values: Any) -> np.ndarray:
    """Where numbers are -0.0; never where they are no float64."""
    numbers = np.asarray(values)
    found: np.ndarray = (
        numbers.view(np.uint64) == SIGN if numbers.dtype == np.float64 else np.zeros(numbers.shape, bool)
    )
    return found


def unsigned_zeros(values: Any) -> np.ndarray:
    """Numbers, as an array, with +0.0 for every -0.0."""
    negative = is_negative_zero(values)
    return np.where(negative, 0.0, values) if negative.any() else np.asarray(values)


def in_order(values: np.ndarray) -> np.ndarray:
    """Integers in the order of the numbers, and equal where those are; numbers that are no float64 as they are."""
    if values.dtype != np.float64:
        return values
    bits = values.view(np.int64)
    return np.where(bits < 0, np.iinfo(np.int64).min - bits, bits)
