"""Rosenbrock methods, each as printed in its source: linear systems with the Jacobian in the place of iterations.

Those of Hairer and Wanner and of Steinebach are published as decimals: the coefficients are the zero of the order
conditions, of the method and of its embedded weights, beside them.
"""

from __future__ import annotations

from typing import Any

from compare.methods.explicit import line, lines
from compare.methods.kinds.one_step import Embedded
from compare.methods.kinds.rosenbrock import Rosenbrock, from_slopes
from compare.methods.order.algebraic import Q, root

__all__ = ["RODAS3", "ROS3P", "ROSENBROCK", "ROSENBROCK23"]

ROOT2, ROOT3 = root(2), root(3)
G: Any = 1 / (2 + ROOT2)
E: Any = 6 + ROOT2

ROSENBROCK23 = from_slopes(
    name="rosenbrock23", order=2, source="Shampine and Reichelt 1997, SIAM J. Sci. Comput. 18, 1",
    alpha=lines("", "1/2", "0 1"),
    gammas=((G,), (-G, G), ((E - 2) * G, -E * G, G)),
    b=line("0 1 0"),
    embedded=(Embedded(3, line("1/6 2/3 1/6")),),
    aliases=("ode23s",),
)  # fmt: skip

G = (3 + ROOT3) / 6

ROS3P = from_slopes(
    name="ros3p", order=3, source="Lang and Verwer 2001, BIT 41, 731",
    alpha=lines("", "1", "1 0"),
    gammas=((G,), (Q(-1), G), (-G, Q(1, 2) - 2 * G, G)),
    b=line("2/3 0 1/3"),
    embedded=(Embedded(2, line("1/3 1/3 1/3")),),
)  # fmt: skip

RODAS3 = Rosenbrock(
    name="rodas3", order=3, source="Sandu, Verwer and others 1997, Atmos. Environ. 31, 3459",
    gamma=Q(1, 2),
    a=lines("", "0", "2 0", "2 0 1"),
    c=lines("", "4", "1 -1", "1 -1 -8/3"),
    m=line("2 0 1 1"),
    embedded=(Embedded(2, line("2 0 1 0")),),
)  # fmt: skip

ROSENBROCK = (ROSENBROCK23, ROS3P, RODAS3)
