"""Explicit one-step methods, each as printed in its source.

Tables as they are printed: lines of fractions.
"""

from compare.methods.kinds.one_step import Tableau
from compare.methods.order.algebraic import Q

__all__ = [
    "BUTCHER6",
    "EULER",
    "EXPLICIT",
    "HEUN",
    "KUTTA3",
    "MIDPOINT",
    "RALSTON",
    "RK4",
    "RK4_MISPRINTED",
    "SSPRK3",
    "THREE_EIGHTHS",
    "line",
    "lines",
]


def line(text: str) -> tuple[Q, ...]:
    """The fractions of one line, such as "3/40 9/40"."""
    return tuple(Q(word) for word in text.split())


def lines(*texts: str) -> tuple[tuple[Q, ...], ...]:
    """The rows of a matrix, a line each; the first row of an explicit method is empty."""
    return tuple(line(text) for text in texts)


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

RALSTON = Tableau(
    name="ralston", order=2, source="Ralston 1962, Math. Comp. 16, 431",
    a=((), (Q(2, 3),)),
    b=(Q(1, 4), Q(3, 4)),
    aliases=("ralston2",),
)  # fmt: skip

KUTTA3 = Tableau(
    name="kutta3", order=3, source="Kutta 1901, Z. Math. Phys. 46, 435",
    a=((), (Q(1, 2),), (Q(-1), Q(2))),
    b=(Q(1, 6), Q(2, 3), Q(1, 6)),
    aliases=("rk3",),
)  # fmt: skip

SSPRK3 = Tableau(
    name="ssprk3", order=3, source="Shu and Osher 1988, J. Comput. Phys. 77, 439",
    a=((), (Q(1),), (Q(1, 4), Q(1, 4))),
    b=(Q(1, 6), Q(1, 6), Q(2, 3)),
    aliases=("ssprk33", "shu_osher3", "tvd_rk3"),
)  # fmt: skip

RK4 = Tableau(
    name="rk4", order=4, source="Kutta 1901, Z. Math. Phys. 46, 435",
    a=((), (Q(1, 2),), (Q(0), Q(1, 2)), (Q(0), Q(0), Q(1))),
    b=(Q(1, 6), Q(1, 3), Q(1, 3), Q(1, 6)),
    aliases=("classical_rk4", "runge_kutta_4", "kutta4"),
)  # fmt: skip

THREE_EIGHTHS = Tableau(
    name="three_eighths", order=4, source="Kutta 1901, Z. Math. Phys. 46, 435",
    a=lines("", "1/3", "-1/3 1", "1 -1 1"),
    b=line("1/8 3/8 3/8 1/8"),
    aliases=("rk4_38", "kutta38"),
)  # fmt: skip

BUTCHER6 = Tableau(
    name="butcher6", order=6, source="Butcher 1964, J. Austral. Math. Soc. 4, 179",
    a=lines(
        "",
        "1/3",
        "0     2/3",
        "1/12  1/3   -1/12",
        "-1/16 9/8   -3/16 -3/8",
        "0     9/8   -3/8  -3/4  1/2",
        "9/44  -9/11 63/44 18/11 0  -16/11",
    ),
    b=line("11/120 0 27/40 27/40 -4/15 -4/15 11/120"),
)  # fmt: skip

RK4_MISPRINTED = Tableau(
    name="rk4_misprinted", order=1,
    source="Šalinović 2022, undergraduate thesis, University of Split, section 3.1: k1 h, k2 h for k1 h/2, k2 h/2",
    a=((), (Q(1),), (Q(0), Q(1)), (Q(0), Q(0), Q(1))),
    b=(Q(1, 6), Q(1, 3), Q(1, 3), Q(1, 6)),
    nodes=(Q(0), Q(1, 2), Q(1, 2), Q(1)),
)  # fmt: skip

EXPLICIT = (
    EULER, MIDPOINT, HEUN, RALSTON, KUTTA3, SSPRK3, RK4, THREE_EIGHTHS, BUTCHER6, RK4_MISPRINTED,
)  # fmt: skip
