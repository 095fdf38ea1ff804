"""Class E: equations of the second order."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.arithmetic.namespaces import MPMATH
from reference.arithmetic.precision import mp
from reference.arithmetic.rational import RATIONAL, IrrationalError
from reference.declaration import Invariant, StateSpace
from reference.problem import SeparableProblem
from reference.problems.detest.nonstiff import Nonstiff, second_order

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.arithmetic.protocols import Arithmetic

__all__ = ["DetestE1", "DetestE2", "DetestE3", "DetestE4", "DetestE5"]


class DetestE1(Nonstiff):
    """y'' = -(y'/(t + 1) + (1 - 1/(4 (t + 1)^2)) y): Bessel's equation of order 1/2, of t + 1.

    y = sqrt(2/(pi (t + 1))) sin(t + 1).  The start is that of Algorithm 648, sqrt(2/pi) times sin 1 and times
    cos 1 - (sin 1)/2, each to 17 decimals and multiplied exactly; later collections have the products as
    0.6713967071418030 and 0.09540051444747446, which are other numbers by 1e-16 and 7e-17.
    """

    name = "detest-e1"
    words = "Bessel's equation of order 1/2"
    space = second_order(1, reversible=False)
    begins = ("0.79788456080286536*0.84147098480789651", "0.79788456080286536*0.11956681346419146")
    equation = "y1' = y2, y2' = -(y2/(t + 1) + (1 - 0.25/(t + 1)^2) y1)"
    difficulty = "lower: one linear equation, whose solution oscillates and decays"
    autonomous = False

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        x = t + 1
        return y[1], -(y[1] / x + (1 - 1 / (4 * x * x)) * y[0])

    def known_state(self, t: Any) -> Sequence[Any]:
        """(a sin x + b cos x)/sqrt(x), x = t + 1, by variation of the start's."""
        start, slope = self.start_in(MPMATH)
        slope += start / 2
        a, b = start * mp.sin(1) + slope * mp.cos(1), start * mp.cos(1) - slope * mp.sin(1)
        x = t + 1
        y = (a * mp.sin(x) + b * mp.cos(x)) / mp.sqrt(x)
        return y, (a * mp.cos(x) - b * mp.sin(x)) / mp.sqrt(x) - y / (2 * x)


class DetestE2(Nonstiff):
    """y'' = (1 - y^2) y' - y, y(0) = 2, y'(0) = 0: van der Pol's equation."""

    name = "detest-e2"
    words = "van der Pol's equation"
    space = second_order(1, reversible=False)
    begins = ("2", "0")
    equation = "y1' = y2, y2' = (1 - y1^2) y2 - y1"
    difficulty = "average: a relaxation oscillation whose limit cycle damps errors but for the phase"

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        return y[1], (1 - y[0] * y[0]) * y[1] - y[0]


class DetestE3(Nonstiff, SeparableProblem):
    """y'' = y^3/6 - y + 2 sin(2.78535 t), y(0) = y'(0) = 0: Duffing's equation, driven."""

    name = "detest-e3"
    words = "Duffing's equation, driven"
    space = StateSpace(
        positions=("y1",), momenta=("y2",), angles=(), odd=None, along=None, scale="units", independent=""
    )
    begins = ("0", "0")
    equation = "y1' = y2, y2' = y1^3/6 - y1 + 2 sin(2.78535 t)"
    difficulty = "average: a nonlinear oscillator that is driven at another frequency than its own"
    autonomous = False

    def velocity(self, m: Arithmetic, momenta: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        return tuple(momenta)

    def force(self, m: Arithmetic, t: Any, positions: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        (y,) = positions
        return (y * y * y / m.number(SIX) - y + 2 * m.sin(m.number(DRIVE) * t),)


class DetestE4(Nonstiff):
    """y'' = 0.032 - 0.4 y'^2, y(0) = 30, y'(0) = 0: a fall through air.

    y' = w tanh(0.4 w t) and y = 30 + 2.5 log cosh(0.4 w t) with w = sqrt(0.08).
    """

    name = "detest-e4"
    words = "a fall through air"
    space = second_order(1, reversible=True)
    begins = ("30", "0")
    equation = "y1' = y2, y2' = 0.032 - 0.4 y2^2"
    invariants = (Invariant("first integral", ("First integral", "(I - I0)/|I0|"), "start"),)
    difficulty = "lower: the velocity tends to a constant"

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        return y[1], m.number(WEIGHT) - m.number(DRAG) * y[1] * y[1]

    def known_state(self, t: Any) -> Sequence[Any]:
        drag, w = MPMATH.number(DRAG), mp.sqrt(MPMATH.number(WEIGHT / DRAG))
        return 30 + mp.log(mp.cosh(drag * w * t)) / drag, w * mp.tanh(drag * w * t)

    def invariant(self, m: Any, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """I = (y2^2 - 0.08) exp(0.8 (y1 - 30)); it is zero where the velocity is constant."""
        height = y[0] - m.number(Fraction(30))
        return (y[1] * y[1] - m.number(WEIGHT / DRAG)) * m.exp(m.number(2 * DRAG) * height)


class DetestE5(Nonstiff):
    """y'' = sqrt(1 + y'^2)/(25 - t), y(0) = y'(0) = 0: a linear pursuit.

    y' = (a - 1/a)/2 and y = (25/2) log a - t/2 + t^2/100 with a = 25/(25 - t): y' is rational at every rational time,
    12/5 at the time 20.
    """

    name = "detest-e5"
    words = "a linear pursuit"
    space = second_order(1, reversible=False)
    begins = ("0", "0")
    equation = "y1' = y2, y2' = sqrt(1 + y2^2)/(25 - t)"
    difficulty = "lower: smooth, with a singularity at t = 25, not far from the end"
    autonomous = False

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        return y[1], m.sqrt(1 + y[1] * y[1]) / (25 - t)

    def known_state(self, t: Any) -> Sequence[Any]:
        a = 25 / (25 - t)
        return mp.mpf(25) / 2 * mp.log(a) - t / 2 + t * t / 100, (a - 1 / a) / 2

    def exact_row(self, row: str, argument: Any) -> tuple[Fraction | None, ...] | None:
        """y' = v (a + 1/a)/2 + sqrt(1 + v^2) (a - 1/a)/2 from y' = v, where that root is rational."""
        known = super().exact_row(row, argument)
        if known is not None or row != "state" or argument >= END:
            return known
        v = self.start[1]
        try:
            root = RATIONAL.sqrt(1 + v * v)
        except IrrationalError:
            return None
        a = END / (END - argument)
        return None, (v * (a + 1 / a) + root * (a - 1 / a)) / 2


SIX = Fraction(6)
"""heyoka takes a quotient by a number of Python as a product with the reciprocal in doubles."""
DRIVE = Fraction("2.78535")
WEIGHT, DRAG = Fraction("0.032"), Fraction("0.4")
END = Fraction(25)
