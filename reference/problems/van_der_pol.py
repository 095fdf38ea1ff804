"""Van der Pol's oscillator: it excites itself, and ends in a limit cycle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from reference.declaration import StateSpace
from reference.flow_families import flow_family
from reference.flow_problem import FlowProblem

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.arithmetic.protocols import Arithmetic

__all__ = ["FAMILY", "VanDerPol"]


class VanDerPol(FlowProblem):
    """x'' = mu (1 - x^2) x' - x, from x = 2 and x' = 0.

    B. van der Pol, Philosophical Magazine 2 (1926), 978, equation (8); the start is that of E. Hairer, S. P. Norsett
    and G. Wanner, Solving Ordinary Differential Equations I, Springer 1993, and II, Springer 1996.
    """

    name = "van-der-pol"
    space = StateSpace(
        positions=("x",), velocities=("v",), angles=(), odd=None, along=None, scale="largest", independent=""
    )
    numbers: ClassVar[dict[str, str]] = {"mu": "1"}
    begins = ("2", "0")
    equation = "x'' = mu (1 - x^2) x' - x"
    invariants = ()
    t_end = 50.0
    variants = ({"mu": "5"},)
    source = "B. van der Pol, Philosophical Magazine 2 (1926), 978"
    difficulty = "average: smooth, with a limit cycle; the larger mu, the stiffer"
    meanings: ClassVar[dict[str, str]] = {
        "mu": "strength of the nonlinear damping",
        "x": "displacement",
        "v": "velocity",
    }

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        del m, t
        x, v = y
        return v, p["mu"] * (1 - x * x) * v - x


FAMILY = flow_family(VanDerPol, "van der Pol's oscillator")
