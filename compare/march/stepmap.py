"""The derivative of a step by the state it starts from, exact but for rounding: its expressions, differentiated."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from reference.arithmetic.compiler import hy

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["slopes_of"]


def slopes_of(step: Sequence[Any], variables: Sequence[Any]) -> np.ndarray:
    """d(step)/d(variables) as expressions of heyoka: [step, variables]."""
    tensors = hy.diff_tensors(list(step), diff_args=list(variables), diff_order=1)
    return np.asarray(tensors.jacobian, dtype=object)
