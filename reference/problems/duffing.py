"""Duffing's oscillator with a cubic force: free, and driven and damped."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from reference.arithmetic.precision import mp
from reference.declaration import Invariant, StateSpace
from reference.flow_families import flow_family
from reference.flow_problem import FlowProblem, HamiltonianFlow

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.arithmetic.protocols import Arithmetic

__all__ = ["FAMILIES", "Duffing", "DuffingDriven"]


class Duffing(HamiltonianFlow):
    """H = v^2/2 + alpha x^2/2 + beta x^4/4, that is x'' = -alpha x - beta x^3, from rest at x = 1.

    G. Duffing, Erzwungene Schwingungen bei veraenderlicher Eigenfrequenz, Vieweg 1918; I. Kovacic and M. J. Brennan,
    The Duffing Equation, Wiley 2011, section 2.3, who solve it by Jacobi's elliptic functions.
    """

    name = "duffing"
    space = StateSpace(
        positions=("x",), momenta=("v",), angles=(), odd=("v",), along=None, scale="largest", independent=""
    )
    numbers: ClassVar[dict[str, str]] = {"alpha": "1", "beta": "1"}
    begins = ("1", "0")
    equation = "x'' = -alpha x - beta x^3"
    invariants = (Invariant("energy", ("Energy", "(E - E0)/E0"), "start"),)
    t_end = 50.0
    source = "I. Kovacic and M. J. Brennan, The Duffing Equation, 2011, section 2.3"
    difficulty = "lower: smooth and periodic, one degree of freedom"
    meanings: ClassVar[dict[str, str]] = {
        "alpha": "stiffness",
        "beta": "cubic stiffness",
        "x": "displacement",
        "v": "velocity",
    }

    def hamiltonian(self, m: Arithmetic, t: Any, q: Sequence[Any], p: Sequence[Any], c: dict[str, Any]) -> Any:
        del m, t
        square = q[0] * q[0]
        return p[0] * p[0] / 2 + c["alpha"] * square / 2 + c["beta"] * (square * square) / 4

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        del m, t
        x, v = y
        return v, -(p["alpha"] * x) - p["beta"] * (x * x * x)

    def known_state(self, t: Any) -> Sequence[Any]:
        """x = cn(w t) with w^2 = 2 and the parameter 1/4."""
        w = mp.sqrt(2)
        cn, sn, dn = (mp.ellipfun(kind, w * t, m=mp.mpf(1) / 4) for kind in ("cn", "sn", "dn"))
        return cn, -w * sn * dn


class DuffingDriven(FlowProblem):
    """x'' = -delta x' - alpha x - beta x^3 + gamma cos(omega t).

    The numbers are those of Y. Ueda, Journal of Statistical Physics 20 (1979), 181, x'' + 0.05 x' + x^3 = 7.5 cos t,
    whose attractor is chaotic.  The start x = 3, x' = 4 is that of J. M. T. Thompson and H. B. Stewart, Nonlinear
    Dynamics and Chaos, Wiley 1986, chapter 1.
    """

    name = "duffing-driven"
    space = StateSpace(
        positions=("x",), velocities=("v",), angles=(), odd=None, along=None, scale="largest", independent=""
    )
    autonomous: ClassVar[bool] = False
    numbers: ClassVar[dict[str, str]] = {"gamma": "7.5", "delta": "0.05", "alpha": "0", "beta": "1", "omega": "1"}
    begins = ("3", "4")
    equation = "x'' = -delta x' - alpha x - beta x^3 + gamma cos(omega t)"
    invariants = ()
    t_end = 50.0
    source = "Y. Ueda, Journal of Statistical Physics 20 (1979), 181"
    difficulty = "higher: depends on the time, and chaotic, errors grow by e^0.1 in a unit of time"
    meanings: ClassVar[dict[str, str]] = {
        "gamma": "strength of the drive",
        "delta": "damping",
        "alpha": "stiffness",
        "beta": "cubic stiffness",
        "omega": "angular frequency of the drive",
        "x": "displacement",
        "v": "velocity",
    }

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        x, v = y
        force = p["gamma"] * m.cos(p["omega"] * t) - p["delta"] * v
        return v, force - p["alpha"] * x - p["beta"] * (x * x * x)


FAMILIES = (
    flow_family(Duffing, "Duffing's oscillator, free", varied="x"),
    flow_family(DuffingDriven, "Duffing's oscillator, driven and damped"),
)
