"""Processed splittings: a cheap kernel in every step, and a processor that is applied where a march begins and ends.

They are printed to 16 digits; the free coefficients are kept as printed, the others moved to the zero of the order
conditions beside them.
"""

from __future__ import annotations

from typing import Any, TypeAlias

from compare.methods.order.algebraic import Q
from compare.methods.order.refined import palindrome, proven_processed

__all__ = ["PROCESSED", "PROCESSED4", "PROCESSED6", "PROCESSED764"]

REIN = "Rein 2020, Mon. Not. R. Astron. Soc. 492, 5413"

Flows: TypeAlias = tuple[tuple[str, Any], ...]


def _processor(first: str, pairs: tuple[Any, ...], gradients: tuple[Any, ...] = ()) -> Flows:
    """Weights of drifts and kicks in turn, and of the gradient with each kick."""
    kinds = {"drift": ("drift", "kick"), "kick": ("kick", "drift")}[first]
    flows = [(kinds[i % 2], weight) for i, weight in enumerate(pairs)]
    beside = iter(gradients)
    return tuple(
        flow
        for kind, weight in flows
        for flow in ((kind, weight), *((("gradient", next(beside)),) if gradients and kind == "kick" else ()))
    )


def _modified_leapfrog(y1: Any, z1: Any, y2: Any, z2: Any, y3: Any, z3: Any) -> tuple[Flows, Flows]:
    """Between half drifts a kick by the modified potential of Takahashi and Imada."""
    kernel = ("drift", Q(1, 2)), ("kick", Q(1)), ("gradient", Q(1, 24)), ("drift", Q(1, 2))
    return _processor("kick", (y1, z1, y2, z2, y3, z3)), kernel


PROCESSED4 = proven_processed(
    "processed4", 4, f"Blanes, Casas and Ros 1999, SIAM J. Sci. Comput. 21, 711; {REIN}", _modified_leapfrog,
    (
        "0.1859353996846055", "0.8749306155955435",
        "0.0731969797858114", "-0.237106680151022",
        "-0.1576624269298081", "-0.5363539829039128",
    ),
    kept=(4, 5), degrees=range(2, 5), implied=0, nystrom=True,
    aliases=("pmlf4",),
)  # fmt: skip


def _three_kicks(a1: Any, b1: Any, c2: Any, *processor: Any) -> tuple[Flows, Flows]:
    """The kernel a1, b1, a2, b2 with its gradient c2, and back; pairs of the processor, then its gradients."""
    half = ("drift", a1), ("kick", b1), ("drift", (1 - 2 * a1) / 2)
    kernel = (*half, ("kick", 1 - 2 * b1), ("gradient", c2), *reversed(half))
    return _processor("drift", processor[:12], processor[12:]), kernel


PROCESSED6 = proven_processed(
    "processed6", 6, f"Blanes, Casas and Ros 2001, Appl. Numer. Math. 39, 245; {REIN}", _three_kicks,
    (
        "-0.0682610383918630", "0.2621129352517028", "0.0164011128160783",
        "0.07943288242455420", "1.3599424487455264",
        "0.02974829169467665", "-0.6505973747535132",
        "-0.7057074964815896", "-0.033542814598338416",
        "0.3190423451260838", "-0.040129915275115030",
        "-0.2869147334299646", "0.044579729809902803",
        "0.564398710666239478150885", "-0.680252073928462652752103",
        "-0.034841228074994859", "0.031675672097525204", "-0.005661054677711889", "0.004262222269023640",
        "0.005", "-0.005",
    ),
    kept=(6, 8, 9, 11, 13, 14, 19, 20), degrees=range(2, 7), implied=9, nystrom=True, slack=459,
    aliases=("pmlf6",),
)  # fmt: skip


def _three_plain_kicks(a1: Any, b1: Any, *processor: Any) -> tuple[Flows, Flows]:
    return _processor("drift", processor), palindrome("drift", (a1, b1, (1 - 2 * a1) / 2, 1 - 2 * b1))


PROCESSED764 = proven_processed(
    "processed764", 4, f"Blanes, Casas and Ros 2000, Celest. Mech. Dyn. Astron. 77, 17; {REIN}", _three_plain_kicks,
    (
        "0.5600879810924619", "1.5171479707207228",
        "-0.3346222298730800", "-1.6218101180868010",
        "1.0975679907321640", "0.0061709468110142",
        "-1.0380887460967830", "0.8348493592472594",
        "0.6234776317921379", "-0.0511253369989315",
        "-1.1027532063031910", "0.5633782670698199",
        "-0.0141183222088869", "-0.5",
    ),
    kept=(3, 13), degrees=range(2, 8), implied=2, generalised=(7, 6, 4), slack=29,
    aliases=("plf764",),
)  # fmt: skip

PROCESSED = (PROCESSED4, PROCESSED764, PROCESSED6)
