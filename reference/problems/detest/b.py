"""Class B: small systems."""

from __future__ import annotations

from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING, Any

from reference.arithmetic.namespaces import MPMATH
from reference.arithmetic.precision import mp
from reference.declaration import Invariant
from reference.problems.detest.nonstiff import Nonstiff, first_order

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.arithmetic.protocols import Arithmetic

__all__ = ["DetestB1", "DetestB2", "DetestB3", "DetestB4", "DetestB5"]


class DetestB1(Nonstiff):
    """y1' = 2 (y1 - y1 y2), y2' = -(y2 - y1 y2), y(0) = (1, 3): two conflicting populations (Lotka and Volterra)."""

    name = "detest-b1"
    words = "two conflicting populations"
    space = first_order(2)
    begins = ("1", "3")
    equation = "y1' = 2 (y1 - y1 y2), y2' = -(y2 - y1 y2)"
    invariants = (Invariant("Volterra's function", ("Volterra's function", "(V - V0)/V0"), "start"),)
    difficulty = "average: periodic, with fast and slow parts of each turn"

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        met = y[0] * y[1]
        return 2 * (y[0] - met), met - y[1]

    def invariant(self, m: Any, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """V = y1 - log y1 + 2 (y2 - log y2)."""
        return y[0] - m.log(y[0]) + 2 * (y[1] - m.log(y[1]))


class DetestB2(Nonstiff):
    """y1' = -y1 + y2, y2' = y1 - 2 y2 + y3, y3' = y2 - y3, y(0) = (2, 0, 1): a linear chemical reaction.

    The eigenvalues are 0, -1 and -3: y2 = 1 - exp(-3 t), y1 - y3 = exp(-t), and y1 + y2 + y3 = 3.
    """

    name = "detest-b2"
    words = "a linear chemical reaction"
    space = first_order(3)
    begins = ("2", "0", "1")
    equation = "y1' = -y1 + y2, y2' = y1 - 2 y2 + y3, y3' = y2 - y3"
    invariants = (Invariant("sum", ("Sum", "(S - S0)/S0"), "start"),)
    difficulty = "lower: linear with constant coefficients, and at rest soon"

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        return y[1] - y[0], y[0] - 2 * y[1] + y[2], y[1] - y[2]

    def known_state(self, t: Any) -> Sequence[Any]:
        slow, fast = mp.exp(-t), mp.exp(-3 * t)
        return 1 + (slow + fast) / 2, 1 - fast, 1 - (slow - fast) / 2

    def invariant(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """S = y1 + y2 + y3."""
        return y[0] + y[1] + y[2]


class DetestB3(Nonstiff):
    """y1' = -y1, y2' = y1 - y2^2, y3' = y2^2, y(0) = (1, 0, 0): a nonlinear chemical reaction.

    y1 = exp(-t), y2 = u'/u with u'' = exp(-t) u, whose solutions are Bessel functions I0 and K0 of 2 exp(-t/2), and
    y1 + y2 + y3 = 1.
    """

    name = "detest-b3"
    words = "a nonlinear chemical reaction"
    space = first_order(3)
    begins = ("1", "0", "0")
    equation = "y1' = -y1, y2' = y1 - y2^2, y3' = y2^2"
    invariants = (Invariant("sum", ("Sum", "(S - S0)/S0"), "start"),)
    difficulty = "lower: smooth, and slower and slower; one component falls to 2e-9"

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        reacted = y[1] * y[1]
        return -y[0], y[0] - reacted, reacted

    def known_state(self, t: Any) -> Sequence[Any]:
        x, i0, i1, k0, k1 = 2 * mp.exp(-t / 2), *(partial(f, n) for f in (mp.besseli, mp.besselk) for n in (0, 1))
        y2 = -x / 2 * (k1(2) * i1(x) - i1(2) * k1(x)) / (k1(2) * i0(x) + i1(2) * k0(x))
        return mp.exp(-t), y2, 1 - mp.exp(-t) - y2

    def invariant(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """S = y1 + y2 + y3."""
        return y[0] + y[1] + y[2]


class DetestB4(Nonstiff):
    """y1' = -y2 - y1 y3/r, y2' = y1 - y2 y3/r, y3' = y1/r, r = sqrt(y1^2 + y2^2), y(0) = (3, 0, 0).

    A curve on a torus: (y1, y2) = (2 + cos t) (cos t, sin t), y3 = sin t.  Every motion turns about the axis at the
    rate 1, with r' = -y3, so that y3 - y2/r is conserved; on a torus it is 0.
    """

    name = "detest-b4"
    words = "an integral surface of a torus"
    space = first_order(3, odd=("y2", "y3"))
    begins = ("3", "0", "0")
    equation = "y1' = -y2 - y1 y3/r, y2' = y1 - y2 y3/r, y3' = y1/r, r = sqrt(y1^2 + y2^2)"
    invariants = (Invariant("height over the torus", ("Height over the torus", "(I - I0)/I0"), "start"),)
    difficulty = "average: periodic, with square roots and quotients"

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        r = m.sqrt(y[0] * y[0] + y[1] * y[1])
        return -y[1] - y[0] * y[2] / r, y[0] - y[1] * y[2] / r, y[0] / r

    def known_state(self, t: Any) -> Sequence[Any]:
        r = 2 + mp.cos(t)
        return r * mp.cos(t), r * mp.sin(t), mp.sin(t)

    def invariant(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """I = 1 + y3 - y2/r: the radius of the tube is added, so that there is a scale for its change."""
        return 1 + y[2] - y[1] / m.sqrt(y[0] * y[0] + y[1] * y[1])


class DetestB5(Nonstiff):
    """y1' = y2 y3, y2' = -y1 y3, y3' = -0.51 y1 y2, y(0) = (0, 1, 1): Euler's equations of a rigid body.

    y = (sn t, cn t, dn t) with the parameter k^2 = 0.51.
    """

    name = "detest-b5"
    words = "Euler's equations of a rigid body"
    space = first_order(3, odd=("y1",))
    begins = ("0", "1", "1")
    equation = "y1' = y2 y3, y2' = -y1 y3, y3' = -0.51 y1 y2"
    invariants = (
        Invariant("circle", ("Circle", "(C - C0)/C0"), "start"),
        Invariant("ellipse", ("Ellipse", "(I - I0)/I0"), "start", "ellipse"),
    )
    difficulty = "average: smooth and periodic, with two quadratic invariants"

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        return y[1] * y[2], -(y[0] * y[2]), -m.number(K_SQUARED) * y[0] * y[1]

    def known_state(self, t: Any) -> Sequence[Any]:
        return [mp.ellipfun(kind, t, m=MPMATH.number(K_SQUARED)) for kind in ("sn", "cn", "dn")]

    def invariant(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """C = y1^2 + y2^2."""
        return y[0] * y[0] + y[1] * y[1]

    def ellipse(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """I = 0.51 y1^2 + y3^2."""
        return m.number(K_SQUARED) * y[0] * y[0] + y[2] * y[2]


K_SQUARED = Fraction("0.51")
