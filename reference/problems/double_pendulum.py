"""The planar double pendulum of two points on massless rods, its angles counted on from turn to turn."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from reference.declaration import Invariant, StateSpace
from reference.flow_families import flow_family
from reference.flow_problem import HamiltonianFlow

if TYPE_CHECKING:
    from collections.abc import Sequence

    from reference.arithmetic.protocols import Arithmetic

__all__ = ["FAMILY", "DoublePendulum"]


class DoublePendulum(HamiltonianFlow):
    """The planar double pendulum, its angles from the vertical.

    Lagrangian of L. D. Landau and E. M. Lifshitz, Mechanics, Pergamon 1976, section 5, problem 1, here by its
    Hamiltonian


    H = (m2 l2^2 p1^2 + (m1 + m2) l1^2 p2^2 - 2 m2 l1 l2 p1 p2 cos d)/(2 m2 l1^2 l2^2 (m1 + m2 sin^2 d))
    - (m1 + m2) g l1 cos theta1 - m2 g l2 cos theta2, with d = theta1 - theta2.

    Masses of 1 kg, rods of 1 m, g = 9.8 m/s^2 and the release from rest at 120 and -10 degrees are those of the example
    "The double pendulum problem" of Matplotlib, after M. S. Wheatland.  At this energy the motion is chaotic
    (T. Shinbrot et al., American Journal of Physics 60 (1992), 491).
    """

    name = "double-pendulum"
    space = StateSpace(
        positions=("theta1", "theta2"),
        momenta=("p1", "p2"),
        angles=("theta1", "theta2"),
        odd=("p1", "p2"),
        along=None,
        scale="units",
        independent="s",
    )
    numbers: ClassVar[dict[str, str]] = {"g": "9.8", "l1": "1", "l2": "1", "m1": "1", "m2": "1"}
    begins = ("2*pi/3", "-pi/18", "0", "0")
    equation = (
        "H = (m2 l2^2 p1^2 + (m1 + m2) l1^2 p2^2 - 2 m2 l1 l2 p1 p2 cos d)/(2 m2 l1^2 l2^2 (m1 + m2 sin^2 d))"
        " - (m1 + m2) g l1 cos theta1 - m2 g l2 cos theta2, d = theta1 - theta2"
    )
    invariants = (Invariant("energy", ("Energy", "(E - E0)/E0"), "start"),)
    t_end = 20.0
    source = "L. D. Landau and E. M. Lifshitz, Mechanics, 1976, section 5, problem 1; T. Shinbrot et al., 1992"
    difficulty = "higher: chaotic, of a Hamiltonian that does not split"
    meanings: ClassVar[dict[str, str]] = {
        "g": "acceleration of gravity",
        "l1": "length of the first rod",
        "l2": "length of the second rod",
        "m1": "first mass",
        "m2": "second mass",
        "theta1": "angle of the first rod from the vertical",
        "theta2": "angle of the second rod from the vertical",
        "p1": "momentum of the first angle",
        "p2": "momentum of the second angle",
    }
    units: ClassVar[dict[str, str]] = {
        "theta1": "rad",
        "theta2": "rad",
        "p1": "kg m^2/s",
        "p2": "kg m^2/s",
    }

    def hamiltonian(self, m: Arithmetic, t: Any, q: Sequence[Any], p: Sequence[Any], c: dict[str, Any]) -> Any:
        del t
        (theta1, theta2), (p1, p2) = q, p
        g, l1, l2, m1, m2 = (c[name] for name in ("g", "l1", "l2", "m1", "m2"))
        sine, cosine = m.sin(theta1 - theta2), m.cos(theta1 - theta2)
        twice = m2 * l2 * l2 * (p1 * p1) + (m1 + m2) * l1 * l1 * (p2 * p2) - 2 * m2 * l1 * l2 * (p1 * p2 * cosine)
        kinetic = twice / ((m1 + m2 * (sine * sine)) * (2 * m2 * l1 * l1 * l2 * l2))
        return kinetic - (m1 + m2) * g * l1 * m.cos(theta1) - m2 * g * l2 * m.cos(theta2)

    def derivative(self, m: Arithmetic, t: Any, y: Sequence[Any], p: dict[str, Any]) -> tuple[Any, ...]:
        """By the velocities: p1' and p2' differ from the torques of gravity by m2 l1 l2 v1 v2 sin d."""
        del t
        theta1, theta2, p1, p2 = y
        g, l1, l2, m1, m2 = (p[name] for name in ("g", "l1", "l2", "m1", "m2"))
        sine, cosine = m.sin(theta1 - theta2), m.cos(theta1 - theta2)
        share = 1 / (m1 + m2 * (sine * sine))
        v1 = (p1 / (l1 * l1) - (p2 * cosine) / (l1 * l2)) * share
        v2 = (p2 * ((m1 + m2) / (m2 * l2 * l2)) - (p1 * cosine) / (l1 * l2)) * share
        drawn = m2 * l1 * l2 * (v1 * v2 * sine)
        return v1, v2, -drawn - (m1 + m2) * g * l1 * m.sin(theta1), drawn - m2 * g * l2 * m.sin(theta2)


FAMILY = flow_family(DoublePendulum, "the double pendulum", varied="theta1")
