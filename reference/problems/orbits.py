"""A numerical state as a point of an exact orbit: its energy gives the amplitude, its place on that orbit the phase.

Phases are counted in periods, amplitudes in the units of the position, both in balls at the precision in force, so that
a difference of 1e-40 is as good as one of 1e-4.  A problem whose orbits are listed here has phase and amplitude errors;
others have not.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from reference.problems.cycloid.orbits import CycloidAngles, CycloidArcs, Linear
from reference.problems.pendulum.orbits import Librations, Rotations, Small
from reference.problems.polar.orbits import PointMassRadii, TunnelRadii

if TYPE_CHECKING:
    from collections.abc import Callable

    from reference.orbits import Orbits
    from reference.problem import Problem

__all__ = ["orbits", "remark"]

KINDS: dict[tuple[str, str], Callable[..., Orbits]] = {
    ("pendulum", "libration"): Librations,
    ("pendulum", "rotation"): Rotations,
    ("pendulum", "rest"): Small,
    ("linear pendulum", ""): Linear,
    ("tautochrone", ""): CycloidAngles,
    ("cycloidal pendulum", ""): CycloidArcs,
    ("cycloid", ""): CycloidArcs,
    ("polar", ""): PointMassRadii,
    ("tunnel", ""): TunnelRadii,
}
"""The orbits of a problem by its name and its motion, where it has more than one kind of them."""
REMARKS = {
    ("pendulum", "separatrix"): "The separatrix has no period, and so neither phase nor amplitude errors.",
    ("pendulum", "rotation"): "A rotation has no amplitude.",
    ("pendulum", "rest"): "At rest there is no phase.",
}


def orbits(problem: Problem) -> Orbits | None:
    """The problem's orbits at the precision in force, or None where phases and amplitudes mean nothing."""
    kind = KINDS.get(_motion(problem))
    return None if kind is None else kind(problem)


def remark(problem: Problem) -> str:
    """What of phase and amplitude the exact motion itself lacks, in a sentence; "" where it has both."""
    motion = _motion(problem)
    unknown = "" if motion in KINDS else f"Phase and amplitude are not defined for the problem {problem.name}."
    return REMARKS.get(motion, unknown)


def _motion(problem: Problem) -> tuple[str, str]:
    return problem.name, getattr(problem, "motion", "")
