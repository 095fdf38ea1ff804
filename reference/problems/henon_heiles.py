"""Henon and Heiles' oscillator, a star in the meridian plane of a galaxy: ordered at low energies, else chaotic."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from reference.declaration import Invariant, StateSpace
from reference.flow_families import flow_family
from reference.flow_problem import HamiltonianFlow

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.arithmetic.protocols import Arithmetic

__all__ = ["FAMILY", "HenonHeiles"]


class HenonHeiles(HamiltonianFlow):
    """H = (px^2 + py^2 + x^2 + y^2)/2 + x^2 y - y^3/3 from x = 0, py = 0, y = 0.1, px = sqrt(2 E - y^2 + 2 y^3/3).

    M. Henon and C. Heiles, The Astronomical Journal 69 (1964), 73, equation (11) and figures 4 to 6: E = 1/12 is
    ordered, 1/8 mixed and 1/6 chaotic.
    """

    name = "henon-heiles"
    space = StateSpace(
        positions=("x", "y"),
        momenta=("px", "py"),
        angles=(),
        odd=("px", "py"),
        along=None,
        scale="units",
        independent="",
    )
    numbers: ClassVar[dict[str, str]] = {"energy": "1/8"}
    begins = ("0", "0.1", "sqrt(2*energy - 0.1**2 + 2*0.1**3/3)", "0")
    equation = "H = (px^2 + py^2 + x^2 + y^2)/2 + x^2 y - y^3/3"
    invariants = (Invariant("energy", ("Energy", "(E - E0)/E0"), "start"),)
    t_end = 100.0
    variants = ({"energy": "1/12"}, {"energy": "1/6"})
    crossings = 32
    source = "M. Henon and C. Heiles, The Astronomical Journal 69 (1964), 73"
    difficulty = "average: smooth, and chaotic from E = 1/9 on, where errors grow exponentially"
    meanings: ClassVar[dict[str, str]] = {
        "energy": "energy of the start",
        "x": "first position",
        "y": "second position",
        "px": "first momentum",
        "py": "second momentum",
    }

    event_words = "passages through y = 0"

    def event(self, m: Arithmetic, y: Sequence[Any]) -> Any:
        """y."""
        del m
        return y[1]

    def hamiltonian(self, m: Arithmetic, t: Any, q: Sequence[Any], p: Sequence[Any], c: dict[str, Any]) -> Any:
        del m, t, c
        (x, y), (px, py) = q, p
        return (px * px + py * py + x * x + y * y) / 2 + x * x * y - y * y * y / 3


FAMILY = flow_family(HenonHeiles, "Henon and Heiles' oscillator")
