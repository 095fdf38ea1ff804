"""Splittings for motions that the drift alone nearly is, and the kicks disturb little, as in a planetary system.

Where the kicks are of a part epsilon of the motion, an error in which two of them meet is of epsilon^2: few of the
order conditions are worth their price.  So each has a generalised order beside its order, which is low.
Drifts are straight lines here, and the gain is that of small forces.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

from compare.methods.kinds.one_step import Splitting
from compare.methods.order.algebraic import Q, root
from compare.methods.order.lyndon_words import DRIFT, KICK, coefficient, exponent
from compare.methods.order.refined import palindrome, proven_splitting
from compare.methods.symplectic import POSITION_VERLET, VERLET

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = [
    "ABA104",
    "ABA864",
    "ABA1064",
    "NEAR_INTEGRABLE",
    "SABA2",
    "SABA3",
    "SABA4",
    "SABAC1",
    "SABAC2",
    "SABAC3",
    "SABAC4",
    "SBAB2",
    "SBAB3",
    "SBAB4",
    "SBABC1",
    "SBABC2",
    "SBABC3",
    "SBABC4",
]

LASKAR_ROBUTEL = "Laskar and Robutel 2001, Celest. Mech. Dyn. Astron. 80, 39"
BLANES = "Blanes, Casas, Farres, Laskar, Makazaga and Murua 2013, Appl. Numer. Math. 68, 58"


def _quadrature(first: str, name: str, weights: Sequence[Any], aliases: tuple[str, ...] = ()) -> Splitting:
    """Kicks with the weights of a formula of Gauss or Lobatto, of n + 1 drifts or kicks, at its nodes."""
    stages = len(weights) - 1
    flows = palindrome(first, weights)
    return Splitting(name, 2, LASKAR_ROBUTEL, flows, aliases, generalised=(2 * stages, 2))


ROOT3, ROOT5, ROOT15, ROOT21 = map(root, (3, 5, 15, 21))

SABA2 = _quadrature("drift", "saba2", ((3 - ROOT3) / 6, Q(1, 2), ROOT3 / 3), ("mclachlan_42",))

SABA3 = _quadrature("drift", "saba3", ((5 - ROOT15) / 10, Q(5, 18), ROOT15 / 10, Q(4, 9)))

SBAB2 = _quadrature("kick", "sbab2", (Q(1, 6), Q(1, 2), Q(2, 3)), ("sexton_weingarten2",))

SBAB3 = _quadrature("kick", "sbab3", (Q(1, 12), (5 - ROOT5) / 10, Q(5, 12), ROOT5 / 5))

SBAB4 = _quadrature("kick", "sbab4", (Q(1, 20), (7 - ROOT21) / 14, Q(49, 180), ROOT21 / 14, Q(16, 45)))


def _saba4(c1: Any, d1: Any, c2: Any) -> tuple[tuple[str, Any], ...]:
    return palindrome("drift", (c1, d1, c2, (1 - 2 * d1) / 2, 1 - 2 * (c1 + c2)))


SABA4_PRINTED = (
    "0.06943184420297371238802675555359524745214", "0.1739274225687269286865319746109997036177",
    "0.2605776340045981552106403648947824089476",
)  # fmt: skip

SABA4 = proven_splitting(
    "saba4", 2, LASKAR_ROBUTEL, _saba4, SABA4_PRINTED,
    degrees=range(3, 8, 2), generalised=(8, 2),
)  # fmt: skip


def _corrected(base: Splitting, name: str, order: int = 4) -> Splitting:
    """Half a corrector before and behind: e h^3 [kick, [drift, kick]], whose e cancels the error epsilon^2 h^2.

    It is linear in the coefficient of drift kick kick, which is 1/6 in the exact flow.
    """
    factors = [exponent(kind, weight) for kind, weight in base.flows]
    half = ("gradient", (coefficient((DRIFT, KICK, KICK), factors) - Fraction(1, 6)) / 2)
    first, last = (base.flows[:1], base.flows[-1:]) if base.fsal else ((), ())
    inner = base.flows[len(first) : len(base.flows) - len(last)]
    flows = (*first, half, *inner, *last, half)
    leading = base.generalised[0] if base.generalised else 2
    return Splitting(name, order, LASKAR_ROBUTEL, flows, nystrom=True, generalised=(leading, 4))


SABAC1 = _corrected(POSITION_VERLET, "sabac1", 2)
SABAC2 = _corrected(SABA2, "sabac2")
SABAC3 = _corrected(SABA3, "sabac3")

SBABC1 = _corrected(VERLET, "sbabc1", 2)
SBABC2 = _corrected(SBAB2, "sbabc2")
SBABC3 = _corrected(SBAB3, "sbabc3")
SBABC4 = _corrected(SBAB4, "sbabc4")


def _sabac4(c1: Any, d1: Any, c2: Any, corrector: Any) -> tuple[tuple[str, Any], ...]:
    half = ("gradient", corrector / 2)
    return half, *_saba4(c1, d1, c2), half


SABAC4 = proven_splitting(
    "sabac4", 4, LASKAR_ROBUTEL, _sabac4, (*SABA4_PRINTED, "0.003396775048208601331532157783492144"),
    degrees=range(3, 8, 2), nystrom=True, generalised=(8, 4),
)  # fmt: skip


def _seven_kicks(a1: Any, b1: Any, a2: Any, b2: Any, a3: Any, b3: Any) -> tuple[tuple[str, Any], ...]:
    return palindrome("drift", (a1, b1, a2, b2, a3, b3, (1 - 2 * (a1 + a2 + a3)) / 2, 1 - 2 * (b1 + b2 + b3)))


ABA104 = proven_splitting(
    "aba104", 4, f"{BLANES}, (10,4)", _seven_kicks,
    (
        "0.04706710064597250612947887637243678556564", "0.1188819173681970199453503950853885936957",
        "0.1847569354170881069247376193702560968574", "0.2410504605515015657441667865901651105675",
        "0.2827060056798362053243616565541452479160", "-0.2732866667053238060543113981664559460630",
    ),
    kept=(0,), degrees=range(3, 10, 2), generalised=(10, 4), slack=40,
)  # fmt: skip

ABA864 = proven_splitting(
    "aba864", 4, f"{BLANES}, (8,6,4)", _seven_kicks,
    (
        "0.0711334264982231177779387300061549964174", "0.183083687472197221961703757166430291072",
        "0.241153427956640098736487795326289649618", "0.310782859898574869507522291054262796375",
        "0.521411761772814789212136078067994229991", "-0.0265646185119588006972121379164987592663",
    ),
    degrees=range(3, 8, 2), generalised=(8, 6, 4),
)  # fmt: skip


def _eight_kicks(a1: Any, b1: Any, a2: Any, b2: Any, a3: Any, b3: Any, a4: Any) -> tuple[tuple[str, Any], ...]:
    b4, a5 = (1 - 2 * (b1 + b2 + b3)) / 2, 1 - 2 * (a1 + a2 + a3 + a4)
    return palindrome("drift", (a1, b1, a2, b2, a3, b3, a4, b4, a5))


ABA1064 = proven_splitting(
    "aba1064", 4, f"{BLANES}, (10,6,4)", _eight_kicks,
    (
        "0.03809449742241219545697532230863756534060", "0.09585888083707521061077150377145884776921",
        "0.1452987161169137492940200726606637497442", "0.2044461531429987806805077839164344779763",
        "0.2076276957255412507162056113249882065158", "0.2170703479789911017143385924306336714532",
        "0.4359097036515261592231548624010651844006",
    ),
    degrees=range(3, 10, 2), generalised=(10, 6, 4), slack=14,
)  # fmt: skip

NEAR_INTEGRABLE = (
    SABA2, SABA3, SABA4, SBAB2, SBAB3, SBAB4, SABAC1, SABAC2, SABAC3, SABAC4, SBABC1, SBABC2, SBABC3, SBABC4,
    ABA104, ABA864, ABA1064,
)  # fmt: skip
