"""Class A: single equations, all with a closed form."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from reference.arithmetic.precision import mp
from reference.arithmetic.rational import RATIONAL, IrrationalError
from reference.flow_problem import CONDITION
from reference.problems.detest.nonstiff import Nonstiff, first_order

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.arithmetic.protocols import Arithmetic

__all__ = ["DetestA1", "DetestA2", "DetestA3", "DetestA4", "DetestA5"]


class DetestA1(Nonstiff):
    """y' = -y, y(0) = 1; y = exp(-t)."""

    name = "detest-a1"
    words = "exponential decay"
    space = first_order(1)
    begins = ("1",)
    equation = "y' = -y"
    difficulty = "lower: one linear equation with constant coefficients, but its solution falls to 2e-9"

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        return (-y[0],)

    def known_state(self, t: Any) -> Sequence[Any]:
        return (mp.exp(-t),)


class DetestA2(Nonstiff):
    """y' = -y^3/2, y(0) = 1, a special case of Riccati's equation; y = 1/sqrt(1 + t)."""

    name = "detest-a2"
    words = "a special case of Riccati's equation"
    space = first_order(1)
    begins = ("1",)
    equation = "y' = -y^3/2"
    difficulty = "lower: one equation, whose solution falls slowly from a singularity at t = -1"

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        return (-(y[0] * y[0] * y[0]) / 2,)

    def known_state(self, t: Any) -> Sequence[Any]:
        return (1 / mp.sqrt(1 + t),)

    def exact_row(self, row: str, argument: Any) -> tuple[Fraction | None, ...] | None:
        """y0/sqrt(1 + y0^2 t) where that root is rational, and its derivative by y0."""
        if row not in ("state", CONDITION):
            return super().exact_row(row, argument)
        (begun,) = self.start
        try:
            root = RATIONAL.sqrt(1 + begun * begun * argument)
        except IrrationalError:
            return None
        if not root:
            return None
        return (begun / root,) if row == "state" else (1 / abs(root) ** 3,)


class DetestA3(Nonstiff):
    """y' = y cos t, y(0) = 1; y = exp(sin t)."""

    name = "detest-a3"
    words = "an oscillatory problem"
    space = first_order(1)
    begins = ("1",)
    equation = "y' = y cos t"
    difficulty = "lower: one linear equation, whose coefficient oscillates"
    autonomous = False

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        return (y[0] * m.cos(t),)

    def known_state(self, t: Any) -> Sequence[Any]:
        return (mp.exp(mp.sin(t)),)


class DetestA4(Nonstiff):
    """y' = (y/4) (1 - y/20), y(0) = 1, a logistic curve; y = 20/(1 + 19 exp(-t/4))."""

    name = "detest-a4"
    words = "a logistic curve"
    space = first_order(1)
    begins = ("1",)
    equation = "y' = (y/4) (1 - y/20)"
    difficulty = "lower: one equation, whose solution grows and levels off"

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        return ((1 - y[0] / m.number(CAPACITY)) * y[0] / 4,)

    def known_state(self, t: Any) -> Sequence[Any]:
        return (20 / (1 + 19 * mp.exp(-t / 4)),)


class DetestA5(Nonstiff):
    """y' = (y - t)/(y + t), y(0) = 4, a spiral curve: log(t^2 + y^2)/2 + atan2(y, t) is constant.

    J. Burkardt's test_ode prints the end value without its sign.
    """

    name = "detest-a5"
    words = "a spiral curve"
    space = first_order(1)
    begins = ("4",)
    equation = "y' = (y - t)/(y + t)"
    difficulty = "average: one equation, whose slope is infinite soon after the end, where y = -t"
    autonomous = False

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        return ((y[0] - t) / (y[0] + t),)

    def known_state(self, t: Any) -> Sequence[Any]:
        level = mp.log(4) + mp.pi / 2
        return (
            mp.findroot(
                lambda y: mp.log(t * t + y * y) / 2 + mp.atan2(y, t) - level,
                (mp.mpf("0.1") - t / 2, 5),
                solver="anderson",
            ),
        )


CAPACITY = Fraction(20)
