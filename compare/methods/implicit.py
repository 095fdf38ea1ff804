"""Implicit Runge-Kutta methods, each as printed in its source."""

from compare.algebraic import Q
from compare.method import Tableau

__all__ = ["IMPLICIT", "IMPLICIT_MIDPOINT"]

IMPLICIT_MIDPOINT = Tableau(
    name="implicit_midpoint", order=2, source="Butcher 1964, Math. Comp. 18, 50",
    a=((Q(1, 2),),),
    b=(Q(1),),
    family="implicit",
    aliases=("gauss2", "gauss_legendre_2"),
    symplectic=True,
)  # fmt: skip

IMPLICIT = (IMPLICIT_MIDPOINT,)
