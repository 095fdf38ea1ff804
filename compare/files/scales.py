"""Digits on the scale of a number: where the truth is zero, or near a zero, a relative error says nothing.

    digits = -log10(|number - truth|/scale),  scale = the largest |truth| of that number at the start and in the file,

to six significant digits; where all these are zero the scale is 1, so that digits are -log10 |number|, as in the log
relative error of NIST's Statistical Reference Datasets (McCullough, The American Statistician 52, 1998).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from compare.files.written import BINARY64_DIGITS

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from fractions import Fraction

    from compare.files.conditioned import Resolution

__all__ = ["SLACK", "Point", "Scales", "near_zero"]

PLACES = 5
"""Places of a scale's mantissa: rows whose truths differ by less need not be told apart."""
SLACK = 1e-12
"""Relative to a truth: more than a rounding of it, or of its logarithm, is."""
NEAR = 3.0
"""Digits that a number loses against its scale where its truth is called near zero."""


@dataclass(frozen=True)
class Point:
    """One row.

    Attributes:
        number: its number among the rows, from 1.
        t: its time as it was handed in, s.
        values: the state as it was handed in.
        digits: correct digits: the least -log10 |error/truth| of the state's numbers, at most what the input can hold;
            of a number whose truth is exactly zero, its digits on its scale.
        scaled_digits: the least of their digits on the scale of each number (``scales``), NaN before that is known.
        error: the largest |number - truth| of the state's numbers, each in its own units.
        errors: number - truth, in the order of the state.
        first_wrong: for each number the place of its first wrong significant digit, from 1; None where all are right.
        phase_error: rad, 2 pi per period, positive where the state is ahead; NaN where it has no phase.
        amplitude_error: in the units of the first number of the state; NaN where it has no amplitude.
        energy_error: (E - E0)/(E0 - Emin), or the invariant itself where it starts at zero.
        conditioned: the largest error over what the format must lose (``compare.files.conditioned``); NaN where that
            is not known.
        instant: the time, exactly.
        relative: the digits of each number relative to its truth, infinite where it is met; NaN where that is exactly
            zero and is not met.
        sizes: log10 |number - truth| of each, -infinite where the truth is met as far as it is known.
        truths: log10 |truth| of each, -infinite where it is exactly zero.
    """

    number: int
    t: str
    values: tuple[str, ...]
    digits: float
    error: float
    errors: tuple[float, ...]
    first_wrong: tuple[int | None, ...]
    phase_error: float
    amplitude_error: float
    energy_error: float
    conditioned: float
    instant: Fraction = field(repr=False)
    scaled_digits: float = field(repr=False)
    relative: tuple[float, ...] = field(repr=False)
    sizes: tuple[float, ...] = field(repr=False)
    truths: tuple[float, ...] = field(repr=False)


class Scales:
    """The scales of the state's numbers, of which ``logs`` are log10 |truth| so far, -infinite where it is zero."""

    def __init__(self, logs: Sequence[float]) -> None:
        self._logs = logs

    def raised(self, points: Iterable[Point]) -> Scales:
        """The scales with some rows more."""
        return Scales([max(column) for column in zip(self._logs, *(point.truths for point in points), strict=True)])

    @property
    def values(self) -> tuple[float, ...]:
        """The scales in the units of the numbers."""
        return tuple(float(f"{mantissa:.{PLACES}f}e{decade}") for mantissa, decade in map(_rounded, self._logs))

    @property
    def limits(self) -> tuple[float, ...]:
        """The sizes up to which a truth changes no scale."""
        return tuple(
            0.0 if log == -math.inf else (mantissa + 0.5 * 10.0**-PLACES) * 10.0 ** max(decade, -330) * (1 - SLACK)
            for log, (mantissa, decade) in zip(self._logs, map(_rounded, self._logs), strict=True)
        )

    def held(self, held: float) -> float:
        """The digits that the input can hold, at least those of a double where every truth is zero: the significant
        digits of such numbers, as 1e-8, say nothing of what they hold on a scale of 1.
        """
        return max(held, BINARY64_DIGITS) if all(log == -math.inf for log in self._logs) else held

    def digits(self, point: Point) -> tuple[float, ...]:
        """The digits of each number of a row on its scale; infinite where it meets the truth, negative beyond scale."""
        return tuple(
            math.log10(mantissa) + decade - size
            for (mantissa, decade), size in zip(map(_rounded, self._logs), point.sizes, strict=True)
        )

    def resolved(self, point: Point, held: float, resolution: Resolution) -> Point:
        """The row with its digits, of which the input can hold ``held``: a truth of zero has them on its scale, and its
        error too.
        """
        held = self.held(held)
        scaled = [max(0.0, digits) for digits in self.digits(point)]
        own = [b if math.isnan(a) else a for a, b in zip(point.relative, scaled, strict=True)]
        zeros = [
            resolution.of_zero(abs(error), scale)
            for digits, error, scale in zip(point.relative, point.errors, self.values, strict=True)
            if math.isnan(digits)
        ]
        conditioned = point.conditioned if math.isnan(point.conditioned) else max([point.conditioned, *zeros])
        return replace(point, digits=min([*own, held]), scaled_digits=min([*scaled, held]), conditioned=conditioned)


def _rounded(log: float) -> tuple[float, int]:
    """The mantissa and the decade of a size; of one that is zero those of 1."""
    if log == -math.inf:
        return 1.0, 0
    decade = math.floor(log)
    mantissa = round(10.0 ** (log - decade), PLACES)
    return (mantissa, decade) if mantissa < 10 else (1.0, decade + 1)


def near_zero(point: Point, scales: Scales, names: Sequence[str], held: float) -> str:
    """A sentence on the row with the fewest digits, where these are few because a truth is near zero; "" else."""
    if not point.digits < held:
        return ""
    scaled = [max(0.0, digits) for digits in scales.digits(point)]
    own = [b if math.isnan(a) else a for a, b in zip(point.relative, scaled, strict=True)]
    worst = min(range(len(own)), key=own.__getitem__)
    name, scale = names[worst], f"{scales.values[worst]:.3g}"
    if math.isnan(point.relative[worst]):
        return f"In row {point.number}, the worst, {name} is exactly zero: its digits are those on its scale, {scale}."
    if not scaled[worst] > own[worst] + NEAR:
        return ""
    return (
        f"In row {point.number}, the worst, {name} is near zero, of size {10.0 ** point.truths[worst]:.1e}: relative "
        f"to that {own[worst]:.1f} digits are correct, and {min(scaled[worst], held):.1f} on its scale, {scale}."
    )
