"""Symplectic splittings of separable systems, each as printed in its source."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from compare.methods.kinds.one_step import Splitting, compose
from compare.methods.order.algebraic import Q, root, root_of
from compare.methods.order.refined import palindrome, proven_splitting

if TYPE_CHECKING:
    from compare.methods.order.algebraic import Algebraic, Coefficient

__all__ = [
    "BLANES_MOAN4",
    "BLANES_MOAN6",
    "MCLACHLAN_ATELA2",
    "MCLACHLAN_ATELA3",
    "PEFRL",
    "POSITION_VERLET",
    "RUTH3",
    "SUZUKI4",
    "SYMPLECTIC",
    "SYMPLECTIC_EULER",
    "SYMPLECTIC_EULER_ADJOINT",
    "VERLET",
    "YOSHIDA4",
]

SYMPLECTIC_EULER = Splitting(
    name="symplectic_euler", order=1, source="de Vogelaere 1956, Univ. of Notre Dame report 4",
    flows=(("kick", Q(1)), ("drift", Q(1))),
    aliases=("semi_implicit_euler", "euler_cromer", "symplectic_euler_vt"),
)  # fmt: skip

SYMPLECTIC_EULER_ADJOINT = Splitting(
    name="symplectic_euler_adjoint", order=1, source="de Vogelaere 1956, Univ. of Notre Dame report 4",
    flows=(("drift", Q(1)), ("kick", Q(1))),
    aliases=("symplectic_euler_tv",),
)  # fmt: skip

VERLET = Splitting(
    name="verlet", order=2, source="Verlet 1967, Phys. Rev. 159, 98; Swope et al. 1982, J. Chem. Phys. 76, 637",
    flows=(("kick", Q(1, 2)), ("drift", Q(1)), ("kick", Q(1, 2))),
    aliases=(
        "stormer_verlet", "velocity_verlet", "leapfrog", "kick_drift_kick", "pseudo_leapfrog", "lobatto_iiia_iiib2",
        "sbab1",
    ),
)  # fmt: skip

POSITION_VERLET = Splitting(
    name="position_verlet", order=2, source="Tuckerman, Berne and Martyna 1992, J. Chem. Phys. 97, 1990",
    flows=(("drift", Q(1, 2)), ("kick", Q(1)), ("drift", Q(1, 2))),
    aliases=("drift_kick_drift", "saba1"),
)  # fmt: skip

RUTH3 = Splitting(
    name="ruth3", order=3, source="Ruth 1983, IEEE Trans. Nucl. Sci. 30, 2669",
    flows=(
        ("drift", Q(7, 24)), ("kick", Q(2, 3)),
        ("drift", Q(3, 4)), ("kick", Q(-2, 3)),
        ("drift", Q(-1, 24)), ("kick", Q(1)),
    ),
)  # fmt: skip


ROOT2 = root(2)

MCLACHLAN_ATELA2 = Splitting(
    name="mclachlan_atela2", order=2, source="McLachlan and Atela 1992, Nonlinearity 5, 541",
    flows=(("kick", 1 - ROOT2 / 2), ("drift", ROOT2 / 2), ("kick", ROOT2 / 2), ("drift", 1 - ROOT2 / 2)),
    aliases=("optimal2",),
)  # fmt: skip

QUARTIC_ROOT = root_of((-3, 16, -24, 0, 12), 0.9196615230173999)
"""a1 of McLachlan and Atela's method of order 3: 12 r^4 - 24 r^2 + 16 r - 3 = 0."""


def _mclachlan_atela3(a1: Algebraic) -> tuple[tuple[str, Coefficient], ...]:
    """a2 = 1/(4 a1) - a1/2,  a3 = 1 - a1 - a2,  b_i = a_(4-i)."""
    a2 = 1 / (4 * a1) - a1 / 2
    a3 = 1 - a1 - a2
    return ("kick", a3), ("drift", a1), ("kick", a2), ("drift", a2), ("kick", a1), ("drift", a3)


MCLACHLAN_ATELA3 = Splitting(
    name="mclachlan_atela3", order=3, source="McLachlan and Atela 1992, Nonlinearity 5, 541",
    flows=_mclachlan_atela3(QUARTIC_ROOT),
    aliases=("optimal3",),
)  # fmt: skip


def triple_jump(radical: Algebraic | Q) -> tuple[Coefficient, ...]:
    """w, 1 - 2w, w with w = 1/(2 - r), r^(p+1) = 2: raises a symmetric method of order p by two (Yoshida 1990, 4.9)."""
    weight = 1 / (2 - radical)
    return weight, 1 - 2 * weight, weight


def fivefold_jump(radical: Algebraic | Q) -> tuple[Coefficient, ...]:
    """w, w, 1 - 4w, w, w with w = 1/(4 - r), r^(p+1) = 4: the same with steps that stay small (Suzuki 1990, 14)."""
    weight = 1 / (4 - radical)
    return weight, weight, 1 - 4 * weight, weight, weight


YOSHIDA4 = compose(
    POSITION_VERLET, triple_jump(root(2, 3)), name="yoshida4", order=4, source="Yoshida 1990, Phys. Lett. A 150, 262",
    aliases=("forest_ruth", "candy_rozmus4", "triple_jump4"),
)  # fmt: skip

SUZUKI4 = compose(
    VERLET, fivefold_jump(root(4, 3)), name="suzuki4", order=4, source="Suzuki 1990, Phys. Lett. A 146, 319",
    aliases=("fractal4",),
)  # fmt: skip


def _pefrl(xi: Any, lamda: Any, chi: Any) -> tuple[tuple[str, Any], ...]:
    return palindrome("drift", (xi, (1 - 2 * lamda) / 2, chi, lamda, 1 - 2 * (chi + xi)))


PEFRL = proven_splitting(
    "pefrl", 4, "Omelyan, Mryglod and Folk 2002, Comput. Phys. Commun. 146, 188", _pefrl,
    ("0.1786178958448091", "-0.2123418310626054", "-0.06626458266981849"),
    kept=(2,), degrees=range(3, 4, 2),
    aliases=("omelyan_mryglod_folk4", "position_extended_forest_ruth"),
)  # fmt: skip


def _blanes_moan4(a1: Any, b1: Any, a2: Any, b2: Any, a3: Any) -> tuple[tuple[str, Any], ...]:
    return palindrome("kick", (a1, b1, a2, b2, a3, (1 - 2 * (b1 + b2)) / 2, 1 - 2 * (a1 + a2 + a3)))


BLANES_MOAN4 = proven_splitting(
    "blanes_moan4", 4, "Blanes and Moan 2002, J. Comput. Appl. Math. 142, 313, table 2, S6", _blanes_moan4,
    (
        "0.0792036964311957", "0.209515106613362",
        "0.353172906049774", "-0.143851773179818",
        "-0.0420650803577195",
    ),
    kept=(0, 2, 4), degrees=range(3, 4, 2),
    aliases=("bm4", "s6_order4"),
)  # fmt: skip


def _blanes_moan6(
    a1: Any, b1: Any, a2: Any, b2: Any, a3: Any, b3: Any, a4: Any, b4: Any, a5: Any
) -> tuple[tuple[str, Any], ...]:
    b5, a6 = (1 - 2 * (b1 + b2 + b3 + b4)) / 2, 1 - 2 * (a1 + a2 + a3 + a4 + a5)
    return palindrome("kick", (a1, b1, a2, b2, a3, b3, a4, b4, a5, b5, a6))


BLANES_MOAN6 = proven_splitting(
    "blanes_moan6", 6, "Blanes and Moan 2002, J. Comput. Appl. Math. 142, 313, table 2, S10", _blanes_moan6,
    (
        "0.0502627644003922", "0.148816447901042",
        "0.413514300428344", "-0.132385865767784",
        "0.0450798897943977", "0.067307604692185",
        "-0.188054853819569", "0.432666402578175",
        "0.541960678450780",
    ),
    kept=(4,), degrees=range(3, 6, 2), slack=3,
    aliases=("bm6", "s10_order6"),
)  # fmt: skip

SYMPLECTIC = (
    SYMPLECTIC_EULER, SYMPLECTIC_EULER_ADJOINT, VERLET, POSITION_VERLET, MCLACHLAN_ATELA2, RUTH3, MCLACHLAN_ATELA3,
    YOSHIDA4, SUZUKI4, PEFRL, BLANES_MOAN4, BLANES_MOAN6,
)  # fmt: skip
