"""Diagonally implicit Runge-Kutta methods, each as its source has it: SDIRK, and ESDIRK with a first stage at y.

Their stages are solved one after another.  Coefficients that are published as roundings, in fractions or decimals, are
the zero of the order conditions and of the simplifying assumptions that the source states, beside what it prints.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.methods.explicit import line, lines
from compare.methods.kinds.one_step import Embedded, Tableau
from compare.methods.order.algebraic import Q, root, root_of
from compare.methods.order.refined import refined

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.methods.order.algebraic import Coefficient

__all__ = [
    "ALEXANDER2",
    "ALEXANDER3",
    "CROUZEIX3",
    "CROUZEIX4",
    "DIAGONALLY_IMPLICIT",
    "HAIRER_WANNER43",
    "KENCARP32",
    "KENCARP43",
    "KENCARP54",
    "KVAERNO32",
    "KVAERNO43",
    "KVAERNO54",
    "TR_BDF2",
]

FAMILY = "diagonally implicit"
ALEXANDER = "Alexander 1977, SIAM J. Numer. Anal. 14, 1006"
CROUZEIX = "Crouzeix 1975, thesis, Univ. Paris VI"
KENNEDY = "Kennedy and Carpenter 2003, Appl. Numer. Math. 44, 139"
KVAERNO = "Kværnø 2004, BIT 44, 489"

ROOT2, ROOT3 = root(2), root(3)
G: Any = (2 - ROOT2) / 2

ALEXANDER2 = Tableau(
    name="alexander2", order=2, source=ALEXANDER,
    a=((G, Q(0)), (1 - G, G)),
    b=(1 - G, G),
    family=FAMILY,
    aliases=("sdirk2",),
)  # fmt: skip

TR_BDF2 = Tableau(
    name="tr_bdf2", order=2,
    source="Bank 1985, IEEE Trans. Comput.-Aided Des. 4, 436; Hosea and Shampine 1996, Appl. Numer. Math. 20, 21",
    a=((Q(0), Q(0), Q(0)), (G, G, Q(0)), (ROOT2 / 4, ROOT2 / 4, G)),
    b=(ROOT2 / 4, ROOT2 / 4, G),
    embedded=(Embedded(3, ((4 - ROOT2) / 12, (4 + 3 * ROOT2) / 12, G / 3)),),
    family=FAMILY,
)  # fmt: skip

G = (3 + ROOT3) / 6

CROUZEIX3 = Tableau(
    name="crouzeix3", order=3, source=CROUZEIX,
    a=((G, Q(0)), (1 - 2 * G, G)),
    b=line("1/2 1/2"),
    family=FAMILY,
    aliases=("norsett3",),
)  # fmt: skip

G = root_of((-1, 12, -36, 24), 1.0685790)
"""1/2 + cos(pi/18)/sqrt(3)."""
D: Any = 1 / (6 * (2 * G - 1) * (2 * G - 1))

CROUZEIX4 = Tableau(
    name="crouzeix4", order=4, source=CROUZEIX,
    a=((G, Q(0), Q(0)), (Q(1, 2) - G, G, Q(0)), (2 * G, 1 - 4 * G, G)),
    b=(D, 1 - 2 * D, D),
    family=FAMILY,
    aliases=("norsett4",),
)  # fmt: skip

G = root_of((-1, 9, -18, 6), 0.4358665)
"""The step of L-stable methods of order 3: a zero of x^3 - 3 x^2 + 3 x/2 - 1/6."""

ALEXANDER3 = Tableau(
    name="alexander3", order=3, source=ALEXANDER,
    a=(
        (G, Q(0), Q(0)),
        ((1 - G) / 2, G, Q(0)),
        ((-6 * G * G + 16 * G - 1) / 4, (6 * G * G - 20 * G + 5) / 4, G),
    ),
    b=((-6 * G * G + 16 * G - 1) / 4, (6 * G * G - 20 * G + 5) / 4, G),
    family=FAMILY,
    aliases=("sdirk3",),
)  # fmt: skip

HAIRER_WANNER43 = Tableau(
    name="hairer_wanner43", order=4,
    source="Hairer and Wanner 1996, Solving Ordinary Differential Equations II, table IV.6.5",
    a=lines(
        "1/4       0         0      0      0",
        "1/2       1/4       0      0      0",
        "17/50     -1/25     1/4    0      0",
        "371/1360  -137/2720 15/544 1/4    0",
        "25/24     -49/48    125/16 -85/12 1/4",
    ),
    b=line("25/24 -49/48 125/16 -85/12 1/4"),
    embedded=(Embedded(3, line("59/48 -17/96 225/32 -85/12 0")),),
    family=FAMILY,
    aliases=("sdirk4",),
)  # fmt: skip

ROW3: Any = ((-4 * G * G + 6 * G - 1) / (4 * G), (1 - 2 * G) / (4 * G), G)
ROW4: Any = ((6 * G - 1) / (12 * G), -1 / (12 * G * (2 * G - 1)), (-6 * G * G + 6 * G - 1) / (6 * G - 3), G)

KVAERNO32 = Tableau(
    name="kvaerno32", order=3, source=KVAERNO,
    a=((Q(0),) * 4, (G, G, Q(0), Q(0)), (*ROW3, Q(0)), ROW4),
    b=ROW4,
    embedded=(Embedded(2, (*ROW3, Q(0))),),
    family=FAMILY,
    aliases=("kvaerno3",),
)  # fmt: skip


def _ark32() -> Tableau:
    """c = 0, 2 gamma, 3/5, 1 and stage order 2; two of the embedded weights as printed, the others by its order."""
    c2, c3 = 2 * G, Q(3, 5)
    a32: Any = c3 * (c3 - c2) / (2 * c2)
    third = (c3 - a32 - G, a32, G, Q(0))
    b3: Any = (Q(1, 3) - G - c2 * (Q(1, 2) - G)) / (c3 * (c3 - c2))
    b2: Any = (Q(1, 2) - G - b3 * c3) / c2
    b = (1 - b2 - b3 - G, b2, b3, G)
    e3, e4 = Q("9247589265047/10645013368117"), Q("2193209047091/5459859503100")
    e2: Any = (Q(1, 2) - e4 - e3 * c3) / c2
    return Tableau(
        name="kencarp32", order=3, source=f"{KENNEDY}, ARK3(2)4L[2]SA, implicit",
        a=((Q(0),) * 4, (G, G, Q(0), Q(0)), third, b),
        b=b,
        embedded=(Embedded(2, (1 - e2 - e3 - e4, e2, e3, e4)),),
        family=FAMILY,
        aliases=("kencarp3", "ark324l2sa_esdirk"),
    )  # fmt: skip


KENCARP32 = _ark32()

KENCARP43 = Tableau(
    name="kencarp43", order=4, source=f"{KENNEDY}, ARK4(3)6L[2]SA, implicit",
    a=lines(
        "0                        0                   0                   0               0          0",
        "1/4                      1/4                 0                   0               0          0",
        "8611/62500               -1743/31250         1/4                 0               0          0",
        "5012029/34652500         -654441/2922500     174375/388108       1/4             0          0",
        "15267082809/155376265600 -71443401/120774400 730878875/902184768 2285395/8070912 1/4        0",
        "82889/524892             0                   15625/83664         69875/102672    -2260/8211 1/4",
    ),
    b=line("82889/524892 0 15625/83664 69875/102672 -2260/8211 1/4"),
    embedded=(
        Embedded(3, line(
            "4586570599/29645900160 0 178811875/945068544 814220225/1159782912 -3700637/11593932 61727/225920"
        )),
    ),
    family=FAMILY,
    aliases=("kencarp4", "ark436l2sa_esdirk"),
)  # fmt: skip

G = root_of((1, -16, 72, -96, 24), 0.5728161)
"""The step of L-stable methods of order 4 with four implicit stages."""


def _kvaerno43() -> Tableau:
    """The pair that advances with the method of order 4, whose gamma makes that one L-stable."""
    g2 = G * G
    g3, u, v, w = g2 * G, 12 * g2 - 6 * G + 1, 12 * g2 - 9 * G + 2, 3 * G - 1
    g4: Any = g2 * g2
    third = (
        (144 * g4 - 180 * g3 + 81 * g2 - 15 * G + 1) * G / (u * u),
        (-36 * g3 + 39 * g2 - 15 * G + 2) * G / (u * u),
        G, Q(0), Q(0),
    )  # fmt: skip
    fourth = (
        (-144 * g4 * G + 396 * g4 - 330 * g3 + 117 * g2 - 18 * G + 1) / (12 * g2 * v),
        (72 * g4 - 126 * g3 + 69 * g2 - 15 * G + 1) / (12 * g2 * w),
        (-6 * g2 + 6 * G - 1) * u * u / (12 * g2 * v * w),
        G, Q(0),
    )  # fmt: skip
    b = (
        (288 * g4 - 312 * g3 + 120 * g2 - 18 * G + 1) / (48 * g2 * v),
        (24 * g2 - 12 * G + 1) / (48 * g2 * w),
        -u * u * u / (48 * g2 * w * v * (6 * g2 - 6 * G + 1)),
        (-24 * g3 + 36 * g2 - 12 * G + 1) / (24 * g2 - 24 * G + 4),
        G,
    )  # fmt: skip
    return Tableau(
        name="kvaerno43", order=4, source=KVAERNO,
        a=((Q(0),) * 5, (G, G, Q(0), Q(0), Q(0)), third, fourth, b),
        b=b,
        embedded=(Embedded(3, fourth),),
        family=FAMILY,
        aliases=("kvaerno4",),
    )  # fmt: skip


KVAERNO43 = _kvaerno43()


def _moments(weights: Sequence[Any], nodes: Sequence[Any], end: Any, exponents: range) -> list[Any]:
    """sum_j w_j c_j^k (k + 1) - end^(k + 1) for each k: what a quadrature up to ``end`` misses."""
    found, powers, total = [], list(nodes), end * end
    for k in range(1, exponents.stop):
        if k in exponents:
            first, *others = (weight * power for weight, power in zip(weights, powers, strict=True))
            found.append(sum(others, first) * (k + 1) - total)
        powers, total = [power * node for power, node in zip(powers, nodes, strict=True)], total * end
    return found


def _column(b: Sequence[Any], rows: Sequence[Sequence[Any]], place: int) -> Any:
    """sum_i b_i a_ij for one j, over the rows that reach so far."""
    first, *others = (weight * row[place] for weight, row in zip(b, rows, strict=True) if len(row) > place)
    return sum(others, first)


def _limit(rows: Sequence[Sequence[Any]]) -> Any:
    """R(z) at infinity, of which an explicit first stage and the last row for weights make -u_s with A u = a_1.

    A is the matrix without the first stage, a_1 its column.
    """
    found: list[Any] = []
    for row in rows[1:]:
        rest = row[0]
        for entry, value in zip(row[1:-1], found, strict=True):
            rest = rest - entry * value
        found.append(rest / row[-1])
    return found[-1]


def _conditions(rows: Sequence[Sequence[Any]], last: int, fifth: int) -> list[Any]:
    """Stage order 3 from the third stage on; order 5 of the last row, and L-stability.

    Args:
        rows: of the matrix, each up to its diagonal, the last of them the weights.
        last: how many rows are left out at the end, whose quadrature is conditioned elsewhere.
        fifth: the column on which the last row must not depend.
    """
    nodes = [rows[0][0] * 0, *(sum(row[1:], row[0]) for row in rows[1:])]
    stages = [
        value
        for i, row in enumerate(rows[3 : len(rows) - last], start=3)
        for value in _moments(row, nodes[: len(row)], nodes[i], range(1, 3))
    ]
    cubes = [node * node * node for node in nodes]
    inner = [sum((a * cube for a, cube in zip(row[1:], cubes[1:], strict=False)), row[0] * 0) for row in rows]
    first, *others = (weight * total for weight, total in zip(rows[-1], inner, strict=True))
    return [
        *_moments(rows[2], nodes[:3], nodes[2], range(1, 2)),
        *stages,
        *_moments(rows[-1], nodes, 1, range(1, 5)),
        sum(others, first) * 20 - 1,
        _column(rows[-1], rows, fifth),
        _limit(rows),
    ]


KVAERNO54_PRINTED = {
    "gamma": "0.26", "a31": "0.13", "a32": "0.84033320996790809",
    "a41": "0.22371961478320505", "a42": "0.47675532319799699", "a43": "-0.06470895363112615",
    "a51": "0.16648564323248321", "a52": "0.10450018841591720", "a53": "0.03631482272098715",
    "a54": "-0.13090704451073998",
    "a63": "-0.04245337201752043", "a64": "0.02446657898003141", "a65": "0.61943039072480676",
    "a73": "-0.05496908796538376", "a74": "-0.04118626728321046", "a75": "0.62993304899016403",
    "a76": "0.06962479448202728",
}  # fmt: skip
"""The first entries of rows 6 and 7 follow from their sums, which are 1, and the second are 0."""
KVAERNO54_KEPT = ("gamma", "a31")
"""The free parameters, taken as printed."""


def _kvaerno54_rows(values: Sequence[Any]) -> list[list[Any]]:
    """The rows up to their diagonals, in any arithmetic."""
    v = dict(zip(KVAERNO54_PRINTED, values, strict=True))
    g = v["gamma"]
    sixth, seventh = [v["a63"], v["a64"], v["a65"], g], [v["a73"], v["a74"], v["a75"], v["a76"], g]
    return [
        [g * 0],
        [g, g],
        [v["a31"], v["a32"], g],
        [v["a41"], v["a42"], v["a43"], g],
        [v["a51"], v["a52"], v["a53"], v["a54"], g],
        [1 - sum(sixth[1:], sixth[0]), g * 0, *sixth],
        [1 - sum(seventh[1:], seventh[0]), g * 0, *seventh],
    ]


def _kvaerno54_conditions(values: Sequence[Any]) -> list[Any]:
    """Those of the weights, and order 4 of the row before them."""
    rows = _kvaerno54_rows(values)
    nodes = [rows[0][0], *(sum(row[1:], row[0]) for row in rows[1:])]
    return [*_conditions(rows, 2, 1), *_moments(rows[5], nodes[:6], 1, range(1, 4))]


def _squared(rows: Sequence[Sequence[Any]], size: int) -> tuple[tuple[Coefficient, ...], ...]:
    return tuple((*row, *(Q(0),) * (size - len(row))) for row in rows)


def _kvaerno54() -> Tableau:
    kept = [list(KVAERNO54_PRINTED).index(name) for name in KVAERNO54_KEPT]
    values = refined("kvaerno54", _kvaerno54_conditions, tuple(KVAERNO54_PRINTED.values()), kept)
    a = _squared(_kvaerno54_rows(values), 7)
    return Tableau(
        name="kvaerno54", order=5, source=KVAERNO,
        a=a,
        b=a[-1],
        embedded=(Embedded(4, a[-2]),),
        family=FAMILY,
        aliases=("kvaerno5",),
    )  # fmt: skip


KVAERNO54 = _kvaerno54()

KENCARP54_PRINTED = {
    "gamma": "41/200", "c5": "23/25", "c6": "6/25", "c7": "3/5",
    "a31": "41/400", "a32": "-567603406766/11931857230679",
    "a41": "683785636431/9252920307686", "a43": "-110385047103/1367015193373",
    "a53": "30586259806659/12414158314087", "a54": "-22760509404356/11113319521817",
    "a63": "638256894668/5436446318841", "a64": "-1179710474555/5321154724896", "a65": "-60928119172/8023461067671",
    "a73": "25762820946817/25263940353407", "a74": "-2161375909145/9755907335909",
    "a75": "-211217309593/5846859502534", "a76": "-4269925059573/7827059040749",
    "b4": "22348218063261/9555858737531", "b5": "-1143369518992/8141816002931",
    "b6": "-39379526789629/19018526304540", "b7": "32727382324388/42900044865799",
    "e4": "78070527104295/32432590147079", "e5": "-548382580838/3424219808633",
    "e6": "-33438840321285/15594753105479", "e7": "3629800801594/4656183773603", "e8": "4035322873751/18575991585200",
}  # fmt: skip
"""The first entries from row 5 on follow from the nodes; e are the embedded weights."""
KENCARP54_KEPT = ("gamma", "c5", "c6", "c7", "a31", "e7", "e8")
"""The free parameters, taken as printed."""


def _kencarp54_rows(values: Sequence[Any]) -> tuple[list[list[Any]], list[Any]]:
    """The rows up to their diagonals and the embedded weights, in any arithmetic."""
    v = dict(zip(KENCARP54_PRINTED, values, strict=True))
    g = v["gamma"]
    nothing = g * 0

    def row(node: Any, *entries: Any) -> list[Any]:
        return [node - sum(entries[1:], entries[0]), nothing, *entries]

    rows = [
        [nothing],
        [g, g],
        [v["a31"], v["a32"], g],
        [v["a41"], nothing, v["a43"], g],
        row(v["c5"], v["a53"], v["a54"], g),
        row(v["c6"], v["a63"], v["a64"], v["a65"], g),
        row(v["c7"], v["a73"], v["a74"], v["a75"], v["a76"], g),
        row(1, nothing, v["b4"], v["b5"], v["b6"], v["b7"], g),
    ]
    return rows, row(1, nothing, v["e4"], v["e5"], v["e6"], v["e7"], v["e8"])


def _kencarp54_conditions(values: Sequence[Any]) -> list[Any]:
    """Those of the weights, and order 4 of the embedded ones."""
    rows, embedded = _kencarp54_rows(values)
    nodes = [rows[0][0], *(sum(row[1:], row[0]) for row in rows[1:])]
    return [*_conditions(rows, 1, 2), *_moments(embedded, nodes, 1, range(1, 4))]


def _kencarp54() -> Tableau:
    kept = [list(KENCARP54_PRINTED).index(name) for name in KENCARP54_KEPT]
    values = refined("kencarp54", _kencarp54_conditions, tuple(KENCARP54_PRINTED.values()), kept, slack=69)
    rows, embedded = _kencarp54_rows(values)
    a = _squared(rows, 8)
    return Tableau(
        name="kencarp54", order=5, source=f"{KENNEDY}, ARK5(4)8L[2]SA, implicit",
        a=a,
        b=a[-1],
        embedded=(Embedded(4, tuple(embedded)),),
        family=FAMILY,
        aliases=("kencarp5", "ark548l2sa_esdirk"),
    )  # fmt: skip


KENCARP54 = _kencarp54()

DIAGONALLY_IMPLICIT = (
    ALEXANDER2, TR_BDF2, CROUZEIX3, CROUZEIX4, ALEXANDER3, HAIRER_WANNER43, KVAERNO32, KVAERNO43, KVAERNO54, KENCARP32,
    KENCARP43, KENCARP54,
)  # fmt: skip
