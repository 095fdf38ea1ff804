"""Embedded pairs, each as printed in its source; with a fixed step they are explicit methods like any other.

The pair of Tsitouras, whose coefficients are published as decimals of 16 digits.
"""

from __future__ import annotations

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

__all__ = ["BOGACKI_SHAMPINE32", "CASH_KARP54", "DOP853", "DORMAND_PRINCE54", "EMBEDDED", "FEHLBERG45", "TSITOURAS54"]

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

EMBEDDED = (BOGACKI_SHAMPINE32, FEHLBERG45, CASH_KARP54, DORMAND_PRINCE54, TSITOURAS54, DOP853)
