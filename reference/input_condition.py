"""How far the smallest changes of what a state depends on lead it: its condition by time, start and parameters.

To first order a number y that depends on inputs x changes by the sum of |x dy/dx| times their relative changes
(Higham, Accuracy and Stability of Numerical Algorithms, 2002, section 1.6); over |y| that sum is its condition number.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    import numpy as np

__all__ = ["InputCondition"]


class InputCondition(Protocol):
    """What tells the condition of one problem's states."""

    def led(self, t: np.ndarray) -> np.ndarray:
        """|t dy/dt| and the sum of |x dy/dx| over the start and the parameters x at times t, for each number y of the
        state: float64 [times, state], in doubles, to about six digits; NaN where it is not known.
        """
