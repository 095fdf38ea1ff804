"""Explicit one-step methods, each as printed in its source."""

from compare.algebraic import Q
from compare.method import Tableau

__all__ = ["EULER", "EXPLICIT", "HEUN", "MIDPOINT", "RK4"]

EULER = Tableau(
    name="euler", order=1, source="Euler 1768, Institutionum calculi integralis I, ch. 7",
    a=((),),
    b=(Q(1),),
    aliases=("explicit_euler", "forward_euler"),
)  # fmt: skip

MIDPOINT = Tableau(
    name="midpoint", order=2, source="Runge 1895, Math. Ann. 46, 167",
    a=((), (Q(1, 2),)),
    b=(Q(0), Q(1)),
    aliases=("explicit_midpoint", "modified_euler", "rk2"),
)  # fmt: skip

HEUN = Tableau(
    name="heun", order=2, source="Heun 1900, Z. Math. Phys. 45, 23",
    a=((), (Q(1),)),
    b=(Q(1, 2), Q(1, 2)),
    aliases=("heun2", "explicit_trapezoid", "improved_euler"),
)  # fmt: skip

RK4 = Tableau(
    name="rk4", order=4, source="Kutta 1901, Z. Math. Phys. 46, 435",
    a=((), (Q(1, 2),), (Q(0), Q(1, 2)), (Q(0), Q(0), Q(1))),
    b=(Q(1, 6), Q(1, 3), Q(1, 3), Q(1, 6)),
    aliases=("classical_rk4", "runge_kutta_4", "kutta4"),
)  # fmt: skip

EXPLICIT = (EULER, MIDPOINT, HEUN, RK4)
