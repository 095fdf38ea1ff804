"""The Brusselator: a chemical reaction that oscillates by itself."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from reference.declaration import StateSpace
from reference.flow_families import flow_family
from reference.flow_problem import FlowProblem

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.arithmetic.protocols import Arithmetic

__all__ = ["FAMILY", "Brusselator"]


class Brusselator(FlowProblem):
    """u' = A + u^2 v - (B + 1) u, v' = B u - u^2 v, with A = 1 and B = 3, from u = 1.5 and v = 3.

    R. Lefever and G. Nicolis, Journal of Theoretical Biology 30 (1971), 267; numbers and start are those of E. Hairer,
    S. P. Norsett and G. Wanner, Solving Ordinary Differential Equations I, Springer 1993, sections I.16 and II.4.  For
    B > A^2 + 1 the point of rest (A, B/A) is unstable, and a limit cycle surrounds it.
    """

    name = "brusselator"
    space = StateSpace(positions=("u", "v"), angles=(), odd=None, along=None, scale="largest", independent="")
    numbers: ClassVar[dict[str, str]] = {"a": "1", "b": "3"}
    begins = ("1.5", "3")
    equation = "u' = a + u^2 v - (b + 1) u, v' = b u - u^2 v"
    invariants = ()
    t_end = 20.0
    source = "E. Hairer, S. P. Norsett and G. Wanner, Solving Ordinary Differential Equations I, 1993, section II.4"
    difficulty = "average: smooth, with a limit cycle of slow and fast parts"
    meanings: ClassVar[dict[str, str]] = {
        "a": "concentration of the first substance supplied",
        "b": "concentration of the second substance supplied",
        "u": "first concentration",
        "v": "second concentration",
    }

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        del m, t
        u, v = y
        turned = u * u * v
        return p["a"] + turned - (p["b"] + 1) * u, p["b"] * u - turned


FAMILY = flow_family(Brusselator, "the Brusselator", varied="b")
