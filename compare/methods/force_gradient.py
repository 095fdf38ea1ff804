"""Splittings with the gradient of the squared force: order 4 with positive steps, and higher with few stages.

The modified potential V - e h^2 |grad V|^2 of a kick is its flow and a gradient's.
"""

from __future__ import annotations

from typing import Any

from compare.methods.kinds.one_step import Splitting, merged
from compare.methods.order.algebraic import Q, root
from compare.methods.order.refined import proven_splitting

__all__ = [
    "CHIN4A",
    "CHIN4B",
    "CHIN4C",
    "FORCE_GRADIENT",
    "OMELYAN4_GP3",
    "OMELYAN4_GP5",
    "OMELYAN4_GV3",
    "OMELYAN4_GV4",
    "OMELYAN6_GP5",
    "OMELYAN8_GP11",
]

CHIN = "Chin 1997, Phys. Lett. A 226, 344"
OMELYAN2002 = "Omelyan, Mryglod and Folk 2002, Phys. Rev. E 66, 026701"
OMELYAN2003 = "Omelyan, Mryglod and Folk 2003, Comput. Phys. Commun. 151, 272"


def mirrored(*half: tuple[str, Any]) -> tuple[tuple[str, Any], ...]:
    """Flows up to the middle one, or the middle kick with its gradient, and back."""
    middle = 2 if half[-1][0] == "gradient" else 1
    return merged([*half, *half[-1 - middle :: -1]])


CHIN4A = Splitting(
    "chin4a", 4, f"{CHIN}, 4A", nystrom=True,
    flows=mirrored(("kick", Q(1, 6)), ("drift", Q(1, 2)), ("kick", Q(2, 3)), ("gradient", Q(1, 72))),
    aliases=("forward4a", "suzuki_chin4"),
)  # fmt: skip

ROOT3 = root(3)

CHIN4B = Splitting(
    "chin4b", 4, f"{CHIN}, 4B", nystrom=True,
    flows=mirrored(
        ("drift", (3 - ROOT3) / 6), ("kick", Q(1, 2)), ("gradient", (2 - ROOT3) / 48), ("drift", ROOT3 / 3),
    ),
    aliases=("forward4b",),
)  # fmt: skip

CHIN4C = Splitting(
    "chin4c", 4, f"{CHIN}, 4C", nystrom=True,
    flows=mirrored(
        ("drift", Q(1, 6)), ("kick", Q(3, 8)), ("drift", Q(1, 3)), ("kick", Q(1, 4)), ("gradient", Q(1, 192)),
    ),
    aliases=("forward4c",),
)  # fmt: skip


def _position3(lamda: Any, theta: Any, chi: Any) -> tuple[tuple[str, Any], ...]:
    return mirrored(
        ("drift", theta), ("kick", lamda), ("drift", (1 - 2 * theta) / 2), ("kick", 1 - 2 * lamda), ("gradient", chi)
    )


OMELYAN4_GP3 = proven_splitting(
    "omelyan4_gp3", 4, f"{OMELYAN2003}, (44)", _position3,
    ("0.2470939580390842", "0.08935804763220157", "0.006938106540706989"),
    kept=(0,), degrees=range(3, 4, 2), nystrom=True, slack=2,
    aliases=("omelyan_4mn3f1gp",),
)  # fmt: skip


def _velocity3(theta: Any, lamda: Any, chi: Any) -> tuple[tuple[str, Any], ...]:
    return mirrored(
        ("kick", lamda), ("drift", theta), ("kick", (1 - 2 * lamda) / 2), ("gradient", chi), ("drift", 1 - 2 * theta)
    )


OMELYAN4_GV3 = proven_splitting(
    "omelyan4_gv3", 4, f"{OMELYAN2003}, (37)", _velocity3,
    ("0.2813980611667719", "0.087893686016807", "0.003061810122369770"),
    kept=(0,), degrees=range(3, 4, 2), nystrom=True,
    aliases=("omelyan_4mn3f2gv",),
)  # fmt: skip


def _velocity4(theta: Any, lamda: Any, chi: Any, vartheta: Any, mu: Any) -> tuple[tuple[str, Any], ...]:
    return mirrored(
        ("kick", vartheta), ("gradient", mu), ("drift", theta), ("kick", lamda), ("drift", (1 - 2 * theta) / 2),
        ("kick", 1 - 2 * (lamda + vartheta)), ("gradient", chi),
    )  # fmt: skip


OMELYAN4_GV4 = proven_splitting(
    "omelyan4_gv4", 4, f"{OMELYAN2003}, (48) and (53)", _velocity4,
    (
        "0.1921125277429464", "0.2852162240687091", "0.002427475259663050", "0.05851872613455621",
        "0.0004339598806816256",
    ),
    kept=(0, 1, 2), degrees=range(3, 4, 2), nystrom=True, slack=3,
    aliases=("omelyan_4mn4f2gvg",),
)  # fmt: skip


def _position5(
    rho: Any, vartheta: Any, theta: Any, lamda: Any, xi: Any = None, chi: Any = None, mu: Any = None
) -> tuple[tuple[str, Any], ...]:
    """The gradients xi, chi and mu are beside the inner, the middle and the outer kicks, where there are such."""
    flows = (
        ("drift", rho), ("kick", vartheta), ("gradient", mu), ("drift", theta), ("kick", lamda), ("gradient", xi),
        ("drift", (1 - 2 * (theta + rho)) / 2), ("kick", 1 - 2 * (lamda + vartheta)), ("gradient", chi),
    )  # fmt: skip
    return mirrored(*(flow for flow in flows if flow[1] is not None))


OMELYAN4_GP5 = proven_splitting(
    "omelyan4_gp5", 4, f"{OMELYAN2003}, (72) and (78)", _position5,
    (
        "0.06419108866816235", "0.1518179640276466", "0.1919807940455741", "0.2158369476787619",
        "0.0009628905212024874",
    ),
    kept=(0, 1, 2), degrees=range(3, 4, 2), nystrom=True,
    aliases=("omelyan_4mn5f2gp",),
)  # fmt: skip


def _position5_of_order6(
    rho: Any, vartheta: Any, mu: Any, theta: Any, lamda: Any, chi: Any
) -> tuple[tuple[str, Any], ...]:
    return _position5(rho, vartheta, theta, lamda, chi=chi, mu=mu)


OMELYAN6_GP5 = proven_splitting(
    "omelyan6_gp5", 6, f"{OMELYAN2002}, (50) and (51)", _position5_of_order6,
    (
        "0.1097059723948682", "0.2693315848935301", "0.0008642161339706166", "0.4140632267310831",
        "1.131980348651556", "-0.01324638643416052",
    ),
    degrees=range(3, 6, 2), nystrom=True,
    aliases=("omelyan_6mn5f3gp",),
)  # fmt: skip


def _position11(*values: Any) -> tuple[tuple[str, Any], ...]:
    """a1, b1, c1, ..., a5, b5, c5 and the middle gradient, of which a6 and the middle kick follow."""
    a, b, c = values[0:15:3], values[1:15:3], values[2:15:3]
    flows = [flow for i in range(5) for flow in (("drift", a[i]), ("kick", b[i]), ("gradient", c[i]))]
    a6, middle = (1 - 2 * sum(a[1:], a[0])) / 2, 1 - 2 * sum(b[1:], b[0])
    return mirrored(*flows, ("drift", a6), ("kick", middle), ("gradient", values[15]))


OMELYAN8_GP11 = proven_splitting(
    "omelyan8_gp11", 8, f"{OMELYAN2002}, (53)", _position11,
    (
        "0.41009674738801111928784693005080", "0.0048249309817414952912695842664785",
        "0.00014743936907797528364717244760736",
        "-0.34123345756052780489101697378499", "0.17492394861090375603419001374207",
        "0.00023288450531932545357194967600155",
        "0.25644714021068150492361761631743", "0.29304366370957066164364546204288",
        "0.0061648659635535962497705619884752",
        "0.27765273975812438394100476242641", "0.047448940168459770284238136482511",
        "-0.012307516860831240716732016960034",
        "-0.56926266869753773902939657321159", "-0.0015299863411743974499219652320477",
        "-0.000073296648559126385387017161643798",
        "0.015295860994523744731993293847001",
    ),
    degrees=range(3, 8, 2), nystrom=True,
    aliases=("omelyan_8s11f11gp",),
)  # fmt: skip

FORCE_GRADIENT = (
    CHIN4A, CHIN4B, CHIN4C, OMELYAN4_GP3, OMELYAN4_GV3, OMELYAN4_GV4, OMELYAN4_GP5, OMELYAN6_GP5, OMELYAN8_GP11,
)  # fmt: skip
