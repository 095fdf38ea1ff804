"""Predators and their prey, of Lotka and Volterra: closed orbits about a point of rest."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from reference.declaration import Invariant, StateSpace
from reference.flow_families import flow_family
from reference.flow_problem import FlowProblem

if TYPE_CHECKING:
    from collections.abc import Sequence


__all__ = ["FAMILY", "LotkaVolterra"]


class LotkaVolterra(FlowProblem):
    """u' = u (v - alpha), v' = v (beta - u), with alpha = 2 and beta = 1, from u = 4 and v = 2.

    E. Hairer, C. Lubich and G. Wanner, Geometric Numerical Integration, Springer 2006, section I.1.1; the start is one
    of two of its symplectic Euler method in figure 1.2.  Equations of A. J. Lotka 1925 and V. Volterra 1927.
    """

    name = "lotka-volterra"
    space = StateSpace(positions=("u", "v"), angles=(), odd=None, along=None, scale="units", independent="")
    numbers: ClassVar[dict[str, str]] = {"alpha": "2", "beta": "1"}
    begins = ("4", "2")
    equation = "u' = u (v - alpha), v' = v (beta - u)"
    invariants = (Invariant("invariant", ("Invariant", "(I - I0)/I0"), "start"),)
    t_end = 20.0
    source = "E. Hairer, C. Lubich and G. Wanner, Geometric Numerical Integration, 2006, section I.1.1"
    difficulty = "lower: smooth and periodic, one closed orbit"
    meanings: ClassVar[dict[str, str]] = {
        "alpha": "number of prey at the point of rest",
        "beta": "number of predators at the point of rest",
        "u": "number of predators",
        "v": "number of prey",
    }

    def derivative(self, m: Any, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        del m, t
        u, v = y
        return u * (v - p["alpha"]), v * (p["beta"] - u)

    def invariant(self, m: Any, y: Sequence[Any], p: dict[str, Any]) -> Any:
        """I = beta log u - u + alpha log v - v."""
        u, v = y
        return p["beta"] * m.log(u) - u + p["alpha"] * m.log(v) - v


FAMILY = flow_family(LotkaVolterra, "Lotka and Volterra's predators and prey", varied="u")
