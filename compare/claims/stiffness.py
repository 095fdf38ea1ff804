"""The order that is left on a stiff equation: on Prothero and Robinson's, with steps far longer than 1/|lam|.

An implicit Runge-Kutta method of order p falls to about the order of its stages there (A. Prothero and A. Robinson,
Mathematics of Computation 28 (1974), 145; E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, Springer
1996, section IV.15).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from compare.claims.engine import Steps, Whole, chosen
from compare.claims.findings import reaches
from compare.claims.frames import Exhausted, MisuseError, Scene
from compare.claims.order import measured
from compare.claims.verdicts import Verdict
from reference.problems.families import stiff_problem

if TYPE_CHECKING:
    from compare.claims.candidate import Candidate
    from compare.claims.engine import Marcher
    from compare.claims.order import Order
    from compare.claims.verdicts import Standing

__all__ = ["stiff"]

RATE = -10_000_000
"""The rate of the approach to the smooth solution."""
T_END, COUNTS = 2.0, (12, 20, 28, 44, 60, 92, 124)
"""Of the march; quarters of these numbers are odd, since with R(infinity) = -1 errors of two steps cancel."""
LARGE = 1.0
"""A relative error beyond this is a march that has left the solution."""


def stiff(candidate: Candidate, claim: float) -> Verdict:
    """On the claim that an order is left on a stiff equation."""
    words = f"order {claim:g} on a stiff equation (Prothero and Robinson's, lam = {RATE:g})"
    scene = Scene(stiff_problem(RATE))
    if not (candidate.form.whole or candidate.form.timed):
        told = "not measured: that equation depends on the time, which the step is not given"
        return Verdict.of("stiff", words, "open", told, ("a step (f, t, y, h) would decide it",))
    try:
        candidate.hold(scene)
        found = measured(_marcher(candidate, scene), T_END, COUNTS, until=-math.inf)
    except (MisuseError, Exhausted) as error:
        return Verdict.of("stiff", words, "fails", f"it does not come through: {str(error).rstrip('.')}", UNSTABLE)
    if not found.cells[0].error <= LARGE:
        told = f"error {found.cells[0].error:.0e} with h = {found.cells[0].h:g}"
        return Verdict.of("stiff", words, "fails", told, UNSTABLE)
    return Verdict.of("stiff", words, *_standing(found, claim))


UNSTABLE = ("it is explicit, not stable there, or its inner iteration does not converge where h lam is large",)


def _standing(found: Order, claim: float) -> tuple[Standing, str]:
    return reaches(found, claim), found.words


def _marcher(candidate: Candidate, scene: Scene) -> Marcher:
    if candidate.form.whole:
        return Whole(candidate, scene)
    return Steps(chosen(candidate, scene, T_END / COUNTS[0])[0], scene)
