"""Splittings of Nyström's kind: made for velocities that are linear in the momenta, where fewer conditions remain."""

from __future__ import annotations

from typing import Any

from compare.methods.order.refined import palindrome, proven_splitting

__all__ = [
    "BLANES_MOAN_SRKN6B",
    "BLANES_MOAN_SRKN11B",
    "BLANES_MOAN_SRKN14A",
    "CALVO_SANZ_SERNA4",
    "MCLACHLAN_ATELA4",
    "NYSTROM",
]


def _mclachlan_atela4(b1: Any, a1: Any, b2: Any, a2: Any, b3: Any, a3: Any) -> tuple[tuple[str, Any], ...]:
    b4, a4 = 1 - (b1 + b2 + b3), 1 - (a1 + a2 + a3)
    weights = (b1, a1, b2, a2, b3, a3, b4, a4)
    return tuple(("drift" if i % 2 else "kick", weight) for i, weight in enumerate(weights))


MCLACHLAN_ATELA4 = proven_splitting(
    "mclachlan_atela4", 4, "McLachlan and Atela 1992, Nonlinearity 5, 541", _mclachlan_atela4,
    (
        "0.134496199277431089", "0.515352837431122936",
        "-0.224819803079420806", "-0.085782019412973646",
        "0.756320000515668291", "0.441583023616466524",
    ),
    kept=(2,), degrees=range(2, 5), nystrom=True,
    aliases=("optimal4",),
)  # fmt: skip


def _calvo_sanz_serna4(b1: Any, g2: Any, b2: Any, g3: Any, b3: Any, g4: Any, b4: Any) -> tuple[tuple[str, Any], ...]:
    """Kicks b_i at the nodes 0, g2, g3, g4, 1."""
    weights = (b1, g2, b2, g3 - g2, b3, g4 - g3, b4, 1 - g4, 1 - (b1 + b2 + b3 + b4))
    return tuple(("drift" if i % 2 else "kick", weight) for i, weight in enumerate(weights))


CALVO_SANZ_SERNA4 = proven_splitting(
    "calvo_sanz_serna4", 4, "Calvo and Sanz-Serna 1993, SIAM J. Sci. Comput. 14, 936", _calvo_sanz_serna4,
    (
        "0.0617588581356263250", "0.2051776615422863869",
        "0.3389780265536433551", "0.6081989431465009739",
        "0.6147913071755775662", "0.4872780668075869657",
        "-0.1405480146593733802",
    ),
    kept=(1, 6), degrees=range(2, 5), nystrom=True,
)  # fmt: skip


def _srkn6b(b1: Any, a1: Any, b2: Any, a2: Any, b3: Any) -> tuple[tuple[str, Any], ...]:
    return palindrome("kick", (b1, a1, b2, a2, b3, (1 - 2 * (a1 + a2)) / 2, 1 - 2 * (b1 + b2 + b3)))


BLANES_MOAN_SRKN6B = proven_splitting(
    "blanes_moan_srkn6b", 4, "Blanes and Moan 2002, J. Comput. Appl. Math. 142, 313, table 3, SRKN6b", _srkn6b,
    (
        "0.0829844064174052", "0.245298957184271",
        "0.396309801498368", "0.604872665711080",
        "-0.0390563049223486",
    ),
    kept=(0, 3, 4), degrees=range(3, 4, 2),
    aliases=("srkn6b",),
)  # fmt: skip


def _srkn11b(
    b1: Any, a1: Any, b2: Any, a2: Any, b3: Any, a3: Any, b4: Any, a4: Any, b5: Any, a5: Any
) -> tuple[tuple[str, Any], ...]:
    b6, a6 = (1 - 2 * (b1 + b2 + b3 + b4 + b5)) / 2, 1 - 2 * (a1 + a2 + a3 + a4 + a5)
    return palindrome("kick", (b1, a1, b2, a2, b3, a3, b4, a4, b5, a5, b6, a6))


BLANES_MOAN_SRKN11B = proven_splitting(
    "blanes_moan_srkn11b", 6, "Blanes and Moan 2002, J. Comput. Appl. Math. 142, 313, table 3, SRKN11b", _srkn11b,
    (
        "0.0414649985182624", "0.123229775946271",
        "0.198128671918067", "0.290553797799558",
        "-0.0400061921041533", "-0.127049212625417",
        "0.0752539843015807", "-0.246331761062075",
        "-0.0115113874206879", "0.357208872795928",
    ),
    kept=(0, 3, 4, 7), degrees=range(3, 6, 2), slack=3, nystrom=True,
    aliases=("srkn11b",),
)  # fmt: skip


def _srkn14a(*values: Any) -> tuple[tuple[str, Any], ...]:
    """a1, b1, a2, b2, ..., b6, a7, of which b7 and a8 follow."""
    a, b = values[::2], values[1::2]
    b7, a8 = (1 - 2 * sum(b[1:], b[0])) / 2, 1 - 2 * sum(a[1:], a[0])
    return palindrome("drift", (*values, b7, a8))


BLANES_MOAN_SRKN14A = proven_splitting(
    "blanes_moan_srkn14a", 6, "Blanes and Moan 2002, J. Comput. Appl. Math. 142, 313, table 3, SRKN14a", _srkn14a,
    (
        "0.0378593198406116", "0.09171915262446165",
        "0.102635633102435", "0.183983170005006",
        "-0.0258678882665587", "-0.05653436583288827",
        "0.314241403071447", "0.004914688774712854",
        "-0.130144459517415", "0.143761127168358",
        "0.106417700369543", "0.328567693746804",
        "-0.00879424312851058",
    ),
    kept=(0, 1, 3, 4, 5, 7, 11), degrees=range(3, 6, 2), slack=6, nystrom=True,
    aliases=("srkn14a",),
)  # fmt: skip

NYSTROM = (
    MCLACHLAN_ATELA4, CALVO_SANZ_SERNA4, BLANES_MOAN_SRKN6B, BLANES_MOAN_SRKN11B, BLANES_MOAN_SRKN14A,
)  # fmt: skip
