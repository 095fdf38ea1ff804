"""Toda's lattice of three particles in a ring: integrable, with springs of exponential force."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from reference.declaration import Invariant, StateSpace
from reference.flow_families import flow_family
from reference.flow_problem import HamiltonianFlow

if TYPE_CHECKING:
    from collections.abc import Sequence


__all__ = ["FAMILY", "Toda"]


class Toda(HamiltonianFlow):
    """H = sum p_k^2/2 + exp(q_k - q_(k+1)) over k = 1, 2, 3, with q_4 = q_1.

    M. Toda, Journal of the Physical Society of Japan 22 (1967), 431; the invariants are those of M. Henon, Physical
    Review B 9 (1974), 1921.  The start q = (1, 2, -1), p = (-1.5, 1, 0.5) is that of E. Hairer, C. Lubich and G.
    Wanner, Geometric Numerical Integration, Springer 2006, section X.1.
    """

    name = "toda"
    space = StateSpace(
        positions=("q1", "q2", "q3"),
        momenta=("p1", "p2", "p3"),
        angles=(),
        odd=("p1", "p2", "p3"),
        along=None,
        scale="units",
        independent="",
    )
    numbers: ClassVar[dict[str, str]] = {}
    begins = ("1", "2", "-1", "-1.5", "1", "0.5")
    equation = "H = (p1^2 + p2^2 + p3^2)/2 + exp(q1 - q2) + exp(q2 - q3) + exp(q3 - q1)"
    invariants = (
        Invariant("energy", ("Energy", "(E - E0)/E0"), "start"),
        Invariant("momentum", ("Momentum", "(P - P0)/K0"), "kinetic", "momentum"),
        Invariant("third invariant", ("Third invariant", "(I - I0)/I0"), "start", "third"),
    )
    t_end = 20.0
    source = "E. Hairer, C. Lubich and G. Wanner, Geometric Numerical Integration, 2006, section X.1"
    difficulty = "average: smooth and integrable, with forces that grow exponentially"
    meanings: ClassVar[dict[str, str]] = {
        **{f"q{k}": f"position of particle {k}" for k in (1, 2, 3)},
        **{f"p{k}": f"momentum of particle {k}" for k in (1, 2, 3)},
    }

    @staticmethod
    def _springs(m: Any, q: Sequence[Any]) -> tuple[Any, Any, Any]:
        """exp(q_k - q_(k+1))."""
        q1, q2, q3 = q
        return m.exp(q1 - q2), m.exp(q2 - q3), m.exp(q3 - q1)

    def hamiltonian(self, m: Any, t: Any, q: Sequence[Any], p: Sequence[Any], c: dict[str, Any]) -> Any:
        del t, c
        p1, p2, p3 = p
        s1, s2, s3 = self._springs(m, q)
        return (p1 * p1 + p2 * p2 + p3 * p3) / 2 + s1 + s2 + s3

    def derivative(self, m: Any, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        del t, p
        s1, s2, s3 = self._springs(m, y[:3])
        return *y[3:], s3 - s1, s1 - s2, s2 - s3

    def momentum(self, m: Any, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """The total momentum."""
        del m, p
        return y[3] + y[4] + y[5]

    def third(self, m: Any, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """Henon's third invariant, p1 p2 p3 - p1 exp(q2 - q3) - p2 exp(q3 - q1) - p3 exp(q1 - q2)."""
        del p
        p1, p2, p3 = y[3:]
        s1, s2, s3 = self._springs(m, y[:3])
        return p1 * p2 * p3 - p1 * s2 - p2 * s3 - p3 * s1


FAMILY = flow_family(Toda, "Toda's lattice of three particles", varied="p1")
