"""Explicit one-step methods, each as printed in its source.

Tables as they are printed: lines of fractions.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.methods.kinds.one_step import Tableau
from compare.methods.order.algebraic import Q, root
from compare.methods.order.refined import refined
from compare.methods.order.rooted_trees import ElementaryWeights, density, trees

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = [
    "BUTCHER6",
    "EULER",
    "EXPLICIT",
    "HEUN",
    "KUTTA3",
    "MIDPOINT",
    "RALSTON",
    "RALSTON3",
    "RALSTON4",
    "RK4",
    "RK4_MISPRINTED",
    "SSPRK3",
    "SSPRK54",
    "SSPRK104",
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

RALSTON3 = Tableau(
    name="ralston3", order=3, source="Ralston 1962, Math. Comp. 16, 431",
    a=lines("", "1/2", "0 3/4"),
    b=line("2/9 1/3 4/9"),
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

ROOT5 = root(5)

RALSTON4 = Tableau(
    name="ralston4", order=4, source="Ralston 1962, Math. Comp. 16, 431; its decimals are those of these numbers",
    a=(
        (),
        (Q(2, 5),),
        ((-2889 + 1428 * ROOT5) / 1024, (3785 - 1620 * ROOT5) / 1024),
        ((-3365 + 2094 * ROOT5) / 6040, (-975 - 3046 * ROOT5) / 2552, (467040 + 203968 * ROOT5) / 240845),
    ),
    b=(
        (263 + 24 * ROOT5) / 1812, (125 - 1000 * ROOT5) / 3828, (3426304 + 1661952 * ROOT5) / 5924787,
        (30 - 4 * ROOT5) / 123,
    ),
)  # fmt: skip

SSPRK54_PRINTED = {
    "b10": "0.391752226571890", "a21": "0.555629506348765", "b21": "0.368410593050371", "a32": "0.379898148511597",
    "a43": "0.821920045606868", "a52": "0.517231671970585", "a53": "0.096059710526147", "b54": "0.226007483236906",
}  # fmt: skip


def _convex_combinations(values: Sequence[Any]) -> tuple[list[list[Any]], list[Any]]:
    """Matrix and weights of y_i = sum_k alpha_ik y_k + beta_ik h f(y_k), alpha_i0 the rest to 1.

    alpha = C beta, but for the first stage and the last slope: C is the optimal coefficient, to which they are equal.
    """
    b10, a21, b21, a32, a43, a52, a53, b54 = values
    rows: list[list[Any]] = [[0] * 5, [b10, 0, 0, 0, 0]]
    for i, alpha in ((2, a21), (3, a32), (4, a43)):
        rows.append([alpha * entry for entry in rows[-1]])
        rows[i][i - 1] = alpha * (b21 / a21)
    weights = [a52 * two + a53 * three + (1 - a52 - a53) * four for two, three, four in zip(*rows[2:], strict=True)]
    weights[3] = weights[3] + a53 * (b21 / a21)
    weights[4] = weights[4] + b54
    return rows, weights


def _ssprk54_conditions(values: Sequence[Any]) -> list[Any]:
    """Order 4 for what is printed, and what the entries of its Butcher array are."""
    combinations, entries = values[:8], values[8:]
    rows, weights = _convex_combinations(combinations)
    stages = ElementaryWeights(rows)
    order = [stages.weight(weights, tree) * density(tree) - 1 for k in range(1, 5) for tree in trees(k)]
    derived = _entries(rows, weights)
    return [*order, *(entry - value for entry, value in zip(entries, derived, strict=True))]


def _entries(rows: Sequence[Sequence[Any]], weights: Sequence[Any]) -> list[Any]:
    """The entries that do not stand among the printed numbers; the first weight is what the others leave of 1."""
    return [*(entry for i, row in enumerate(rows) for entry in row[:i] if i > 1), *weights[1:]]


def _ssprk54() -> Tableau:
    printed = tuple(SSPRK54_PRINTED.values())
    derived = [f"{float(entry):.15f}" for entry in _entries(*_convex_combinations([Q(text) for text in printed]))]
    values = refined("ssprk54", _ssprk54_conditions, (*printed, *derived), slack=9)
    first, entries = values[0], values[8:]
    b: Any = entries[9:]
    return Tableau(
        name="ssprk54",
        order=4,
        source="Spiteri and Ruuth 2002, SIAM J. Numer. Anal. 40, 469",
        a=((), (first,), entries[:2], entries[2:5], entries[5:9]),
        b=(1 - sum(b[1:], b[0]), *b),
        aliases=("ssp54",),
    )


SSPRK54 = _ssprk54()

SSPRK104 = Tableau(
    name="ssprk104", order=4, source="Ketcheson 2008, SIAM J. Sci. Comput. 30, 2113",
    a=(
        *lines("", "1/6", "1/6 1/6", "1/6 1/6 1/6", "1/6 1/6 1/6 1/6"),
        *((Q(1, 15),) * 5 + (Q(1, 6),) * i for i in range(5)),
    ),
    b=(Q(1, 10),) * 10,
    aliases=("ssp104",),
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
    EULER, MIDPOINT, HEUN, RALSTON, KUTTA3, RALSTON3, SSPRK3, RK4, THREE_EIGHTHS, RALSTON4, SSPRK54, SSPRK104,
    BUTCHER6, RK4_MISPRINTED,
)  # fmt: skip
