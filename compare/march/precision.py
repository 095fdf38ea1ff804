"""The number formats a march may run in: how each rounds exact numbers, its arrays, its compiler type."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from reference.arithmetic.compiler import hy
from reference.arithmetic.limbs import exact_decimal, interval, rounded, ziv
from reference.arithmetic.namespaces import BALL
from reference.names import unknown

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from flint import arb

    from compare.methods.order.algebraic import Coefficient, Enclosed

__all__ = ["FORMATS", "Precision", "precision"]


@dataclass(frozen=True)
class Precision:
    """A binary floating-point format.

    Attributes:
        name: as the command line spells it.
        bits: significand bits, the hidden one included.
        type: the scalar type, which is also heyoka's ``fp_type`` and the arrays' dtype.
        lanes: how many lanes a batch may hold; 1 where the hardware has no vectors of this type.
    """

    name: str
    bits: int
    type: Any
    lanes: int

    def number(self, value: Coefficient | Enclosed) -> Any:
        """``value``, an exact number or what encloses itself in a ball, correctly rounded (subnormals excepted)."""
        if self.type is float and isinstance(value, (int, Fraction)):
            return value.numerator / value.denominator  # Python rounds the quotient of two integers correctly
        return self._scalar(*self.parts(value))

    def parts(self, value: Coefficient | Enclosed) -> tuple[int, int]:
        """``value`` correctly rounded, as (mantissa, exponent): mantissa 2^exponent."""
        if isinstance(value, (int, Fraction)):
            if value.denominator & (value.denominator - 1) == 0:
                return rounded(value.numerator, 1 - value.denominator.bit_length(), self.bits)
            exact = Fraction(value)
            ((found,),) = ziv(lambda _: [[BALL.number(exact)]], self._decided, 1, self.bits + 40, f"{value}")
        else:
            ((found,),) = ziv(lambda _: [[value.ball()]], self._decided, 1, self.bits + 40, f"{value}")
        return found

    def round(self, value: Coefficient | Enclosed) -> Fraction:
        """``value`` correctly rounded, as the rational it then is."""
        mantissa, exponent = self.parts(value)
        return mantissa * Fraction(2) ** exponent

    def _decided(self, ball: arb) -> tuple[int, int] | None:
        bounds = interval(ball)
        if bounds is None:
            return None
        low, high = (rounded(end, bounds[2], self.bits) for end in bounds[:2])
        return low if _value(low) == _value(high) else None

    def _scalar(self, mantissa: int, exponent: int) -> Any:
        if self.bits <= 53:
            return self.type(math.ldexp(mantissa, exponent))
        if self.type is np.longdouble:
            return np.ldexp(_long(mantissa), exponent)
        digits = exact_decimal(Fraction(mantissa) * Fraction(2) ** exponent, self.bits + abs(exponent) + 20)
        return hy.real(digits, self.bits) if self.type is hy.real else self.type(digits)

    def array(self, values: Iterable[Any]) -> np.ndarray:
        """Exact numbers, each correctly rounded, as a one-dimensional array."""
        return np.array([self.number(value) for value in values], dtype=self.type)

    def zeros(self, shape: Sequence[int]) -> np.ndarray:
        """An array of zeros, every one at the format's full precision."""
        zeros = np.empty(shape, dtype=self.type)
        zeros[...] = self.number(Fraction(0)) if self.type is not hy.real else hy.real(0, self.bits)
        return zeros

    def difference(self, values: np.ndarray, limbs: np.ndarray) -> np.ndarray:
        """``values`` - the sum of ``limbs`` along the last axis, as float64, without losing what they share.

        Values of fewer than 53 bits are widened first, which is exact.
        """
        wide = values.astype(np.float64) if self.bits < 53 else values
        for limb in np.moveaxis(limbs, -1, 0):
            wide = wide - limb.astype(wide.dtype)
        return wide.astype(np.float64)

    @property
    def exact_epsilon(self) -> Fraction:
        """The spacing of the numbers at 1, exactly."""
        return Fraction(1, 1 << (self.bits - 1))

    @property
    def epsilon(self) -> float:
        """The spacing of the numbers at 1."""
        return math.ldexp(1.0, 1 - self.bits)

    @property
    def tiny(self) -> Fraction:
        """A number near the least that is normal."""
        return Fraction(1, 1 << (126 if self.type is np.float32 else 1022))

    @property
    def compiler_options(self) -> dict[str, Any]:
        """What heyoka's compiler needs to know; calls of MPFR gain nothing from optimization, which takes long."""
        return {"fp_type": self.type, **({"prec": self.bits, "opt_level": 0} if self.type is hy.real else {})}


def _value(parts: tuple[int, int]) -> Fraction:
    """The number: just below a power of two, what is rounded up to that has another mantissa than the power itself."""
    mantissa, exponent = parts
    return mantissa * Fraction(2) ** exponent


FORMATS = (
    Precision("float32", 24, np.float32, 64),
    Precision("float64", 53, float, 32),
    Precision("longdouble", np.finfo(np.longdouble).nmant + 1, np.longdouble, 1),
    Precision("float128", 113, getattr(hy, "real128", hy.real), 1),  # MPFR's where the compiler has no binary128
)
MIN_BITS, MAX_BITS = 64, 4096
"""Of MPFR; fewer would not hold the integers that NumPy mixes with them."""


def _long(whole: int) -> Any:
    """A whole number that a long double holds, by pieces that any has room for."""
    if abs(whole) < 1 << 32:
        return np.longdouble(whole)
    high, low = divmod(whole, 1 << 32)
    return _long(high) * 2**32 + np.longdouble(low)


def precision(name: str) -> Precision:
    """Return the format of this name: float32, float64, longdouble, float128 or ``mp:BITS`` (MPFR).

    Raises:
        ValueError: there is none.
    """
    for known in FORMATS:
        if known.name == name:
            return known
    kind, _, bits = str(name).partition(":")
    if kind == "mp" and bits.isdecimal() and MIN_BITS <= int(bits) <= MAX_BITS:
        return Precision(name, int(bits), hy.real, 1)
    raise ValueError(
        unknown("precision", str(name), [*(known.name for known in FORMATS), f"mp:{MIN_BITS} to mp:{MAX_BITS}"])
    )
