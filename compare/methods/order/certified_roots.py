"""Coefficients that are published as decimals: the zero of the order conditions nearest to what is printed.

Printed decimals satisfy the order conditions only to their digits.  The zero beside them is proven to exist and to be
the only one by an interval Newton step, and is enclosed to any precision by more of them
(R. E. Moore, R. B. Kearfott and M. J. Cloud, Introduction to Interval Analysis, 2009, chapter 8).
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any, Protocol

from flint import arb, arb_mat

from reference.arithmetic.dual import Dual
from reference.arithmetic.namespaces import BALL
from reference.arithmetic.precision import ctx
from reference.once import cached_property

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

__all__ = ["Coordinates", "Linear", "Zero", "ZeroError"]

ISOLATION_BITS, STILL_BITS, BOX_BITS = 256, 192, 128
NEWTON_STEPS = 40
GUARD_BITS = 80


class ZeroError(ArithmeticError):
    """Near the printed decimals no zero could be proven to exist."""


class Zero:
    """The zero of a system of equations that Newton's method finds from printed decimals, proven to exist.

    Args:
        name: what the equations are of; zeros of one name and the same printed decimals are one.
        equations: unknowns, in any arithmetic that mixes with integers, to as many values, which vanish at the zero.
        printed: the unknowns as printed.
        slack: how far the zero may be from what is printed, in units of the last printed place.
    """

    def __init__(
        self,
        name: str,
        equations: Callable[[Sequence[Any]], Sequence[Any]],
        printed: Sequence[str],
        slack: int = 1,
    ) -> None:
        self.name, self.equations, self.printed, self.slack = name, equations, tuple(printed), slack
        self._enclosures: dict[int, list[arb]] = {}

    def __reduce__(self) -> tuple[Any, ...]:
        return Zero, (self.name, self.equations, self.printed, self.slack)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Zero) and (self.name, self.printed) == (other.name, other.printed)

    def __hash__(self) -> int:
        return hash((self.name, self.printed))

    @property
    def coordinates(self) -> tuple[Linear, ...]:
        """The unknowns at the zero."""
        return tuple(Linear(self, {i: Fraction(1)}) for i in range(len(self.printed)))

    @cached_property
    def box(self) -> list[arb]:
        """A narrow box around the point to which Newton's method leads from the printed decimals."""
        with ctx.workprec(ISOLATION_BITS):
            point = [BALL.number(Fraction(text)).mid() for text in self.printed]
            derivatives = self._derivatives(point)
            for _ in range(NEWTON_STEPS):
                before, point = point, [ball.mid() for ball in self._newton(point, derivatives)]
                if max(abs(x - y) for x, y in zip(before, point, strict=True)) < arb(2) ** -STILL_BITS:
                    break
            return [arb(mid=middle, rad=arb(2) ** -BOX_BITS) for middle in point]

    @cached_property
    def jacobian(self) -> arb_mat:
        """The derivatives of the equations by the unknowns, everywhere in the box."""
        with ctx.workprec(ISOLATION_BITS):
            return self._derivatives(self.box)

    def _derivatives(self, at: Sequence[arb]) -> arb_mat:
        width = len(at)
        rows = [tuple(arb(int(i == j)) for j in range(width)) for i in range(width)]
        values = self.equations([Dual(ball, row) for ball, row in zip(at, rows, strict=True)])
        if len(values) != width:
            raise ValueError(f"{self.name}: {width} unknowns for {len(values)} equations; equally many are accepted.")
        return arb_mat(width, width, [slope for value in values for slope in value.slopes])

    def _newton(self, point: Sequence[arb], jacobian: arb_mat) -> list[arb]:
        """point - jacobian^-1 equations(point): balls around every zero in the box whose derivatives these are."""
        middle = [ball.mid() for ball in point]
        values = arb_mat(len(middle), 1, list(self.equations(middle)))
        try:
            change = jacobian.solve(values)
        except ZeroDivisionError:
            raise ZeroError(f"{self.name}: the equations are dependent near the printed decimals.") from None
        return [start - change[i, 0] for i, start in enumerate(middle)]

    @cached_property
    def isolated(self) -> list[arb]:
        """A first enclosure, inside the box: so that there is a zero in the box, and one only.

        Raises:
            ZeroError: it is not inside the box, or not within ``slack`` units of what is printed.
        """
        with ctx.workprec(ISOLATION_BITS):
            found = self._newton(self.box, self.jacobian)
            if not all(box.contains_interior(ball) for box, ball in zip(self.box, found, strict=True)):
                raise ZeroError(f"{self.name}: no zero near the printed decimals is proven.")
            for text, ball in zip(self.printed, found, strict=True):
                if not abs(ball - BALL.number(Fraction(text))) < BALL.number(self.slack * unit(text)):
                    raise ZeroError(f"{self.name}: {text} is printed, and the zero is at {ball.str(25, radius=False)}.")
        return found

    def enclosures(self) -> list[arb]:
        """Balls around the coordinates, as narrow as the precision in force allows."""
        bits = ctx.prec
        if bits not in self._enclosures:
            with ctx.workprec(bits + GUARD_BITS):
                found, width = self.isolated, _width(self.isolated)
                while True:
                    narrower = self._newton(found, self.jacobian)
                    if not _width(narrower) < width / 2:
                        break
                    found, width = narrower, _width(narrower)
            self._enclosures[bits] = found
        return self._enclosures[bits]


def _width(balls: Sequence[arb]) -> arb:
    return max(ball.rad() for ball in balls)


def unit(text: str) -> Fraction:
    """One unit of the last place of a decimal, such as 1/100 for "0.25"; of a fraction p/q, 1/q^2.

    A fraction that is the best of those with a denominator so small is nearer than that to what it stands for.
    """
    if "/" in text:
        return Fraction(1, Fraction(text).denominator ** 2)
    digits, _, exponent = text.lower().partition("e")
    return Fraction(10) ** (int(exponent or 0) - len(digits.partition(".")[2]))


class Coordinates(Protocol):
    """Real numbers that are known together, by their enclosures; equal where they are the same."""

    @property
    def name(self) -> str: ...
    def enclosures(self) -> list[arb]:
        """Balls around them, as narrow as the precision in force allows."""


class Linear:
    """constant + sum of shares[i] times coordinate i of a zero, its shares and constant rational.

    Two of them are equal where they are the same combination; none with a share left is rational.
    """

    def __init__(self, zero: Coordinates, shares: Mapping[int, Fraction], constant: Fraction = Fraction(0)) -> None:
        self.zero, self.constant = zero, constant
        self.shares = {i: share for i, share in sorted(shares.items()) if share}

    @property
    def rational(self) -> Fraction | None:
        """The number as a fraction, where it is one."""
        return None if self.shares else self.constant

    def _scaled(self, factor: Fraction) -> Linear:
        return Linear(self.zero, {i: share * factor for i, share in self.shares.items()}, self.constant * factor)

    def __add__(self, other: Linear | Fraction | int) -> Linear:
        if not isinstance(other, Linear):
            return Linear(self.zero, self.shares, self.constant + other)
        if other.zero != self.zero:
            raise ValueError(f"{self.zero.name} and {other.zero.name} are two zeros; numbers of one are accepted.")
        places = {*self.shares, *other.shares}
        shares = {i: self.shares.get(i, Fraction(0)) + other.shares.get(i, Fraction(0)) for i in places}
        return Linear(self.zero, shares, self.constant + other.constant)

    def __neg__(self) -> Linear:
        return self._scaled(Fraction(-1))

    def __sub__(self, other: Linear | Fraction | int) -> Linear:
        return self + (-other)

    def __rsub__(self, other: Fraction | int) -> Linear:
        return -self + other

    def __mul__(self, other: Fraction | int) -> Linear:
        return self._scaled(Fraction(other))

    def __truediv__(self, other: Fraction | int) -> Linear:
        return self._scaled(1 / Fraction(other))

    __radd__ = __add__
    __rmul__ = __mul__

    def __eq__(self, other: object) -> bool:
        if isinstance(other, (Fraction, int)):
            return not self.shares and self.constant == other
        if isinstance(other, Linear):
            return (self.zero, self.shares, self.constant) == (other.zero, other.shares, other.constant)
        return NotImplemented

    def __hash__(self) -> int:
        return hash((self.zero, tuple(self.shares.items()), self.constant)) if self.shares else hash(self.constant)

    def __repr__(self) -> str:
        with ctx.workprec(ISOLATION_BITS):
            return str(self.ball().str(25, radius=False))

    def ball(self) -> arb:
        """The enclosure at the precision in force."""
        with ctx.workprec(ctx.prec + GUARD_BITS):
            total = BALL.number(self.constant)
            balls = self.zero.enclosures()
            for i, share in self.shares.items():
                total += BALL.number(share) * balls[i]
        return total
