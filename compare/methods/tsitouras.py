"""The pair of Tsitouras, whose coefficients are published as decimals of 16 digits."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.methods.kinds.one_step import Embedded, Tableau
from compare.methods.order.algebraic import Q
from compare.methods.order.refined import refined
from compare.methods.order.rooted_trees import ElementaryWeights, density, trees

if TYPE_CHECKING:
    from collections.abc import Sequence

    from compare.methods.order.rooted_trees import Tree

__all__ = ["TSITOURAS54"]

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
