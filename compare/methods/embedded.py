"""Embedded pairs, each as printed in its source; with a fixed step they are explicit methods like any other.

The pairs of Tsitouras and of Calvo, Montijano and Randez, whose coefficients are published as decimals of 16 digits and
as fractions near to what they stand for, are the zeros of their order conditions beside what is printed.
"""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING, Any

from compare.methods.explicit import line, lines
from compare.methods.kinds.one_step import Embedded, Tableau
from compare.methods.order.algebraic import Q, root
from compare.methods.order.refined import refined
from compare.methods.order.rooted_trees import ElementaryWeights, density, trees

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.methods.order.algebraic import Coefficient
    from compare.methods.order.rooted_trees import Tree

__all__ = [
    "BOGACKI_SHAMPINE32",
    "BOGACKI_SHAMPINE54",
    "CALVO_MONTIJANO_RANDEZ65",
    "CASH_KARP54",
    "DOP853",
    "DORMAND_PRINCE54",
    "EMBEDDED",
    "FEHLBERG45",
    "FEHLBERG78",
    "TSITOURAS54",
]

PRINTED = {
    "c2": "0.161", "c3": "0.327", "c4": "0.9", "c5": "0.9800255409045097",
    "a32": "0.3354806554923570",
    "a42": "-6.359448489975075", "a43": "4.362295432869581",
    "a52": "-11.74888356406283", "a53": "7.495539342889836", "a54": "-0.09249506636175525",
    "a62": "-12.92096931784711", "a63": "8.159367898576159", "a64": "-0.07158497328140100",
    "a65": "-0.02826905039406838",
    "b2": "0.01", "b3": "0.4798896504144996", "b4": "1.379008574103742", "b5": "-3.290069515436081",
    "b6": "2.324710524099774",
    "e2": "0.000816434459657", "e3": "-0.007880878010262", "e4": "0.144711007173263", "e5": "-0.582357165452555",
    "e6": "0.458082105929187", "e7": "-1/66",
}  # fmt: skip
"""e = b less the embedded weights, which the source prints for those weights, with the last one's sign changed."""

KEPT = ("c2", "c3", "c4", "b2", "e7")
"""The free parameters of such a pair, taken as printed."""


def _tree(*subtrees: Tree) -> Tree:
    return 0, tuple(sorted(subtrees))


LEAF = _tree()
CHAIN2 = _tree(LEAF)
CHAIN3 = _tree(CHAIN2)
CHERRY = _tree(LEAF, LEAF)
WEIGHT_TREES = (
    CHERRY,
    _tree(LEAF, LEAF, LEAF),
    _tree(LEAF, CHAIN2),
    _tree(LEAF, LEAF, LEAF, LEAF),
    _tree(LEAF, LEAF, CHAIN2),
    _tree(CHAIN2, CHAIN2),
    _tree(LEAF, CHERRY),
    _tree(LEAF, CHAIN3),
)
"""The trees of order up to 5 whose root has several branches: sum_i b_i a_ij = b_j (1 - c_j) implies the others."""
ESTIMATE_TREES = tuple(tree for order in (2, 3, 4) for tree in trees(order))
"""Those of the embedded weights' order: they determine these weights, and two coefficients more."""


def _table(values: Sequence[Any]) -> tuple[list[list[Any]], list[Any], list[Any]]:
    """The rows of a, the weights b and the estimate e that follow from the printed numbers, in any arithmetic."""
    v = dict(zip(PRINTED, values, strict=True))
    b = [v[f"b{i}"] for i in range(2, 7)]
    estimate = [v[f"e{i}"] for i in range(2, 8)]
    rows: list[list[Any]] = [[], [v["c2"]]]
    for i in range(3, 7):
        row = [v[f"a{i}{j}"] for j in range(2, i)]
        rows.append([(v[f"c{i}"] if i < 6 else 1) - sum(row[1:], row[0]), *row])
    b = [1 - sum(b[1:], b[0]), *b]
    return [*rows, b], [*b, 0], [0 - sum(estimate[1:], estimate[0]), *estimate]


def _conditions(values: Sequence[Any]) -> list[Any]:
    """The first column's simplifying assumption, the rest of order 5 for b, and order 4 for the embedded weights."""
    rows, b, estimate = _table(values)
    nodes = [0, *(sum(row[1:], row[0]) for row in rows[1:])]
    columns = [[(b[i], rows[i][j]) for i in range(j + 1, 6)] for j in range(5)]
    sums = [sum((weight * a for weight, a in column[1:]), column[0][0] * column[0][1]) for column in columns]
    assumption = [total - b[j] * (1 - nodes[j]) for j, total in enumerate(sums)]
    stages = ElementaryWeights([[*row, *[0] * (7 - len(row))] for row in rows])
    weights = [stages.weight(b, tree) * density(tree) - 1 for tree in WEIGHT_TREES]
    return [*assumption, *weights, *(stages.weight(estimate, tree) for tree in ESTIMATE_TREES)]


def _tableau() -> Tableau:
    names = list(PRINTED)
    kept = [names.index(name) for name in KEPT]
    values = refined("tsitouras54", _conditions, tuple(PRINTED.values()), kept)
    rows, b, estimate = _table(values)
    weights = tuple(weight - error for weight, error in zip(b, estimate, strict=True))
    return Tableau(
        name="tsitouras54",
        order=5,
        source="Tsitouras 2011, Comput. Math. Appl. 62, 770",
        a=tuple(map(tuple, rows)),
        b=(*b[:-1], Q(0)),
        embedded=(Embedded(4, weights),),
        family="embedded",
        aliases=("tsit5", "tsitouras5"),
    )


TSITOURAS54 = _tableau()

CALVO = {
    "c2": "2/15", "c3": "1/5", "c4": "3/10", "c5": "14/25", "c6": "19/25", "c7": "35226607/35688279",
    "a32": "3/20", "a43": "9/40",
    "a52": "-60129073/52624712", "a53": "957436434/1378352377", "a54": "83886832/147842441",
    "a62": "111022885/25716487", "a63": "108046682/101167669", "a64": "-141756746/36005461",
    "a65": "73139862/60170633",
    "a72": "-49252809/6452555", "a73": "-381680111/51572984", "a74": "879269579/66788831",
    "a75": "-90453121/33722162", "a76": "111179552/157155827",
    "a82": "-100523239/10677940", "a83": "-265574846/27330247", "a84": "317978411/18988713",
    "a85": "-124494385/35453627", "a86": "86822444/100138635", "a87": "-12873523/724232625",
    "b3": "57513011/201864250", "b4": "15587306/354501571", "b5": "71783021/234982865", "b6": "29672000/180480167",
    "b7": "65567621/127060952", "b8": "-79074570/210557597",
    "d3": "59452991/116050448", "d4": "-28398517/122437738", "d5": "56673824/137010559", "d6": "68003849/426673583",
    "d7": "7097631/37564021", "d8": "-71226429/583093742", "d9": "1/20",
}  # fmt: skip
"""d are the embedded weights; what is printed of the first column follows from the other ones."""
CALVO_KEPT = ("c2", "c3", "c4", "c5", "c6", "c7", "a32", "a43", "a54", "d9")
"""The nodes and the other free parameters of such a pair, taken as printed."""


def _calvo_table(values: Sequence[Any]) -> tuple[list[list[Any]], list[Any], list[Any]]:
    """The rows of a, the weights b and the embedded ones that follow from the printed numbers, in any arithmetic."""
    v = dict(zip(CALVO, values, strict=True))
    rows: list[list[Any]] = [[], [v["c2"]]]
    for i in range(3, 9):
        row = [v.get(f"a{i}{j}", 0) for j in range(2, i)]
        rows.append([(v[f"c{i}"] if i < 8 else 1) - sum(row[1:], row[0]), *row])
    weights = [[0, *(v.get(f"{letter}{j}", 0) for j in range(3, 10))] for letter in "bd"]
    b, embedded = ([1 - sum(others[1:], others[0]), *others] for others in weights)
    return [*rows, b[:-1]], b, embedded


def _calvo_conditions(values: Sequence[Any]) -> list[Any]:
    """Quadratures of stages and of weights, sum_i b_i a_ij = b_j (1 - c_j), and what the orders need besides."""
    rows, b, embedded = _calvo_table(values)
    c = [0, *(sum(row[1:], row[0]) for row in rows[1:])]
    squares, cubes = (_powers(c, k) for k in (2, 3))
    stages = [3 * _dot(row, squares) - cubes[i] for i, row in enumerate(rows[:8]) if i > 3]
    stages += [2 * _dot(row, c) - squares[i] for i, row in enumerate(rows[:8]) if i > 3]
    quadratures = [(k + 1) * _dot(b, _powers(c, k)) - 1 for k in range(1, 6)]
    quadratures += [(k + 1) * _dot(embedded, _powers(c, k)) - 1 for k in range(1, 5)]
    columns = [[row[j] if j < len(row) else 0 for row in rows] for j in range(9)]
    first = [_dot(b, columns[j]) - b[j] * (1 - c[j]) for j in (1, 4, 5, 6)]
    second, third = ([_dot(row, vector) for row in rows] for vector in (columns[1], cubes))
    b1, b2, embedded1 = _times(b, c), _times(b, squares), _times(embedded, c)
    left = [_dot(b1, columns[1]), _dot(b2, columns[1]), _dot(b1, second), 24 * _dot(b1, third) - 1]
    left += [_dot(embedded, columns[1]), _dot(embedded1, columns[1]), _dot(embedded, second)]
    return [*stages, *quadratures, *first, *left, 20 * _dot(embedded, third) - 1]


def _times(first: Sequence[Any], second: Sequence[Any]) -> list[Any]:
    return [x * y for x, y in zip(first, second, strict=False)]


def _powers(values: Sequence[Any], power: int) -> list[Any]:
    return [prod([value] * power) for value in values]


def _dot(first: Sequence[Any], second: Sequence[Any]) -> Any:
    """The sum of products, as far as the shorter one goes."""
    return sum(_times(first, second), 0)


def _calvo() -> Tableau:
    kept = [list(CALVO).index(name) for name in CALVO_KEPT]
    values = refined("calvo_montijano_randez65", _calvo_conditions, tuple(CALVO.values()), kept, slack=263)
    rows, b, embedded = _calvo_table(values)
    return Tableau(
        name="calvo_montijano_randez65",
        order=6,
        source="Calvo, Montijano and Rández 1990, Comput. Math. Appl. 20, 15",
        a=tuple(tuple(Q(x) if isinstance(x, int) else x for x in row) for row in rows),
        b=tuple(Q(x) if isinstance(x, int) else x for x in b),
        embedded=(Embedded(5, tuple(Q(x) if isinstance(x, int) else x for x in embedded)),),
        family="embedded",
        aliases=("calvo65", "cmr6"),
    )


CALVO_MONTIJANO_RANDEZ65 = _calvo()

FAMILY = "embedded"

BOGACKI_SHAMPINE32 = Tableau(
    name="bogacki_shampine32", order=3, source="Bogacki and Shampine 1989, Appl. Math. Lett. 2, 321",
    a=lines("", "1/2", "0 3/4", "2/9 1/3 4/9"),
    b=line("2/9 1/3 4/9 0"),
    embedded=(Embedded(2, line("7/24 1/4 1/3 1/8")),),
    family=FAMILY,
    aliases=("bs32", "bs3", "rk23"),
)  # fmt: skip

FEHLBERG45 = Tableau(
    name="fehlberg45", order=4, source="Fehlberg 1969, NASA Technical Report R-315",
    a=lines(
        "",
        "1/4",
        "3/32      9/32",
        "1932/2197 -7200/2197 7296/2197",
        "439/216   -8         3680/513   -845/4104",
        "-8/27     2          -3544/2565 1859/4104 -11/40",
    ),
    b=line("25/216 0 1408/2565 2197/4104 -1/5 0"),
    embedded=(Embedded(5, line("16/135 0 6656/12825 28561/56430 -9/50 2/55")),),
    family=FAMILY,
    aliases=("rkf45", "fehlberg4"),
)  # fmt: skip

CASH_KARP54 = Tableau(
    name="cash_karp54", order=5, source="Cash and Karp 1990, ACM Trans. Math. Softw. 16, 201",
    a=lines(
        "",
        "1/5",
        "3/40       9/40",
        "3/10       -9/10   6/5",
        "-11/54     5/2     -70/27    35/27",
        "1631/55296 175/512 575/13824 44275/110592 253/4096",
    ),
    b=line("37/378 0 250/621 125/594 0 512/1771"),
    embedded=(Embedded(4, line("2825/27648 0 18575/48384 13525/55296 277/14336 1/4")),),
    family=FAMILY,
    aliases=("cash_karp", "rkck"),
)  # fmt: skip

DORMAND_PRINCE54 = Tableau(
    name="dormand_prince54", order=5, source="Dormand and Prince 1980, J. Comput. Appl. Math. 6, 19",
    a=lines(
        "",
        "1/5",
        "3/40       9/40",
        "44/45      -56/15      32/9",
        "19372/6561 -25360/2187 64448/6561 -212/729",
        "9017/3168  -355/33     46732/5247 49/176  -5103/18656",
        "35/384     0           500/1113   125/192 -2187/6784  11/84",
    ),
    b=line("35/384 0 500/1113 125/192 -2187/6784 11/84 0"),
    embedded=(Embedded(4, line("5179/57600 0 7571/16695 393/640 -92097/339200 187/2100 1/40")),),
    family=FAMILY,
    aliases=("dopri5", "rk45", "dp5"),
)  # fmt: skip

BOGACKI_SHAMPINE54 = Tableau(
    name="bogacki_shampine54", order=5, source="Bogacki and Shampine 1996, Comput. Math. Appl. 32, 15",
    a=lines(
        "",
        "1/6",
        "2/27          4/27",
        "183/1372      -162/343     1053/1372",
        "68/297        -4/11        42/143           1960/3861",
        "597/22528     81/352       63099/585728     58653/366080   4617/20480",
        "174197/959244 -30942/79937 8152137/19744439 666106/1039181 -29421/29068 482048/414219",
        "587/8064      0            4440339/15491840 24353/124800   387/44800    2152/5985     7267/94080",
    ),
    b=line("587/8064 0 4440339/15491840 24353/124800 387/44800 2152/5985 7267/94080 0"),
    embedded=(
        Embedded(4, line("2479/34992 0 123/416 612941/3411720 43/1440 2272/6561 79937/1113912 3293/556956")),
    ),
    family=FAMILY,
    aliases=("bs54", "bs5"),
)  # fmt: skip

FEHLBERG78 = Tableau(
    name="fehlberg78", order=7, source="Fehlberg 1968, NASA Technical Report R-287",
    a=lines(
        "",
        "2/27",
        "1/36       1/12",
        "1/24       0    1/8",
        "5/12       0    -25/16 25/16",
        "1/20       0    0      1/4      1/5",
        "-25/108    0    0      125/108  -65/27    125/54",
        "31/300     0    0      0        61/225    -2/9    13/900",
        "2          0    0      -53/6    704/45    -107/9  67/90     3",
        "-91/108    0    0      23/108   -976/135  311/54  -19/60    17/6  -1/12",
        "2383/4100  0    0      -341/164 4496/1025 -301/82 2133/4100 45/82 45/164 18/41",
        "3/205      0    0      0        0         -6/41   -3/205    -3/41 3/41   6/41",
        "-1777/4100 0    0      -341/164 4496/1025 -289/82 2193/4100 51/82 33/164 12/41 0 1",
    ),
    b=line("41/840 0 0 0 0 34/105 9/35 9/35 9/280 9/280 41/840 0 0"),
    embedded=(Embedded(8, line("0 0 0 0 0 34/105 9/35 9/35 9/280 9/280 0 41/840 41/840")),),
    family=FAMILY,
    aliases=("rkf78", "fehlberg7"),
)  # fmt: skip

ROOT6 = root(6)


def _row(first: str, half_sum: str, half_difference: str, rest: str = "") -> tuple[Coefficient, ...]:
    """A row from the sixth on: columns 4 and 5 are conjugate, half_sum +- half_difference sqrt(6); 2 and 3 are 0."""
    fourth = Q(half_sum) + Q(half_difference) * ROOT6
    fifth = Q(half_sum) - Q(half_difference) * ROOT6
    return (Q(first), Q(0), Q(0), fourth, fifth, *line(rest))


DOP853 = Tableau(
    name="dop853", order=8,
    source="Hairer, Nørsett and Wanner 1993, Solving Ordinary Differential Equations I, II.5 and II.10, dop853.f; "
    "its decimals are those of these numbers",
    a=(
        (),
        ((12 - 2 * ROOT6) / 135,),
        ((6 - ROOT6) / 180, (6 - ROOT6) / 60),
        ((6 - ROOT6) / 120, Q(0), (6 - ROOT6) / 40),
        ((462 + 107 * ROOT6) / 3000, Q(0), (-402 - 197 * ROOT6) / 1000, (168 + 73 * ROOT6) / 375),
        _row("1/27", "4/27", "1/108"),
        _row("19/512", "59/512", "23/1024", "-9/512"),
        _row("13772/371293", "51544/371293", "368/28561", "-5688/371293 3072/371293"),
        _row(
            "58656157643/93983540625", "-331222431026/156639234375", "-8174396021/16065562500",
            "96044563816/3480871875 5682451879168/281950621875 -165125654/3796875",
        ),
        _row(
            "8909899/18653125", "-1130352/734375", "-1137963/2937500",
            "96663078/4553125 2107245056/137915625 -4913652016/147609375 -78894270/3880452869",
        ),
        _row(
            "-20401265806/21769653311", "354216/112847", "94326/112847",
            "-43306765128/5313852383 -20866708358144/1126708119789 14886003438020/654632330667 "
            "35290686222309375/14152473387134411 -1477884375/485066827",
        ),
        _row(
            "39815761/17514443", "-864370/137909", "-960905/551636",
            "-844554132/47026969 8444996352/302158619 -2509602342/877790785 -28388795297996250/3199510091356783 "
            "226716250/18341897 1371316744/2131383595",
        ),
    ),
    b=line(
        "104257/1920240 0 0 0 0 3399327/763840 66578432/35198415 -1674902723/288716400 "
        "54980371265625/176692375811392 -734375/4826304 171414593/851261400 137909/3084480"
    ),
    embedded=(
        Embedded(5, line(
            "72864797/1769693184 0 0 0 0 8670301/1527680 22407563/9386244 -1839305140361/246371328000 "
            "3740185851728885/5654156025964544 -676000805/1389975552 2342627240947/19613062656000 137909/2056320"
        )),
        Embedded(3, line("31/127 0 0 0 0 0 0 0 12675/17272 0 0 3/136")),
    ),
    family=FAMILY,
    aliases=("dormand_prince853", "dop8"),
)  # fmt: skip

EMBEDDED = (
    BOGACKI_SHAMPINE32, FEHLBERG45, CASH_KARP54, DORMAND_PRINCE54, TSITOURAS54, BOGACKI_SHAMPINE54,
    CALVO_MONTIJANO_RANDEZ65, FEHLBERG78, DOP853,
)  # fmt: skip
