"""An equation as Python source, for compilers of Python that cannot read one with the arithmetic as an argument."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable
    from fractions import Fraction

__all__ = ["SOURCE", "Term"]


class Term:
    """A piece of source; arithmetic on it writes longer pieces."""

    def __init__(self, text: str) -> None:
        self.text = text

    def __str__(self) -> str:
        return self.text

    def _with(self, operator: str, other: Any) -> Term:
        return Term(f"({self} {operator} {other})")

    def _after(self, operator: str, other: Any) -> Term:
        return Term(f"({other} {operator} {self})")

    def __neg__(self) -> Term:
        return Term(f"(-{self})")

    def __add__(self, other: Any) -> Term:
        return self._with("+", other)

    def __radd__(self, other: Any) -> Term:
        return self._after("+", other)

    def __sub__(self, other: Any) -> Term:
        return self._with("-", other)

    def __rsub__(self, other: Any) -> Term:
        return self._after("-", other)

    def __mul__(self, other: Any) -> Term:
        return self._with("*", other)

    def __rmul__(self, other: Any) -> Term:
        return self._after("*", other)

    def __truediv__(self, other: Any) -> Term:
        return self._with("/", other)

    def __rtruediv__(self, other: Any) -> Term:
        return self._after("/", other)

    def __pow__(self, other: Any) -> Term:
        return self._with("**", other)


def _called(name: str) -> Callable[[Any], Term]:
    """The function of this name in the module ``math``, applied to a piece of source."""
    return lambda x: Term(f"math.{name}({x})")


class Source:
    """The arithmetic whose numbers are pieces of source that use the module ``math``."""

    sin = staticmethod(_called("sin"))
    cos = staticmethod(_called("cos"))
    tan = staticmethod(_called("tan"))
    asin = staticmethod(_called("asin"))
    acos = staticmethod(_called("acos"))
    atan = staticmethod(_called("atan"))
    sinh = staticmethod(_called("sinh"))
    cosh = staticmethod(_called("cosh"))
    tanh = staticmethod(_called("tanh"))
    exp = staticmethod(_called("exp"))
    log = staticmethod(_called("log"))
    sqrt = staticmethod(_called("sqrt"))

    @staticmethod
    def number(value: Fraction) -> Term:
        return Term(repr(float(value)))

    @staticmethod
    def pi() -> Term:
        return Term("math.pi")

    @staticmethod
    def power(x: Any, exponent: Fraction) -> Term:
        return Term(f"({x} ** {float(exponent)!r})")


SOURCE = Source()
