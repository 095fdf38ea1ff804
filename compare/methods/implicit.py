"""Implicit Runge-Kutta methods, each as printed in its source."""

from compare.methods.explicit import line, lines
from compare.methods.kinds.one_step import Tableau
from compare.methods.kinds.partitioned import Partitioned
from compare.methods.order.algebraic import Q, root
from compare.methods.order.collocation import Collocation, legendre

__all__ = [
    "GAUSS4",
    "GAUSS6",
    "IMPLICIT",
    "IMPLICIT_EULER",
    "IMPLICIT_MIDPOINT",
    "LOBATTO_PAIR4",
    "RADAU3",
    "RADAU5",
    "TRAPEZOID",
]

FAMILY = "implicit"
ROOT3, ROOT6, ROOT15 = root(3), root(6), root(15)

IMPLICIT_EULER = Tableau(
    name="implicit_euler", order=1, source="Curtiss and Hirschfelder 1952, Proc. Natl. Acad. Sci. 38, 235",
    a=((Q(1),),),
    b=(Q(1),),
    family=FAMILY,
    aliases=("backward_euler", "bdf1", "radau_iia1"),
)  # fmt: skip

TRAPEZOID = Tableau(
    name="trapezoid", order=2, source="Crank and Nicolson 1947, Proc. Camb. Phil. Soc. 43, 50",
    a=lines("0 0", "1/2 1/2"),
    b=line("1/2 1/2"),
    family=FAMILY,
    aliases=("implicit_trapezoid", "crank_nicolson", "lobatto_iiia2"),
)  # fmt: skip

IMPLICIT_MIDPOINT = Tableau(
    name="implicit_midpoint", order=2, source="Butcher 1964, Math. Comp. 18, 50",
    a=((Q(1, 2),),),
    b=(Q(1),),
    family=FAMILY,
    aliases=("gauss2", "gauss_legendre_2"),
)  # fmt: skip

GAUSS4 = Tableau(
    name="gauss4", order=4, source="Butcher 1964, Math. Comp. 18, 50",
    a=(
        (Q(1, 4), Q(1, 4) - ROOT3 / 6),
        (Q(1, 4) + ROOT3 / 6, Q(1, 4)),
    ),
    b=(Q(1, 2), Q(1, 2)),
    family=FAMILY,
    aliases=("gauss_legendre_4", "hammer_hollingsworth4"),
)  # fmt: skip

GAUSS6 = Tableau(
    name="gauss6", order=6, source="Butcher 1964, Math. Comp. 18, 50",
    a=(
        (Q(5, 36), Q(2, 9) - ROOT15 / 15, Q(5, 36) - ROOT15 / 30),
        (Q(5, 36) + ROOT15 / 24, Q(2, 9), Q(5, 36) - ROOT15 / 24),
        (Q(5, 36) + ROOT15 / 30, Q(2, 9) + ROOT15 / 15, Q(5, 36)),
    ),
    b=line("5/18 4/9 5/18"),
    family=FAMILY,
    aliases=("gauss_legendre_6", "kuntzmann_butcher6"),
)  # fmt: skip

_A, _B = Collocation("gauss8", legendre(4)).table()

GAUSS8 = Tableau(
    name="gauss8", order=8, source="Butcher 1964, Math. Comp. 18, 50",
    a=_A,
    b=_B,
    family=FAMILY,
    aliases=("gauss_legendre_8", "kuntzmann_butcher8"),
)  # fmt: skip

_A, _B = Collocation("gauss10", legendre(5)).table()

GAUSS10 = Tableau(
    name="gauss10", order=10, source="Butcher 1964, Math. Comp. 18, 50",
    a=_A,
    b=_B,
    family=FAMILY,
    aliases=("gauss_legendre_10",),
)  # fmt: skip

_A, _B = Collocation("radau15", tuple(a + b for a, b in zip((*legendre(7), 0), legendre(8), strict=True))).table()

RADAU15 = Tableau(
    name="radau15", order=15,
    source="Everhart 1985, in Dynamics of Comets, IAU Coll. 83, 185; Rein and Spiegel 2015, MNRAS 446, 1424",
    a=_A,
    b=_B,
    family=FAMILY,
    aliases=("gauss_radau15", "ias15", "everhart15"),
    solved_by="fixed-point iteration",
)  # fmt: skip

RADAU3 = Tableau(
    name="radau3", order=3, source="Ehle 1969, Univ. of Waterloo, Dept. AACS, report CSRR 2010",
    a=lines("5/12 -1/12", "3/4 1/4"),
    b=line("3/4 1/4"),
    family=FAMILY,
    aliases=("radau_iia3",),
)  # fmt: skip

RADAU5 = Tableau(
    name="radau5", order=5, source="Ehle 1969, Univ. of Waterloo, Dept. AACS, report CSRR 2010",
    a=(
        ((88 - 7 * ROOT6) / 360, (296 - 169 * ROOT6) / 1800, (-2 + 3 * ROOT6) / 225),
        ((296 + 169 * ROOT6) / 1800, (88 + 7 * ROOT6) / 360, (-2 - 3 * ROOT6) / 225),
        ((16 - ROOT6) / 36, (16 + ROOT6) / 36, Q(1, 9)),
    ),
    b=((16 - ROOT6) / 36, (16 + ROOT6) / 36, Q(1, 9)),
    family=FAMILY,
    aliases=("radau_iia5",),
)  # fmt: skip

LOBATTO_PAIR4 = Partitioned(
    name="lobatto_pair4", order=4, source="Sun 1993, J. Comput. Math. 11, 365; Jay 1996, SIAM J. Numer. Anal. 33, 368",
    matrix=lines("0 0 0", "5/24 1/3 -1/24", "1/6 2/3 1/6"),
    hat=lines("1/6 -1/6 0", "1/6 1/3 0", "1/6 5/6 0"),
    b=line("1/6 2/3 1/6"),
    family=FAMILY,
    aliases=("lobatto_iiia_iiib4",),
)  # fmt: skip

IMPLICIT = (
    IMPLICIT_EULER, TRAPEZOID, IMPLICIT_MIDPOINT, GAUSS4, GAUSS6, GAUSS8, GAUSS10, RADAU3, RADAU5, RADAU15,
    LOBATTO_PAIR4,
)  # fmt: skip
