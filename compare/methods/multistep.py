"""Multistep methods, their coefficients derived; each starts by RK4."""

from __future__ import annotations

from typing import TYPE_CHECKING

from compare.methods.explicit import RK4
from compare.methods.kinds.multistep import LinearMultistep, PredictorCorrector
from compare.methods.kinds.stormer import StormerCowell
from compare.methods.order.algebraic import Q
from compare.methods.order.multistep import adams, backward_differences, stormer

if TYPE_CHECKING:
    from compare.methods.kinds.protocol import Method

__all__ = ["BDF2", "MULTISTEP", "TWO_STEP_LEAPFROG"]

BASHFORTH = "Bashforth and Adams 1883, Theories of Capillary Action, Cambridge"
MOULTON = "Moulton 1926, New Methods in Exterior Ballistics, Chicago"
STORMER = "Stoermer 1907, Arch. Sci. Phys. Nat. 24, 5"
COWELL = "Cowell and Crommelin 1910, Greenwich Observations for 1909, appendix"

BASHFORTH_METHODS = tuple(
    LinearMultistep(
        f"adams_bashforth{k}", k, BASHFORTH, *adams(k, implicit=False), starter=RK4, aliases=(f"ab{k}",)
    )
    for k in range(2, 6)
)  # fmt: skip

MOULTON_METHODS = tuple(
    LinearMultistep(
        f"adams_moulton{k + 1}", k + 1, MOULTON, *adams(k, implicit=True), starter=RK4, aliases=(f"am{k + 1}",)
    )
    for k in range(2, 5)
)  # fmt: skip

TRAPEZOID = LinearMultistep("adams_moulton2", 2, MOULTON, *adams(1, implicit=True), starter=RK4)

PREDICTOR_CORRECTORS = tuple(
    PredictorCorrector(f"abm{k}", k, MOULTON, predictor, corrector, aliases=(f"adams_pece{k}",))
    for k, predictor, corrector in zip(
        range(2, 6), BASHFORTH_METHODS, (TRAPEZOID, *MOULTON_METHODS), strict=True
    )
)  # fmt: skip

BDF2 = LinearMultistep(
    "bdf2", 2, "Curtiss and Hirschfelder 1952, Proc. Natl. Acad. Sci. USA 38, 235", *backward_differences(2),
    starter=RK4, aliases=("gear2",),
)  # fmt: skip

TWO_STEP_LEAPFROG = LinearMultistep(
    name="two_step_leapfrog", order=2, source="Nystroem 1925, Acta Soc. Sci. Fenn. 50 (13), 1",
    alpha=(Q(-1), Q(0), Q(1)),
    beta=(Q(0), Q(2), Q(0)),
    starter=RK4,
    aliases=("explicit_midpoint_multistep", "nystroem2"),
)  # fmt: skip

STORMER_COWELL = (
    *(StormerCowell(f"stormer{k}", k, STORMER, stormer(k, implicit=False), velocity=k, starter=RK4) for k in (3, 4, 5)),
    StormerCowell("cowell4", 4, COWELL, stormer(2, implicit=True), velocity=4, starter=RK4, aliases=("numerov",)),
    StormerCowell("cowell5", 5, COWELL, stormer(4, implicit=True), velocity=5, starter=RK4),
)  # fmt: skip

MULTISTEP: tuple[Method, ...] = (
    *BASHFORTH_METHODS,
    *MOULTON_METHODS,
    *PREDICTOR_CORRECTORS,
    BDF2,
    TWO_STEP_LEAPFROG,
    *STORMER_COWELL,
)
