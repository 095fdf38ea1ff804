"""Errors in units of what a format must lose: of its condition times its unit roundoff.

A computation that is as stable as any gives the exact result of inputs that are a rounding off, rounded (mixed forward
and backward stability; Higham, Accuracy and Stability of Numerical Algorithms, 2002, sections 1.5 and 1.6).  So a
number y of the state, of the inputs x = t, start and parameters, may be wrong by

    loss = max(u |y|, d/2) + v (|t dy/dt| + sum |x dy/dx|),

u the unit roundoff of the numbers, d a unit of the last decimal place that they have, v the roundoff of the inputs:

    binary, of p bits:          u = v = 2^-p,                            d = 0,
    decimals of D <= 17 digits: u = max(2^-53, 10^(1 - D)/2), v = 2^-53, d = the least unit of a number's last place,
    decimals of D > 17 digits:  u = v = 10^(1 - D)/2,                    d the same.

An error of 1 and less of these is as small as the format can promise.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from compare.files.written import ROUND_TRIP_DIGITS

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["Resolution", "conditioned", "resolution"]

BINARY64 = 2.0**-53
HIGHEST = 300
"""A place above this power of ten says no more than that power; of more digits than these no double is the roundoff."""


class Resolution(NamedTuple):
    """What a format resolves.

    Attributes:
        numbers: the unit roundoff u of its numbers, and ``inputs`` v of what they depend on.
        place: half a unit of the last decimal place, d/2.
    """

    numbers: float
    inputs: float
    place: float

    def losses(self, sizes: np.ndarray, led: np.ndarray) -> np.ndarray:
        """The losses of numbers of these sizes, which changes of the inputs lead so far; 0 of a zero led nowhere."""
        rounded, moved = self.numbers * sizes, self.inputs * led
        return np.where(rounded + moved == 0, 0.0, np.maximum(rounded, self.place) + moved)

    def of_zero(self, error: float, scale: float) -> float:
        """The error of a number that is exactly zero over the roundoff on its scale, or half a unit of its place."""
        return error / max(self.numbers * scale, self.place)


def conditioned(errors: Iterable[float], losses: Iterable[float]) -> float:
    """The largest error of a state's numbers over their losses; NaN where these are not known.

    A number that is exactly zero, and led nowhere, has no loss, and does not count.
    """
    worst = 0.0
    for error, loss in zip(errors, losses, strict=True):
        if math.isnan(loss):
            return math.nan
        worst = max(worst, abs(error) / loss if loss else 0.0)
    return worst


def resolution(held: float, last: float) -> Resolution:
    """That of numbers of so many digits, of which the least last decimal place is this power of ten, or -infinite.

    The digits of decimals are a whole number, those of bits are not: no power of 2 is one of 10.
    """
    place = 10.0 ** min(last, HIGHEST) / 2
    if held != math.floor(held):
        return Resolution(10.0**-held, 10.0**-held, place)
    rounding = 10.0 ** (1 - held) / 2 if held <= HIGHEST else math.nan
    if held <= ROUND_TRIP_DIGITS:
        return Resolution(max(BINARY64, rounding), BINARY64, place)
    return Resolution(rounding, rounding, place)
