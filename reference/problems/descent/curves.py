"""The curves that a body can slide along: the race of the thesis, and any curve that formulas give.

A curve is read at the fraction w of its way, 0 at its beginning and 1 at its end: of its parameter, which for a height
over the horizontal is x itself; for the cycloid by its arc, the fraction of its length.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.arithmetic.dual import with_slope
from reference.arithmetic.formula import Expression
from reference.arithmetic.limbs import BINARY64_BITS
from reference.arithmetic.namespaces import MPMATH
from reference.arithmetic.precision import mp
from reference.names import short, unknown
from reference.problems.descent.equations import acceleration

if TYPE_CHECKING:
    from collections.abc import Callable

    from reference.arithmetic.protocols import ElementaryArithmetic

__all__ = ["CYCLOID", "RACE", "Curve", "CycloidByArc", "FormulaCurve", "lagrange", "spelled_curve"]


@dataclass(frozen=True)
class Curve:
    """A curve from w = 0 down to w = 1, in any arithmetic: x and y in m, y upwards."""

    name: str = field(compare=False)

    def horizontal(self, m: ElementaryArithmetic, w: Any) -> Any:
        """x at w."""
        raise NotImplementedError

    def height(self, m: ElementaryArithmetic, w: Any) -> Any:
        """y at w."""
        raise NotImplementedError

    def slopes(self, m: ElementaryArithmetic, w: Any) -> tuple[Any, Any]:
        """dx/dw and dy/dw."""
        raise NotImplementedError

    def profile(self, m: ElementaryArithmetic, w: Any) -> tuple[Any, Any, Any]:
        """The height, dy/dw and N = (dx/dw)^2 + (dy/dw)^2: all that the motion depends on."""
        raise NotImplementedError

    @property
    def arguments(self) -> str:
        """The curve as the arguments of a descent are written."""
        return repr(self.name)

    @property
    def size(self) -> int:
        """How many operations its profile takes."""
        raise NotImplementedError

    def spelled(self, w: Fraction) -> str:
        """The place w as a message shows it."""
        return f"the fraction {float(w):.6g} of the way"


@dataclass(frozen=True)
class FormulaCurve(Curve):
    """x and y as formulas of a ``variable``, which goes from ``start`` to ``end``."""

    variable: str
    x: Expression
    y: Expression
    start: Expression
    end: Expression

    @property
    def arguments(self) -> str:
        named = self.name in {curve.name for curve in RACE}
        return repr(self.name) if named else f"{self.name!r}, start={self.start!r}, end={self.end!r}"

    @property
    def size(self) -> int:
        return len(self.x.terms) + len(self.y.terms)

    def spelled(self, w: Fraction) -> str:
        with mp.workprec(BINARY64_BITS):
            return f"{self.variable} = {float(self.parameter(MPMATH, MPMATH.number(w))):.6g}"

    def parameter(self, m: ElementaryArithmetic, w: Any) -> Any:
        """p at w."""
        start = self.start(m)
        return start + (self.end(m) - start) * w

    def end_or_parameter(self, m: ElementaryArithmetic, w: Fraction) -> Any:
        """p at an exact w: at an end what is written there, whatever the other end is."""
        ends = {Fraction(0): self.start, Fraction(1): self.end}
        return ends[w](m) if w in ends else self.parameter(m, m.number(w))

    def horizontal(self, m: ElementaryArithmetic, w: Any) -> Any:
        return self.x(m, self.parameter(m, w))

    def height(self, m: ElementaryArithmetic, w: Any) -> Any:
        return self.y(m, self.parameter(m, w))

    def slopes(self, m: ElementaryArithmetic, w: Any) -> tuple[Any, Any]:
        return with_slope(m, self.horizontal, w)[1], with_slope(m, self.height, w)[1]

    def profile(self, m: ElementaryArithmetic, w: Any) -> tuple[Any, Any, Any]:
        _, dx = with_slope(m, self.horizontal, w)
        y, dy = with_slope(m, self.height, w)
        return y, dy, dx * dx + dy * dy

    def second_slopes(self, m: ElementaryArithmetic, w: Any) -> tuple[Any, Any]:
        """d2x/dw2 and d2y/dw2."""

        def second(of: Callable[[Any, Any], Any]) -> Any:
            return with_slope(m, lambda duals, place: with_slope(duals, of, place)[1], w)[1]

        return second(self.horizontal), second(self.height)


@dataclass(frozen=True)
class CycloidByArc(Curve):
    """The cycloid x = pi - a + sin a, y = 1 + cos a from its cusp (pi, 2) to its lowest point (0, 0), a from 0 to pi.

    Its arc is 4 (1 - cos(a/2)), so that w = 1 - cos(a/2): in w the height is a polynomial and N = 16, where the
    angle would start with N = 0 at the cusp.
    """

    size = 5

    def horizontal(self, m: ElementaryArithmetic, w: Any) -> Any:
        """pi - a + sin a, with sin(a/4) = sqrt(w/2) and sin(a/2) = sqrt(w (2 - w))."""
        return m.pi() - 4 * m.asin(m.sqrt(w / 2)) + 2 * m.sqrt(w * (2 - w)) * (1 - w)

    def height(self, m: ElementaryArithmetic, w: Any) -> Any:
        """1 + cos a = 2 cos^2(a/2)."""
        del m
        cosine = 1 - w
        return 2 * cosine * cosine

    def slopes(self, m: ElementaryArithmetic, w: Any) -> tuple[Any, Any]:
        """-4 (sin(a/2), cos(a/2)), the tangent."""
        return -4 * m.sqrt(w * (2 - w)), 4 * (w - 1)

    def profile(self, m: ElementaryArithmetic, w: Any) -> tuple[Any, Any, Any]:
        return self.height(m, w), 4 * (w - 1), m.number(Fraction(16))


def lagrange(curve: Curve, m: ElementaryArithmetic, w: Any, rate: Any, g: Any) -> tuple[Any, Any]:
    """(w', w'') at w, in 1/s and 1/s^2."""
    _, slope, arc_square = curve.profile(m, w)
    _, arc_square_slope = with_slope(m, lambda duals, place: curve.profile(duals, place)[2], w)
    return rate, acceleration(rate, slope, arc_square, arc_square_slope, g)


def _over_x(name: str, height: str) -> FormulaCurve:
    """A height over x, from x = pi to x = 0."""
    x, y = Expression.parse("x", "x"), Expression.parse(height, "x")
    return FormulaCurve(name, "x", x, y, Expression.parse("pi"), Expression.parse("0"))


def _by_parameter(name: str, x: str, y: str, start: str, end: str) -> FormulaCurve:
    ends = Expression.parse(start), Expression.parse(end)
    return FormulaCurve(name, "p", Expression.parse(x, "p"), Expression.parse(y, "p"), *ends)


CYCLOID = CycloidByArc("cycloid")
RACE: tuple[Curve, ...] = (
    _over_x("line", "2*x/pi"),
    _over_x("parabola", "2*(x/pi)**2"),
    _over_x("cubic", "2*(x/pi)**3"),
    _over_x("quartic", "2*(x/pi)**4"),
    _by_parameter("circular_arc", "(pi**2 + 4)/2*p/(1 + p**2)", "(pi**2 + 4)/2*p**2/(1 + p**2)", "2/pi", "0"),
    _by_parameter("quarter_ellipse", "pi*cos(p)", "2 - 2*sin(p)", "0", "pi/2"),
    CYCLOID,
)
"""The race of the thesis, from (pi, 2) down to (0, 0); its arc and ellipse meet the bottom horizontally.

The arc's radius is (pi^2 + 4)/4; its parameter is the tangent of half the angle from the bottom.
"""


def spelled_curve(text: Any, start: Any, end: Any) -> Curve:
    """The curve of the race of this name, or the one whose formulas ``text`` spells, from ``start`` to ``end``.

    Raises:
        ValueError: it is no name and no formula, or the ends of its parameter are missing, superfluous or the same.
        TypeError: it is no text, or an end is no number.
    """
    if not isinstance(text, str):
        raise TypeError(f"curve is of type {type(text).__name__}; a name or a formula is accepted.")
    named = {curve.name: curve for curve in RACE}
    if text in named:
        if (start, end) != (None, None):
            raise ValueError(f"curve is '{text}', whose ends are known; start and end are accepted with a formula.")
        return named[text]
    if text.isidentifier() and text not in {"x", "p", "pi"}:
        raise ValueError(unknown("curve", text, named))
    x, y, variable = _formulas(text)
    if start is None or end is None:
        missing = "start" if start is None else "end"
        raise ValueError(f"curve is '{short(text)}', a formula; it needs the {missing} of its {variable}.")
    parsed = Expression.parse(x, variable, "curve"), Expression.parse(y, variable, "curve")
    return FormulaCurve(text, variable, *parsed, Expression.constant(start, "start"), Expression.constant(end, "end"))


def _formulas(text: str) -> tuple[str, str, str]:
    """The formulas of x and y, and their variable: "x = ...; y = ..." in p, or the height in x, with or without y =."""
    parts: dict[str, str] = {}
    for part in text.split(";"):
        left, equals, right = part.partition("=")
        name = left.strip() if equals else "y"
        if name not in {"x", "y"} or name in parts or "=" in right:
            raise ValueError(
                f"curve is '{short(text)}'; a height such as '2*(x/pi)**4' or 'x = ...; y = ...' in p is accepted."
            )
        parts[name] = right if equals else part
    if "y" not in parts:
        raise ValueError(f"curve is '{short(text)}', without a formula of y.")
    return (parts["x"], parts["y"], "p") if "x" in parts else ("x", parts["y"], "x")
