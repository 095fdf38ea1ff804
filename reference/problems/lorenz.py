"""Lorenz' three modes of convection: the best known chaotic attractor."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from reference.declaration import StateSpace
from reference.flow_families import flow_family
from reference.flow_problem import FlowProblem

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.arithmetic.protocols import Arithmetic

__all__ = ["FAMILY", "Lorenz"]


class Lorenz(FlowProblem):
    """x' = sigma (y - x), y' = x (rho - z) - y, z' = x y - beta z, with sigma = 10, rho = 28 and beta = 8/3.

    E. N. Lorenz, Journal of the Atmospheric Sciences 20 (1963), 130, equations (25) to (27); his r is rho and his b is
    beta.  The start (0, 1, 0) is that of his numerical integration, near the state without convection; the start
    (1, 1, 1) of many programs is not his.
    """

    name = "lorenz"
    space = StateSpace(positions=("x", "y", "z"), angles=(), odd=None, along=None, scale="largest", independent="")
    numbers: ClassVar[dict[str, str]] = {"sigma": "10", "rho": "28", "beta": "8/3"}
    begins = ("0", "1", "0")
    equation = "x' = sigma (y - x), y' = x (rho - z) - y, z' = x y - beta z"
    invariants = ()
    t_end = 20.0
    until = "50"
    source = "E. N. Lorenz, Journal of the Atmospheric Sciences 20 (1963), 130"
    difficulty = "higher: chaotic, errors grow by e^0.906 in a unit of time"
    meanings: ClassVar[dict[str, str]] = {
        "sigma": "Prandtl number",
        "rho": "Rayleigh number over its critical value",
        "beta": "aspect of the convection cells",
        "x": "intensity of the convection",
        "y": "temperature difference of the currents",
        "z": "distortion of the temperature profile",
    }

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        del m, t
        x, y_, z = y
        return p["sigma"] * (y_ - x), x * (p["rho"] - z) - y_, x * y_ - p["beta"] * z


FAMILY = flow_family(Lorenz, "Lorenz' equations of 1963", varied="rho")
