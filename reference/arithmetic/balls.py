"""Ball arithmetic as an arithmetic that equations read: every result encloses the exact value."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from flint import acb, arb, arb_series, fmpq

from reference.arithmetic.calculus import ball_integral, ball_root
from reference.arithmetic.elliptic import BallElliptic
from reference.arithmetic.precision import ctx

if TYPE_CHECKING:
    from collections.abc import Callable
    from contextlib import AbstractContextManager
    from fractions import Fraction

__all__ = ["BALL", "SERIES", "Ball", "BallSeries", "ComplexBall"]


class Ball:
    """Arb's real balls at the working precision in force."""

    elliptic = staticmethod(BallElliptic)

    @staticmethod
    def number(value: Fraction) -> arb:
        return arb(fmpq(value.numerator, value.denominator))

    @staticmethod
    def sin(x: arb) -> arb:
        return x.sin()

    @staticmethod
    def cos(x: arb) -> arb:
        return x.cos()

    @staticmethod
    def pi() -> arb:
        return arb.pi()

    @staticmethod
    def exp(x: arb) -> arb:
        return x.exp()

    @staticmethod
    def log(x: arb) -> arb:
        return x.log()

    @staticmethod
    def tan(x: arb) -> arb:
        return x.tan()

    @staticmethod
    def asin(x: arb) -> arb:
        return x.asin()

    @staticmethod
    def acos(x: arb) -> arb:
        return x.acos()

    @staticmethod
    def atan(x: arb) -> arb:
        return x.atan()

    @staticmethod
    def atan2(y: arb, x: arb) -> arb:
        return arb.atan2(y, x)

    @staticmethod
    def tanh(x: arb) -> arb:
        return x.tanh()

    @staticmethod
    def power(x: arb, exponent: Fraction) -> arb:
        """x^exponent, x > 0; also of x = 0 where the exponent is positive, and of any x where it is whole."""
        if exponent.denominator == 1:
            return x**exponent.numerator
        if x.is_zero() and exponent > 0:
            return arb(0)
        return x ** arb(fmpq(exponent.numerator, exponent.denominator)) if x > 0 else arb.nan()

    @staticmethod
    def sinh(x: arb) -> arb:
        return x.sinh()

    @staticmethod
    def cosh(x: arb) -> arb:
        return x.cosh()

    @staticmethod
    def floor(x: arb) -> arb:
        """The integer below every point of the ball; not a number where there is more than one."""
        whole = x.floor().unique_fmpz()
        return arb.nan() if whole is None else arb(whole)

    @staticmethod
    def sqrt(x: arb) -> arb:
        return x.sqrt()

    @staticmethod
    def integral(function: Callable[[Any, Any], Any], low: Any, high: Any) -> arb:
        """The integral of function(m, x), real and analytic on [low, high]."""
        return ball_integral(ComplexBall, function, low, high)

    def root(self, function: Callable[[Any, Any], Any], low: Any, high: Any) -> arb:
        """The one zero of the monotone function(m, x) in [low, high], its ends exact or balls."""
        return ball_root(self, function, low, high)


class ComplexBall:
    """Arb's complex balls, for the integrands of ``Ball.integral``.

    Where ``analytic`` is set, a function that is not analytic on the whole of its argument gives no number.
    """

    def __init__(self, analytic: bool) -> None:
        self.analytic = analytic

    @staticmethod
    def number(value: Fraction) -> acb:
        return acb(fmpq(value.numerator, value.denominator))

    @staticmethod
    def sin(x: Any) -> acb:
        return acb(x).sin()

    @staticmethod
    def cos(x: Any) -> acb:
        return acb(x).cos()

    @staticmethod
    def sinh(x: Any) -> acb:
        return acb(x).sinh()

    @staticmethod
    def cosh(x: Any) -> acb:
        return acb(x).cosh()

    @staticmethod
    def pi() -> acb:
        return acb.pi()

    @staticmethod
    def exp(x: Any) -> acb:
        return acb(x).exp()

    @staticmethod
    def tan(x: Any) -> acb:
        return acb(x).tan()

    @staticmethod
    def tanh(x: Any) -> acb:
        return acb(x).tanh()

    def sqrt(self, x: Any) -> acb:
        return acb(x).sqrt(analytic=self.analytic)

    def log(self, x: Any) -> acb:
        return acb(x).log(analytic=self.analytic)

    def power(self, x: Any, exponent: Fraction) -> acb:
        return acb(x).pow(self.number(exponent), analytic=self.analytic)

    def asin(self, x: Any) -> acb:
        return acb(x).asin() if self._between_the_cuts(acb(x)) else acb(arb.nan())

    def acos(self, x: Any) -> acb:
        return acb(x).acos() if self._between_the_cuts(acb(x)) else acb(arb.nan())

    def atan(self, x: Any) -> acb:
        """Its cuts are those of the arcsine, turned by a right angle."""
        return acb(x).atan() if self._between_the_cuts(acb(0, 1) * x) else acb(arb.nan())

    def _between_the_cuts(self, x: acb) -> bool:
        """Whether x avoids the real numbers from 1 and from -1 outwards, where that is asked for."""
        return not self.analytic or not x.imag.contains(0) or bool(abs(x.real) < 1)


class BallSeries:
    """Arb's power series with balls as coefficients; a constant stays a ball.

    A series is known up to its own ``prec``, on which every bound of what is left out rests.
    """

    @staticmethod
    def of_length(terms: int) -> AbstractContextManager[None]:
        """Series are known up to this many terms."""
        return ctx.worklength(terms)

    @staticmethod
    def number(value: Fraction) -> arb:
        return Ball.number(value)

    @staticmethod
    def pi() -> arb:
        return arb.pi()

    @staticmethod
    def sqrt(x: Any) -> Any:
        return x.sqrt()

    @staticmethod
    def exp(x: Any) -> Any:
        return x.exp()

    @staticmethod
    def log(x: Any) -> Any:
        return x.log()

    @staticmethod
    def sin(x: Any) -> Any:
        return x.sin()

    @staticmethod
    def cos(x: Any) -> Any:
        return x.cos()

    @staticmethod
    def tan(x: Any) -> Any:
        return x.tan()

    @staticmethod
    def asin(x: Any) -> Any:
        return x.asin()

    @staticmethod
    def acos(x: Any) -> Any:
        return x.acos()

    @staticmethod
    def atan(x: Any) -> Any:
        return x.atan()

    @staticmethod
    def sinh(x: Any) -> Any:
        return (x.exp() - (-x).exp()) / 2

    @staticmethod
    def cosh(x: Any) -> Any:
        return (x.exp() + (-x).exp()) / 2

    def tanh(self, x: Any) -> Any:
        return self.sinh(x) / self.cosh(x)

    @staticmethod
    def power(x: Any, exponent: Fraction) -> Any:
        return x ** Ball.number(exponent) if isinstance(x, arb_series) else Ball.power(x, exponent)


BALL = Ball()
SERIES = BallSeries()
