"""Pairs of many stages: the coefficients of each are in a file of ``tables``, as they are printed in its source.

A line has its name and its numbers with blanks between: ``a`` a row of the matrix, ``b`` the weights, ``b 8`` embedded
weights of order 8, ``e 8`` the weights b less those, ``c`` the nodes where the source prints them as decimals.

Verner's are those that his page calls most efficient, of 2007 and 2008, which are also Vern6 to Vern9 of
OrdinaryDiffEq.  The printed fractions of Prince and Dormand are near to numbers that satisfy all conditions, which
follow from the nodes; these are here, as P. Stone's worksheets and MRKISS of M. Richling have them.  What Feagin prints
to 60 digits has no exact form; it is what rklib of J. Williams has of his files.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

from compare.methods.kinds.one_step import Embedded, Tableau
from compare.methods.order.algebraic import EXACT, Coefficient, Q, root

__all__ = [
    "FEAGIN10",
    "FEAGIN12",
    "FEAGIN14",
    "MANY_STAGES",
    "PRINCE_DORMAND87",
    "VERNER65",
    "VERNER76",
    "VERNER87",
    "VERNER98",
]

TABLES = Path(__file__).with_name("tables")
ROOT6, SURD = root(6), "*sqrt(6)"


@cache
def _number(word: str) -> Coefficient:
    """A decimal, a fraction, or a multiple of sqrt(6) with or without one before it."""
    if not word.endswith(SURD):
        return Q(word)
    body = word.removesuffix(SURD)
    start = max(body.rfind("+"), body.rfind("-"), 0)
    return Q(body[:start] or 0) + Q(body[start:]) * ROOT6


def _read(name: str, order: int, source: str, aliases: tuple[str, ...], residual: Q = EXACT) -> Tableau:
    lines: dict[str, list[tuple[Any, ...]]] = {}
    for text in (TABLES / f"{name}.txt").read_text(encoding="ascii").splitlines():
        kind, _, numbers = text.partition("  ")
        lines.setdefault(kind.strip(), []).append(tuple(map(_number, numbers.split())))
    (b,) = lines["b"]
    embedded = []
    for kind, rows in lines.items():
        letter, _, lower = kind.partition(" ")
        for row in rows if lower else ():
            weights = row if letter == "b" else tuple(x - y for x, y in zip(b, row, strict=True))
            embedded.append(Embedded(int(lower), weights))
    return Tableau(
        name, order, source, tuple(lines["a"]), b, "embedded", aliases,
        embedded=tuple(embedded), nodes=lines.get("c", [()])[0], residual=residual,
    )  # fmt: skip


VERNER = "Verner 2010, Numer. Algorithms 53, 383; from his page, 'most efficient',"

VERNER65 = _read("verner65", 6, f"{VERNER} RKV65.IIIXb.Efficient.00000144617.081204", ("vern6",))
VERNER76 = _read("verner76", 7, f"{VERNER} RKV76.IIa.Efficient.00001675585.081206", ("vern7",))
VERNER87 = _read("verner87", 8, f"{VERNER} RKV87.IIa.Efficient.000000282866.081208", ("vern8",))
VERNER98 = _read("verner98", 9, f"{VERNER} RKV98.IIa.Efficient.000000349.081209", ("vern9",))

PRINCE_DORMAND87 = _read(
    "prince_dormand87", 8, "Prince and Dormand 1981, J. Comput. Appl. Math. 7, 67, RK8(7)13M", ("rk8713m", "dopri87"),
)  # fmt: skip

FEAGIN10 = _read(
    "feagin10", 10, "Feagin 2007, Proc. IAENG Conf. on Scientific Computing; rk108.txt of his page", ("rk108",),
    residual=Q("1e-56"),
)  # fmt: skip
FEAGIN = "Feagin 2012, Neural Parallel Sci. Comput. 20, 437;"
FEAGIN12 = _read("feagin12", 12, f"{FEAGIN} rk1210.txt of his page", ("rk1210",), residual=Q("2e-55"))
FEAGIN14 = _read("feagin14", 14, f"{FEAGIN} rk1412.txt of his page", ("rk1412",), residual=Q("2e-49"))

MANY_STAGES = (
    VERNER65, VERNER76, VERNER87, VERNER98, PRINCE_DORMAND87, FEAGIN10, FEAGIN12, FEAGIN14,
)  # fmt: skip
