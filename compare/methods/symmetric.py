"""Symmetric splittings and compositions with free parameters, by which their authors made the errors small."""

from __future__ import annotations

from typing import Any

from compare.methods.kinds.one_step import Splitting
from compare.methods.order.algebraic import Q, root, root_of
from compare.methods.order.refined import palindrome, proven_composition, proven_splitting
from compare.methods.symplectic import VERLET

__all__ = [
    "MCLACHLAN_S2",
    "MCLACHLAN_S4",
    "MCLACHLAN_S5",
    "MCLACHLAN_SB3A4",
    "MCLACHLAN_SB3A5",
    "MCLACHLAN_SS5",
    "MCLACHLAN_SS9",
    "MCLACHLAN_SS17",
    "OMELYAN2_P2",
    "OMELYAN4_P5",
    "OMELYAN4_V4",
    "OMELYAN4_V5",
    "OMELYAN6_V7",
    "SYMMETRIC",
]

MCLACHLAN = "McLachlan 1995, SIAM J. Sci. Comput. 16, 151"
OMELYAN2002 = "Omelyan, Mryglod and Folk 2002, Comput. Phys. Commun. 146, 188"
OMELYAN2003 = "Omelyan, Mryglod and Folk 2003, Comput. Phys. Commun. 151, 272"

LAMBDA = root_of((-5, 38, -72, 48), 0.1931833275037836)
"""Where the error of two stages is least: 48 r^3 - 72 r^2 + 38 r - 5 = 0."""

MCLACHLAN_S2 = Splitting(
    "mclachlan_s2", 2, f"{MCLACHLAN}, S, m = 2",
    palindrome("kick", (LAMBDA, Q(1, 2), 1 - 2 * LAMBDA)),
    aliases=("mclachlan2", "omelyan2_v2", "minimum_norm2"),
)  # fmt: skip

OMELYAN2_P2 = Splitting(
    "omelyan2_p2", 2, f"{OMELYAN2003}, (31) and (32)",
    palindrome("drift", (LAMBDA, Q(1, 2), 1 - 2 * LAMBDA)),
)  # fmt: skip

ROOT471 = root(471)

MCLACHLAN_S4 = Splitting(
    "mclachlan_s4", 4, f"{MCLACHLAN}, S, m = 4",
    palindrome(
        "kick",
        (
            (642 + ROOT471) / 3924, Q(6, 11), 121 * (12 - ROOT471) / 3924, Q(-1, 22),
            1 - 2 * ((642 + ROOT471) / 3924 + 121 * (12 - ROOT471) / 3924),
        ),
    ),
)  # fmt: skip

ROOT19 = root(19)

MCLACHLAN_S5 = Splitting(
    "mclachlan_s5", 4, f"{MCLACHLAN}, S, m = 5",
    palindrome(
        "kick",
        ((14 - ROOT19) / 108, Q(2, 5), (20 - 7 * ROOT19) / 108, Q(-1, 10), (20 + 8 * ROOT19) / 108, Q(2, 5)),
    ),
    aliases=("mclachlan4",),
)  # fmt: skip

MCLACHLAN_SS5 = proven_composition(
    VERLET, "mclachlan_ss5", 4, f"{MCLACHLAN}, SS, m = 5",
    ("0.28", "0.6254664284676700450"),
    kept=(0,),
)  # fmt: skip

MCLACHLAN_SS9 = proven_composition(
    VERLET, "mclachlan_ss9", 6, f"{MCLACHLAN}, SS, m = 9",
    ("0.1867", "0.55549702371247839916", "0.12946694891347535806", "-0.84326562338773460855"),
    kept=(0,), aliases=("mclachlan6",),
)  # fmt: skip

MCLACHLAN_SS17 = proven_composition(
    VERLET, "mclachlan_ss17", 8, f"{MCLACHLAN}, SS, m = 17",
    (
        "25/194", "0.5815140871052509624", "-0.41017537146985013753", "0.1851469357165877327",
        "-0.40955234342085141934", "0.14440594108001204106", "0.27833550039367965131", "0.31495668391629485789",
    ),
    kept=(0,),
)  # fmt: skip


def _sb3a4(a1: Any, a2: Any, b1: Any) -> tuple[tuple[str, Any], ...]:
    return palindrome("drift", (a1, b1, a2, (1 - 2 * b1) / 2, 1 - 2 * (a1 + a2)))


MCLACHLAN_SB3A4 = proven_splitting(
    "mclachlan_sb3a4", 4, f"{MCLACHLAN}, SB3A, m = 4", _sb3a4,
    ("0.18819521776883821787", "-0.021528551102171551201", "1"),
    kept=(2,), degrees=range(3, 4, 2),
)  # fmt: skip


def _sb3a5(a1: Any, a2: Any, b1: Any, b2: Any) -> tuple[tuple[str, Any], ...]:
    return palindrome("drift", (a1, b1, a2, b2, (1 - 2 * (a1 + a2)) / 2, 1 - 2 * (b1 + b2)))


MCLACHLAN_SB3A5 = proven_splitting(
    "mclachlan_sb3a5", 4, f"{MCLACHLAN}, SB3A, m = 5", _sb3a5,
    ("0.4051886183952522772", "-0.2871440408165240890", "-3/73", "17/59"),
    kept=(2, 3), degrees=range(3, 4, 2),
)  # fmt: skip


def _four_kicks_between(xi: Any, lamda: Any, chi: Any) -> tuple[tuple[str, Any], ...]:
    return palindrome("kick", (xi, (1 - 2 * lamda) / 2, chi, lamda, 1 - 2 * (chi + xi)))


OMELYAN4_V4 = proven_splitting(
    "omelyan4_v4", 4, OMELYAN2002, _four_kicks_between,
    ("0.1644986515575760", "-0.02094333910398989", "1.235692651138917"),
    kept=(2,), degrees=range(3, 4, 2),
    aliases=("vefrl", "velocity_extended_forest_ruth"),
)  # fmt: skip


def _five_stages(first: str, outer: Any, rho: Any, lamda: Any, theta: Any) -> tuple[tuple[str, Any], ...]:
    """outer, rho, lambda, theta, 1/2 - outer - lambda, 1 - 2 (rho + theta) and back, beginning with ``first``."""
    return palindrome(first, (outer, rho, lamda, theta, (1 - 2 * (outer + lamda)) / 2, 1 - 2 * (rho + theta)))


def _velocity5(vartheta: Any, rho: Any, lamda: Any, theta: Any) -> tuple[tuple[str, Any], ...]:
    return _five_stages("kick", vartheta, rho, lamda, theta)


def _position5(rho: Any, vartheta: Any, theta: Any, lamda: Any) -> tuple[tuple[str, Any], ...]:
    return _five_stages("drift", rho, vartheta, theta, lamda)


OMELYAN4_V5 = proven_splitting(
    "omelyan4_v5", 4, f"{OMELYAN2003}, (63) and (71)", _velocity5,
    ("0.08398315262876693", "0.2539785108410595", "0.6822365335719091", "-0.03230286765269967"),
    kept=(0, 3), degrees=range(3, 4, 2),
    aliases=("omf4", "omelyan_4mn5fv"),
)  # fmt: skip

OMELYAN4_P5 = proven_splitting(
    "omelyan4_p5", 4, f"{OMELYAN2003}, (72) and (80)", _position5,
    ("0.2750081212332419", "-0.08442961950707149", "-0.1347950099106792", "0.3549000571574260"),
    kept=(0, 1), degrees=range(3, 4, 2), slack=2,
    aliases=("omelyan_4mn5fp",),
)  # fmt: skip


def _velocity7(b1: Any, a1: Any, b2: Any, a2: Any, b3: Any, a3: Any) -> tuple[tuple[str, Any], ...]:
    return palindrome("kick", (b1, a1, b2, a2, b3, a3, (1 - 2 * (b1 + b2 + b3)) / 2, 1 - 2 * (a1 + a2 + a3)))


OMELYAN6_V7 = proven_splitting(
    "omelyan6_v7", 6, f"{OMELYAN2003}, (83)", _velocity7,
    (
        "0.08333333333333333", "0.2465881872786138",
        "0.3977675859548440", "0.6047073875057809",
        "-0.03933369314462574", "-0.4009869039788007",
    ),
    degrees=range(3, 6, 2), nystrom=True,
    aliases=("omelyan_6mn7fv",),
)  # fmt: skip

SYMMETRIC = (
    MCLACHLAN_S2, OMELYAN2_P2, MCLACHLAN_S4, MCLACHLAN_S5, MCLACHLAN_SS5, MCLACHLAN_SB3A4, MCLACHLAN_SB3A5,
    OMELYAN4_V4, OMELYAN4_V5, OMELYAN4_P5, MCLACHLAN_SS9, OMELYAN6_V7, MCLACHLAN_SS17,
)  # fmt: skip
