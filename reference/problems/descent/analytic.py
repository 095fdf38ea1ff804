"""Complex balls for curves: a function of the place has to be analytic, a constant of the formula only real.

So acos(1) or sqrt(0), at the ends of their domains, are numbers like any other.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from flint import arb

from reference.arithmetic.balls import BALL, ComplexBall

if TYPE_CHECKING:
    from fractions import Fraction

__all__ = ["ANALYTIC"]


class AnalyticBall:
    """Arb's complex balls where functions are analytic, no numbers elsewhere; a real ball stays one."""

    def __init__(self) -> None:
        self._complex = ComplexBall(analytic=True)

    @staticmethod
    def number(value: Fraction) -> arb:
        return BALL.number(value)

    @staticmethod
    def pi() -> arb:
        return BALL.pi()

    def _of(self, name: str, x: Any, *more: Any) -> Any:
        return getattr(BALL if isinstance(x, arb) else self._complex, name)(x, *more)

    def sin(self, x: Any) -> Any:
        return self._of("sin", x)

    def cos(self, x: Any) -> Any:
        return self._of("cos", x)

    def tan(self, x: Any) -> Any:
        return self._of("tan", x)

    def asin(self, x: Any) -> Any:
        return self._of("asin", x)

    def acos(self, x: Any) -> Any:
        return self._of("acos", x)

    def atan(self, x: Any) -> Any:
        return self._of("atan", x)

    def sinh(self, x: Any) -> Any:
        return self._of("sinh", x)

    def cosh(self, x: Any) -> Any:
        return self._of("cosh", x)

    def tanh(self, x: Any) -> Any:
        return self._of("tanh", x)

    def exp(self, x: Any) -> Any:
        return self._of("exp", x)

    def log(self, x: Any) -> Any:
        return self._of("log", x)

    def sqrt(self, x: Any) -> Any:
        return self._of("sqrt", x)

    def power(self, x: Any, exponent: Fraction) -> Any:
        return self._of("power", x, exponent)


ANALYTIC = AnalyticBall()
