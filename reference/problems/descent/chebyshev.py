"""The time on a curve by Chebyshev series in mpmath: Clenshaw and Curtis's rule, kept as a function of its upper limit.

The place is u = tan(pi z/4), z in [0, 1], with w = w0 + L u^2 or w = w0 + L u by the order of the slide.  On each piece
of the way the integrand is interpolated at Chebyshev's points, and its series integrated term by term (C. W. Clenshaw
and A. R. Curtis, Numerische Mathematik 2 (1960) 197).  A piece is halved until the last coefficients of its series
are below the working precision.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from reference.arithmetic.namespaces import MPMATH
from reference.arithmetic.precision import mp
from reference.once import cached_property
from reference.problems.descent.equations import slowness

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.problems.descent.slide import Slide

__all__ = ["ChebyshevClock", "chebyshev_clock"]

MAX_DEPTH = 16
WORD = 64
BISECTIONS = 45
"""A guess of so many bits, which Newton's steps double."""
TAIL = 4
"""Coefficients at the end of a series that must have vanished."""


@dataclass(frozen=True)
class Segment:
    """The series of dt/dz and of t on low <= z <= high, and the time at low."""

    low: Any
    high: Any
    begins: Any
    rates: Sequence[Any]
    times: Sequence[Any]

    def _x(self, z: Any) -> Any:
        return (2 * z - self.low - self.high) / (self.high - self.low)

    @cached_property
    def coarse(self) -> list[float]:
        """The series of t in binary64, as a part of the time of the segment."""
        return [float(value / self.spends) for value in self.times]

    @property
    def spends(self) -> Any:
        """The time on the segment."""
        return _value(self.times, mp.mpf(1))

    def guess(self, time: Any) -> Any:
        """Z at a time of the segment, to about binary64, by bisection."""
        part = float((time - self.begins) / self.spends)
        low, high = -1.0, 1.0
        for _ in range(BISECTIONS):
            middle = (low + high) / 2
            low, high = (middle, high) if _value(self.coarse, middle) < part else (low, middle)
        return ((self.low + self.high) + (self.high - self.low) * low) / 2

    def time(self, z: Any) -> Any:
        return self.begins + _value(self.times, self._x(z))

    def rate(self, z: Any) -> Any:
        return _value(self.rates, self._x(z))


class ChebyshevClock:
    """sqrt(2 g) t as a function of the fraction w of the way, and back, at mpmath's working precision.

    Raises:
        ArithmeticError: the series of a piece that is 2^-MAX_DEPTH of the way does not come to an end.
    """

    def __init__(self, slide: Slide) -> None:
        self._slide = slide
        self._length = MPMATH.number(1 - slide.released)
        count = max(24, mp.prec // 3)
        angles = [mp.pi * (2 * i + 1) / (2 * count) for i in range(count)]
        self._points = [mp.cos(angle) for angle in angles]
        self._cosines = [mp.cos(mp.pi * i / (2 * count)) for i in range(4 * count)]
        self._segments: list[Segment] = []
        self._cover(mp.mpf(0), mp.mpf(1), 0)
        self.total = self._segments[-1].time(mp.mpf(1))

    def _fraction(self, z: Any) -> tuple[Any, Any]:
        """w at z, and dw/dz."""
        power = 3 - self._slide.order
        u = mp.tan(mp.pi * z / 4)
        length = MPMATH.number(1 - self._slide.released)
        by_z = length * power * u ** (power - 1) * (1 + u * u) * mp.pi / 4
        return MPMATH.number(self._slide.released) + length * u**power, by_z

    def _integrand(self, z: Any) -> Any:
        """sqrt(2 g) dt/dz as it stands, with the digits that the drop cancels near the start to spare."""
        with mp.extraprec(40 + 6 * max(0, -int(mp.frexp(z)[1]))):
            w, by_z = self._fraction(z)
            height, _, arc_square = self._slide.curve.profile(MPMATH, w)
            drop = self._slide.curve.height(MPMATH, MPMATH.number(self._slide.released)) - height
            return slowness(MPMATH, arc_square, drop) * by_z

    def _cover(self, low: Any, high: Any, depth: int) -> None:
        values = [self._integrand((low + high) / 2 + (high - low) / 2 * x) for x in self._points]
        rates = self._series(values)
        largest = max(abs(value) for value in rates)
        if max(abs(value) for value in rates[-TAIL:]) <= largest * mp.eps * 8:
            begins = self._segments[-1].time(low) if self._segments else mp.mpf(0)
            self._segments.append(Segment(low, high, begins, rates, _integrated(rates, (high - low) / 2)))
            return
        if depth == MAX_DEPTH:
            raise ArithmeticError(f"the Chebyshev series of {self._slide!r} do not come to an end.")
        middle = (low + high) / 2
        self._cover(low, middle, depth + 1)
        self._cover(middle, high, depth + 1)

    def _series(self, values: Sequence[Any]) -> list[Any]:
        """The coefficients of the series that takes the values at the points."""
        count = len(values)
        found = []
        for k in range(count):
            cosines = [self._cosines[k * (2 * i + 1) % (4 * count)] for i in range(count)]
            found.append(mp.fdot(values, cosines) * 2 / count)
        found[0] /= 2
        return found

    def time(self, w: Any) -> tuple[Any, Any]:
        """The time at the fraction w, and the rate dw/dt there."""
        left = (w - MPMATH.number(self._slide.released)) / self._length
        z = 4 * mp.atan(mp.sqrt(left) if self._slide.order == 1 else left) / mp.pi
        here = next((segment for segment in self._segments if z <= segment.high), self._segments[-1])
        return here.time(z), self._fraction(z)[1] / here.rate(z)

    def place(self, time: Any) -> tuple[Any, Any]:
        """The fraction w at the time, and the rate dw/dt there, by Newton's method."""
        here = next(segment for segment in reversed(self._segments) if segment.begins <= time)
        z = here.guess(time) if time else mp.mpf(0)
        for _ in range(1 + (mp.prec // BISECTIONS).bit_length()):
            z = min(max(z + (time - here.time(z)) / here.rate(z), here.low), here.high)
        if abs(time - here.time(z)) > mp.ldexp(here.spends, 16 - mp.prec):
            raise ArithmeticError(f"no place of {self._slide!r} was found at the time {mp.nstr(time, 5)}/sqrt(2 g).")
        w, by_z = self._fraction(z)
        return w, by_z / here.rate(z)


def chebyshev_clock(slide: Slide) -> ChebyshevClock:
    """The clock of a slide at the working precision in force or a little above, built once."""
    return _built(slide, WORD * -(-mp.prec // WORD))


@lru_cache(maxsize=32)
def _built(slide: Slide, bits: int) -> ChebyshevClock:
    with mp.workprec(bits):
        return ChebyshevClock(slide)


def _integrated(series: Sequence[Any], half: Any) -> list[Any]:
    """The series of the integral from -1 on, times ``half``."""
    padded = [*series, mp.mpf(0), mp.mpf(0)]
    padded[0] *= 2
    found = [mp.mpf(0)] + [half * (padded[k - 1] - padded[k + 1]) / (2 * k) for k in range(1, len(series) + 1)]
    found[0] = -mp.fsum(value * (-1) ** k for k, value in enumerate(found))
    return found


def _value(series: Sequence[Any], x: Any) -> Any:
    """The sum of series[k] T_k(x), by Clenshaw's recurrence."""
    last, next_ = 0 * x, 0 * x
    for value in reversed(series[1:]):
        last, next_ = value + 2 * x * last - next_, last
    return series[0] + x * last - next_
