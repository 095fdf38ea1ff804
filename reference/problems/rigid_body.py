"""Euler's free rigid body, by its angular momentum in the body's frame."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from reference.arithmetic.namespaces import MPMATH
from reference.arithmetic.precision import mp
from reference.declaration import Invariant, StateSpace
from reference.flow_families import flow_family
from reference.flow_problem import FlowProblem

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.arithmetic.protocols import Arithmetic

__all__ = ["FAMILY", "RigidBody"]


class RigidBody(FlowProblem):
    """y1' = (1/I3 - 1/I2) y2 y3, y2' = (1/I1 - 1/I3) y3 y1, y3' = (1/I2 - 1/I1) y1 y2.

    I1 = 2, I2 = 1, I3 = 2/3 and the start (cos 1.1, 0, sin 1.1) are those of E. Hairer, C. Lubich and G. Wanner,
    Geometric Numerical Integration, Springer 2006, section IV.1.  Equations of L. Euler 1758; the solution is
    one of Jacobi's elliptic functions for each component (C. G. J. Jacobi 1850).
    """

    name = "rigid-body"
    space = StateSpace(
        positions=("y1", "y2", "y3"), angles=(), odd=("y1", "y2", "y3"), along=None, scale="units", independent=""
    )
    numbers: ClassVar[dict[str, str]] = {"i1": "2", "i2": "1", "i3": "2/3"}
    begins = ("cos(1.1)", "0", "sin(1.1)")
    equation = "y1' = (1/i3 - 1/i2) y2 y3, y2' = (1/i1 - 1/i3) y3 y1, y3' = (1/i2 - 1/i1) y1 y2"
    invariants = (
        Invariant("energy", ("Energy", "(E - E0)/E0"), "start"),
        Invariant("squared angular momentum", ("Squared angular momentum", "(C - C0)/C0"), "start", "casimir"),
    )
    t_end = 50.0
    source = "E. Hairer, C. Lubich and G. Wanner, Geometric Numerical Integration, 2006, section IV.1"
    difficulty = "lower: smooth and periodic, with two quadratic invariants"
    meanings: ClassVar[dict[str, str]] = {
        "i1": "first principal moment of inertia",
        "i2": "second principal moment of inertia",
        "i3": "third principal moment of inertia",
        "y1": "first component of the angular momentum",
        "y2": "second component of the angular momentum",
        "y3": "third component of the angular momentum",
    }

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        del m, t
        y1, y2, y3 = y
        a1, a2, a3 = (1 / p[name] for name in ("i1", "i2", "i3"))
        return (a3 - a2) * (y2 * y3), (a1 - a3) * (y3 * y1), (a2 - a1) * (y1 * y2)

    def known_state(self, t: Any) -> Sequence[Any]:
        """(a cn, b sn, c dn) of w t (L. D. Landau and E. M. Lifshitz, Mechanics, 1976, section 37)."""
        first, _, third = self.start_in(MPMATH)
        a1, a2, a3 = (1 / moment for moment in self.parameters_in(MPMATH).values())
        b1, b2, b3 = a3 - a2, a1 - a3, a2 - a1
        u, square = mp.sqrt(-b1 * b2) * third * t, b3 * first**2 / (b1 * third**2)
        cn, sn, dn = (mp.ellipfun(kind, u, m=square) for kind in ("cn", "sn", "dn"))
        return first * cn, -first * mp.sqrt(-b2 / b1) * sn, third * dn

    def invariant(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The kinetic energy."""
        del m
        y1, y2, y3 = y
        return (y1 * y1 / p["i1"] + y2 * y2 / p["i2"] + y3 * y3 / p["i3"]) / 2

    def casimir(self, m: Arithmetic, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The squared length of the angular momentum, a Casimir function."""
        del m, p
        y1, y2, y3 = y
        return y1 * y1 + y2 * y2 + y3 * y3


FAMILY = flow_family(RigidBody, "Euler's free rigid body")
