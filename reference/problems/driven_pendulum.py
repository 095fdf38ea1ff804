"""The driven and damped pendulum: periodic or chaotic, as the drive is."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from reference.declaration import StateSpace
from reference.flow_families import flow_family
from reference.flow_problem import FlowProblem

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.arithmetic.protocols import Arithmetic

__all__ = ["FAMILY", "DrivenPendulum"]


class DrivenPendulum(FlowProblem):
    """theta'' = -theta'/q - sin theta + g cos(frequency t), with q = 2, g = 1.15 and the frequency 2/3.

    G. L. Baker and J. P. Gollub, Chaotic Dynamics, Cambridge University Press 1990, chapter 3: chaotic at g = 1.15 and
    1.5, and periodic at 0.9, 1.07, 1.35 and 1.45.  The book names no one start; here it hangs at rest.
    """

    name = "driven-pendulum"
    space = StateSpace(
        positions=("theta",),
        velocities=("omega",),
        angles=("theta",),
        odd=None,
        along=None,
        scale="largest",
        independent="",
    )
    autonomous: ClassVar[bool] = False
    numbers: ClassVar[dict[str, str]] = {"g": "1.15", "q": "2", "frequency": "2/3"}
    begins = ("0", "0")
    equation = "theta'' = -theta'/q - sin(theta) + g cos(frequency t)"
    invariants = ()
    t_end = 50.0
    source = "G. L. Baker and J. P. Gollub, Chaotic Dynamics, 1990, chapter 3"
    difficulty = "average: depends on the time, and chaotic at g = 1.15 and 1.5"
    meanings: ClassVar[dict[str, str]] = {
        "g": "strength of the drive",
        "q": "quality, the larger the less damped",
        "frequency": "angular frequency of the drive",
        "theta": "angle from the vertical",
        "omega": "angular velocity",
    }
    units: ClassVar[dict[str, str]] = {"theta": "rad", "omega": "rad"}

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        theta, omega = y
        return omega, p["g"] * m.cos(p["frequency"] * t) - omega / p["q"] - m.sin(theta)


FAMILY = flow_family(DrivenPendulum, "the driven and damped pendulum")
