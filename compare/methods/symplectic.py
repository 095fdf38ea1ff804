"""Symplectic splittings of separable systems, each as printed in its source."""

from __future__ import annotations

from typing import TYPE_CHECKING

from compare.algebraic import Q, root
from compare.method import Splitting, compose

if TYPE_CHECKING:
    from compare.algebraic import Coefficient

__all__ = [
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
    aliases=("stormer_verlet", "velocity_verlet", "leapfrog", "kick_drift_kick"),
)  # fmt: skip

POSITION_VERLET = Splitting(
    name="position_verlet", order=2, source="Tuckerman, Berne and Martyna 1992, J. Chem. Phys. 97, 1990",
    flows=(("drift", Q(1, 2)), ("kick", Q(1)), ("drift", Q(1, 2))),
    aliases=("drift_kick_drift",),
)  # fmt: skip

RUTH3 = Splitting(
    name="ruth3", order=3, source="Ruth 1983, IEEE Trans. Nucl. Sci. 30, 2669",
    flows=(
        ("drift", Q(7, 24)), ("kick", Q(2, 3)),
        ("drift", Q(3, 4)), ("kick", Q(-2, 3)),
        ("drift", Q(-1, 24)), ("kick", Q(1)),
    ),
)  # fmt: skip


def triple_jump(radical: Coefficient) -> tuple[Coefficient, ...]:
    """w, 1 - 2w, w with w = 1/(2 - r), r^(p+1) = 2: raises a symmetric method of order p by two (Yoshida 1990, 4.9)."""
    weight = 1 / (2 - radical)
    return weight, 1 - 2 * weight, weight


def fivefold_jump(radical: Coefficient) -> tuple[Coefficient, ...]:
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

SYMPLECTIC = (SYMPLECTIC_EULER, SYMPLECTIC_EULER_ADJOINT, VERLET, POSITION_VERLET, RUTH3, YOSHIDA4, SUZUKI4)
